/* Probes, what checks read from them, and profiles, on particles whose motion is known. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <sys/resource.h>
#include <unistd.h>

#include "base/csv.h"
#include "build_case.h"
#include "measure/probes.h"
#include "measure/profiles.h"
#include "populations.h"
#include "run/catalogue.h"
#include "run/checks.h"
#include "shape/kinds.h"

/* Two bodies of EACH x EACH particles in a plane, or EACH^3 in space, 0.1 m apart, side by side
 * along x. */
enum { BODIES = 2, EACH = 4 };

struct bench {
    struct body_input body[BODIES];
    char *names[BODIES];
    struct probe_input given;
    char *probe_names[1];
    struct profile_input profile;
    struct check_input check;
    struct simulation_case input;
    struct ranks ranks;
    struct simulation simulation;
    struct population population;
    struct probes probes;
    char folder[64];
};

/* The members as they are now. */
static const struct population *look(struct bench *b)
{
    b->population = simulation_population(&b->simulation);
    return &b->population;
}

static char it[] = "it", left[] = "left", right[] = "right", pressure[] = "pressure";

static void place_particles(struct bench *b, int dimension)
{
    int each = dimension == 3 ? EACH * EACH * EACH : EACH * EACH;
    int32_t first;
    assert_null(give_particles(&b->simulation, 1.0, NULL, 0));
    struct particles *p = particles_of(&b->simulation);
    assert_null(particles_append(p, BODIES * each, &first));
    for (int i = 0; i < BODIES * each; i++) {
        int site = i % each;
        p->id[i] = particle_id(i / each, site);
        p->body[i] = (uint16_t)(i / each);
        p->mass[i] = 1.0 + site % 3;
        p->density[i] = 2.0;
        p->position[i][0] = 0.1 * (site % EACH) + 1.0 * (i / each);
        p->position[i][1] = 0.1 * (site / EACH % EACH);
        p->position[i][2] = dimension == 3 ? 0.1 * (site / EACH / EACH) : 0.0;
        p->pressure[i] = i;
    }
    assert_null(particles_commit(p));
}

static struct bench *make_bench(int dimension)
{
    struct bench *b = calloc(1, sizeof *b);
    assert_non_null(b);
    b->names[0] = left;
    b->names[1] = right;
    for (int body = 0; body < BODIES; body++) {
        static struct shape_box box[BODIES] = {
            {{3, {-0.05, -0.05, -0.05}}, {3, {0.35, 0.35, 0.35}}},
            {{3, {0.95, -0.05, -0.05}}, {3, {1.35, 0.35, 0.35}}}};
        b->body[body].shape =
            (struct one_of){0, catalogue_find(&bolide_catalogue, "shape", "box"), &box[body]};
    }
    b->probe_names[0] = it;
    b->input.dimension = dimension;
    b->input.resolution = 0.1;
    b->input.run.until = 10.0;
    b->input.bodies = (struct named_map){BODIES, b->names, b->body, {0}};
    b->input.probes = (struct named_map){1, b->probe_names, &b->given, {0}};
    b->input.profiles = (struct named_map){1, b->probe_names, &b->profile, {0}};
    b->input.checks = (struct named_map){1, b->probe_names, &b->check, {0}};
    b->given.axis = -1;
    b->given.every = b->profile.width = NAN;
    b->check.is.value = b->check.within.value = b->check.scale.value = NAN;
    b->check.at_least.value = b->check.at = NAN;
    b->check.regression_bound.value = b->check.recorded.value = NAN;
    b->check.at_most.value = 1e300;
    b->check.relative_check = -1;
    b->ranks = ranks_alone();
    problem_of(&b->simulation)->input = &b->input;
    b->simulation.ranks = &b->ranks;
    problem_of(&b->simulation)->dimension = dimension;
    place_particles(b, dimension);
    strcpy(b->folder, "/tmp/bolide-test-XXXXXX");
    assert_non_null(mkdtemp(b->folder));
    return b;
}

static void drop_bench(struct bench *b)
{
    char command[96];
    snprintf(command, sizeof command, "rm -r '%s'", b->folder);
    assert_int_equal(system(command), 0);
    probes_free(&b->probes);
    end_simulation(&b->simulation);
    free(b);
}

