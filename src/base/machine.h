/* What the machine has that a run needs. */
#ifndef BOLIDE_MACHINE_H
#define BOLIDE_MACHINE_H

/* Bytes of memory that this process may have: those of the machine, or fewer where its control
 * group or a limit of the process (ulimit -v) says so. INFINITY where the system does not tell. */
double machine_memory(void);

#endif
