/* How threads wait for each other: briefly awake, then asleep. libgomp's own 300 000 spins are 6 to
 * 14 ms in which a thread keeps the processor that the one it waits for may need; two threads
 * beside two busy programs then take twenty times as long as one. It reads its settings before
 * main, in a constructor, so that ours has to run before: libgomp is linked statically where there
 * is one (CMakeLists.txt), since constructors of shared libraries come first. clang's OpenMP reads
 * them at the first parallel loop. What the user sets wins. */
#include <stdlib.h>

/* Spins of 20 to 45 ns: time enough for a thread that has a processor. scripts/bench sets the
 * same. */
static const char spins[] = "5000";
/* Milliseconds, the unit of clang's OpenMP. */
static const char block_time[] = "0";

/* The earliest priority that is not the system's. */
__attribute__((constructor(101))) static void wait_briefly(void)
{
    if (getenv("OMP_WAIT_POLICY"))
        return;
    setenv("GOMP_SPINCOUNT", spins, 0);
    setenv("KMP_BLOCKTIME", block_time, 0);
}
