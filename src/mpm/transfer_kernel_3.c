/* The loops of transfer.h for particles that reach three nodes along an axis. */
#define WINDOW 3
#include "mpm/transfer_kernel.h"
