/* Verney's shell: the printed table, and the balance of energy and momentum. */
#include "exact_solution.h"

#include "exact/verney.h"

static const struct exact_verney beryllium = {80e-3, 100e-3, 1845.0, 330e6, 417.1};

static struct exact_state at(const struct solution *solution, double r, double time)
{
    return solution->class->sample(solution->solved, SIDE_LEFT, r, time);
}

static double stop_radius(double speed)
{
    struct exact_verney shell = beryllium;
    shell.speed = speed;
    struct solution solution = solve(&exact_verney_class, &shell, 0.0);
    double radius = number(&solution, "inner radius at the stop");
    release(&solution);
    return radius;
}

static void shells_of_given_last_radius_have_the_printed_digits(void **state)
{
    (void)state;
    static const struct {
        double inner;
        const char *outer, *speed, *time, *energy;
    } rows[] = {
        {50e-3, "78.102", "417.08", "129.10", "1.43995"},
        {45e-3, "75.000", "454.65", "134.94", "1.71109"},
        {40e-3, "72.111", "490.30", "139.33", "1.98991"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        double low = 300.0, high = 600.0;
        for (int step = 0; step < 60; step++) {
            double middle = 0.5 * (low + high);
            if (stop_radius(middle) > rows[i].inner)
                low = middle;
            else
                high = middle;
        }
        struct exact_verney shell = beryllium;
        shell.speed = low;
        struct solution solution = solve(&exact_verney_class, &shell, 0.0);
        assert_printed("speed", low, 1.0, rows[i].speed);
        assert_printed("outer", number(&solution, "outer radius at the stop"), 1e-3, rows[i].outer);
        assert_printed("time", number(&solution, "time of the stop"), 1e-6, rows[i].time);
        assert_printed("energy", number(&solution, "kinetic energy at the start"), 1e6,
                       rows[i].energy);
        release(&solution);
    }
}

/* To a hundredth of a millimetre and the last digit of the shares: the radii of the table are
 * rounded down, and off by up to 1.3 um. The first row is checked against an integration of da/dt
 * besides. */
static void shell_moves_as_printed(void **state)
{
    (void)state;
    static const double rows[][4] = {
        {20e-6, 72.107, 93.805, 0.7585},  {40e-6, 65.192, 88.600, 0.5345},
        {60e-6, 59.389, 84.422, 0.3373},  {80e-6, 54.849, 81.292, 0.1770},
        {100e-6, 51.730, 79.221, 0.0639}, {120e-6, 50.168, 78.210, 0.0063},
        {130e-6, 49.997, 78.101, 0.0},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        struct solution solution = solve(&exact_verney_class, &beryllium, rows[i][0]);
        double share = number(&solution, "share of the kinetic energy");
        assert_near(number(&solution, "inner radius"), 1e-3 * rows[i][1], 1e-3, 2e-3);
        assert_near(number(&solution, "outer radius"), 1e-3 * rows[i][2], 1e-3, 2e-3);
        assert_near(share, rows[i][3], 1.0, 1e-4);
        assert_printed("stop", number(&solution, "time of the stop"), 1e-6, "129.11");
        assert_printed("energy", number(&solution, "kinetic energy at the start"), 1e6, "1.44009");
        if (i == 0)
            assert_near(number(&solution, "inner radius"), 72.10787351476863e-3, 0.08, 1e-13);
        release(&solution);
    }
}

static void stress_accelerates_the_shell(void **state)
{
    (void)state;
    struct solution solution = solve(&exact_verney_class, &beryllium, 0.0);
    double flow = 2.0 * beryllium.yield / sqrt(3.0), dt = 1e-8, dr = 1e-5;
    for (int i = 0; i < 20; i++) {
        double t = 2e-6 + 6e-6 * i, r = 0.081;
        struct exact_state now = at(&solution, r, t);
        if (!(now.density > 0.0) || !(at(&solution, r + dr, t).density > 0.0))
            continue;
        double rate =
            (at(&solution, r, t + dt).velocity - at(&solution, r, t - dt).velocity) / (2.0 * dt);
        double steep =
            (at(&solution, r + dr, t).velocity - at(&solution, r - dr, t).velocity) / (2.0 * dr);
        double pull =
            (at(&solution, r + dr, t).stress - at(&solution, r - dr, t).stress) / (2.0 * dr);
        double inertia = beryllium.density * (rate + now.velocity * steep);
        assert_near(inertia, pull + flow / r, flow / r, 1e-5);
        /* Work heats the particle that passes here. */
        double warmer =
            (at(&solution, r, t + dt).energy - at(&solution, r, t - dt).energy) / (2.0 * dt);
        double along =
            (at(&solution, r + dr, t).energy - at(&solution, r - dr, t).energy) / (2.0 * dr);
        double power = flow * -now.velocity / r;
        assert_near(beryllium.density * (warmer + now.velocity * along), power, power, 1e-5);
    }
    release(&solution);
}

static void surfaces_are_free_and_nothing_is_beyond(void **state)
{
    (void)state;
    struct solution solution = solve(&exact_verney_class, &beryllium, 50e-6);
    double inner = number(&solution, "inner radius"), outer = number(&solution, "outer radius");
    double push = beryllium.density * square(number(&solution, "velocity of the inner surface"));
    assert_near(at(&solution, inner + 1e-12, 50e-6).stress, 0.0, push, 1e-8);
    assert_near(at(&solution, outer - 1e-12, 50e-6).stress, 0.0, push, 1e-8);
    assert_true(at(&solution, inner - 1e-9, 50e-6).density == 0.0);
    assert_true(at(&solution, outer + 1e-9, 50e-6).density == 0.0);
    release(&solution);
}

static void shells_that_close_or_have_no_wall_are_refused(void **state)
{
    (void)state;
    struct exact_verney shell = beryllium;
    shell.speed = 1000.0;
    assert_refused(&exact_verney_class, &shell);
    shell = beryllium;
    shell.outer_radius = 70e-3;
    assert_refused(&exact_verney_class, &shell);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shells_of_given_last_radius_have_the_printed_digits),
        cmocka_unit_test(shell_moves_as_printed),
        cmocka_unit_test(stress_accelerates_the_shell),
        cmocka_unit_test(surfaces_are_free_and_nothing_is_beyond),
        cmocka_unit_test(shells_that_close_or_have_no_wall_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
