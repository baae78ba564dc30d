/* The acoustic contact problem against what waves must do, and against tabulated states. */
#include "dice.h"

#include "riemann/acoustic.h"

static struct side random_side(struct dice *dice)
{
    struct side side = {pow(10.0, dice_between(dice, 2.0, 8.0)), dice_between(dice, -1e3, 1e3),
                        dice_between(dice, -1e10, 1e10)};
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

/* Across a wave of impedance Z the jumps of stress and velocity are in the ratio Z: momentum is kept. */
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
    struct side moving = {4e6, 100.0, -1e8}, wall = {1e30, 0.0, 0.0}, nothing = {0.0, 0.0, 0.0};
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
    struct side left = {1500.0 * sqrt(3.0 * 3e4 / 1500.0), 0.0, -3e4};
    struct side right = {1200.0 * sqrt(3.0 * 1e4 / 1200.0), 0.0, -1e4};
    struct contact contact = riemann_acoustic(left, right);
    assert_near(contact.stress, -16810.848532, 1e-6);
    assert_near(contact.velocity, 1.1351414219, 1e-10);
}

/* Fluids have no shear impedance. */
static void two_sides_without_impedance_carry_no_stress_and_meet_half_way(void **state)
{
    (void)state;
    struct side left = {0.0, 3.0, 0.0}, right = {0.0, -5.0, 0.0};
    struct contact contact = riemann_acoustic(left, right);
    assert_true(contact.stress == 0.0);
    assert_true(contact.velocity == -1.0);
    /* One fluid: the solid's surface is free in shear. */
    struct side solid = {2e6, 3.0, 4e6};
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

int main(void)
{
    const struct CMUnitTest tests[] = {
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
