/* A case given as text with checks, whose particles tests move by hand. Its last line is
 * `checks:`. */
#ifndef BOLIDE_TEST_STAGE_H
#define BOLIDE_TEST_STAGE_H

#include <stdio.h>
#include <stdlib.h>

#include "model/generate.h"
#include "model/particles/fill.h"
#include "model/solver.h"
#include "model/start_place.h"
#include "populations.h"
#include "run/catalogue.h"
#include "run/checks.h"

struct stage {
    struct simulation_case *input;
    struct ranks ranks;
    struct simulation simulation;
    void *solver;
    struct population population;
    struct totals start;
    struct checks *checks;
    struct check_memory memory[24];
    struct check_results results;
};

/* The members as they are now. */
static inline const struct population *look(struct stage *s)
{
    s->population = simulation_population(&s->simulation);
    return &s->population;
}

static inline void expect_success(struct error *error)
{
    if (error)
        fail_msg("%s", error_message(error, 0));
}

static inline struct error *read_checks(const char *text, const char *checks,
                                        struct simulation_case **input)
{
    static const char path[] = "stage.yaml";
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "%s%s\n", text, checks);
    fclose(file);
    return case_read(path, &(struct case_options){0}, &bolide_catalogue, input);
}

/* The case TEXT with CHECKS at time zero. */
static inline struct error *stage_open(struct stage *s, const char *text, const char *checks)
{
    *s = (struct stage){.ranks = ranks_alone()};
    expect_success(read_checks(text, checks, &s->input));
    expect_success(simulation_create(s->input, &s->ranks, 1, &s->simulation));
    const struct solver_class *method = s->input->solver.choice->thing;
    s->solver = calloc(1, method->size);
    expect_success(method->create(s->solver, &s->simulation, s->input->solver.value));
    expect_success(generate_particles(&s->simulation, particles_of(&s->simulation)));
    expect_success(method->start(s->solver, &s->simulation));
    s->start = population_totals(simulation_population(&s->simulation), &s->ranks, -1);
    return checks_prepare(&s->simulation, look(s), NULL, &s->checks);
}

static inline struct check_moment stage_moment(struct stage *s)
{
    return (struct check_moment){&s->simulation, look(s), &s->start, s->memory};
}

static inline void stage_begin(struct stage *s, const char *text, const char *checks)
{
    expect_success(stage_open(s, text, checks));
    const struct check_moment moment = stage_moment(s);
    expect_success(checks_start(s->checks, &moment));
}

static inline void stage_watch(struct stage *s, double time)
{
    const struct check_moment moment = stage_moment(s);
    s->simulation.time = time;
    expect_success(checks_watch(s->checks, &moment));
}

/* What the check at INDEX measures. */
static inline double stage_value(struct stage *s, int index)
{
    const struct check_moment moment = stage_moment(s);
    check_results_free(&s->results);
    expect_success(checks_evaluate(s->checks, &moment, &s->results));
    return s->results.item[index].measured;
}

static inline void stage_close(struct stage *s)
{
    const struct solver_class *method = s->input->solver.choice->thing;
    check_results_free(&s->results);
    checks_free(s->checks);
    method->destroy(s->solver);
    free(s->solver);
    simulation_destroy(&s->simulation);
    case_free(s->input);
}

/* The place at the start of particle I, and where it is now. */
static inline struct vec3 start_of(struct stage *s, int32_t i)
{
    double place[1][3];
    start_places(look(s), i, i + 1, place);
    return vec3_make(place[0][0], place[0][1], place[0][2]);
}

static inline void move_to(struct stage *s, int32_t i, double x, double y)
{
    particles_of(&s->simulation)->position[i][0] = x;
    particles_of(&s->simulation)->position[i][1] = y;
}

#endif
