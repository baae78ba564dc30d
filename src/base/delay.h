/* How long the threads of this process have waited for a processor that others had. */
#ifndef BOLIDE_DELAY_H
#define BOLIDE_DELAY_H

/* Seconds that all threads together were ready to run and did not, since the process began; a
 * thread that has ended takes its part away. Negative where the system does not tell (it takes
 * Linux, with schedstats). */
double delay_seconds(void);

#endif
