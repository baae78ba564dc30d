/* The elastic-plastic HLLC contact against the tabulated states of the three tests of Wang et al.
 * (2024), and against what a Riemann problem must do. */
#include "dice.h"

#include "material/eos.h"
#include "riemann/acoustic.h"
#include "riemann/hllc.h"

struct solid {
    struct eos eos;
    double shear_modulus, yield;
};

static struct solid gas_like_aluminium(void)
{
    struct solid solid = {.shear_modulus = 26.5e9, .yield = 300e6};
    solid.eos.kind = EOS_stiffened_gas;
    solid.eos.of.stiffened_gas = (struct eos_stiffened_gas){2700.0, 5380.0, 2.67};
    return solid;
}

static struct solid aluminium(void)
{
    struct solid solid = {.shear_modulus = 27.6e9, .yield = 300e6};
    solid.eos.kind = EOS_grueneisen_eta;
    solid.eos.of.grueneisen_eta =
        (struct eos_grueneisen_eta){2785.0, 5328.0, 1.338, 2.0, EOS_EXTENDED};
    return solid;
}

static struct solid copper(void)
{
    struct solid solid = {.shear_modulus = 45.0e9, .yield = 90e6};
    solid.eos.kind = EOS_grueneisen_eta;
    solid.eos.of.grueneisen_eta =
        (struct eos_grueneisen_eta){8930.0, 3940.0, 1.49, 2.0, EOS_EXTENDED};
    return solid;
}

static struct elastic_side side_of(struct solid solid, double density, double velocity,
                                   double energy, double deviator)
{
    double history[POINT_HISTORY] = {0.0};
    struct eos_value value = eos_evaluate(&solid.eos, density, energy, history);
    struct elastic_side side = {density,       velocity,    deviator - value.pressure, deviator,
                                value.dp_drho, value.dp_de, solid.shear_modulus,       solid.yield};
    return side;
}

/* A side at PRESSURE: the energy follows, p = A + B e. */
static struct elastic_side side_at(struct solid solid, double density, double velocity,
                                   double pressure, double deviator)
{
    double history[POINT_HISTORY] = {0.0};
    struct eos_value value = eos_evaluate(&solid.eos, density, 0.0, history);
    return side_of(solid, density, velocity, (pressure - value.pressure) / value.dp_de, deviator);
}

static struct elastic_side random_side(struct dice *dice)
{
    struct solid kinds[] = {gas_like_aluminium(), aluminium(), copper()};
    struct solid solid = kinds[dice_below(dice, 3)];
    double deviator = dice_between(dice, -1.0, 1.0) * 2.0 / 3.0 * solid.yield;
    double density = eos_reference_density(&solid.eos) * dice_between(dice, 0.98, 1.05);
    return side_of(solid, density, dice_between(dice, -500.0, 500.0), dice_between(dice, 0.0, 1e5),
                   deviator);
}

/* Stress and velocity as the table has them, to its last digit. */
static void contacts_of_the_three_tests_are_the_tabulated_ones(void **state)
{
    (void)state;
    struct contact contact = riemann_hllc(side_of(gas_like_aluminium(), 2700.0, 200.0, 0.0, -200e6),
                                          side_of(gas_like_aluminium(), 2700.0, -200.0, 0.0, 0.0));
    assert_close(contact.stress, -3065.33e6, 2e-6);
    assert_near(contact.velocity, 3.1650, 6e-5);
    contact = riemann_hllc(side_of(aluminium(), 2785.0, 800.0, 0.0, 0.0),
                           side_of(aluminium(), 2785.0, 0.0, 0.0, 0.0));
    assert_close(contact.stress, -6058.31e6, 2e-6);
    assert_close(contact.velocity, 400.0, 1e-14);
    contact = riemann_hllc(side_of(copper(), 8930.0, 60.0, 0.0, 0.0),
                           side_of(aluminium(), 2785.0, 0.0, 0.0, 0.0));
    assert_close(contact.stress, -712.95e6, 1e-5);
    assert_near(contact.velocity, 40.6717, 6e-5);
}

/* Copper and aluminium as the exact solution leaves them: one stress, one velocity, both at
 * yield. */
static void a_contact_at_yield_reproduces_itself(void **state)
{
    (void)state;
    const double velocity = 40.646381, stress = -718.513845e6;
    struct elastic_side left = side_at(copper(), 8971.996, velocity, -60e6 - stress, -60e6);
    struct elastic_side right = side_at(aluminium(), 2803.017, velocity, -200e6 - stress, -200e6);
    struct contact contact = riemann_hllc(left, right);
    assert_close(contact.velocity, velocity, 1e-8);
    assert_close(contact.stress, stress, 1e-8);
}