static struct error *prepare(struct bench *b, const char *kind, void *parameters)
{
    probes_free(&b->probes);
    b->given.probe.value = parameters;
    for (int i = 0; i < PROBES; i++)
        if (!strcmp(probe_choices[i].name, kind))
            b->given.probe.choice = &probe_choices[i];
    TRY(probes_create(&b->input, &b->probes));
    return probes_prepare(&b->probes, &b->simulation, look(b));
}

/* Readies a probe of KIND that keeps its rows. */
static struct probe *ready(struct bench *b, const char *kind, void *parameters)
{
    assert_null(prepare(b, kind, parameters));
    b->probes.item[0].kept = true;
    return &b->probes.item[0];
}

static void watch(struct bench *b, bool last)
{
    assert_null(probes_watch(&b->probes, &b->simulation, look(b), last));
}

/* The number in COLUMN of the last row. */
static double last_of(const struct probe *probe, const char *column)
{
    for (int i = 0; i < probe->columns; i++)
        if (!strcmp(probe->column[i].name, column))
            return probe->value[(probe->rows - 1) * probe->columns + i];
    fail_msg("no column %s", column);
    return NAN;
}

static void spin(struct bench *b, struct vec3 velocity, struct vec3 turn)
{
    struct particles *p = particles_of(&b->simulation);
    for (int32_t i = 0; i < p->count; i++) {
        struct vec3 x = vec3_make(p->position[i][0], p->position[i][1], p->position[i][2]);
        struct vec3 u = vec3_add(velocity, vec3_cross(turn, x));
        p->velocity[i][0] = u.x;
        p->velocity[i][1] = u.y;
        p->velocity[i][2] = u.z;
    }
}

static void a_body_that_turns_as_one_has_its_angular_velocity(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; dimension++) {
        struct bench *b = make_bench(dimension);
        struct probe_body body = {right};
        struct vec3 turn = dimension == 3 ? vec3_make(1.0, -2.0, 3.0) : vec3_make(0.0, 0.0, 3.0);
        spin(b, vec3_make(10.0, 20.0, 0.0), turn);
        struct probe *probe = ready(b, "body", &body);
        watch(b, false);
        assert_float_equal(last_of(probe, "angular_velocity.z"), 3.0, 1e-12);
        if (dimension == 3) {
            assert_float_equal(last_of(probe, "angular_velocity.x"), 1.0, 1e-12);
            assert_float_equal(last_of(probe, "angular_velocity.y"), -2.0, 1e-12);
        }
        double mass = last_of(probe, "mass"), speed_square = 0.0;
        double x = last_of(probe, "centre.x"), y = last_of(probe, "centre.y");
        for (int i = 0; i < dimension; i++)
            speed_square += square(
                last_of(probe, (const char *[]){"velocity.x", "velocity.y", "velocity.z"}[i]));
        if (dimension == 2)
            assert_float_equal(last_of(probe, "velocity.x"), 10.0 - 3.0 * y, 1e-12);
        assert_float_equal(
            last_of(probe, "kinetic_energy"),
            last_of(probe, "kinetic_energy_about_centre") + 0.5 * mass * speed_square, 1e-9);
        assert_true(x > 1.0 && x < 1.3);
        assert_float_equal(last_of(probe, "low.x"), 1.0, 0.0);
        assert_float_equal(last_of(probe, "high.y"), 0.1 * 3, 1e-15);
        drop_bench(b);
    }
}

static void a_tracer_follows_its_particle_wherever_it_is_stored(void **state)
{
    (void)state;
    struct bench *b = make_bench(2);
    /* Four particles are as near; the one of the smallest id is taken. */
    struct probe_tracer tracer = {{2, {0.05, 0.05}}};
    b->given.fields = (struct name_list){1, (char *[]){pressure}};
    struct probe *probe = ready(b, "tracer", &tracer);
    watch(b, false);
    assert_int_equal(probe->id, particle_id(0, 0));
    assert_float_equal(last_of(probe, "position.x"), 0.0, 0.0);
    struct particles *p = particles_of(&b->simulation);
    for (int32_t i = 0; i < p->count; i++) /* far away, so that it is stored elsewhere */
        if (p->id[i] == probe->id) {
            p->position[i][0] = 50.0;
            p->pressure[i] = 77.0;
        }
    assert_null(particles_sort(p));
    assert_int_not_equal(p->id[0], probe->id);
    watch(b, false);
    assert_int_equal(probe->rows, 1); /* the step is the same */
    b->simulation.step++;
    watch(b, false);
    assert_int_equal(probe->rows, 2);
    assert_float_equal(last_of(probe, "position.x"), 50.0, 0.0);
    assert_float_equal(last_of(probe, "pressure"), 77.0, 0.0);
    assert_int_equal(probe->columns, 4);
    drop_bench(b);
}

