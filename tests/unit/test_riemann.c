/* The acoustic Riemann problem against what waves must do, and against tabulated states. */
#include "dice.h"

#include "riemann/dukowicz.h"
#include "riemann/exact_gas.h"

static struct side random_side(struct dice *dice)
{
    struct side side = {.impedance = pow(10.0, dice_between(dice, 2.0, 8.0)),
                        .velocity = dice_between(dice, -1e3, 1e3),
                        .stress = dice_between(dice, -1e10, 1e10)};
    return side;
}

static void acoustic_contact_of_equal_states_is_that_state(void **state)
{
    (void)state;
    struct dice dice = {1};
    for (int k = 0; k < 1000; k++) {
        struct side side = random_side(&dice);
        struct contact contact = riemann_acoustic(side, side);
        assert_true(contact.velocity == side.velocity);
        assert_close(contact.stress, side.stress, 1e-15);
        /* Of different impedance too. */
        struct side other = side;
        other.impedance = random_side(&dice).impedance;
        contact = riemann_acoustic(side, other);
        assert_true(contact.velocity == side.velocity);
        assert_close(contact.stress, side.stress, 1e-15);
    }
}

/* Seen from the other side the axis turns round: velocities change their sign, stresses do not. */
static void acoustic_contact_is_the_same_from_both_sides(void **state)
{
    (void)state;
    struct dice dice = {2};
    for (int k = 0; k < 1000; k++) {
        struct side left = random_side(&dice), right = random_side(&dice);
        struct contact contact = riemann_acoustic(left, right);
        struct side turned_left = left, turned_right = right;
        turned_left.velocity = -left.velocity;
        turned_right.velocity = -right.velocity;
        struct contact turned = riemann_acoustic(turned_right, turned_left);
        double speed =
            fabs(left.velocity) + fabs(right.velocity) +
            (fabs(left.stress) + fabs(right.stress)) / (left.impedance + right.impedance);
        double stress =
            fabs(left.stress) + fabs(right.stress) +
            fabs(right.velocity - left.velocity) * minimum(left.impedance, right.impedance);
        assert_near(turned.velocity, -contact.velocity, 1e-14 * speed);
        assert_near(turned.stress, contact.stress, 1e-14 * stress);
    }
}

/* Across a wave of impedance Z the jumps of stress and velocity are in the ratio Z: momentum is
 * kept. */
static void acoustic_contact_keeps_momentum_across_both_waves(void **state)
{
    (void)state;
    struct dice dice = {3};
    for (int k = 0; k < 1000; k++) {
        struct side left = random_side(&dice), right = random_side(&dice);
        struct contact contact = riemann_acoustic(left, right);
        double scale = fabs(left.stress) + fabs(right.stress) +
                       (left.impedance + right.impedance) *
                           (fabs(left.velocity) + fabs(right.velocity) + fabs(contact.velocity));
        assert_near(contact.stress - left.stress,
                    left.impedance * (contact.velocity - left.velocity), 1e-14 * scale);
        assert_near(contact.stress - right.stress,
                    -right.impedance * (contact.velocity - right.velocity), 1e-14 * scale);
    }
}

static void acoustic_contact_lies_between_hard_and_soft(void **state)
{
    (void)state;
    /* Against a wall at rest stress rises by Z U; at a free surface velocity by sigma/Z. */
    struct side moving = {4e6, 100.0, -1e8, 0.0, 0.0}, wall = {.impedance = 1e30};
    struct side nothing = {.impedance = 0.0};
    struct contact contact = riemann_acoustic(moving, wall);
    assert_near(contact.velocity, 0.0, 1e-12);
    assert_close(contact.stress, -1e8 - 4e8, 1e-14);
    contact = riemann_acoustic(moving, nothing);
    assert_close(contact.velocity, 100.0 + 25.0, 1e-14);
    assert_near(contact.stress, 0.0, 1e-6);
}

/* Acceptance test T2: two gases at rest, gamma = 3. */
static void acoustic_contact_of_two_gases_is_the_tabulated_one(void **state)
{
    (void)state;
    struct side left = {1500.0 * sqrt(3.0 * 3e4 / 1500.0), 0.0, -3e4, 1500.0, 3.0};
    struct side right = {1200.0 * sqrt(3.0 * 1e4 / 1200.0), 0.0, -1e4, 1200.0, 3.0};
    struct contact contact = riemann_acoustic(left, right);
    assert_near(contact.stress, -16810.848532, 1e-6);
    assert_near(contact.velocity, 1.1351414219, 1e-10);
}

/* Fluids have no shear impedance. */
static void two_sides_without_impedance_carry_no_stress_and_meet_half_way(void **state)
{
    (void)state;
    struct side left = {.velocity = 3.0}, right = {.velocity = -5.0};
    struct contact contact = riemann_acoustic(left, right);
    assert_true(contact.stress == 0.0);
    assert_true(contact.velocity == -1.0);
    /* One fluid: the solid's surface is free in shear. */
    struct side solid = {2e6, 3.0, 4e6, 0.0, 0.0};
    contact = riemann_acoustic(solid, right);
    assert_true(contact.stress == 0.0);
    assert_close(contact.velocity, 1.0, 1e-15);
}

