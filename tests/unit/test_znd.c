/* Steady detonations with a reaction zone: those of PETN beside printed ones, and of a gas beside
 * its formulas. */
#include "exact_solution.h"

#include "exact/detonation.h"
#include "exact/znd.h"

static const struct exact_znd petn = {
    .material = "petn",
    .density = NAN,
    .models = {.eos = {EOS_reactive_jwl, {.reactive_jwl = EOS_reactive_jwl_SAMPLE}},
               .burn = {BURN_ignition_growth,
                        {.ignition_growth = {.ignition = 20e6,
                                             .ignition_depletion = 2.0 / 9.0,
                                             .ignition_power = 4.0,
                                             .ignition_until = 1.0,
                                             .growth = 400e6,
                                             .growth_depletion = 2.0 / 9.0,
                                             .growth_products = 2.0 / 3.0,
                                             .growth_power = 1.4,
                                             .growth_until = 1.0,
                                             .completion_power = 1.0}}}}};

/* Table 5.2 of Parshikov (2013), its ZND column, within 0.2 %. */
static void petn_detonates_as_its_source_says(void **state)
{
    (void)state;
    struct solution wave = solve(&exact_znd_class, &petn, 0.0);
    assert_near(number(&wave, "detonation speed"), 8348.0, 8348.0, 0.002);
    assert_near(number(&wave, "CJ velocity"), 2294.0, 2294.0, 0.002);
    assert_near(number(&wave, "CJ pressure"), 33.51e9, 33.51e9, 0.002);
    assert_near(1750.0 / number(&wave, "CJ density"), 0.7252, 0.7252, 0.002);
    assert_near(number(&wave, "spike pressure"), 48.89e9, 48.89e9, 0.002);
    assert_near(1750.0 / number(&wave, "spike density"), 0.5992, 0.5992, 0.002);
    assert_near(number(&wave, "spike velocity"), 3345.5, 3345.5, 0.002);
    assert_near(number(&wave, "distance to 0.99 burnt"), 1e-4, 1e-4, 0.05); /* section 5.1 */
    assert_near(number(&wave, "CJ sound speed") + number(&wave, "CJ velocity"),
                number(&wave, "detonation speed"), 8348.0, 1e-6);
    release(&wave);
}

static void porous_petn_detonates_more_slowly(void **state)
{
    (void)state;
    static const double rows[][2] = {{800.0, 4540.0},  {900.0, 4892.0},  {1006.0, 5300.0},
                                     {1100.0, 5686.0}, {1200.0, 6113.0}, {1309.0, 6585.0},
                                     {1400.0, 6977.0}, {1500.0, 7395.0}, {1600.0, 7795.0},
                                     {1650.0, 7986.0}, {1700.0, 8171.0}};
    for (size_t k = 0; k < COUNT_OF(rows); k++) {
        struct exact_znd porous = petn;
        porous.density = rows[k][0];
        struct solution wave = solve(&exact_znd_class, &porous, 0.0);
        assert_near(number(&wave, "detonation speed"), rows[k][1], 0.5, 1.1);
        release(&wave);
    }
}

/* Mass, momentum and energy are those ahead, in the frame of the front, and the equation of state
 * holds, all through the zone and in any frame. */
static void the_zone_conserves(void **state)
{
    (void)state;
    struct exact_znd moving = petn;
    moving.velocity = -1600.0;
    moving.at = 2e-3;
    const double time = 1e-6;
    struct solution wave = solve(&exact_znd_class, &moving, time);
    const double speed = number(&wave, "detonation speed"), front = number(&wave, "front");
    assert_near(front, 2e-3 + (speed - 1600.0) * time, 1e-2, 1e-12);
    double last = 0.0;
    for (int k = 0; k <= 300; k++) {
        const double x = front - 0.5e-6 * k;
        const struct exact_state s = wave.class->sample(wave.solved, SIDE_LEFT, x - 1e-12, time);
        const double flow = 1750.0 * speed, to = speed - 1600.0 - s.velocity;
        assert_near(s.density * to, flow, flow, 1e-5);
        assert_near(s.pressure + flow * to, flow * speed, flow * speed, 1e-6);
        assert_near(s.energy + s.pressure / s.density + 0.5 * square(to), 0.5 * square(speed),
                    square(speed), 1e-5);
        assert_true(s.burnt >= last && s.burnt <= 1.0 && s.temperature > 2000.0);
        last = s.burnt;
    }
    assert_true(last == 1.0);
    const struct exact_state ahead = wave.class->sample(wave.solved, SIDE_LEFT, front + 1e-9, time);
    assert_true(ahead.density == 1750.0 && ahead.velocity == -1600.0 && ahead.burnt == 0.0);
    assert_near(ahead.temperature, 295.0, 295.0, 0.001);
    release(&wave);
}