static void a_tracer_of_a_body_and_a_gauge_see_that_body_alone(void **state)
{
    (void)state;
    struct bench *b = make_bench(2);
    struct probe_tracer tracer = {{2, {0.0, 0.0}}};
    b->body[1].resolution = 1.0; /* the place is no farther outside */
    b->given.of = right;
    b->given.fields = (struct name_list){1, (char *[]){pressure}};
    struct probe *probe = ready(b, "tracer", &tracer);
    watch(b, false);
    assert_int_equal(probe->id, particle_id(1, 0));
    struct probe_gauge gauge = {{2, {0.0, 0.0}}, 0.11};
    probe = ready(b, "gauge", &gauge);
    watch(b, false);
    assert_float_equal(last_of(probe, "particles"), 0.0, 0.0);
    assert_true(isnan(last_of(probe, "pressure")));
    drop_bench(b);
}

static void a_gauge_takes_the_mean_by_volume_within_its_radius(void **state)
{
    (void)state;
    struct bench *b = make_bench(2);
    struct probe_gauge gauge = {{2, {0.0, 0.0}}, 0.11};
    b->given.fields = (struct name_list){1, (char *[]){pressure}};
    struct probe *probe = ready(b, "gauge", &gauge);
    watch(b, false);
    /* Sites 0, 1 and EACH of masses 1, 2, 2 and pressures 0, 1, 4. */
    assert_float_equal(last_of(probe, "particles"), 3.0, 0.0);
    assert_float_equal(last_of(probe, "pressure"), (2.0 * 1.0 + 2.0 * 4.0) / 5.0, 1e-15);
    drop_bench(b);
}

static void half_the_jump_is_found_whatever_lies_behind(void **state)
{
    (void)state;
    struct bench *b = make_bench(2);
    struct particles *p = particles_of(&b->simulation);
    /* A shock of 8 over 1 up to x = 1.1 with one peak of 40, and nothing at x = 0. */
    for (int32_t i = 0; i < p->count; i++) {
        double x = p->position[i][0], y = p->position[i][1];
        p->pressure[i] = x > 1.15 || x < 0.05 ? 1.0 : x > 0.25 && x < 0.35 && y < 0.05 ? 40.0 : 9.0;
    }
    struct measure_front front = {
        .field = pressure, .value = {.value = NAN}, .half = true, .from = FRONT_FROM_HIGH};
    struct probe *probe = ready(b, "front", &front);
    watch(b, false);
    const double mean = (19.0 * 8.0 + 39.0) / 20.0; /* over 1 */
    assert_float_equal(last_of(probe, "level"), 1.0 + 0.5 * mean, 1e-14);
    assert_float_equal(last_of(probe, "position"), 1.2 - 0.1 * (0.5 * mean / 8.0), 1e-14);
    for (int32_t i = 0; i < p->count; i++)
        p->pressure[i] = 1.0;
    b->simulation.step++;
    watch(b, false);
    assert_true(isnan(last_of(probe, "position")));
    drop_bench(b);
}

static void expect_mistake(struct bench *b, const char *kind, void *parameters, const char *text)
{
    struct error *error = prepare(b, kind, parameters);
    assert_non_null(error);
    assert_int_equal(error_kind(error), ERROR_INPUT);
    assert_string_equal(error_message(error, 0), text);
    error_free(error);
}

