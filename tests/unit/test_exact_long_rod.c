/* The long rod of Alekseevskii and Tate: its closed forms, and its own equations. */
#include "exact_solution.h"

#include "exact/long_rod.h"

/* Tungsten alloy into armour. */
static const struct exact_long_rod armour = {0.06, 1500.0, 17150.0, 7830.0, 1.6e9, 5.0e9};

static struct solution at_time(const struct exact_long_rod *rod, double time)
{
    return solve(&exact_long_rod_class, rod, time);
}

static double number_of(const struct exact_long_rod *rod, double time, const char *name)
{
    struct solution solution = at_time(rod, time);
    double value = number(&solution, name);
    release(&solution);
    return value;
}

static void without_strength_depth_is_hydrodynamic(void **state)
{
    (void)state;
    static const double densities[] = {2700.0, 7830.0, 17150.0};
    for (size_t i = 0; i < COUNT_OF(densities); i++) {
        struct exact_long_rod rod = armour;
        rod.rod_strength = rod.target_strength = 0.0;
        rod.target_density = densities[i];
        double wanted = sqrt(rod.rod_density / densities[i]);
        assert_near(number_of(&rod, 0.0, "final depth over length"), wanted, wanted, 1e-14);
        double u = rod.speed * wanted / (1.0 + wanted), end = rod.length / (rod.speed - u);
        assert_near(number_of(&rod, 0.0, "nose velocity at the start"), u, u, 1e-14);
        assert_near(number_of(&rod, 0.0, "time of the end"), end, end, 1e-14);
        assert_near(number_of(&rod, 0.5 * end, "depth"), 0.5 * end * u, rod.length, 1e-14);
        assert_near(number_of(&rod, 0.5 * end, "length of the rod"), 0.5 * rod.length, rod.length,
                    1e-14);
        /* The limit of a little strength. */
        rod.rod_strength = 1.0;
        rod.target_strength = 2.0;
        assert_near(number_of(&rod, 0.0, "final depth over length"), wanted, wanted, 1e-7);
    }
}

/* With equal strengths u = v/(1 + mu), mu^2 = rho_t/rho_p, down to rest: with k = rho_p mu/(2 Y (1
 * + mu)), L = L_0 exp(-k (V^2 - v^2)) and P = L_0/mu (1 - exp(-k V^2)). */
static void equal_strengths_have_a_closed_form(void **state)
{
    (void)state;
    struct exact_long_rod rod = armour;
    rod.rod_strength = rod.target_strength = 2e9;
    double mu = sqrt(rod.target_density / rod.rod_density);
    double k = 0.5 * rod.rod_density * mu / (rod.rod_strength * (1.0 + mu));
    double left = exp(-k * square(rod.speed));
    assert_near(number_of(&rod, 0.0, "final length"), rod.length * left, rod.length, 1e-10);
    assert_near(number_of(&rod, 0.0, "final depth"), rod.length / mu * (1.0 - left), rod.length,
                1e-10);
    for (int i = 1; i < 10; i++) {
        struct solution solution = at_time(&rod, 10e-6 * i);
        double v = number(&solution, "tail velocity");
        double length = rod.length * exp(-k * (square(rod.speed) - square(v)));
        assert_near(number(&solution, "length of the rod"), length, rod.length, 1e-10);
        assert_near(number(&solution, "depth"), (rod.length - length) / mu, rod.length, 1e-10);
        assert_near(number(&solution, "nose velocity"), v / (1.0 + mu), v, 1e-12);
        release(&solution);
    }
}

/* Where the target is the stronger, u = 0 below v_c, and what is left then is spent: L = L_c
 * exp(-rho_p v_c^2/(2 Y)). */
static void strong_target_stops_the_nose_first(void **state)
{
    (void)state;
    struct exact_long_rod slow = armour;
    slow.speed = number_of(&armour, 0.0, "tail velocity where penetration ends");
    assert_near(slow.speed, sqrt(2.0 * 3.4e9 / 17150.0), slow.speed, 1e-14);
    double left = exp(-0.5 * slow.rod_density * square(slow.speed) / slow.rod_strength);
    assert_near(number_of(&slow, 0.0, "final depth"), 0.0, slow.length, 1e-12);
    assert_near(number_of(&slow, 0.0, "final length"), slow.length * left, slow.length, 1e-10);
    slow.speed *= 0.9;
    assert_true(number_of(&slow, 0.0, "final depth") == 0.0);
    assert_true(number_of(&armour, 0.0, "final depth over length") > 0.5);
}

