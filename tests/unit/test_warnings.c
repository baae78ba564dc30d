/* What a run warns of. A solver that puts a state of nonsense on the last particle stands in for a
 * method that comes to one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "messages.h"
#include "model/generate.h"
#include "model/particles/fill.h"
#include "model/particles/held.h"
#include "model/solver.h"
#include "populations.h"
#include "run/catalogue.h"
#include "run/run.h"
#include "source_folder.h"
#include "study/verify.h"

/* NAN: stays. */
struct nonsense_parameters {
    double velocity, pressure, density, energy, damage;
    int64_t from, to, many; /* its first and last step, and how many particles of a body have it */
    int64_t only;           /* the body; -1: all */
};

#define NONSENSE(name, of)                                                                      \
    {                                                                                           \
        .key = #name, .kind = PARAMETER_NUMBER,                                                 \
        .offset = offsetof(struct nonsense_parameters, name), .unit = of, .standard = OPTIONAL, \
        .above = -INFINITY, .below = INFINITY                                                   \
    }

static const struct parameter nonsense_table[] = {
    NONSENSE(velocity, "m/s"),
    NONSENSE(pressure, "Pa"),
    NONSENSE(density, "kg/m^3"),
    NONSENSE(energy, "J/kg"),
    NONSENSE(damage, ""),
    {.key = "from",
     .kind = PARAMETER_INTEGER,
     .offset = offsetof(struct nonsense_parameters, from),
     .standard = "3"},
    {.key = "to",
     .kind = PARAMETER_INTEGER,
     .offset = offsetof(struct nonsense_parameters, to),
     .standard = "1000"},
    {.key = "only",
     .kind = PARAMETER_INTEGER,
     .offset = offsetof(struct nonsense_parameters, only),
     .standard = "-1"},
    {.key = "many",
     .kind = PARAMETER_INTEGER,
     .offset = offsetof(struct nonsense_parameters, many),
     .standard = "1"},
    PARAMETER_END,
};

struct nonsense {
    struct nonsense_parameters parameters; /* first: what the steps read */
    struct particles *particles;
};

static struct error *nonsense_create(void *solver, struct simulation *simulation,
                                     const void *parameters)
{
    struct nonsense *nonsense = solver;
    nonsense->parameters = *(const struct nonsense_parameters *)parameters;
    struct field_declaration fields[POINT_HISTORY];
    const int count = problem_history(simulation->problem, fields);
    return particles_add(simulation, 1.0, fields, count, &nonsense->particles);
}

static struct error *nonsense_fill(void *solver, struct simulation *simulation)
{
    return generate_particles(simulation, ((struct nonsense *)solver)->particles);
}

static struct error *nonsense_start(void *solver, struct simulation *simulation)
{
    (void)solver;
    (void)simulation;
    return NULL;
}

static struct error *nonsense_prepare(void *solver, struct simulation *simulation,
                                      struct limit *limit)
{
    (void)solver;
    *limit = (struct limit){0.1, "wish", particles_of(simulation)->id[0], next_event(simulation)};
    return NULL;
}

static void put(double *field, double value)
{
    if (!isnan(value))
        *field = value;
}

/* Every step adds to it, so that the worst comes last. */
static struct error *nonsense_advance(void *solver, struct simulation *simulation, double dt)
{
    const struct nonsense_parameters *nonsense = solver;
    struct particles *p = particles_of(simulation);
    const double more = 1.0 + 0.1 * (double)(simulation->step + 1 - nonsense->from);
    for (int32_t i = 0; i < p->count; i++) {
        p->position[i][0] += dt * p->velocity[i][0];
        if (simulation->step + 1 < nonsense->from || (int)(p->id[i] & 0xff) >= nonsense->many ||
            (nonsense->only >= 0 && p->body[i] != nonsense->only))
            continue;
        if (simulation->step + 1 > nonsense->to) {
            p->pressure[i] = 0.0;
            continue;
        }
        put(&p->velocity[i][0], more * nonsense->velocity);
        put(&p->pressure[i], more * nonsense->pressure);
        put(&p->density[i], more * nonsense->density);
        put(&p->energy[i], more * nonsense->energy);
        if (p->history[HISTORY_damage])
            put(&p->history[HISTORY_damage][i], nonsense->damage);
    }
    return NULL;
}

