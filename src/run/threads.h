/* How many threads a run uses while other programs want the same processors. Threads wait for each
 * other many times a step; when one of them has no processor, all wait until the scheduler comes
 * back to it, some milliseconds later. So a run with as many threads as processors is slower beside
 * one busy program than a run with fewer. Results have the same bits with any number of threads,
 * which may therefore change between steps. */
#ifndef BOLIDE_THREADS_H
#define BOLIDE_THREADS_H

#include "base/base.h"

struct threads {
    int most, now;  /* allowed, and used */
    double began;   /* of the present window, s */
    double delay;   /* of all threads until then, s; negative: not known, and the number stays */
    double changed; /* when the number changed, s */
    double raised;  /* when it grew, or the run began, s */
    double pause;   /* before more threads are tried again, s */
    double work;    /* thread-seconds, over all windows */
    double seconds; /* of all windows */
};

/* MOST threads from NOW on; DELAY is delay_seconds(), or negative for a number that stays. */
struct threads threads_start(int most, double now, double delay);

/* True when the window has lasted long enough for threads_adapt. */
bool threads_are_due(const struct threads *threads, double now);

/* Ends the window at NOW, with all threads delayed by DELAY until then, and sets the number for the
 * next one. */
void threads_adapt(struct threads *threads, double now, double delay);

/* The mean number of threads used until NOW. */
double threads_mean(const struct threads *threads, double now);

#endif