/* Fickett and Rivard's steady reaction zone of a gas of gamma 3, rate 2 sqrt(1 - l) per us, as
 * ExactPack (2025) prints it: microseconds, cm, Mbar, g. Two such gases are a JWL without A and B,
 * but that a shock needs a little of A to begin from rest. */
static void a_gas_has_the_zone_of_fickett_and_rivard(void **state)
{
    (void)state;
    static const double rows[][5] = {
        {0.1, 0.0435625, 0.5491, 3.047619, 0.19}, {0.3, 0.1370625, 0.4913, 2.782609, 0.51},
        {0.5, 0.2390625, 0.4335, 2.56, 0.75},     {0.7, 0.3495625, 0.3757, 2.37037, 0.91},
        {0.9, 0.4685625, 0.3179, 2.206897, 0.99},
    };
    const double energy = 1600.0 * square(8500.0) / 16.0; /* D^2 = 2 (gamma^2 - 1) q */
    const struct exact_znd gas = {
        .material = "gas",
        .density = NAN,
        .models = {.eos = {EOS_reactive_jwl,
                           {.reactive_jwl = {1600.0, 1e4, 0.0, 4.0, 1.0, 2.0, 1e6, 0.0, 0.0, 4.0,
                                             1.0, 2.0, 1e6, energy}}},
                   .burn = {BURN_ignition_growth,
                            {.ignition_growth = {.ignition_until = 1.0,
                                                 .ignition_power = 1.0,
                                                 .growth = 2e6,
                                                 .growth_depletion = 0.5,
                                                 .growth_until = 1.0,
                                                 .completion_power = 1.0}}}}};
    struct solution wave = solve(&exact_znd_class, &gas, 1e-6);
    assert_near(number(&wave, "detonation speed"), 8500.0, 8500.0, 1e-6);
    assert_near(number(&wave, "spike pressure"), 57.8e9, 57.8e9, 1e-5);
    assert_near(number(&wave, "CJ pressure"), 28.9e9, 28.9e9, 1e-5);
    for (size_t k = 0; k < COUNT_OF(rows); k++) {
        const double place = number(&wave, "front") - rows[k][1] * 1e-2;
        const struct exact_state s = wave.class->sample(wave.solved, SIDE_LEFT, place, 1e-6);
        assert_near(s.pressure, rows[k][2] * 1e11, 1e11, 2e-4);
        assert_near(s.density, rows[k][3] * 1e3, 1e3, 1e-3);
        assert_near(s.burnt, rows[k][4], 1.0, 3e-4);
    }
    release(&wave);
}

static void what_does_not_burn_by_itself_is_refused(void **state)
{
    (void)state;
    struct exact_znd lit = petn;
    lit.models.burn = (struct burn){BURN_programmed, {.programmed = {8348.0}}};
    assert_refused(&exact_znd_class, &lit);
    struct exact_znd inert = petn;
    inert.models.eos.of.reactive_jwl.energy = -50e9;
    assert_refused(&exact_znd_class, &inert);
    struct exact_znd slow = petn; /* no term burns the last half */
    slow.models.burn.of.ignition_growth.growth_until = 0.5;
    slow.models.burn.of.ignition_growth.ignition_until = 0.5;
    assert_refused(&exact_znd_class, &slow);
}

/* A material without a detonation has none, and products alone have one without a spike. */
static void only_explosives_detonate(void **state)
{
    (void)state;
    struct detonation d;
    const struct material tnt = {
        .eos = {EOS_jwl, {.jwl = {1630.0, 371.2e9, 3.21e9, 4.15, 0.95, 0.3, 6.993e9, 0}}}};
    assert_true(detonation_solve(&tnt, 1630.0, &d));
    assert_near(d.speed, 6927.81, 6927.81, 1e-6);
    assert_true(isnan(d.spike.pressure));
    static const struct material air = {.eos = {EOS_ideal_gas, {.ideal_gas = {1.225, 1.4}}}};
    assert_false(detonation_solve(&air, 1.225, &d));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(petn_detonates_as_its_source_says),
        cmocka_unit_test(porous_petn_detonates_more_slowly),
        cmocka_unit_test(the_zone_conserves),
        cmocka_unit_test(a_gas_has_the_zone_of_fickett_and_rivard),
        cmocka_unit_test(what_does_not_burn_by_itself_is_refused),
        cmocka_unit_test(only_explosives_detonate),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