static struct error *nonsense_state(void *solver, struct visitor *visitor)
{
    (void)solver;
    (void)visitor;
    return NULL;
}

static void nonsense_destroy(void *solver)
{
    particles_drop(((struct nonsense *)solver)->particles);
}

static double nonsense_bytes(const void *parameters, int dimension)
{
    (void)parameters;
    return 100.0 * dimension;
}

static double nonsense_step(const void *parameters, const struct simulation_case *input,
                            const struct material *material, const struct point *point,
                            double diameter)
{
    (void)parameters;
    (void)input;
    (void)material;
    (void)point;
    (void)diameter;
    return 0.1;
}

static bool all_lose_tension(const struct material *material)
{
    (void)material;
    return true;
}

static void nonsense_judge(const void *parameters, const struct simulation *simulation,
                           struct judgement *judgement)
{
    (void)parameters;
    (void)simulation;
    judgement->loses_tension = all_lose_tension;
}

static const struct solver_class nonsense_class = {.size = sizeof(struct nonsense),
                                                   .create = nonsense_create,
                                                   .fill = nonsense_fill,
                                                   .start = nonsense_start,
                                                   .prepare = nonsense_prepare,
                                                   .advance = nonsense_advance,
                                                   .state = nonsense_state,
                                                   .destroy = nonsense_destroy,
                                                   .bytes = nonsense_bytes,
                                                   .step = nonsense_step,
                                                   .judge = nonsense_judge};

static const struct choice nonsense_choice = {"nonsense", "nonsense", nonsense_table,
                                              sizeof(struct nonsense_parameters), &nonsense_class};

static const char text[] =
    "format: 1\n"
    "dimension: 1\n"
    "resolution: 0.01 m\n"
    "solver: nonsense\n"
    "materials:\n"
    "  metal:\n"
    "    eos: {mie-grueneisen: {density: 8000 kg/m^3, sound: 4 km/s, slope: 1.5, gamma: 2,\n"
    "                           bulk_modulus: 128 GPa}}\n"
    "    heat: {capacity: 400 J/(kg*K)}\n"
    "bodies: {slab: {material: metal, velocity: [2 m/s], box: {from: [0 m], to: [1 m]}}}\n"
    "run: {until: 1 s, energy_drift: 0}\n"
    "output: {history: 0.1 s, snapshots: no}\n"
    "checks: {mass: {conserved: mass, within: 1}}\n";

static const char *const case_file = "test_warnings_case.yaml";

static const struct catalogue *nonsense_catalogue(void)
{
    static struct choice_list lists[16];
    static struct catalogue catalogue;
    int kinds = 0;
    for (; bolide_catalogue.lists[kinds].kind_of_thing; kinds++) {
        lists[kinds] = bolide_catalogue.lists[kinds];
        if (!strcmp(lists[kinds].kind_of_thing, "solver")) {
            lists[kinds].choices = &nonsense_choice;
            lists[kinds].count = 1;
        }
    }
    lists[kinds] = (struct choice_list){0};
    catalogue = (struct catalogue){lists};
    return &catalogue;
}

static void write_case(void)
{
    FILE *file = fopen(case_file, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0 && fclose(file) == 0);
}

static int count_settings(const char *const *settings)
{
    int count = 0;
    while (settings[count])
        count++;
    return count;
}

static struct run_result run(const char *const *settings, const struct run_options *options)
{
    struct run_result result;
    struct simulation_case *input;
    static const char *const library_paths[] = {materials_folder};
    struct case_options reading = {.settings = settings,
                                   .setting_count = count_settings(settings),
                                   .library_paths = library_paths,
                                   .library_count = COUNT_OF(library_paths)};
    write_case();
    struct error *error = case_read(case_file, &reading, nonsense_catalogue(), &input);
    if (!error)
        error = run_case(input, options, &result);
    if (error)
        fail_msg("%s", error_message(error, 0));
    case_free(input);
    return result;
}

