/* What a body starts with: states from two givens, temperatures, stresses, and fields of the
 * position. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "case/internal.h"
#include "populations.h"
#include "workshop.h"

static const struct start_given nothing = {
    .density = NAN, .pressure = NAN, .energy = NAN, .temperature = NAN};

static struct material aluminium(void)
{
    struct material material = {
        .strength = {.kind = STRENGTH_perfect_plastic,
                     .of.perfect_plastic = {.shear_modulus = 23e9, .yield = 0.3e9}},
        .heat = {.capacity = 880.0, .temperature = 293.0}};
    material.eos.kind = EOS_mie_grueneisen;
    material.eos.of.mie_grueneisen = (struct eos_mie_grueneisen){
        .density = 2700.0, .sound = 5200.0, .slope = 1.338, .gamma = 2.0, .bulk_modulus = 73e9};
    return material;
}

static struct point found_state(const struct start_given *given, const struct material *material)
{
    struct point point;
    const char *key, *wrong = start_state(given, material, &point, &key);
    if (wrong)
        fail_msg("%s: %s", key, wrong);
    return point;
}

static void a_temperature_stands_for_the_energy(void **state)
{
    (void)state;
    const struct material material = aluminium();
    struct start_given given = nothing;
    given.temperature = 600.0;
    struct point hot = found_state(&given, &material);
    assert_true(hot.density == 2700.0 && hot.pressure > 0.0);
    assert_true(fabs(hot.energy / (880.0 * 307.0) - 1.0) < 1e-14);
    given.pressure = 0.0;
    hot = found_state(&given, &material);
    assert_true(hot.density < 2700.0 && fabs(hot.pressure) < 1.0);
    assert_true(fabs(heat_temperature(&material.heat, &material.eos, hot.density, hot.energy) -
                     600.0) < 1e-10);
    given.pressure = 20e9;
    hot = found_state(&given, &material);
    assert_true(hot.density > 2700.0 && fabs(hot.pressure / 20e9 - 1.0) < 1e-12);
    assert_true(fabs(heat_temperature(&material.heat, &material.eos, hot.density, hot.energy) -
                     600.0) < 1e-9);
    given.pressure = NAN;
    given.density = 2800.0;
    hot = found_state(&given, &material);
    assert_true(hot.density == 2800.0);
    assert_true(hot.energy == heat_energy(&material.heat, &material.eos, 2800.0, 600.0));
}

static void a_stress_is_its_deviator_and_its_mean(void **state)
{
    (void)state;
    const struct material material = aluminium();
    struct start_given given = nothing;
    given.stressed = true;
    given.stress = (struct sym3){90e6, 30e6, 0.0, 20e6, -10e6, 5e6};
    struct point point = found_state(&given, &material);
    assert_true(fabs(point.pressure / -40e6 - 1.0) < 1e-6 && point.density < 2700.0);
    const double *s = &point.deviator.xx;
    const double wanted[6] = {50e6, -10e6, -40e6, 20e6, -10e6, 5e6};
    for (int i = 0; i < 6; i++)
        assert_true(fabs(s[i] - wanted[i]) < 1e-6);
    given.stress.xy = 0.3e9;
    const char *key, *wrong = start_state(&given, &material, &point, &key);
    assert_string_equal(wrong, "this is above the yield stress: the material would flow at once");
    assert_string_equal(key, "stress");
}

static struct field_value field(const char *text)
{
    struct quantity result;
    struct field_value value;
    assert_null(varying_expression_compile(text, ARGUMENT_POSITION, NULL, &result, &value.varying));
    value.constant = result.value;
    return value;
}

/* A square of 1 m whose density, velocity and temperature depend on the place. */
static struct body_input *add_varied(struct workshop *w, struct shape_box *box)
{
    open_workshop(w, 2, 0.125);
    w->iron = aluminium();
    struct body_input *body = add_body(w, "box", box);
    body->varies = true;
    body->density = field("2700 kg/m^3 + 80 kg/m^3*(x > 0.5 m)");
    body->pressure = body->energy = (struct field_value){NAN, NULL};
    body->temperature = field("300 K + 100 K/m*y");
    body->velocity = (struct field_list){2, {field("-(3 1/s)*y"), field("(3 1/s)*x")}};
    return body;
}

static void release(struct body_input *body)
{
    varying_expression_free(body->density.varying);
    varying_expression_free(body->temperature.varying);
    for (int i = 0; i < body->velocity.count; i++)
        varying_expression_free(body->velocity.at[i].varying);
}

static void every_particle_has_the_state_of_its_place(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    struct workshop w;
    struct simulation simulation;
    struct shape_box box = {VECTOR(0.0, 0.0), VECTOR(1.0, 1.0)};
    struct body_input *body = add_varied(&w, &box);
    const struct material *material = &w.iron;
    assert_made(&w, &alone, &simulation);
    const struct particles *p = particles_of(&simulation);
    assert_int_equal(p->count, 64);
    for (int i = 0; i < p->count; i++) {
        const double *x = p->position[i];
        double density = x[0] > 0.5 ? 2780.0 : 2700.0;
        assert_true(p->density[i] == density && p->mass[i] == density / 64.0);
        assert_true(p->velocity[i][0] == -3.0 * x[1] && p->velocity[i][1] == 3.0 * x[0]);
        double temperature =
            heat_temperature(&material->heat, &material->eos, density, p->energy[i]);
        assert_true(fabs(temperature - (300.0 + 100.0 * x[1])) < 1e-9);
    }
    end_simulation(&simulation);
    struct body_summary summary;
    assert_null(generate_summary(&w.input, NULL, &summary));
    assert_true(fabs(summary.mass / 2740.0 - 1.0) < 1e-14);
    assert_true(summary.density.low == 2700.0 && summary.density.high == 2780.0);
    assert_true(fabs(summary.temperature.high - 393.75) < 1e-9 &&
                summary.fastest.density == 2780.0);
    release(body);
}

static void a_state_that_is_none_is_told_at_the_key_with_its_first_place(void **state)
{
    (void)state;
    struct workshop w;
    struct shape_box box = {VECTOR(0.0, 0.0), VECTOR(1.0, 1.0)};
    struct body_input *body = add_varied(&w, &box);
    varying_expression_free(body->density.varying);
    body->density = field("2700 kg/m^3*(x < 0.5 m)");
    assert_refused(&w, 1,
                   "bodies.matrix.density: the value must be more than zero (at [0.5625 m, 0.0625 "
                   "m])");
    varying_expression_free(body->velocity.at[1].varying);
    varying_expression_free(body->density.varying);
    body->density = (struct field_value){2700.0, NULL};
    body->velocity.at[1] = field("1 m/s*sqrt((y - 0.5 m)/(1 m))");
    assert_refused(&w, 1, "bodies.matrix.velocity: the value is not finite (at [0.0625 m, 0.0625");
    release(body);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_temperature_stands_for_the_energy),
        cmocka_unit_test(a_stress_is_its_deviator_and_its_mean),
        cmocka_unit_test(every_particle_has_the_state_of_its_place),
        cmocka_unit_test(a_state_that_is_none_is_told_at_the_key_with_its_first_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
