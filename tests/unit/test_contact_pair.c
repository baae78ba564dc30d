/* The contact of two particles against the Riemann problems that it is made of. */
#include "dice.h"

#include "riemann/contact_pair.h"

static struct pair_side side_of_dice(struct dice *dice)
{
    return (struct pair_side){.impedance = dice_between(dice, 1e6, 4e7),
                              .shear_impedance = dice_between(dice, 1e6, 2e7),
                              .stress = dice_between(dice, -1e9, 1e9),
                              .shear = {0.0, dice_between(dice, -1e8, 1e8), 0.0}};
}

static struct pair_difference difference_of(struct dice *dice, const struct pair_side *left,
                                            const struct pair_side *right)
{
    return (struct pair_difference){.velocity = dice_between(dice, -200.0, 200.0),
                                    .sliding = {0.0, dice_between(dice, -100.0, 100.0), 0.0},
                                    .shear = vec3_sub(right->shear, left->shear)};
}

static const struct pair_limits free_of_laws = {0.0, 0.0, 1.0, 0.0};

/* Along the axis and across it a pair is two acoustic contacts, with and without slopes that carry
 * nothing. */
static void both_parts_of_a_contact_are_acoustic(void **state)
{
    (void)state;
    struct dice dice = {7};
    for (int k = 0; k < 1000; k++) {
        const struct pair_side left = side_of_dice(&dice), right = side_of_dice(&dice);
        const struct pair_difference difference = difference_of(&dice, &left, &right);
        const struct contact along =
            riemann_acoustic((struct side){.impedance = left.impedance, .stress = left.stress},
                             (struct side){.impedance = right.impedance,
                                           .velocity = difference.velocity,
                                           .stress = right.stress});
        const struct contact across = riemann_acoustic(
            (struct side){.impedance = left.shear_impedance, .stress = left.shear.y},
            (struct side){.impedance = right.shear_impedance,
                          .velocity = difference.sliding.y,
                          .stress = right.shear.y});
        for (int carried = 0; carried < 2; carried++) {
            const struct pair_law law = {STAR_ACOUSTIC, true, carried, false, false};
            const struct pair_contact pair =
                contact_pair(&left, &right, &difference, free_of_laws, law);
            assert_near(pair.stress, along.stress, 1e-3);
            assert_near(pair.velocity, along.velocity, 1e-9);
            assert_near(pair.shear.y, across.stress, 1e-3);
            assert_near(pair.sliding.y, across.velocity, 1e-9);
        }
    }
}

/* Where slopes carry all of the difference, half from each side, there is no jump left to dissipate
 * anything. */
static void a_linear_field_is_met_in_the_middle(void **state)
{
    (void)state;
    struct dice dice = {9};
    struct pair_side left = side_of_dice(&dice), right = side_of_dice(&dice);
    const struct pair_difference difference = difference_of(&dice, &left, &right);
    left.carried = right.carried = (struct pair_carried){0.5, 0.5, 0.5, 0.5};
    const struct pair_law law = {STAR_SHOCK, true, true, false, false};
    const struct pair_contact pair = contact_pair(&left, &right, &difference, free_of_laws, law);
    assert_near(pair.stress, 0.5 * (left.stress + right.stress), 1e-3);
    assert_near(pair.velocity, 0.5 * difference.velocity, 1e-9);
    assert_near(pair.shear.y, 0.5 * (left.shear.y + right.shear.y), 1e-3);
    assert_near(pair.sliding.y, 0.5 * difference.sliding.y, 1e-9);
}

static void a_contact_law_opens_in_tension_and_lets_slip(void **state)
{
    (void)state;
    const struct pair_law law = {STAR_ACOUSTIC, true, false, true, false};
    struct dice dice = {11};
    for (int k = 0; k < 1000; k++) {
        const struct pair_side left = side_of_dice(&dice), right = side_of_dice(&dice);
        const struct pair_difference difference = difference_of(&dice, &left, &right);
        const struct pair_contact bonded =
            contact_pair(&left, &right, &difference, free_of_laws, law);
        const struct pair_contact slips =
            contact_pair(&left, &right, &difference, (struct pair_limits){1.0, 0.0, 1.0, 0.0}, law);
        const struct pair_contact opens =
            contact_pair(&left, &right, &difference, (struct pair_limits){0.0, 1.0, 1.0, 0.0}, law);
        assert_true(slips.stress == bonded.stress && slips.velocity == bonded.velocity);
        assert_true(slips.shear.y == 0.0);
        assert_near(slips.sliding.y, -left.shear.y / left.shear_impedance, 1e-9);
        if (bonded.stress > 0.0) { /* a free surface */
            assert_true(opens.stress == 0.0 && opens.shear.y == 0.0);
            assert_near(opens.velocity, -left.stress / left.impedance, 1e-9);
        } else {
            assert_true(opens.stress == bonded.stress && opens.shear.y == bonded.shear.y);
        }
    }
}

/* A wave keeps all of its jump of stress, a jump of stress without motion moves nothing elastic,
 * and what is not elastic moves as without the gate. */
static void elastic_sides_count_jumps_of_stress_as_far_as_they_move(void **state)
{
    (void)state;
    const struct pair_law law = {STAR_ACOUSTIC, true, true, false, true},
                          whole = {STAR_ACOUSTIC, true, true, false, false};
    const struct pair_limits elastic = {0.0, 0.0, 1.0, 1.0};
    struct dice dice = {13};
    for (int k = 0; k < 1000; k++) {
        struct pair_side left = side_of_dice(&dice), right;
        const double u = dice_between(&dice, -100.0, 100.0), v = dice_between(&dice, -50.0, 50.0);
        right = left;
        right.stress = left.stress + left.impedance * u;
        right.shear.y = left.shear.y - left.shear_impedance * v;
        const struct pair_difference wave = {
            .velocity = u, .sliding = {0.0, v, 0.0}, .shear = vec3_sub(right.shear, left.shear)};
        const struct pair_difference still = {.shear = wave.shear};
        const struct pair_contact passes = contact_pair(&left, &right, &wave, elastic, law);
        const struct pair_contact all = contact_pair(&left, &right, &wave, elastic, whole);
        assert_near(passes.velocity, all.velocity, 1e-9);
        assert_near(passes.sliding.y, all.sliding.y, 1e-9);
        const struct pair_contact held = contact_pair(&left, &right, &still, elastic, law);
        const struct pair_contact other = contact_pair(&left, &right, &still, free_of_laws, law);
        const struct pair_contact moved = contact_pair(&left, &right, &still, elastic, whole);
        assert_true(held.velocity == 0.0 && held.sliding.y == 0.0);
        assert_true(other.velocity == moved.velocity && other.sliding.y == moved.sliding.y);
        assert_true(held.stress == moved.stress && held.shear.y == moved.shear.y);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_parts_of_a_contact_are_acoustic),
        cmocka_unit_test(a_linear_field_is_met_in_the_middle),
        cmocka_unit_test(a_contact_law_opens_in_tension_and_lets_slip),
        cmocka_unit_test(elastic_sides_count_jumps_of_stress_as_far_as_they_move),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