/* The one warning under SETTINGS is NAME, and its text has all WORDS. */
static void expect_warning(const char *const *settings, const char *name, const char *const *words)
{
    struct run_result result = run(settings, &(struct run_options){.threads = 1});
    if (result.warnings.count != 1)
        fail_msg("%d warnings, not that of %s", result.warnings.count, name);
    assert_string_equal(result.warnings.item[0].name, name);
    for (; *words; words++)
        if (!strstr(result.warnings.item[0].text, *words))
            fail_msg("\"%s\" does not say \"%s\"", result.warnings.item[0].text, *words);
    assert_int_equal(result.warnings.unexpected, 1);
    run_result_free(&result);
}

static void a_run_that_stays_within_its_models_has_no_warning(void **state)
{
    (void)state;
    const char *const settings[] = {"solver={nonsense: {velocity: 5 m/s, pressure: -3 GPa, energy: "
                                    "1 kJ/kg, density: 8050 kg/m^3}}",
                                    "run.until=0.4 s", NULL};
    struct run_result result = run(settings, &(struct run_options){.threads = 1});
    assert_int_equal(result.warnings.count, 0);
    run_result_free(&result);
}

static void tension_beyond_a_twentieth_of_the_modulus_is_named(void **state)
{
    (void)state;
    const char *const settings[] = {"solver={nonsense: {pressure: -6.5 GPa, many: 2}}", NULL};
    const char *const words[] = {"6.5 GPa",
                                 "an estimate",
                                 "K/20 = 6.4 GPa",
                                 "step 3, t = 300 ms",
                                 "body \"slab\"",
                                 "up to 2 particles at once",
                                 "at worst 11.7 GPa at t = 1 s",
                                 "`materials.metal.eos`",
                                 NULL};
    expect_warning(settings, "tension in metal", words);
}

static void a_known_tensile_strength_takes_the_place_of_the_estimate(void **state)
{
    (void)state;
    const char *const settings[] = {"solver={nonsense: {pressure: -1.4 GPa, from: 10}}",
                                    "materials.metal.tensile_strength=1.3 GPa", NULL};
    const char *const words[] = {"1.4 GPa", "tensile strength of 1.3 GPa", "1 particle at", NULL};
    expect_warning(settings, "tension in metal", words);
}

static void metals_of_the_library_are_named_beyond_their_spall_strength(void **state)
{
    (void)state;
    static const struct {
        const char *set, *strength;
    } metals[] = {
        {"materials.metal={library: copper}", "tensile strength of 1.38 GPa"},
        {"materials.metal={library: copper-johnson-cook}", "tensile strength of 1.38 GPa"},
        {"materials.metal={library: aluminium}", "tensile strength of 1.26 GPa"},
        {"materials.metal={library: steel-1006}", "tensile strength of 2 GPa"},
        {"materials.metal={library: tungsten-alloy-johnson-cook}", "tensile strength of 1.9 GPa"},
    };
    for (size_t k = 0; k < COUNT_OF(metals); k++) {
        const char *const settings[] = {"solver={nonsense: {pressure: -2.1 GPa, from: 10}}",
                                        metals[k].set, NULL};
        const char *const words[] = {metals[k].strength, "set `materials.metal.failure`", NULL};
        expect_warning(settings, "tension in metal", words);
    }
}

static void a_model_that_limits_tension_needs_no_estimate(void **state)
{
    (void)state;
    const char *const settings[] = {
        "solver={nonsense: {pressure: -1 GPa}}",
        "materials.metal.eos={tillotson: {density: 2700 kg/m^3, a: 0.5, b: 1.63, bulk_modulus: 1 "
        "GPa, second_modulus: 1 GPa, energy: 5 MJ/kg, alpha: 5, beta: 5, incipient_energy: 3 "
        "MJ/kg, "
        "complete_energy: 13.9 MJ/kg, tension: 1 GPa}}",
        NULL};
    struct run_result result = run(settings, &(struct run_options){.threads = 1});
    assert_int_equal(result.warnings.count, 0);
    run_result_free(&result);
}

static void a_speed_beyond_three_times_that_of_the_start_is_named(void **state)
{
    (void)state;
    const char *const settings[] = {"solver={nonsense: {velocity: -8 m/s, from: 10}}", NULL};
    const char *const words[] = {"a speed of 8 m/s", "three times what the case can cause", NULL};
    expect_warning(settings, "speed in metal", words);
}

