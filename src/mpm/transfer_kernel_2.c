/* The loops of transfer.h for particles that reach two nodes along an axis. */
#define WINDOW 2
#include "mpm/transfer_kernel.h"
