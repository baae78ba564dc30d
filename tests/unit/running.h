/* A case given as text, run step by step in the hands of a test. */
#ifndef BOLIDE_TEST_RUNNING_H
#define BOLIDE_TEST_RUNNING_H

#include "dice.h"
#include "populations.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "gas/gas_internal.h"
#include "model/generate.h"
#include "mpm/mpm_internal.h"
#include "output/checkpoint.h"
#include "run/catalogue.h"
#include "sph/muscl/muscl.h"

/* How a case is run. */
struct variant {
    const char *name;
    int threads; /* -3: three, two and one, by turns */
    double cell; /* factor of the store's cells */
    const char *setting;
    bool resumed; /* in the middle, by another simulation */
};

static char folder[64];

static inline int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/bolide-test-XXXXXX");
    return mkdtemp(folder) ? 0 : -1;
}

static inline int remove_folder(void **state)
{
    (void)state;
    char command[96];
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    return system(command);
}

struct running {
    struct simulation_case *input;
    struct ranks ranks;
    struct simulation simulation;
    const struct solver_class *solver;
    union { /* the solver's state */
        struct sph sph;
        struct mpm mpm;
        struct gas gas;
    };
    struct limit limit;
    int most_threads; /* 0: their number stays */
};

/* What the solver refuses of the case with PARAMETERS. */
static inline struct error *refusal_of(const struct running *run, const void *parameters)
{
    struct judgement judgement = judge_with(run->solver, parameters, &run->simulation);
    struct error *error = findings_refusal(&judgement.findings);
    findings_free(&judgement.findings);
    return error;
}

/* The case and its simulation, before the solver is created. */
static inline struct running *open_case(const char *text, const struct variant *variant)
{
    char path[96];
    snprintf(path, sizeof path, "%s/case.yaml", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
    struct case_options options = {.settings = &variant->setting,
                                   .setting_count = variant->setting != NULL};
    struct running *run = calloc(1, sizeof *run);
    run->ranks = ranks_alone();
    assert_success(case_read(path, &options, &bolide_catalogue, &run->input));
    assert_success(
        simulation_create(run->input, &run->ranks, abs(variant->threads), &run->simulation));
    run->most_threads = variant->threads < 0 ? -variant->threads : 0;
    run->solver = run->input->solver.choice->thing;
    assert_true(run->solver->size == sizeof run->sph || run->solver->size == sizeof run->mpm ||
                run->solver->size == sizeof run->gas);
    return run;
}

static inline struct running *begin(const char *text, const struct variant *variant)
{
    struct running *run = open_case(text, variant);
    assert_success(run->solver->create(&run->sph, &run->simulation, run->input->solver.value));
    if (variant->cell != 1.0)
        particles_of(&run->simulation)->cell *= variant->cell;
    return run;
}

static inline void end(struct running *run)
{
    run->solver->destroy(&run->sph);
    simulation_destroy(&run->simulation);
    case_free(run->input);
    free(run);
}

/* One step of at most LONGEST. */
static inline void step_of(struct running *run, double longest)
{
    if (run->most_threads)
        run->simulation.threads =
            run->most_threads - (int)(run->simulation.step % run->most_threads);
    assert_success(run->solver->prepare(&run->sph, &run->simulation, &run->limit));
    double dt = minimum(run->limit.dt, longest);
    assert_success(run->solver->advance(&run->sph, &run->simulation, dt));
    run->simulation.time += dt;
    run->simulation.step++;
}

static inline void step(struct running *run, int steps)
{
    for (int k = 0; k < steps; k++)
        step_of(run, (double)INFINITY);
}

static inline struct error *nothing_more(void *context, struct visitor *visitor)
{
    (void)context;
    (void)visitor;
    return NULL;
}

/* Another simulation of the same case that goes on from where RUN stands; ends RUN. */
static inline struct running *resume(struct running *run, const char *text,
                                     const struct variant *variant)
{
    char path[96];
    snprintf(path, sizeof path, "%s/checkpoint.h5", folder);
    struct checkpoint checkpoint = {&run->simulation, run->solver, &run->sph,
                                    nothing_more,     NULL,        text};
    assert_success(checkpoint_write(path, &checkpoint));
    uint64_t hash = simulation_hash(&run->simulation);
    end(run);
    run = begin(text, variant);
    checkpoint.simulation = &run->simulation;
    checkpoint.solver = &run->sph;
    assert_success(checkpoint_read(path, &checkpoint));
    assert_true(simulation_hash(&run->simulation) == hash);
    assert_success(run->solver->start(&run->sph, &run->simulation));
    return run;
}

/* A run of TEXT at time zero, its particles made. */
static inline struct running *begin_fresh(const char *text, const struct variant *variant)
{
    struct running *run = begin(text, variant);
    assert_success(run->solver->fill(&run->sph, &run->simulation));
    assert_success(run->solver->start(&run->sph, &run->simulation));
    return run;
}

/* The hash of the state after STEPS steps as VARIANT says; one that is resumed begins as FIRST. */
static inline uint64_t hash_after(const char *text, const struct variant *first,
                                  const struct variant *variant, int steps)
{
    struct running *run = begin_fresh(text, variant->resumed ? first : variant);
    step(run, steps / 2);
    if (variant->resumed)
        run = resume(run, text, variant);
    step(run, steps - steps / 2);
    uint64_t hash = simulation_hash(&run->simulation);
    end(run);
    return hash;
}

/* Every particle of BODY has the velocity (X, Y). */
static inline void assert_velocity(const struct running *run, int body, double x, double y)
{
    const struct particles *p = particles_of(&run->simulation);
    for (int32_t i = 0; i < p->count; i++)
        if (p->body[i] == body)
            assert_true(p->velocity[i][0] == x && p->velocity[i][1] == y);
}

#endif