static void a_state_that_can_expand_may_move_faster(void **state)
{
    (void)state;
    const char *const settings[] = {"solver={nonsense: {velocity: 99 m/s, from: 10}}",
                                    "bodies.slab.pressure=0 Pa", "bodies.slab.energy=1 kJ/kg",
                                    NULL};
    const char *const pressed[] = {"solver={nonsense: {velocity: 99 m/s, from: 10}}",
                                   "bodies.slab.pressure=2 GPa", NULL};
    const char *const *const all[] = {settings, pressed};
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        struct run_result result = run(all[k], &(struct run_options){.threads = 1});
        assert_int_equal(result.warnings.count, 0);
        run_result_free(&result);
    }
}

static void a_prescribed_motion_may_move_others(void **state)
{
    (void)state;
    const char *const settings[] = {
        "solver={nonsense: {velocity: 8 m/s, from: 10}}",
        "bodies.piston={material: metal, driven: yes, velocity: [3 m/s], box: {from: [2 m], to: [3 "
        "m]}}",
        NULL};
    struct run_result result = run(settings, &(struct run_options){.threads = 1});
    assert_int_equal(result.warnings.count, 0);
    run_result_free(&result);
}

static void a_temperature_below_zero_is_named(void **state)
{
    (void)state;
    const char *const settings[] = {"solver={nonsense: {energy: -200 kJ/kg, from: 10}}", NULL};
    const char *const words[] = {"a temperature of -207 K, below 0 K", NULL};
    expect_warning(settings, "temperature in metal", words);
    const char *const cold[] = {"solver={nonsense: {energy: -100 kJ/kg, from: 10}}", NULL};
    struct run_result result = run(cold, &(struct run_options){.threads = 1});
    assert_int_equal(result.warnings.count, 0);
    run_result_free(&result);
}

static void a_density_beyond_the_equation_of_state_is_named(void **state)
{
    (void)state;
    const char *const settings[] = {"solver={nonsense: {density: 1150 kg/m^3, from: 10}}",
                                    "materials.metal={eos: {barotropic: {density: 1000 kg/m^3, "
                                    "bulk_modulus: 2 GPa}}}",
                                    NULL};
    const char *const words[] = {"1150 kg/m^3", "more than 1.1 times", "mie-grueneisen", NULL};
    expect_warning(settings, "density in metal", words);
    const char *const dense[] = {"solver={nonsense: {density: 33 g/cm^3, from: 10}}",
                                 "materials.metal={eos: {grueneisen-eta: {density: 8000 kg/m^3, "
                                 "sound: 4 km/s, slope: 1.5, gamma: 2}}}",
                                 NULL};
    const char *const four[] = {"more than 4 times", NULL};
    expect_warning(dense, "density in metal", four);
}

/* 100 particles that a wave passes four of at a row. */
#define LARGE                                                                              \
    "dimension=2", "resolution=100 m", "materials.metal.tensile_strength=1000 GPa",        \
        "bodies.slab={material: metal, velocity: [2 m/s, 0 m/s], box: {from: [0 m, 0 m], " \
        "to: [1 km, 1 km]}}"

#define BREAKS                                                                             \
    "materials.metal.strength={perfect-plastic: {shear_modulus: 40 GPa, yield: 0.3 GPa}}", \
        "materials.metal.failure={spall: {strength: 1 GPa}}", "solver={nonsense: {damage: 1}}"

static void an_explosive_compressed_before_it_is_lit_is_named(void **state)
{
    (void)state;
    const char *const settings[] = {"solver={nonsense: {density: 2500 kg/m^3}}",
                                    "materials.metal={library: tnt}",
                                    "detonations={late: {at: [1 m], time: 0.999 s}}", NULL};
    const char *const words[] = {"2500 kg/m^3", "more than 1.5 times", "before the detonation",
                                 "burn: beta", NULL};
    expect_warning(settings, "unlit in metal", words);
}

static void a_tracer_is_named_when_its_particle_fails(void **state)
{
    (void)state;
    const char *const settings[] = {BREAKS, "probes={face: {tracer: [0 m], fields: [velocity]}}",
                                    NULL};
    const char *const words[] = {"tracer \"face\" follows a particle that failed at t = 300 ms",
                                 NULL};
    expect_warning(settings, "tracer \"face\"", words);
}

