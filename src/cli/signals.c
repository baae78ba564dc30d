/* Signals: most that would end the program ask a run to write a checkpoint and stop; SIGUSR1
 * asks for a checkpoint alone. */
#include <signal.h>
#include <time.h>

#include "cli/cli.h"

static const int stopping[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXCPU};

/* Some senders signal twice at once: a terminal and mpirun, `timeout`, an impatient user. Later
 * than this a further signal ends the program without waiting for the checkpoint. */
enum { SECONDS_OF_ONE_REQUEST = 3 };

static volatile sig_atomic_t stop_signal, stop_second, checkpoints_wanted;

static sig_atomic_t now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (sig_atomic_t)time.tv_sec;
}

static void on_stop(int number)
{
    if (!stop_signal) {
        stop_signal = number;
        stop_second = now();
    } else if (number != SIGPIPE && now() - stop_second >= SECONDS_OF_ONE_REQUEST) {
        signal(number, SIG_DFL);
        raise(number); /* blocked until this handler returns */
    }
}

static void on_checkpoint(int number)
{
    (void)number;
    checkpoints_wanted++;
}

/* A signal that the parent ignores stays ignored: under `nohup` a run outlives its terminal. */
static void handle(int number, void (*handler)(int))
{
    struct sigaction action = {.sa_handler = handler, .sa_flags = SA_RESTART}, before;
    sigemptyset(&action.sa_mask);
    if (!sigaction(number, NULL, &before) && before.sa_handler != SIG_IGN)
        sigaction(number, &action, NULL);
}

const volatile sig_atomic_t *signals_catch(void)
{
    for (size_t i = 0; i < COUNT_OF(stopping); i++)
        handle(stopping[i], on_stop);
    if (launch_has_made_us())
        handle(SIGUSR2, on_stop);
    handle(SIGUSR1, on_checkpoint);
    signal(SIGXFSZ, SIG_IGN); /* the write fails instead, and that is reported */
    return &stop_signal;
}

const volatile sig_atomic_t *signals_checkpoints(void) { return &checkpoints_wanted; }

int signals_status(void) { return 128 + stop_signal; }