static void mistakes_are_told_where_they_stand(void **state)
{
    (void)state;
    struct bench *b = make_bench(2);
    char presure[] = "presure", lefd[] = "lefd";
    struct probe_tracer tracer = {{1, {0.0}}};
    expect_mistake(b, "tracer", &tracer,
                   "probes.it.tracer: expected 2 components, one per dimension; found 1");
    tracer.at = (struct vector_value){2, {0.0, 0.5}};
    expect_mistake(b, "tracer", &tracer,
                   "probes.it.tracer: it starts more than a resolution outside all bodies, so that "
                   "no particle is near: move it into the body");
    b->given.of = right;
    tracer.at.at[1] = 0.1;
    expect_mistake(b, "tracer", &tracer,
                   "probes.it.tracer: it starts more than a resolution outside body \"right\", so "
                   "that no particle is near: move it into the body");
    b->given.of = NULL;
    b->given.axis = 0;
    expect_mistake(b, "tracer", &tracer,
                   "probes.it.axis: this has no meaning for the probe `tracer`");
    b->given.axis = -1;
    b->given.fields = (struct name_list){1, (char *[]){presure}};
    expect_mistake(b, "tracer", &tracer,
                   "probes.it.fields: the particles have no field \"presure\" (did you mean "
                   "\"pressure\"?)");
    b->given.fields.count = 0;
    struct probe_body body = {lefd};
    expect_mistake(b, "body", &body,
                   "probes.it.body: there is no body \"lefd\" (did you mean \"left\"?)");
    struct measure_front front = {.field = pressure, .value = {1.0, {0, 0, 0, 0}}};
    expect_mistake(b, "front", &front, "probes.it.front: `value` must be in Pa, as pressure is");
    front.half = true;
    expect_mistake(b, "front", &front,
                   "probes.it.front: a front needs either `value` or `half: yes`");
    drop_bench(b);
}

static void rows_come_as_often_as_wanted_and_stay_on_resume(void **state)
{
    (void)state;
    struct bench *b = make_bench(2);
    struct probe_body body = {left};
    b->given.every = 0.3;
    struct csv_mark mark = {0};
    struct probe *probe = ready(b, "body", &body);
    assert_null(probes_open(&b->probes, b->folder, false, true));
    for (int step = 0; step <= 10; step++) {
        b->simulation.step = step;
        b->simulation.time = 0.1 * step;
        watch(b, step == 10);
        if (step == 8) {
            assert_null(probes_mark(&b->probes));
            mark = probe->mark;
        }
    }
    assert_int_equal(probe->rows, 5); /* 0, 0.3, 0.6, 0.9, and the last */
    assert_null(probes_close(&b->probes));
    /* A run that stood at three rows goes on behind them, and still knows them. */
    double third = probe->value[2 * probe->columns];
    probe = ready(b, "body", &body);
    probe->rows = 3;
    probe->mark = mark;
    assert_null(probes_open(&b->probes, b->folder, true, true));
    assert_int_equal(probe->rows, 3);
    assert_float_equal(probe->value[2 * probe->columns], third, 0.0);
    assert_null(probes_close(&b->probes));
    char path[128];
    struct csv csv;
    snprintf(path, sizeof path, "%s/probes/it.csv", b->folder);
    assert_null(csv_read(path, &csv));
    assert_int_equal(csv.rows, 3);
    assert_string_equal(csv_head(&csv, 1), "mass [kg/m]");
    csv_free(&csv);
    drop_bench(b);
}

/* COUNT bodies' probes in place of the one of the bench. */
static void ready_many(struct bench *b, int count, char (*name)[16], char **names)
{
    static struct probe_body body = {left};
    struct probe_input *given = calloc((size_t)count, sizeof *given);
    assert_non_null(given);
    assert_null(prepare(b, "body", &body));
    for (int i = 0; i < count; i++) {
        given[i] = b->given;
        names[i] = name[i];
        snprintf(name[i], sizeof name[i], "p%d", i);
    }
    probes_free(&b->probes);
    b->input.probes = (struct named_map){count, names, given, {0}};
    assert_null(probes_create(&b->input, &b->probes));
    assert_null(probes_prepare(&b->probes, &b->simulation, look(b)));
}

