/* The ceilings of this machine that a pair loop meets: clock, vector arithmetic, divisions and
 * roots, bandwidth by size of the working set, and records at random places as neighbours are.
 * Compiled for the processor that it is built on.
 *
 * Usage: probe [THREADS]   Bandwidth and records by that many threads at once; 1 by default. */
#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#if defined(__linux__)
#include <sys/mman.h>
#endif

#include "base/clock.h"

#if defined(__AVX512F__)
enum { LANES = 8 };
#elif defined(__AVX__)
enum { LANES = 4 };
#else
enum { LANES = 2 };
#endif
typedef double vector __attribute__((vector_size(LANES * sizeof(double))));

enum { REPEATS = 5, LARGEST = 256 };

static volatile double sink;

static double least(double a, double b) { return a < b ? a : b; }

static double most(double a, double b) { return a > b ? a : b; }

/* Clock: one addition waits for the one before, one cycle each. */
static double cycles_a_second(void)
{
    const long steps = 20 * 1000 * 1000;
    double best = 0.0;
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        unsigned long x = 1, y = (unsigned long)repeat + 3;
        double begin = clock_seconds();
        for (long k = 0; k < steps; k++) {
#define ADD \
    x += y; \
    __asm__ volatile("" : "+r"(x), "+r"(y)) /* else they are folded into one */
            ADD;
            ADD;
            ADD;
            ADD;
#undef ADD
        }
        best = most(best, 4.0 * (double)steps / (clock_seconds() - begin));
        sink = (double)x;
    }
    return best;
}

/* VALUE in all lanes. */
static vector vector_of(double value)
{
    const vector zero = {0.0};
    return zero + value;
}

/* Operations on vectors a second. Twelve chains keep two units of a latency of four busy, and are
 * few enough for registers. */
#define TWELVE(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5) DO(6) DO(7) DO(8) DO(9) DO(10) DO(11)
#define BEGIN(k) vector a##k = start + k;
#define FINISH(k) total += a##k;
#define RATE(name, steps, operation)                                                  \
    static double name(void)                                                          \
    {                                                                                 \
        vector start = vector_of(0.0 * sink), x = start + 0.999999, y = start + 2e-6; \
        double best = 0.0;                                                            \
        for (int repeat = 0; repeat < REPEATS; repeat++) {                            \
            TWELVE(BEGIN)                                                             \
            double begin = clock_seconds();                                           \
            for (long k = 0; k < (steps); k++) {                                      \
                TWELVE(operation)                                                     \
            }                                                                         \
            double seconds = clock_seconds() - begin;                                 \
            vector total = x + y;                                                     \
            TWELVE(FINISH)                                                            \
            best = most(best, 12.0 * (double)(steps) / seconds);                      \
            sink = total[0];                                                          \
        }                                                                             \
        return best;                                                                  \
    }

/* Fused and not: the kernels are compiled without contraction. */
#define FUSE(k) a##k = a##k * x + y;
#define ADD(k) a##k = a##k + y;
#define DIVIDE(k) a##k = x / (a##k + y);
RATE(fused_a_second, 20 * 1000 * 1000L, FUSE)
RATE(sums_a_second, 20 * 1000 * 1000L, ADD)
RATE(quotients_a_second, 1000 * 1000L, DIVIDE)

/* There is no operator for roots; these go through the nearest cache, which takes far less time
 * than they do, and never settle on a number whose root is easy. */
static double roots_a_second(void)
{
    const long steps = 1000 * 1000;
    double value[12 * LANES], best = 0.0;
    for (int k = 0; k < 12 * LANES; k++)
        value[k] = 2.0 + k;
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        double begin = clock_seconds();
        for (long step = 0; step < steps; step++) {
            for (int k = 0; k < 12 * LANES; k++)
                value[k] = sqrt(value[k] + 3.0);
            __asm__ volatile("" : : "r"(value) : "memory"); /* somebody may read them */
        }
        best = most(best, 12.0 * (double)steps / (clock_seconds() - begin));
        sink = value[0];
    }
    return best;
}

/* BYTES on huge pages where the system gives them, zeroed. */
static void *allocate(size_t bytes)
{
    void *memory = aligned_alloc((size_t)2 << 20, bytes);
    if (!memory) {
        fprintf(stderr, "probe: out of memory\n");
        exit(4);
    }
#if defined(MADV_HUGEPAGE)
    madvise(memory, bytes, MADV_HUGEPAGE);
#endif
    memset(memory, 0, bytes);
    return memory;
}

static void read_all(const vector *from, size_t count)
{
    vector a = {0.0}, b = a, c = a, d = a;
    for (size_t k = 0; k < count; k += 4) {
        a += from[k];
        b += from[k + 1];
        c += from[k + 2];
        d += from[k + 3];
    }
    a += b + (c + d);
    sink = a[0];
}