static void a_tracer_of_another_particle_is_not_named(void **state)
{
    (void)state;
    const char *const settings[] = {BREAKS, "probes={deep: {tracer: [0.1 m], fields: [velocity]}}",
                                    NULL};
    struct run_result result = run(settings, &(struct run_options){.threads = 1});
    assert_int_equal(result.warnings.count, 0);
    run_result_free(&result);
}

static void tension_that_lasts_is_named_for_its_body(void **state)
{
    (void)state;
    const char *const settings[] = {
        LARGE, "solver={nonsense: {pressure: -12.8 GPa, many: 26, only: 1}}",
        "bodies.other={material: metal, box: {from: [2 km, 0 m], to: [3 km, 1 km]}}", NULL};
    const char *const words[] = {"lasting tension of 1.92",
                                 "step 7, t = 700 ms",
                                 "body \"other\"",
                                 "up to 26 particles at once",
                                 "at worst 3.8 at t = 1 s",
                                 "use `solver: mpm`",
                                 NULL};
    expect_warning(settings, "tensile-instability in metal", words);
}

static void surfaces_that_cut_the_lattice_creep_in_small_tension_that_lasts(void **state)
{
    (void)state;
    const char *const settings[] = {
        LARGE, "solver={nonsense: {pressure: -4 MPa, many: 256, to: 60}}", "run.until=6 s",
        "bodies.ring={material: metal, ball: {center: [3 km, 0 m], radius: 500 m}}", NULL};
    const char *const words[] = {"step 52", "body \"ring\"", NULL};
    expect_warning(settings, "tensile-instability in metal", words);
}

static void tension_that_passes_or_cannot_last_has_no_warning(void **state)
{
    (void)state;
    const char *const few[] = {LARGE, "solver={nonsense: {pressure: -12.8 GPa, many: 25}}", NULL};
    const char *const pulse[] = {
        LARGE, "solver={nonsense: {pressure: -12.8 GPa, many: 256, to: 5}}", NULL};
    const char *const noise[] = {LARGE, "solver={nonsense: {pressure: -1 MPa, many: 256}}",
                                 "run.until=9 s", NULL};
    const char *const piston[] = {LARGE, "solver={nonsense: {pressure: -12.8 GPa, many: 256}}",
                                  "bodies.slab.driven=yes", NULL};
    const char *const line[] = {"solver={nonsense: {pressure: -1 GPa, many: 256}}", NULL};
    const char *const *const all[] = {few, pulse, noise, piston, line};
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        struct run_result result = run(all[k], &(struct run_options){.threads = 1});
        if (result.warnings.count)
            fail_msg("%zu: %s", k, result.warnings.item[0].text);
        run_result_free(&result);
    }
}

static void an_expected_warning_has_a_reason_and_is_counted_apart(void **state)
{
    (void)state;
    const char *const settings[] = {
        "solver={nonsense: {pressure: -6.5 GPa, velocity: 8 m/s}}",
        "expected_warnings={lump: {warning: tension, of: [metal], reason: it is a test}}", NULL};
    struct run_result result = run(settings, &(struct run_options){.threads = 1});
    assert_int_equal(result.warnings.count, 2);
    assert_int_equal(result.warnings.unexpected, 1);
    assert_string_equal(result.warnings.item[0].expected, "it is a test");
    assert_null(result.warnings.item[1].expected);
    run_result_free(&result);
}

static void an_expected_warning_of_another_material_does_not_count(void **state)
{
    (void)state;
    const char *const settings[] = {
        "solver={nonsense: {pressure: -6.5 GPa}}",
        "materials.gas={eos: {ideal-gas: {density: 1 kg/m^3, gamma: 1.4}}}",
        "expected_warnings={lump: {warning: tension, of: [gas], reason: it is a test}}", NULL};
    struct run_result result = run(settings, &(struct run_options){.threads = 1});
    assert_int_equal(result.warnings.unexpected, 1);
    run_result_free(&result);
}