static void equal_states_give_themselves_to_the_bit(void **state)
{
    (void)state;
    struct dice dice = {1};
    for (int k = 0; k < 1000; k++) {
        struct elastic_side side = random_side(&dice);
        struct contact contact = riemann_hllc(side, side);
        assert_true(contact.velocity == side.velocity);
        assert_true(contact.stress == side.stress);
    }
}

static void the_mirrored_contact_is_the_mirror_image_to_the_bit(void **state)
{
    (void)state;
    struct dice dice = {2};
    for (int k = 0; k < 1000; k++) {
        struct elastic_side left = random_side(&dice), right = random_side(&dice);
        struct contact contact = riemann_hllc(left, right);
        left.velocity *= -1.0;
        right.velocity *= -1.0;
        struct contact mirrored = riemann_hllc(right, left);
        assert_true(mirrored.velocity == -contact.velocity);
        assert_true(mirrored.stress == contact.stress);
    }
}

static void a_moving_observer_sees_the_same_contact(void **state)
{
    (void)state;
    struct dice dice = {3};
    for (int k = 0; k < 1000; k++) {
        struct elastic_side left = random_side(&dice), right = random_side(&dice);
        struct contact contact = riemann_hllc(left, right);
        left.velocity += 1234.5;
        right.velocity += 1234.5;
        struct contact moved = riemann_hllc(left, right);
        double impedance = left.density * sqrt(left.dp_drho);
        assert_near(moved.velocity, contact.velocity + 1234.5, 1e-11);
        assert_near(moved.stress, contact.stress, 1e-11 * impedance);
    }
}

/* A solid that does not yield, and a fluid of the same sound speed. */
static void without_yield_it_is_the_acoustic_contact(void **state)
{
    (void)state;
    struct dice dice = {4};
    for (int k = 0; k < 1000; k++) {
        struct elastic_side left = random_side(&dice), right = random_side(&dice);
        for (int fluid = 0; fluid < 2; fluid++) {
            left.yield = right.yield = fluid ? 0.0 : 1e14;
            if (fluid)
                left.shear_modulus = right.shear_modulus = left.deviator = right.deviator = 0.0;
            struct side l = {.impedance = hllc_elastic(left).impedance,
                             .velocity = left.velocity,
                             .stress = left.stress};
            struct side r = {.impedance = hllc_elastic(right).impedance,
                             .velocity = right.velocity,
                             .stress = right.stress};
            struct contact wanted = riemann_acoustic(l, r), contact = riemann_hllc(left, right);
            assert_near(contact.velocity, wanted.velocity, 1e-11);
            assert_near(contact.stress, wanted.stress, 1e-11 * l.impedance);
        }
    }
}

/* What is certain without plastic waves is right; where it is not, there is doubt. */
static void a_contact_without_doubt_is_the_elastic_one(void **state)
{
    (void)state;
    struct dice dice = {6};
    int certain = 0;
    for (int k = 0; k < 10000; k++) {
        struct elastic_side left = random_side(&dice), right = random_side(&dice);
        left.velocity *= dice_between(&dice, 0.0, 0.1);
        right.velocity = left.velocity + dice_between(&dice, -20.0, 20.0);
        right.stress = left.stress + dice_between(&dice, -1e8, 1e8);
        struct elastic_contact elastic = riemann_hllc_elastic(left, right);
        struct contact contact = riemann_hllc(left, right);
        bool same = contact.velocity == elastic.contact.velocity &&
                    contact.stress == elastic.contact.stress;
        assert_true(same || elastic.doubt > 0.0);
        certain += elastic.doubt <= 0.0;
    }
    assert_in_range(certain, 2000, 9000);
}

/* Nothing is left of a side that meets faster than sound: no logarithm of it is asked for. */
static void a_side_without_volume_stays_elastic(void **state)
{
    (void)state;
    struct elastic_side left = side_of(aluminium(), 2785.0, 2e4, 0.0, 0.0);
    struct elastic_side right = side_of(aluminium(), 2785.0, -2e4, 0.0, 0.0);
    struct contact contact = riemann_hllc(left, right);
    assert_close(contact.stress, -2e4 * hllc_elastic(left).impedance, 1e-12);
    assert_true(contact.velocity == 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contacts_of_the_three_tests_are_the_tabulated_ones),
        cmocka_unit_test(a_contact_at_yield_reproduces_itself),
        cmocka_unit_test(equal_states_give_themselves_to_the_bit),
        cmocka_unit_test(the_mirrored_contact_is_the_mirror_image_to_the_bit),
        cmocka_unit_test(a_moving_observer_sees_the_same_contact),
        cmocka_unit_test(without_yield_it_is_the_acoustic_contact),
        cmocka_unit_test(a_contact_without_doubt_is_the_elastic_one),
        cmocka_unit_test(a_side_without_volume_stays_elastic),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