/* Where the rod is the stronger it is rigid below v_r, and goes on by rho_p L/rho_t ln(1 + rho_t
 * v_r^2/(2 R)) in the time rho_p L sqrt(2/(rho_t R)) atan(v_r sqrt(rho_t/(2 R))). */
static void strong_rod_ends_rigid(void **state)
{
    (void)state;
    struct exact_long_rod rod = armour;
    rod.rod_strength = 3e9;
    rod.target_strength = 1e9;
    double turn = number_of(&rod, 0.0, "tail velocity where erosion ends");
    assert_near(turn, sqrt(4e9 / 7830.0), turn, 1e-14);
    assert_true(number_of(&rod, 0.0, "final length") < rod.length);
    rod.speed = turn;
    double mass = rod.rod_density * rod.length;
    double head = 0.5 * rod.target_density * square(turn) / rod.target_strength;
    double depth = mass / rod.target_density * log1p(head);
    double time = mass * sqrt(2.0 / (rod.target_density * rod.target_strength)) * atan(sqrt(head));
    assert_true(number_of(&rod, 0.0, "final length") == rod.length);
    assert_near(number_of(&rod, 0.0, "final depth"), depth, depth, 1e-10);
    assert_near(number_of(&rod, 0.0, "time of the end"), time, time, 1e-10);
}

/* Bernoulli's equation at the nose, the motion of the tail and the shortening of the rod. */
static void its_equations_hold(void **state)
{
    (void)state;
    const double dt = 1e-9;
    for (int i = 1; i < 7; i++) {
        double time = 10e-6 * i;
        struct solution now = at_time(&armour, time), before = at_time(&armour, time - dt),
                        after = at_time(&armour, time + dt);
        double v = number(&now, "tail velocity"), u = number(&now, "nose velocity");
        double length = number(&now, "length of the rod");
        double rod = 0.5 * armour.rod_density * square(v - u) + armour.rod_strength;
        double target = 0.5 * armour.target_density * square(u) + armour.target_strength;
        assert_near(rod, target, target, 1e-12);
        double rate = number(&after, "tail velocity") - number(&before, "tail velocity");
        assert_near(rate / (2.0 * dt), -armour.rod_strength / (armour.rod_density * length),
                    armour.rod_strength / (armour.rod_density * length), 1e-5);
        rate = number(&after, "length of the rod") - number(&before, "length of the rod");
        assert_near(rate / (2.0 * dt), u - v, v, 1e-7);
        rate = number(&after, "depth") - number(&before, "depth");
        assert_near(rate / (2.0 * dt), u, v, 1e-7);
        double nose = exact_long_rod_class.contact(now.solved, time);
        assert_true(nose == number(&now, "depth"));
        struct exact_state seen =
            exact_long_rod_class.sample(now.solved, SIDE_LEFT, nose - 0.5 * length, time);
        assert_near(seen.velocity, v, v, 1e-12);
        assert_true(seen.density == armour.rod_density);
        seen = exact_long_rod_class.sample(now.solved, SIDE_LEFT, nose - 1.01 * length, time);
        assert_true(seen.density == 0.0);
        seen = exact_long_rod_class.sample(now.solved, SIDE_RIGHT, nose + 1e-3, time);
        assert_true(seen.density == armour.target_density && seen.velocity == 0.0);
        release(&now);
        release(&before);
        release(&after);
    }
}

static void rod_that_never_stops_is_refused(void **state)
{
    (void)state;
    struct exact_long_rod rod = armour;
    rod.target_strength = 0.0;
    assert_refused(&exact_long_rod_class, &rod);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_strength_depth_is_hydrodynamic),
        cmocka_unit_test(equal_strengths_have_a_closed_form),
        cmocka_unit_test(strong_target_stops_the_nose_first),
        cmocka_unit_test(strong_rod_ends_rigid),
        cmocka_unit_test(its_equations_hold),
        cmocka_unit_test(rod_that_never_stops_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
