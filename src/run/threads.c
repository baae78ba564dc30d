/* The number of threads follows what the scheduler tells. Delay over time is the mean number of
 * threads that were ready and had no processor: so many are too many. More are tried again after a
 * while. A trial that fails costs one window, and each one that does doubles the time to the
 * next. */
#include "run/threads.h"

static const double WINDOW = 0.05; /* s; short of it a few ticks of the scheduler decide */
static const double SHORTEST = 0.2, LONGEST = 6.4; /* s, between trials */
static const double WINDOWS_A_PAUSE = 16.0; /* at least, where a step takes longer than WINDOW */

/* Delays that every machine has: daemons, interrupts, more of them where threads are many. */
static double tolerated(int threads) { return 0.1 + 0.002 * threads; }

struct threads threads_start(int most, double now, double delay)
{
    return (struct threads){.most = most,
                            .now = most,
                            .began = now,
                            .delay = delay,
                            .changed = now,
                            .raised = now,
                            .pause = SHORTEST};
}

bool threads_are_due(const struct threads *threads, double now)
{
    return threads->most > 1 && threads->delay >= 0.0 && now - threads->began >= WINDOW;
}

static void reduce(struct threads *threads, double now, int excess)
{
    const bool at_once = now - threads->raised <= threads->pause;
    if (threads->changed == threads->raised) /* the first time since they grew */
        threads->pause = at_once ? minimum(2.0 * threads->pause, LONGEST) : SHORTEST;
    threads->now = threads->now - excess > 1 ? threads->now - excess : 1;
    threads->changed = now;
}

/* Half of what is missing: the last step up fails most often, and costs least when it is small. */
static void increase(struct threads *threads, double now)
{
    threads->now += (threads->most - threads->now + 1) / 2;
    threads->changed = threads->raised = now;
}

void threads_adapt(struct threads *threads, double now, double delay)
{
    const double window = now - threads->began;
    const double excess = maximum(delay - threads->delay, 0.0) / window;
    const bool crowded = excess > tolerated(threads->now);
    threads->work += threads->now * window;
    threads->seconds += window;
    threads->began = now;
    threads->delay = delay;
    if (crowded && threads->now > 1)
        reduce(threads, now, excess < 1.5 ? 1 : (int)(excess + 0.5));
    else if (!crowded && threads->now < threads->most &&
             now - threads->changed >= maximum(threads->pause, WINDOWS_A_PAUSE * window))
        increase(threads, now);
}

double threads_mean(const struct threads *threads, double now)
{
    const double window = now - threads->began, seconds = threads->seconds + window;
    return seconds > 0.0 ? (threads->work + threads->now * window) / seconds : threads->now;
}