static void expect_the_same_after_a_resume(const char *const *settings)
{
    assert_int_equal(system("rm -rf test_warnings_resumed"), 0);
    struct run_options options = {.threads = 1, .output = "test_warnings_resumed", .max_steps = 5};
    struct run_result whole = run(settings, &(struct run_options){.threads = 1});
    struct run_result part = run(settings, &options);
    run_result_free(&part);
    options.resume = true;
    options.max_steps = 0;
    part = run(settings, &options);
    assert_int_equal(part.warnings.count, 1);
    assert_string_equal(part.warnings.item[0].text, whole.warnings.item[0].text);
    run_result_free(&part);
    run_result_free(&whole);
}

static void warnings_survive_a_resume(void **state)
{
    (void)state;
    const char *const settings[] = {"solver={nonsense: {pressure: -6.5 GPa}}", NULL};
    expect_the_same_after_a_resume(settings);
    const char *const lasting[] = {LARGE, "solver={nonsense: {pressure: -12.8 GPa, many: 256}}",
                                   NULL};
    expect_the_same_after_a_resume(lasting);
    const char *const failed[] = {BREAKS, "probes={face: {tracer: [0 m], fields: [velocity]}}",
                                  NULL};
    expect_the_same_after_a_resume(failed);
}

/* Verifies the case under SETTINGS; the messages are to be freed. */
static char *verified(const char *const *settings, bool strict)
{
    struct verify_result result;
    const char *const paths[] = {case_file};
    const struct verify_options options = {
        .reading = {.settings = settings, .setting_count = count_settings(settings)},
        .catalogue = nonsense_catalogue(),
        .running = {.threads = 1},
        .warnings_fail = strict,
    };
    write_case();
    struct error *error = verify_cases(paths, 1, &options, &result);
    char *said = messages(error);
    error_free(error);
    verify_result_free(&result);
    return said;
}

static void verify_fails_on_a_warning_that_the_case_does_not_list(void **state)
{
    (void)state;
    const char *const settings[] = {"solver={nonsense: {pressure: -6.5 GPa}}", NULL};
    char *said = verified(settings, true);
    assert_non_null(strstr(said, "warning of tension in metal, which `expected_warnings`"));
    free(said);
    said = verified(settings, false); /* a sweep of `bolide run` */
    assert_string_equal(said, "");
    free(said);
    const char *const listed[] = {
        "solver={nonsense: {pressure: -6.5 GPa}}",
        "expected_warnings={lump: {warning: tension, reason: it is a test}}", NULL};
    said = verified(listed, true);
    assert_string_equal(said, "");
    free(said);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_run_that_stays_within_its_models_has_no_warning),
        cmocka_unit_test(tension_beyond_a_twentieth_of_the_modulus_is_named),
        cmocka_unit_test(a_known_tensile_strength_takes_the_place_of_the_estimate),
        cmocka_unit_test(metals_of_the_library_are_named_beyond_their_spall_strength),
        cmocka_unit_test(a_model_that_limits_tension_needs_no_estimate),
        cmocka_unit_test(a_speed_beyond_three_times_that_of_the_start_is_named),
        cmocka_unit_test(a_state_that_can_expand_may_move_faster),
        cmocka_unit_test(a_prescribed_motion_may_move_others),
        cmocka_unit_test(a_temperature_below_zero_is_named),
        cmocka_unit_test(a_density_beyond_the_equation_of_state_is_named),
        cmocka_unit_test(an_explosive_compressed_before_it_is_lit_is_named),
        cmocka_unit_test(a_tracer_is_named_when_its_particle_fails),
        cmocka_unit_test(a_tracer_of_another_particle_is_not_named),
        cmocka_unit_test(tension_that_lasts_is_named_for_its_body),
        cmocka_unit_test(surfaces_that_cut_the_lattice_creep_in_small_tension_that_lasts),
        cmocka_unit_test(tension_that_passes_or_cannot_last_has_no_warning),
        cmocka_unit_test(an_expected_warning_has_a_reason_and_is_counted_apart),
        cmocka_unit_test(an_expected_warning_of_another_material_does_not_count),
        cmocka_unit_test(warnings_survive_a_resume),
        cmocka_unit_test(verify_fails_on_a_warning_that_the_case_does_not_list),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
