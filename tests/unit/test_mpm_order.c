/* Velocities of nodes by the inverse of the full mass matrix to some order, in a bar at rest in
 * which no force acts yet: so one step shows what nodes make of the velocities of particles. */
#include "populations.h"
#include "running.h"

static const char bar_case[] =
    "format: 1\ntitle: A bar\ndimension: 1\nresolution: 1 mm\nsolver: {mpm: {cell: 2 mm}}\n"
    "materials:\n"
    "  aluminium:\n"
    "    eos: {mie-grueneisen: {density: 2700 kg/m^3, sound: 5350 m/s, slope: 1.35, gamma: "
    "2.17, bulk_modulus: 73 GPa}}\n"
    "    strength: {perfect-plastic: {shear_modulus: 23 GPa, yield: 0.4 GPa}}\n"
    "bodies:\n"
    "  bar: {material: aluminium, box: {from: [0 mm], to: [64 mm]}}\n"
    "walls:\n"
    "  low: {mirror: x, at: 0 mm, side: low}\n"
    "  high: {mirror: x, at: 64 mm, side: high}\n"
    "run: {until: 1 s}\n";

/* Velocities that particles get, by place. */
static double alternating(double x) { return (int)(x / 1e-3) % 2 ? -1e-3 : 1e-3; }
static double linear(double x) { return x - 0.032; }
static double wave(double x) { return 1e-3 * sin(M_PI * x / 8e-3); } /* of eight cells */

/* The component of the velocities along those that they were, after one step by particles that keep
 * FLIP of their own, over MARGIN from the walls; *most becomes the largest change. */
static double kept(double (*velocity)(double), const char *shape, int order, double flip,
                   double margin, double *most)
{
    char setting[96];
    snprintf(setting, sizeof setting, "solver.mpm.shape=%s", shape);
    const struct variant variant = {"", 1, 1.0, setting, false};
    struct running *run = begin_fresh(bar_case, &variant);
    struct particles *p = particles_of(&run->simulation);
    run->mpm.parameters.order = order;
    run->mpm.parameters.flip = flip;
    for (int32_t i = 0; i < p->count; i++)
        p->velocity[i][0] = velocity(p->position[i][0]);
    double *before = malloc((size_t)p->count * sizeof *before);
    for (int32_t i = 0; i < p->count; i++)
        before[i] = p->velocity[i][0];
    step(run, 1);
    double along = 0.0, square_of = 0.0;
    *most = 0.0;
    for (int32_t i = 0; i < p->count; i++) {
        const double x = p->position[i][0];
        if (x < margin || x > 0.064 - margin)
            continue;
        along += p->velocity[i][0] * before[i];
        square_of += before[i] * before[i];
        *most = maximum(*most, fabs(p->velocity[i][0] - before[i]));
    }
    free(before);
    end(run);
    return along / square_of;
}

static const char *const shapes[] = {"gimp", "quadratic", "cubic"};

static void what_nodes_do_not_see_goes_in_one_step(void **state)
{
    (void)state;
    double most;
    for (int order = 1; order <= 3; order++)
        for (size_t k = 0; k < COUNT_OF(shapes); k++) {
            assert_true(fabs(kept(alternating, shapes[k], order, 0.0, 0.0, &most)) < 1e-12);
            assert_true(fabs(kept(alternating, shapes[k], order, 1.0, 0.0, &most) - 1.0) < 1e-12);
        }
}

static void a_linear_velocity_stays(void **state)
{
    (void)state;
    double most;
    for (int order = 1; order <= 3; order++)
        for (size_t k = 0; k < COUNT_OF(shapes); k++) {
            kept(linear, shapes[k], order, 0.0, 0.02, &most);
            assert_true(most < 1e-14);
        }
}

/* Of what nodes see in part, lambda, the order k keeps 1 - (1 - lambda)^k. */
static void each_order_keeps_more_of_a_short_wave(void **state)
{
    (void)state;
    double most;
    for (size_t k = 0; k < COUNT_OF(shapes); k++) {
        const double first = kept(wave, shapes[k], 1, 0.0, 0.0, &most);
        assert_true(first > 0.5 && first < 0.95);
        for (int order = 2; order <= 4; order++) {
            const double expected = 1.0 - pow(1.0 - first, order);
            assert_true(fabs(kept(wave, shapes[k], order, 0.0, 0.0, &most) - expected) < 2e-3);
        }
    }
}

static void check_refused(const char *setting, const char *why)
{
    const struct variant variant = {"", 1, 1.0, setting, false};
    struct running *run = open_case(bar_case, &variant);
    struct error *error = refusal_of(run, run->input->solver.value);
    assert_non_null(error);
    assert_int_equal(error_kind(error), ERROR_INPUT);
    assert_non_null(strstr(error_message(error, 0), "solver.mpm.order"));
    assert_non_null(strstr(error_message(error, 0), why));
    error_free(error);
    end(run);
}

static void affine_particles_and_linear_functions_have_no_order(void **state)
{
    (void)state;
    check_refused("solver.mpm={order: 2, transfer: apic}", "transfer: flip");
    check_refused("solver.mpm={order: 2, shape: linear}", "shape: linear");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_nodes_do_not_see_goes_in_one_step),
        cmocka_unit_test(a_linear_velocity_stays),
        cmocka_unit_test(each_order_keeps_more_of_a_short_wave),
        cmocka_unit_test(affine_particles_and_linear_functions_have_no_order),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