static void mean_weights_give_the_standard_sph_means(void **state)
{
    (void)state;
    struct contact_weights mean = riemann_mean_weights();
    assert_true(contact_velocity_jump(mean, 6.0, 1e9) == 3.0);
    assert_true(contact_stress(mean, 2e6, 4e6, 1e3) == 3e6);
}

static struct side gas_side(double density, double pressure, double velocity, double gamma)
{
    struct side side = {sqrt(gamma * pressure * density), velocity, -pressure, density, gamma};
    return side;
}

static struct side shock_side(double density, double pressure, double velocity, double gamma)
{
    struct side side = gas_side(density, pressure, velocity, gamma);
    side.shock_slope = 0.5 * (gamma + 1.0);
    return side;
}

/* Acceptance tests T2 and T3. Of T3 the pressure is that of both curves at the tabulated
 * velocity. */
static void strong_shock_solvers_give_the_tabulated_states(void **state)
{
    (void)state;
    struct contact c = riemann_dukowicz(shock_side(1500, 3e4, 0, 3), shock_side(1200, 1e4, 0, 3));
    assert_close(c.stress, -20454.232862, 1e-10);
    assert_close(c.velocity, 1.1827824316, 1e-10);
    c = riemann_exact_gas(gas_side(1500, 3e4, 0, 3), gas_side(1200, 1e4, 0, 3));
    assert_close(c.stress, -18592.310924, 1e-10);
    assert_close(c.velocity, 1.1418764645, 1e-10);
    c = riemann_dukowicz(shock_side(1, 3e10, 0, 1.3), shock_side(1, 1e5, 0, 1.4));
    assert_close(c.velocity, 127432.129, 1e-8);
    c = riemann_exact_gas(gas_side(1, 3e10, 0, 1.3), gas_side(1, 1e5, 0, 1.4));
    assert_close(c.stress, -1.4205672612e10, 1e-10);
    assert_close(c.velocity, 1.0880202183e5, 1e-10);
}

/* All four cases of signs come up. */
static void dukowicz_contact_lies_on_both_shock_curves(void **state)
{
    (void)state;
    struct dice dice = {11};
    for (int k = 0; k < 10000; k++) {
        struct side l = shock_side(dice_between(&dice, 0.5, 5), pow(10, dice_between(&dice, 3, 8)),
                                   dice_between(&dice, -1e4, 1e4), dice_between(&dice, 1.1, 3));
        struct side r = shock_side(dice_between(&dice, 0.5, 5), pow(10, dice_between(&dice, 3, 8)),
                                   dice_between(&dice, -1e4, 1e4), dice_between(&dice, 1.1, 3));
        struct contact c = riemann_dukowicz(l, r);
        double cl = l.impedance / l.density, cr = r.impedance / r.density;
        double left0 = -l.stress - 0.25 * l.impedance * cl / l.shock_slope;
        double x = c.velocity - l.velocity - 0.5 * cl / l.shock_slope;
        double left = left0 - l.density * l.shock_slope * fabs(x) * x;
        double y = c.velocity - r.velocity + 0.5 * cr / r.shock_slope;
        double scale = fabs(left0) + l.density * l.shock_slope * x * x +
                       r.density * r.shock_slope * y * y + fabs(c.stress);
        assert_near(-c.stress, left, 1e-11 * scale);
    }
}

static void gases_that_part_too_fast_leave_a_vacuum(void **state)
{
    (void)state;
    struct side left = gas_side(1, 1e5, -4000, 1.4), right = gas_side(1, 1e5, 4000, 1.4);
    struct contact c = riemann_exact_gas(left, right);
    assert_true(c.stress == 0.0);
    assert_close(c.velocity, -4000 + 5.0 * sqrt(1.4e5), 1e-14);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strong_shock_solvers_give_the_tabulated_states),
        cmocka_unit_test(dukowicz_contact_lies_on_both_shock_curves),
        cmocka_unit_test(gases_that_part_too_fast_leave_a_vacuum),
        cmocka_unit_test(acoustic_contact_of_equal_states_is_that_state),
        cmocka_unit_test(acoustic_contact_is_the_same_from_both_sides),
        cmocka_unit_test(acoustic_contact_keeps_momentum_across_both_waves),
        cmocka_unit_test(acoustic_contact_lies_between_hard_and_soft),
        cmocka_unit_test(acoustic_contact_of_two_gases_is_the_tabulated_one),
        cmocka_unit_test(two_sides_without_impedance_carry_no_stress_and_meet_half_way),
        cmocka_unit_test(mean_weights_give_the_standard_sph_means),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