static void there_may_be_more_probes_than_open_files(void **state)
{
    (void)state;
    enum { MANY = 100, STEPS = 200 };
    char name[MANY][16], *names[MANY], path[128];
    struct bench *b = make_bench(2);
    ready_many(b, MANY, name, names);
    struct rlimit before, few;
    assert_int_equal(getrlimit(RLIMIT_NOFILE, &before), 0);
    few = before;
    few.rlim_cur = 20;
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &few), 0);
    struct error *error = probes_open(&b->probes, b->folder, false, true);
    for (int step = 0; step < STEPS && !error; step++) {
        b->simulation.step = step;
        b->simulation.time = step;
        error = probes_watch(&b->probes, &b->simulation, look(b), false);
        if (step == STEPS / 2 && !error)
            error = probes_mark(&b->probes);
    }
    if (!error)
        error = probes_close(&b->probes);
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &before), 0);
    assert_null(error);
    for (int i = 0; i < MANY; i += MANY - 1) {
        struct csv csv;
        snprintf(path, sizeof path, "%s/probes/p%d.csv", b->folder, i);
        assert_null(csv_read(path, &csv));
        assert_int_equal(csv.rows, STEPS);
        for (int row = 0; row < STEPS; row++)
            assert_float_equal(csv_number(&csv, row, 0), row, 0.0);
        csv_free(&csv);
    }
    free(b->input.probes.items);
    drop_bench(b);
}

/* The value of a check `recorded` over COUNT rows of time and mass. */
static double recorded(struct bench *b, const double (*rows)[2], int count,
                       struct measure_recorded recorded, struct dimension dimension)
{
    struct probe_body body = {left};
    struct probe *probe = ready(b, "body", &body);
    struct checks *checks;
    struct check_results results;
    struct check_memory memory = {NAN, NAN, NAN, NOTHING_SAID};
    const struct check_moment moment = {&b->simulation, look(b), NULL, &memory};
    recorded.probe = it;
    recorded.column = (char[]){"mass"};
    for (int i = 0; i < MEASURES; i++)
        if (!strcmp(measure_choices[i].name, "recorded"))
            b->check.measure = (struct one_of){i, &measure_choices[i], &recorded};
    b->check.at_most.dimension = dimension;
    assert_null(checks_prepare(&b->simulation, look(b), &b->probes, &checks));
    free(probe->value);
    probe->value = calloc((size_t)(count * probe->columns), sizeof(double));
    probe->room = count * probe->columns;
    probe->rows = count;
    for (int i = 0; i < count; i++) {
        probe->value[i * probe->columns] = rows[i][0];
        probe->value[i * probe->columns + 1] = rows[i][1];
    }
    assert_null(checks_evaluate(checks, &moment, &results));
    double value = results.item[0].measured;
    check_results_free(&results);
    checks_free(checks);
    return value;
}

/* `take` by its name. */
static int take(const char *name)
{
    for (const struct parameter *p = measure_recorded_table; !PARAMETER_IS_END(p); p++)
        for (int i = 0; p->names && p->names[i]; i++)
            if (!strcmp(p->names[i], name))
                return i;
    fail_msg("no take %s", name);
    return -1;
}

