/* What a run will take: steps, time and memory; from its case and the rate of earlier runs on this
 * machine, or from a pilot, the same case at a coarser resolution. */
#ifndef BOLIDE_FORECAST_H
#define BOLIDE_FORECAST_H

#include "run/estimate.h"
#include "run/run.h"

enum forecast_rate { RATE_ASSUMED, RATE_OF_EARLIER_RUN, RATE_OF_PILOT };

/* What a pilot may take where the user has asked for one, s; see forecast_by_pilot. */
#define FORECAST_PILOT_SECONDS 20.0

struct forecast {
    double steps;
    double seconds, output; /* s: of the steps, of output */
    double before;          /* s: of the case that this one starts from */
    double bytes;           /* of memory, at most at any time */
    int threads;            /* that the time is for, of all ranks */
    enum forecast_rate rate;
    double pilot_resolution, pilot_seconds; /* of the pilot, m and s; 0: there was none */
};

/* The forecast of INPUT, whose ESTIMATE is known, with the ranks, the threads and the table of
 * earlier rates of OPTIONS. */
struct forecast forecast_make(const struct simulation_case *input, const struct estimate *estimate,
                              const struct run_options *options);

/* Collective: runs a pilot of INPUT, with OPTIONS but for the output, and puts what follows from it
 * into FORECAST. It takes at most about SECONDS twice. Where no pilot can be run, FORECAST stays as
 * it is. */
void forecast_by_pilot(const struct simulation_case *input, const struct estimate *estimate,
                       const struct run_options *options, double seconds,
                       struct forecast *forecast);

/* The steps FROM a time, s, to the end of INPUT as the state at its start, fast impacts and
 * explosives let expect, whatever `max_steps`. */
double forecast_steps(const struct simulation_case *input, const struct estimate *estimate,
                      double from);

/* Seconds of the output of a run with the steps and seconds of FORECAST. */
double forecast_output(const struct simulation_case *input, const struct estimate *estimate,
                       const struct forecast *forecast);

/* All that passes until the run has ended, s. */
double forecast_total(const struct forecast *forecast);

/* "about 306 steps, 24 s + 4 s for output on 1 thread (pilot: resolution 0.2 mm, 2 s)" in fresh
 * memory; NULL when it is out. */
char *forecast_text(const struct forecast *forecast);

/* Collective: ERROR_INPUT when the run needs more memory than the machine has. */
struct error *forecast_check_memory(const struct simulation_case *input,
                                    const struct forecast *forecast, const struct ranks *ranks);

#endif
