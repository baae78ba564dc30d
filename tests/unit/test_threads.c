/* How many threads a run uses beside other programs. */
#include "dice.h"

#include <time.h>

#include "base/clock.h"
#include "base/delay.h"
#include "run/threads.h"

/* Ends COUNT windows of SECONDS in which EXCESS threads waited for a processor. */
static void pass(struct threads *threads, int count, double seconds, double excess)
{
    for (int k = 0; k < count; k++)
        threads_adapt(threads, threads->began + seconds, threads->delay + excess * seconds);
}

static void an_idle_machine_keeps_all_threads(void **state)
{
    (void)state;
    struct threads threads = threads_start(4, 10.0, 1.0);
    for (int k = 0; k < 100; k++) {
        pass(&threads, 1, 0.05, 0.05);
        assert_int_equal(threads.now, 4);
    }
    assert_true(fabs(threads_mean(&threads, threads.began) - 4.0) < 1e-9);
}

static void as_many_threads_go_as_wait_for_a_processor(void **state)
{
    (void)state;
    struct threads threads = threads_start(64, 0.0, 0.0);
    pass(&threads, 1, 0.05, 4.1);
    assert_int_equal(threads.now, 60);
    threads = threads_start(2, 0.0, 0.0);
    pass(&threads, 1, 0.05, 0.4);
    assert_int_equal(threads.now, 1);
    pass(&threads, 1, 0.05, 5.0);
    assert_int_equal(threads.now, 1);
}

static void they_come_back_when_none_waits(void **state)
{
    (void)state;
    struct threads threads = threads_start(8, 0.0, 0.0);
    pass(&threads, 1, 0.05, 5.0);
    assert_int_equal(threads.now, 3);
    pass(&threads, 100, 0.05, 0.5);
    assert_int_equal(threads.now, 1);
    pass(&threads, 60, 0.05, 0.0);
    assert_int_equal(threads.now, 8);
}

/* A second run that has reduced its threads as well: one thread of each is never delayed, and two
 * always are. */
static void trials_that_fail_become_rare(void **state)
{
    (void)state;
    struct threads threads = threads_start(2, 0.0, 0.0);
    int trials = 0;
    for (int k = 0; k < 2000; k++) { /* 100 s */
        pass(&threads, 1, 0.05, threads.now == 2 ? 0.7 : 0.0);
        trials += threads.now == 2;
    }
    assert_in_range(trials, 10, 25);
    assert_true(threads_mean(&threads, threads.began) < 1.02);
}

/* Where a step takes longer than a window. */
static void trials_are_rare_where_steps_are_long(void **state)
{
    (void)state;
    struct threads threads = threads_start(2, 0.0, 0.0);
    for (int k = 0; k < 1000; k++)
        pass(&threads, 1, 10.0, threads.now == 2 ? 0.7 : 0.0);
    assert_true(threads_mean(&threads, threads.began) < 1.1);
}

static void a_number_stays_where_delays_are_not_known(void **state)
{
    (void)state;
    struct threads threads = threads_start(2, 0.0, -1.0);
    assert_false(threads_are_due(&threads, 100.0));
    threads = threads_start(1, 0.0, 0.0);
    assert_false(threads_are_due(&threads, 100.0));
    threads = threads_start(2, 0.0, 0.0);
    assert_false(threads_are_due(&threads, 0.01));
    assert_true(threads_are_due(&threads, 0.1));
    assert_true(threads_mean(&threads, 0.0) == 2.0);
}

/* A thread that sleeps is not delayed, but for the moment in which it wakes. */
static void delays_are_those_of_threads_that_could_run(void **state)
{
    (void)state;
    if (delay_seconds() < 0.0)
        skip();
    const double began = clock_seconds(), delayed = delay_seconds();
    const struct timespec pause = {.tv_nsec = 20000000};
    nanosleep(&pause, NULL);
    const double slept = clock_seconds() - began;
    assert_true(delay_seconds() - delayed <= slept);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_idle_machine_keeps_all_threads),
        cmocka_unit_test(as_many_threads_go_as_wait_for_a_processor),
        cmocka_unit_test(they_come_back_when_none_waits),
        cmocka_unit_test(trials_that_fail_become_rare),
        cmocka_unit_test(trials_are_rare_where_steps_are_long),
        cmocka_unit_test(a_number_stays_where_delays_are_not_known),
        cmocka_unit_test(delays_are_those_of_threads_that_could_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
