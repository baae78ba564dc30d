/* Every Riemann solver of gas grids against what a flux must be, and against the exact problem. */
#include "dice.h"

#include "riemann/exact_gas.h"
#include "riemann/gas_solvers.h"

static const double ratio = 1.4;

static struct gas_side side_of(double density, double normal, double pressure)
{
    struct gas_side side = {density, normal, {3.0, -2.0}, pressure, pressure / density / 0.4, 0, 0};
    side.sound = sqrt(ratio * pressure / density);
    return side;
}

static struct gas_side random_side(struct dice *dice)
{
    return side_of(dice_between(dice, 0.1, 10.0), dice_between(dice, -2e3, 2e3),
                   pow(10.0, dice_between(dice, 3.0, 7.0)));
}

static void assert_flow(struct gas_flow flow, struct gas_flow wanted, double part)
{
    const double push = part * fabs(wanted.normal);
    assert_near(flow.mass, wanted.mass, 1e-2 * push);
    assert_near(flow.normal, wanted.normal, push);
    assert_near(flow.across[0], wanted.across[0], push);
    assert_near(flow.across[1], wanted.across[1], push);
    assert_near(flow.energy, wanted.energy, part * fabs(wanted.energy) + 1e3 * push);
}

static struct gas_flow flow_of(struct gas_side side)
{
    const double mass = side.density * side.normal;
    const struct gas_flow flow = {mass,
                                  mass * side.normal + side.pressure,
                                  {mass * side.across[0], mass * side.across[1]},
                                  side.normal * (gas_side_energy(&side) + side.pressure)};
    return flow;
}

static void between_equal_gases_flows_what_flows_in_them(void **state)
{
    (void)state;
    struct dice dice = {1};
    for (int kind = 0; kind < GAS_RIEMANN_KINDS; kind++)
        for (int k = 0; k < 1000; k++) {
            const struct gas_side side = random_side(&dice);
            assert_flow(gas_riemann_solve(kind, side, side), flow_of(side), 1e-12);
        }
}

static struct gas_side mirrored(struct gas_side side)
{
    side.normal = -side.normal;
    return side;
}

static void a_flux_is_the_same_from_both_sides(void **state)
{
    (void)state;
    struct dice dice = {2};
    for (int kind = 0; kind < GAS_RIEMANN_KINDS; kind++)
        for (int k = 0; k < 1000; k++) {
            const struct gas_side low = random_side(&dice), high = random_side(&dice);
            struct gas_flow back = gas_riemann_solve(kind, mirrored(high), mirrored(low));
            back.mass = -back.mass;
            back.energy = -back.energy;
            for (int n = 0; n < 2; n++)
                back.across[n] = -back.across[n];
            assert_flow(gas_riemann_solve(kind, low, high), back, 1e-11);
        }
}

/* The errors of all solvers are of second order in weak waves without a contact. */
static void a_weak_wave_has_the_pressure_of_the_exact_problem(void **state)
{
    (void)state;
    for (int kind = 0; kind < GAS_RIEMANN_KINDS; kind++) {
        double error[2];
        for (int fine = 0; fine < 2; fine++) {
            const double rise = fine ? 1e-4 : 1e-3, pressure = 1e5 * (1.0 + rise),
                         density = 1.2 * pow(1.0 + rise, 1.0 / ratio);
            const struct gas_side low = side_of(density, 0.0, pressure),
                                  high = side_of(1.2, 0.0, 1e5);
            const struct side left = {density * low.sound, 0.0, -pressure, density, ratio},
                              right = {1.2 * high.sound, 0.0, -1e5, 1.2, ratio};
            const struct contact exact = riemann_exact_gas(left, right);
            const double wanted = -exact.stress + 1.2 * square(exact.velocity);
            error[fine] = fabs(gas_riemann_solve(kind, low, high).normal - wanted) / 1e5;
        }
        assert_true(error[0] < 1e-6 && error[1] < 1.5e-2 * error[0] + 1e-14);
    }
}

static void hllc_keeps_a_contact_that_moves(void **state)
{
    (void)state;
    const struct gas_side low = side_of(5.0, 30.0, 1e5), high = side_of(0.1, 30.0, 1e5);
    assert_flow(gas_riemann_hllc(low, high), flow_of(low), 1e-13);
}

/* With less of what waves move at the face, less flows at the same velocity and pressure, which
 * keep momentum across the wave on the other side. */
static void a_surplus_changes_what_flows_and_not_the_contact(void **state)
{
    (void)state;
    const struct gas_side low = side_of(2.0, 50.0, 2e5), high = side_of(80.0, 20.0, 1e5);
    struct gas_side light = low;
    light.density = 0.5;
    light.surplus = -1.5;
    const struct gas_flow all = gas_riemann_hllc(low, high), some = gas_riemann_hllc(light, high);
    const double pressure = (some.normal - 0.25 * all.normal) / 0.75,
                 speed = (all.normal - pressure) / all.mass;
    const struct gas_waves waves = gas_waves_of(&low, &high);
    assert_true(all.mass > 0.0);
    assert_close(some.mass, 0.25 * all.mass, 1e-12);
    assert_close(pressure,
                 high.pressure + high.density * (waves.fast - high.normal) * (speed - high.normal),
                 1e-10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(between_equal_gases_flows_what_flows_in_them),
        cmocka_unit_test(a_flux_is_the_same_from_both_sides),
        cmocka_unit_test(a_weak_wave_has_the_pressure_of_the_exact_problem),
        cmocka_unit_test(hllc_keeps_a_contact_that_moves),
        cmocka_unit_test(a_surplus_changes_what_flows_and_not_the_contact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
