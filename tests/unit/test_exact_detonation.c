/* A slab of TNT lit at a wall: printed values, and what mass, momentum and energy say. */
#include "exact_solution.h"

#include "exact/radial.h"
#include "exact/slab_detonation.h"

static const struct exact_slab_detonation tnt = {
    {1630.0, 371.2e9, 3.21e9, 4.15, 0.95, 0.3, 6.993e9, EOS_EXTENDED}};
static const double time = 10e-6;

static struct exact_state at(const struct solution *solution, double share)
{
    const double front = number(solution, "front");
    return solution->class->sample(solution->solved, SIDE_LEFT, share * front, time);
}

static void the_front_is_that_of_chapman_and_jouguet(void **state)
{
    (void)state;
    struct solution slab = solve(&exact_slab_detonation_class, &tnt, time);
    static const struct row rows[] = {
        {"detonation speed", 1.0, "6927.81"},  {"front pressure", 1e9, "20.98374"},
        {"front density", 1.0, "2227.47"},     {"front velocity", 1.0, "1858.23"},
        {"front sound speed", 1.0, "5069.58"}, {"pressure at rest", 1e9, "5.634"},
        {"density at rest", 1.0, "1460.5"},    {NULL, 0.0, NULL}};
    assert_rows(&slab, rows);
    assert_printed("edge", number(&slab, "edge of rest") / number(&slab, "front"), 1.0, "0.5220");
    release(&slab);
}

static void the_wave_behind_it_has_its_printed_values(void **state)
{
    (void)state;
    /* Of a coarser quadrature, whose last digits are off by one or two. */
    static const struct {
        double share, pressure, density, velocity;
    } rows[] = {{0.95, 18.487, 2128.1, 1629.5}, {0.9, 16.254, 2034.7, 1410.1},
                {0.85, 14.259, 1946.6, 1199.4}, {0.8, 12.478, 1863.1, 997.0},
                {0.75, 10.891, 1783.7, 802.3},  {0.7, 9.478, 1707.9, 614.9},
                {0.65, 8.224, 1635.2, 434.2},   {0.6, 7.113, 1565.2, 259.9},
                {0.55, 6.132, 1497.5, 91.7},    {0.5, 5.634, 1460.5, 0.0}};
    struct solution slab = solve(&exact_slab_detonation_class, &tnt, time);
    for (size_t k = 0; k < COUNT_OF(rows); k++) {
        const struct exact_state s = at(&slab, rows[k].share);
        assert_near(s.pressure, 1e9 * rows[k].pressure, 1e6, 2.0);
        assert_near(s.density, rows[k].density, 0.1, 2.0);
        assert_near(s.velocity, rows[k].velocity, 0.1, 2.0);
    }
    const struct exact_state ahead = at(&slab, 1.001);
    assert_true(ahead.density == 1630.0 && ahead.pressure == 0.0 && ahead.velocity == 0.0);
    release(&slab);
}

enum { MASS, MOMENTUM, ENERGY };
struct content {
    const struct solution *solution;
    int what;
};

static double content_at(const void *context, double share)
{
    const struct content *content = context;
    const struct exact_state s = at(content->solution, share);
    const double parts[] = {s.density, s.density * s.velocity,
                            s.density * (s.energy + 0.5 * square(s.velocity))};
    return parts[content->what];
}

static double content_of(const struct solution *slab, int what)
{
    const struct content content = {slab, what};
    const double edge = number(slab, "edge of rest") / number(slab, "front");
    return number(slab, "front") * (radial_integral(content_at, &content, 0.0, edge, 20) +
                                    radial_integral(content_at, &content, edge, 1.0, 200));
}

static void it_holds_the_mass_the_impulse_of_the_wall_and_no_new_energy(void **state)
{
    (void)state;
    struct solution slab = solve(&exact_slab_detonation_class, &tnt, time);
    const double mass = 1630.0 * number(&slab, "front");
    const double impulse = number(&slab, "pressure at rest") * time;
    assert_near(content_of(&slab, MASS), mass, mass, 1e-8);
    assert_near(content_of(&slab, MOMENTUM), impulse, impulse, 1e-8);
    assert_near(content_of(&slab, ENERGY), 0.0, 6.993e9 * number(&slab, "front"), 1e-8);
    release(&slab);
}

static void what_has_no_energy_to_give_does_not_detonate(void **state)
{
    (void)state;
    struct exact_slab_detonation inert = tnt;
    inert.jwl.energy = -50e9;
    assert_refused(&exact_slab_detonation_class, &inert);
}

/* Printed by ExactPack (2025) for Mader's problem: the Taylor wave of a gas of gamma 3. */
static void a_gas_has_the_wave_of_mader(void **state)
{
    (void)state;
    const struct exact_slab_detonation gas = {
        {1875.0, 0.0, 0.0, 4.0, 1.0, 2.0, 7.5e9, EOS_EXTENDED}};
    struct solution slab = solve(&exact_slab_detonation_class, &gas, 6.25e-6);
    assert_near(number(&slab, "detonation speed"), 8000.0, 8000.0, 1e-9);
    assert_near(number(&slab, "front pressure"), 30e9, 30e9, 1e-9);
    const struct exact_state s = slab.class->sample(slab.solved, SIDE_LEFT, 0.05 - 0.007, 6.25e-6);
    assert_printed("velocity", s.velocity, 1e3, "1.44000");
    assert_near(s.pressure, 22.3599e9, 22.3599e9, 2e-5); /* 30 GPa (c/c_CJ)^3 is 22.3596 GPa */
    assert_printed("density", s.density, 1e3, "2.2666667");
    release(&slab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_front_is_that_of_chapman_and_jouguet),
        cmocka_unit_test(the_wave_behind_it_has_its_printed_values),
        cmocka_unit_test(it_holds_the_mass_the_impulse_of_the_wall_and_no_new_energy),
        cmocka_unit_test(a_gas_has_the_wave_of_mader),
        cmocka_unit_test(what_has_no_energy_to_give_does_not_detonate),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