static void a_recorded_column_gives_its_numbers(void **state)
{
    (void)state;
    struct bench *b = make_bench(2);
    const double rows[][2] = {{0, NAN}, {1, 2}, {2, 4}, {4, -8}, {5, -7}};
    const struct dimension line = {-1, 1, 0, 0}, rate = {-1, 1, -1, 0}, second = {0, 0, 1, 0};
    struct measure_recorded r = {.after = NAN,
                                 .before = NAN,
                                 .less_mean = NAN,
                                 .noise = {.value = NAN},
                                 .reaches = {.value = NAN}};
    r.take = take("last");
    assert_float_equal(recorded(b, rows, 5, r, line), -7.0, 0.0);
    r.before = 3.0; /* between two rows */
    assert_float_equal(recorded(b, rows, 5, r, line), -2.0, 0.0);
    r.take = take("slope");
    r.before = 2.0;
    assert_float_equal(recorded(b, rows, 5, r, rate), 2.0, 1e-15);
    r.take = take("mean");
    assert_float_equal(recorded(b, rows, 5, r, line), 3.0, 1e-15);
    r.take = take("rms");
    assert_float_equal(recorded(b, rows, 5, r, line), sqrt(28.0 / 3.0), 1e-15);
    r.take = take("last");
    r.before = NAN;
    r.less_mean = 2.0; /* none is left at an end, */
    assert_float_equal(recorded(b, rows, 5, r, line), 0.0, 0.0);
    r.take = take("minimum"); /* and at 4 the mean is that from 3 to 5, -6.25 */
    assert_float_equal(recorded(b, rows, 5, r, line), -1.75, 1e-14);
    r.less_mean = NAN;
    r.less = it; /* itself */
    r.take = take("range");
    assert_float_equal(recorded(b, rows, 5, r, line), 0.0, 0.0);
    r.less = NULL;
    r.take = take("speed");
    r.after = 2.0;
    r.before = 4.0;
    assert_float_equal(recorded(b, rows, 5, r, rate), 6.0, 1e-14);
    r.after = NAN;
    r.before = NAN;
    r.take = take("maximum");
    assert_float_equal(recorded(b, rows, 5, r, line), 4.0, 0.0);
    r.absolute = true;
    assert_float_equal(recorded(b, rows, 5, r, line), 8.0, 0.0);
    r.take = take("time_of_maximum");
    assert_float_equal(recorded(b, rows, 5, r, second), 4.0, 0.0);
    r.absolute = false;
    r.take = take("range");
    assert_float_equal(recorded(b, rows, 5, r, line), 12.0, 0.0);
    r.take = take("minimum");
    r.after = 9.0;
    assert_true(isnan(recorded(b, rows, 5, r, line)));
    r.after = NAN;
    r.take = take("last");
    r.when = (char[]){"mass"}; /* from -8 at 4 to -7 at 5; never to 5 */
    r.reaches = (struct quantity){-7.25, line};
    assert_float_equal(recorded(b, rows, 5, r, line), -7.25, 1e-14);
    r.reaches.value = 5.0;
    assert_true(isnan(recorded(b, rows, 5, r, line)));
    drop_bench(b);
}

static void peaks_count_when_they_rise_above_the_noise(void **state)
{
    (void)state;
    struct bench *b = make_bench(2);
    enum { ROWS = 400 };
    double rows[ROWS][2];
    for (int i = 0; i < ROWS; i++) {
        rows[i][0] = 0.01 * i; /* periods of 1, and a little noise of every second row */
        rows[i][1] = sin(2.0 * 3.14159265358979 * rows[i][0]) + (i % 2 ? 0.004 : -0.004);
    }
    const struct dimension none = {0, 0, 0, 0}, line = {-1, 1, 0, 0}, second = {0, 0, 1, 0};
    struct measure_recorded r = {.less_mean = NAN,
                                 .after = NAN,
                                 .before = NAN,
                                 .noise = {.value = NAN},
                                 .reaches = {.value = NAN}};
    r.take = take("maxima");
    assert_float_equal(recorded(b, rows, ROWS, r, none), 4.0, 0.0);
    r.take = take("period");
    assert_float_equal(recorded(b, rows, ROWS, r, second), 1.0, 0.011);
    r.noise = (struct quantity){3.0, line};
    r.take = take("maxima");
    assert_float_equal(recorded(b, rows, ROWS, r, none), 0.0, 0.0);
    r.noise.value = 0.0;
    assert_true(recorded(b, rows, ROWS, r, none) > 4.0);
    drop_bench(b);
}

static void a_check_of_a_probe_that_is_not_there_is_told(void **state)
{
    (void)state;
    struct bench *b = make_bench(2);
    struct probe_body body = {left};
    struct measure_recorded r = {.less_mean = NAN,
                                 .after = NAN,
                                 .before = NAN,
                                 .noise = {.value = NAN},
                                 .reaches = {.value = NAN}};
    struct checks *checks;
    ready(b, "body", &body);
    for (int i = 0; i < MEASURES; i++)
        if (!strcmp(measure_choices[i].name, "recorded"))
            b->check.measure = (struct one_of){i, &measure_choices[i], &r};
    r.probe = (char[]){"its"};
    r.column = (char[]){"mass"};
    struct error *error = checks_prepare(&b->simulation, look(b), &b->probes, &checks);
    assert_string_equal(error_message(error, 0),
                        "checks.it: there is no probe \"its\" (did you mean \"it\"?)");
    error_free(error);
    r.probe = it;
    r.column = (char[]){"velocity.z"};
    error = checks_prepare(&b->simulation, look(b), &b->probes, &checks);
    assert_string_equal(error_message(error, 0), "checks.it: the probe \"it\" has no column "
                                                 "\"velocity.z\" (did you mean \"velocity.x\"?)");
    error_free(error);
    drop_bench(b);
}