static void write_all(vector *to, size_t count)
{
    const vector value = {1.0};
    for (size_t k = 0; k < count; k++)
        to[k] = value;
    __asm__ volatile("" : : "r"(to) : "memory"); /* somebody may read it */
}

/* The working set of one thread, and records in it in an order without pattern. */
struct area {
    vector *data;
    unsigned *order;
};

/* Adds up RECORDS records of BYTES each, every line of them. */
static void read_records(const struct area *area, size_t records, size_t bytes)
{
    const size_t vectors = bytes / sizeof(vector);
    vector sum = {0.0};
    for (size_t k = 0; k < records; k++) {
        const vector *from = area->data + area->order[k] * vectors;
        for (size_t v = 0; v < vectors; v++)
            sum += from[v];
    }
    sink = sum[0];
}

/* A permutation of 0 .. COUNT - 1. */
static void shuffle(unsigned *order, size_t count)
{
    unsigned long state = 88172645463325252ul;
    for (size_t k = 0; k < count; k++)
        order[k] = (unsigned)k;
    for (size_t k = count - 1; k > 0; k--) {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        size_t other = state % (k + 1);
        unsigned kept = order[k];
        order[k] = order[other];
        order[other] = kept;
    }
}

enum job { READ, WRITE, RECORDS };

/* Bytes a second of all threads together, each with a set of its own of MEGABYTES; RECORD bytes
 * long are RECORDS. */
static double bandwidth(enum job job, struct area *areas, int threads, size_t megabytes,
                        size_t record)
{
    const size_t bytes = megabytes << 20, passes = most(1.0, 512.0 / (double)megabytes);
    double best = INFINITY;
    for (int t = 0; t < threads && job == RECORDS; t++)
        shuffle(areas[t].order, bytes / record);
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        double begin = clock_seconds();
#pragma omp parallel num_threads(threads)
        {
            struct area *own = &areas[omp_get_thread_num()];
            for (size_t pass = 0; pass < passes; pass++)
                if (job == READ)
                    read_all(own->data, bytes / sizeof(vector));
                else if (job == WRITE)
                    write_all(own->data, bytes / sizeof(vector));
                else
                    read_records(own, bytes / record, record);
        }
        best = least(best, clock_seconds() - begin);
    }
    return (double)bytes * (double)passes * threads / best;
}

int main(int argc, char **argv)
{
    const int threads = argc > 1 ? atoi(argv[1]) : 1;
    if (threads < 1 || threads > 1024) {
        fprintf(stderr, "usage: probe [THREADS]\n");
        return 2;
    }
    const double clock = cycles_a_second();
    printf("one core\n");
    printf("  %-40s %8.2f GHz\n", "clock", 1e-9 * clock);
    const struct {
        const char *name;
        double rate, flops;
    } rates[] = {{"multiply-adds", fused_a_second(), 2.0},
                 {"additions or multiplications", sums_a_second(), 1.0},
                 {"divisions (and an addition)", quotients_a_second(), 1.0},
                 {"square roots", roots_a_second(), 1.0}};
    for (size_t k = 0; k < sizeof rates / sizeof *rates; k++)
        printf("  %-40s %8.3f G vectors/s of %d, %.3f a cycle, %.1f Gflop/s\n", rates[k].name,
               1e-9 * rates[k].rate, LANES, rates[k].rate / clock,
               1e-9 * rates[k].rate * LANES * rates[k].flops);

    struct area areas[1024];
    for (int t = 0; t < threads; t++) {
        areas[t].data = allocate((size_t)LARGEST << 20);
        areas[t].order = allocate((((size_t)LARGEST << 20) / 128) * sizeof(unsigned));
    }
    printf("%d thread%s at once, GB/s in all\n", threads, threads == 1 ? "" : "s");
    printf("  %-14s %8s %8s %12s %12s\n", "MB a thread", "read", "write", "128 B random",
           "512 B random");
    for (size_t megabytes = 1; megabytes <= LARGEST; megabytes *= 4)
        printf("  %-14zu %8.1f %8.1f %12.1f %12.1f\n", megabytes,
               1e-9 * bandwidth(READ, areas, threads, megabytes, 0),
               1e-9 * bandwidth(WRITE, areas, threads, megabytes, 0),
               1e-9 * bandwidth(RECORDS, areas, threads, megabytes, 128),
               1e-9 * bandwidth(RECORDS, areas, threads, megabytes, 512));
    for (int t = 0; t < threads; t++) {
        free(areas[t].data);
        free(areas[t].order);
    }
    return 0;
}
