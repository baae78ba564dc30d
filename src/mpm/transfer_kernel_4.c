/* The loops of transfer.h for particles that reach four nodes along an axis. */
#define WINDOW 4
#include "mpm/transfer_kernel.h"