static void a_profile_has_mean_and_scatter_of_each_bin(void **state)
{
    (void)state;
    struct bench *b = make_bench(2);
    struct profiles profiles;
    struct shape_box box = {VECTOR(0.0, 0.0), VECTOR(2.0, 1.0)};
    b->body[0].shape = b->body[1].shape = shape_of("box", &box);
    b->profile.fields = (struct name_list){1, (char *[]){pressure}};
    b->profile.width = 0.2;
    b->profile.of = left;
    b->profile.by = PROFILE_BY_BODY;
    assert_null(profiles_prepare(&b->simulation, look(b), &profiles));
    assert_null(profiles_write(&profiles, &b->simulation, look(b), b->folder, 7));
    char path[128];
    struct csv csv;
    snprintf(path, sizeof path, "%s/profiles/it-000007.csv", b->folder);
    assert_null(csv_read(path, &csv));
    assert_string_equal(csv_head(&csv, 4), "pressure.spread [Pa]");
    assert_int_equal(csv.rows, 2);
    assert_string_equal(csv_field(&csv, 1, 0), "left");
    assert_float_equal(csv_number(&csv, 1, 1), 0.3, 1e-15);
    assert_float_equal(csv_number(&csv, 1, 2), 8.0, 0.0);
    /* 2 and 3 and then every fourth: mean 8.5, variance 20.25 of the rows and 0.25 between the
     * columns */
    assert_float_equal(csv_number(&csv, 1, 3), 8.5, 1e-14);
    assert_float_equal(csv_number(&csv, 1, 4), sqrt(20.25), 1e-14);
    assert_float_equal(csv_number(&csv, 1, 5), 2.0, 0.0);
    assert_float_equal(csv_number(&csv, 1, 6), 15.0, 0.0);
    csv_free(&csv);
    profiles_free(&profiles);
    drop_bench(b);
}

static void an_empty_bin_of_a_profile_is_not_a_number_and_has_no_sign(void **state)
{
    (void)state;
    struct bench *b = make_bench(2);
    struct profiles profiles;
    b->profile.fields = (struct name_list){1, (char *[]){pressure}};
    b->profile.width = 0.2;
    assert_null(profiles_prepare(&b->simulation, look(b), &profiles));
    assert_null(profiles_write(&profiles, &b->simulation, look(b), b->folder, 7));
    char path[128];
    struct csv csv;
    snprintf(path, sizeof path, "%s/profiles/it-000007.csv", b->folder);
    assert_null(csv_read(path, &csv));
    assert_string_equal(csv_field(&csv, 3, 1), "0");
    for (int column = 2; column < csv.columns; column++)
        assert_string_equal(csv_field(&csv, 3, column), "nan");
    csv_free(&csv);
    profiles_free(&profiles);
    drop_bench(b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_body_that_turns_as_one_has_its_angular_velocity),
        cmocka_unit_test(a_tracer_follows_its_particle_wherever_it_is_stored),
        cmocka_unit_test(a_tracer_of_a_body_and_a_gauge_see_that_body_alone),
        cmocka_unit_test(a_gauge_takes_the_mean_by_volume_within_its_radius),
        cmocka_unit_test(half_the_jump_is_found_whatever_lies_behind),
        cmocka_unit_test(mistakes_are_told_where_they_stand),
        cmocka_unit_test(rows_come_as_often_as_wanted_and_stay_on_resume),
        cmocka_unit_test(there_may_be_more_probes_than_open_files),
        cmocka_unit_test(a_recorded_column_gives_its_numbers),
        cmocka_unit_test(peaks_count_when_they_rise_above_the_noise),
        cmocka_unit_test(a_check_of_a_probe_that_is_not_there_is_told),
        cmocka_unit_test(a_profile_has_mean_and_scatter_of_each_bin),
        cmocka_unit_test(an_empty_bin_of_a_profile_is_not_a_number_and_has_no_sign),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
