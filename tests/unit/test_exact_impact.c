/* Plates that strike each other: Wilkins' impact against its printed table, the laws of
 * conservation, the Riemann problem while the waves have met nothing, and the mirror image. */
#include "exact_solution.h"

#include "exact/elastic_plastic_impact.h"
#include "exact/elastic_plastic_riemann.h"
#include "material/eos.h"

static const struct choice metal_choice = {.size = sizeof(struct eos_grueneisen_eta)};
static struct eos_grueneisen_eta grey = {2785.0, 5328.0, 1.338, 2.0, EOS_EXTENDED};
static struct eos_grueneisen_eta red = {8930.0, 3940.0, 1.490, 2.0, EOS_EXTENDED};

static struct exact_solid metal(struct eos_grueneisen_eta *eos, double shear_modulus, double yield,
                                double velocity)
{
    return (struct exact_solid){.reference_density = NAN,
                                .bulk_modulus = NAN,
                                .shear_modulus = shear_modulus,
                                .yield = yield,
                                .density = NAN,
                                .velocity = velocity,
                                .eos = {EOS_grueneisen_eta, &metal_choice, eos}};
}

static struct exact_solid aluminium(double velocity)
{
    return metal(&grey, 27.6e9, 300e6, velocity);
}

static struct exact_solid copper(double velocity) { return metal(&red, 45e9, 90e6, velocity); }

/* Wilkins' impact, solved once for all tests. */
static int setup(void **state)
{
    struct exact_elastic_plastic_impact problem = {
        {aluminium(800.0), aluminium(0.0)}, 5e-3, {0.0, NAN}, 5e-6};
    struct solution *solution = calloc(1, sizeof *solution);
    *solution = solve(&exact_elastic_plastic_impact_class, &problem, 5e-6);
    *state = solution;
    return 0;
}

static int teardown(void **state)
{
    release(*state);
    free(*state);
    return 0;
}

static struct exact_state at_end(const struct solution *solution, double x)
{
    enum exact_side side = exact_side_at(solution->class, solution->solved, x, 5e-6);
    return solution->class->sample(solution->solved, side, x, 5e-6);
}

static void plateaus_of_wilkins_impact_have_the_printed_digits(void **state)
{
    static const struct {
        double x;
        const char *density, *velocity, *pressure, *deviator;
    } rows[] = {
        {28e-3, "2953.352", "325.354", "5313.59", "200"},
        {33e-3, "2985.629", "400.000", "6435.879", "-200"},
        {36e-3, "2800.177", "35.178", "435.879", "-200"},
        {39e-3, "2785", "0.0", "0.0", "0"},
    };
    const struct solution *solution = *state;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        struct exact_state there = at_end(solution, rows[i].x);
        assert_printed("density", there.density, 1.0, rows[i].density);
        assert_printed("velocity", there.velocity, 1.0, rows[i].velocity);
        assert_printed("pressure", there.pressure, 1e6, rows[i].pressure);
        assert_printed("deviator", there.deviator, 1e6, rows[i].deviator);
        assert_near(there.stress, there.deviator - there.pressure, 1e9, 1e-14);
    }
}

/* The table reads these off a fine grid, which smears the head of the elastic release: its exact
 * place follows from where it meets the plastic shock, 0.8805 mm at 0.8064 us, and its speed there,
 * 7312.5 m/s. */
static void wilkins_plate_is_released_as_printed(void **state)
{
    static const double plastic[][2] = {{22.90, 300.0},  {23.43, 1000.0}, {24.13, 2000.0},
                                        {24.81, 3000.0}, {25.46, 4000.0}, {26.12, 5000.0}};
    const struct solution *solution = *state;
    for (size_t i = 0; i < COUNT_OF(plastic); i++) {
        double low = at_end(solution, 1e-3 * plastic[i][0] - 0.04e-3).pressure;
        double high = at_end(solution, 1e-3 * plastic[i][0] + 0.04e-3).pressure;
        assert_true(low < 1e6 * plastic[i][1] && high > 1e6 * plastic[i][1]);
    }
    assert_true(at_end(solution, 30.34e-3).deviator > 199e6);
    assert_true(at_end(solution, 30.71e-3).deviator > 0.0);
    assert_true(at_end(solution, 30.77e-3).deviator < 0.0);
    assert_true(at_end(solution, 31.51e-3).deviator > -199e6);
    assert_true(at_end(solution, 31.58e-3).deviator == at_end(solution, 33e-3).deviator);
    struct exact_state released = at_end(solution, 10e-3);
    assert_near(released.velocity, 7.02, 1.0, 0.02);
    assert_near(released.pressure, 200e6, 1e6, 0.3);
    assert_near(released.density, 2789.78, 1.0, 0.01);
    assert_near(number(solution, "left end place"), 0.7013e-3, 1e-3, 0.0015);
    assert_near(number(solution, "contact place"), 5.693e-3, 1e-3, 0.0005);
    assert_near(number(solution, "contact velocity"), 7.0, 1.0, 0.05);
    assert_true(at_end(solution, 34.542e-3).pressure > 6e9);
    assert_true(at_end(solution, 34.544e-3).pressure < 1e9);
    assert_true(at_end(solution, 37.451e-3).pressure > 4e8);
    assert_true(at_end(solution, 37.453e-3).pressure < 1e8);
}

/* Fans are read between the middles of their pieces: to the second order of these. */
static void impact_keeps_mass_momentum_and_energy(void **state)
{
    enum { POINTS = 20000 };
    const struct solution *solution = *state;
    double surface = number(solution, "left end place"), step = (40e-3 - surface) / POINTS;
    double mass = 0.0, momentum = 0.0, energy = 0.0;
    for (int i = 0; i < POINTS; i++) {
        struct exact_state there = at_end(solution, surface + (i + 0.5) * step);
        mass += there.density * step;
        momentum += there.density * there.velocity * step;
        energy += there.density * (there.energy + 0.5 * square(there.velocity)) * step;
    }
    double flyer = 2785.0 * 5e-3;
    assert_near(mass, 8.0 * flyer, 8.0 * flyer, 5e-5);
    assert_near(momentum, 800.0 * flyer, 800.0 * flyer, 2e-4);
    assert_near(energy, 0.5 * square(800.0) * flyer, 0.5 * square(800.0) * flyer, 2e-4);
}

static void before_its_waves_meet_an_impact_is_a_riemann_problem(void **state)
{
    (void)state;
    struct exact_elastic_plastic_impact impact = {
        {copper(60.0), aluminium(0.0)}, 25e-3, {0.0, 50e-3}, 3e-6};
    struct exact_elastic_plastic_riemann riemann = {{copper(60.0), aluminium(0.0)}, 25e-3};
    struct solution a = solve(&exact_elastic_plastic_impact_class, &impact, 2e-6);
    struct solution b = solve(&exact_elastic_plastic_riemann_class, &riemann, 2e-6);
    for (int i = 0; i < 500; i++) {
        double x = 0.2e-3 + 0.0995e-3 * i;
        for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
            struct exact_state s = a.class->sample(a.solved, (enum exact_side)side, x, 2e-6);
            struct exact_state t = b.class->sample(b.solved, (enum exact_side)side, x, 2e-6);
            if (side == SIDE_LEFT ? x > 25e-3 : x < 25.08e-3)
                t = b.class->star(b.solved, (enum exact_side)side);
            assert_near(s.density, t.density, t.density, 1e-12);
            assert_near(s.velocity, t.velocity, 60.0, 1e-9);
            assert_near(s.stress, t.stress, 1e9, 1e-9);
            assert_near(s.deviator, t.deviator, 1e9, 1e-9);
        }
    }
    release(&b);
    release(&a);
}

/* But for the weak waves that are let go: which ones, rounding may decide. */
static void mirror_image_of_an_impact_is_its_mirror_image(void **state)
{
    struct exact_elastic_plastic_impact mirror = {
        {aluminium(0.0), aluminium(-800.0)}, -5e-3, {NAN, 0.0}, 5e-6};
    const struct solution *a = *state;
    struct solution b = solve(&exact_elastic_plastic_impact_class, &mirror, 5e-6);
    for (int i = 1; i < 400; i++) {
        double x = 0.8e-3 + 0.09987e-3 * i;
        struct exact_state s = at_end(a, x), t = at_end(&b, -x);
        assert_near(s.velocity, -t.velocity, 800.0, 3e-5);
        assert_near(s.stress, t.stress, 6e9, 3e-5);
        assert_near(s.density, t.density, s.density, 3e-5);
    }
    release(&b);
}

static void surfaces_must_lie_outside_and_time_within(void **state)
{
    struct exact_elastic_plastic_impact problem = {
        {aluminium(800.0), aluminium(0.0)}, 5e-3, {6e-3, NAN}, 5e-6};
    assert_refused(&exact_elastic_plastic_impact_class, &problem);
    problem.rear[SIDE_LEFT] = NAN;
    problem.rear[SIDE_RIGHT] = 5e-3;
    assert_refused(&exact_elastic_plastic_impact_class, &problem);
    problem.rear[SIDE_RIGHT] = NAN;
    problem.solid[SIDE_LEFT].free = true;
    assert_refused(&exact_elastic_plastic_impact_class, &problem);
    const struct solution *solution = *state;
    struct exact_state late = solution->class->sample(solution->solved, SIDE_LEFT, 1e-3, 5.1e-6);
    assert_true(isnan(late.pressure));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plateaus_of_wilkins_impact_have_the_printed_digits),
        cmocka_unit_test(wilkins_plate_is_released_as_printed),
        cmocka_unit_test(impact_keeps_mass_momentum_and_energy),
        cmocka_unit_test(before_its_waves_meet_an_impact_is_a_riemann_problem),
        cmocka_unit_test(mirror_image_of_an_impact_is_its_mirror_image),
        cmocka_unit_test(surfaces_must_lie_outside_and_time_within),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
