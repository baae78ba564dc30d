/* A step of many points at once against the step of each alone, to the last bit; and the logarithm
 * and powers of lanes against the library's. */
#include "dice.h"

#include "material/batch.h"
#include "material/whole.h"

static const struct strength_johnson_cook hard = {
    .shear_modulus = 81.8e9, .a = 350e6, .b = 275e6, .n = 0.36, .c = 0.022, .rate = 1.0, .m = NAN};

static struct strength_johnson_cook soft(void)
{
    struct strength_johnson_cook solid = hard;
    solid.m = 1.03;
    solid.room = 300.0;
    solid.melt = 1811.0;
    solid.capacity = 452.0;
    return solid;
}

static struct strength_johnson_cook explicitly(struct strength_johnson_cook solid)
{
    solid.return_map = JOHNSON_COOK_EXPLICIT;
    return solid;
}

static const struct strength_johnson_holmquist brittle = {.shear_modulus = 23e9,
                                                          .a = 0.93,
                                                          .n = 0.77,
                                                          .b = 0.2,
                                                          .m = 0.9,
                                                          .c = 0.003,
                                                          .rate = 1.0,
                                                          .most = 0.5,
                                                          .tension = 0.1e9,
                                                          .hel = 0.5e9,
                                                          .hel_pressure = 0.2e9,
                                                          .d1 = 0.01,
                                                          .d2 = 0.85,
                                                          .bulking = 1.0,
                                                          .tension_limit = true};

static struct strength_johnson_holmquist unlimited(void)
{
    struct strength_johnson_holmquist solid = brittle;
    solid.tension_limit = false;
    return solid;
}

static const struct strength_failure_wave glass = {.shear_modulus = 23e9,
                                                   .speed = 1600.0,
                                                   .intact = 0.1e9,
                                                   .intact_slope = 0.5,
                                                   .failed = 0.05e9,
                                                   .failed_slope = 0.2,
                                                   .tip_pressure = 0.1e9,
                                                   .tip_end = 0.07e9};

static double some(struct dice *dice, double scale) { return dice_between(dice, -scale, scale); }

/* A point and what happens to it; one in four does not flow. */
static void throw_point(struct dice *dice, double rest, struct point *point, struct motion *motion)
{
    const double size = dice_below(dice, 4) ? 1.0 : 0.05, spin = 1e6;
    const bool common = dice_below(dice, 4); /* the others are beyond the forms of the sources */
    const double ratio = common ? dice_between(dice, 0.9, 1.4) : dice_between(dice, 0.3, 3.2);
    *point = (struct point){.density = rest * ratio,
                            .energy = some(dice, 1e5),
                            .pressure = some(dice, 1e9),
                            .deviator = {some(dice, 3e8 * size), some(dice, 3e8 * size), 0.0,
                                         some(dice, 1e8 * size), some(dice, 1e8 * size),
                                         some(dice, 1e8 * size)}};
    point->deviator.zz = -point->deviator.xx - point->deviator.yy;
    point->history[HISTORY_plastic_strain] =
        dice_below(dice, 3) ? dice_between(dice, 0.0, 1.0) : 0.0;
    point->history[HISTORY_plastic_heating] = dice_between(dice, 0.0, 1600.0);
    *motion = (struct motion){.dt = 1e-8,
                              .density = point->density * dice_between(dice, 0.99, 1.01),
                              .viscous_pressure = dice_between(dice, 0.0, 1e8),
                              .spin = {some(dice, spin), some(dice, spin), some(dice, spin)},
                              .damage_gradient = dice_between(dice, 0.0, 1e4)};
    double *rate = &motion->strain_rate.xx;
    for (int c = 0; c < 6; c++)
        rate[c] = some(dice, 2e6 * size);
}

static void put(struct batch *b, int k, const struct point *point, const struct motion *motion)
{
    b->density[k] = point->density;
    b->new_density[k] = motion->density;
    b->energy[k] = point->energy;
    b->pressure[k] = point->pressure;
    b->viscous_pressure[k] = motion->viscous_pressure;
    batch_keep_tensor(b->strain_rate, k, motion->strain_rate);
    batch_keep_tensor(b->deviator, k, point->deviator);
    b->spin[0][k] = motion->spin.x;
    b->spin[1][k] = motion->spin.y;
    b->spin[2][k] = motion->spin.z;
    b->plastic_strain[k] = point->history[HISTORY_plastic_strain];
    b->plastic_heating[k] = point->history[HISTORY_plastic_heating];
    b->damage[k] = point->history[HISTORY_damage];
    b->void_ratio[k] = point->history[HISTORY_void_ratio];
    b->scatter[k] = point->history[HISTORY_strength_scatter];
    b->overload[k] = point->history[HISTORY_overload];
    b->acceleration[0][k] = motion->acceleration.x;
    b->acceleration[1][k] = motion->acceleration.y;
    b->acceleration[2][k] = motion->acceleration.z;
    b->length[k] = motion->length;
    b->bulking[k] = point->history[HISTORY_bulking];
    b->damage_gradient[k] = motion->damage_gradient;
}

static void check(const struct batch *b, int k, const struct point *point,
                  const struct response *response)
{
    const double *s = &point->deviator.xx;
    assert_true(b->energy[k] == point->energy && b->pressure[k] == point->pressure);
    assert_true(b->sound_long[k] == response->sound_long);
    assert_true(b->plastic_strain[k] == point->history[HISTORY_plastic_strain]);
    assert_true(b->plastic_heating[k] == point->history[HISTORY_plastic_heating]);
    assert_true(b->damage[k] == point->history[HISTORY_damage]);
    assert_true(b->bulking[k] == point->history[HISTORY_bulking]);
    assert_true(b->void_ratio[k] == point->history[HISTORY_void_ratio]);
    assert_true(b->overload[k] == point->history[HISTORY_overload]);
    assert_true(b->new_density[k] == point->density);
    for (int c = 0; c < 6; c++)
        assert_true(b->new_deviator[c][k] == s[c]);
}

static void a_batch_does_to_each_point_what_a_step_alone_does(void **state)
{
    (void)state;
    static const struct eos forms[] = {
        {EOS_ideal_gas, {.ideal_gas = {1500.0, 3.0}}},
        {EOS_polynomial, {.polynomial = {2530.0, 45.4e9, -138e9, 290e9}}},
        {EOS_jwl, {.jwl = {1630.0, 371.2e9, 3.21e9, 4.15, 0.95, 0.3, 6.993e9}}},
        {EOS_jwl, {.jwl = {1750.0, 3756e9, -131.3e9, 7.2, 3.6, 1.173, 60.7965e6, EOS_EXTENDED}}},
        {EOS_mie_grueneisen, {.mie_grueneisen = {2700.0, 5350.0, 1.35, 2.17, 73e9, EOS_EXTENDED}}},
        {EOS_grueneisen_polynomial, {.grueneisen_polynomial = {7890.0, 4569.0, 1.49, 2.17}}},
        {EOS_grueneisen_eta, {.grueneisen_eta = {8930.0, 3940.0, 1.49, 2.0, EOS_EXTENDED}}}};
    const struct strength strengths[] = {
        {.kind = STRENGTH_NONE},
        {STRENGTH_perfect_plastic, {.perfect_plastic = {23e9, 0.3e9}}},
        {STRENGTH_johnson_cook, {.johnson_cook = hard}},
        {STRENGTH_johnson_cook, {.johnson_cook = soft()}},
        {STRENGTH_johnson_cook, {.johnson_cook = explicitly(hard)}},
        {STRENGTH_johnson_cook, {.johnson_cook = explicitly(soft())}},
        {STRENGTH_johnson_holmquist, {.johnson_holmquist = brittle}},
        {STRENGTH_johnson_holmquist, {.johnson_holmquist = unlimited()}},
        {STRENGTH_failure_wave, {.failure_wave = glass}}};
    const struct failure failures[] = {
        {.kind = FAILURE_NONE},
        {FAILURE_cavitation, {.cavitation = {.tension = 1e8}}},
        {FAILURE_spall, {.spall = {.friction = 0.3, .strength = 1e9}}},
        {FAILURE_spall, {.spall = {.friction = 0.3, .strength = 0.5e9, .stress = SPALL_MEAN}}},
        {FAILURE_spall, {.spall = {.friction = 0.3, .strength = 1e9, .onset = SPALL_STANDING}}},
        {FAILURE_spall,
         {.spall = {.friction = 0.3, .strength = 0.5e9, .growth = 0.15, .stress = SPALL_MEAN}}},
        {FAILURE_johnson_cook,
         {.johnson_cook = {.friction = 0.3,
                           .d1 = 0.01,
                           .d2 = 0.1,
                           .d3 = -1.5,
                           .d4 = 0.01,
                           .d5 = 0.5,
                           .rate = 1.0,
                           .least_strain = 1e-3,
                           .spall = 2e9}}},
        {FAILURE_johnson_cook,
         {.johnson_cook = {.friction = 0.3,
                           .d1 = 0.1,
                           .d2 = 0.1,
                           .d3 = -1.5,
                           .rate = 1.0,
                           .least_strain = 1e-3,
                           .spall = NAN,
                           .band = NAN,
                           .coupling = 1.0,
                           .critical = 0.7,
                           .onset = 0.05}}},
        {FAILURE_cockcroft_latham,
         {.cockcroft_latham = {.friction = 0.3, .work = 1e7, .spall = NAN}}}};
    struct dice dice = {3};
    size_t broken = 0, whole = 0, molten = 0;
    for (size_t m = 0; m < COUNT_OF(forms) * COUNT_OF(strengths) * COUNT_OF(failures) * 20; m++) {
        struct material material = {
            .eos = forms[m % COUNT_OF(forms)],
            .strength = strengths[m / COUNT_OF(forms) % COUNT_OF(strengths)],
            .failure = failures[m / COUNT_OF(forms) / COUNT_OF(strengths) % COUNT_OF(failures)]};
        struct batch batch = {.count = LANES * (1 + dice_below(&dice, 8)), .dt = 1e-8};
        struct point point[BATCH];
        struct motion motion[BATCH];
        if (strength_takes_pressure(&material.strength))
            material.failure.kind = FAILURE_NONE;
        if (material_failure_wrong(&material) && material_has_strength(&material))
            material.failure.of.johnson_cook.coupling = 0.0;
        material_complete(&material);
        assert_true(batch_takes(&material));
        for (int k = 0; k < batch.count; k++) {
            throw_point(&dice, material_density(&material), &point[k], &motion[k]);
            if (!dice_below(&dice, 4)) /* some are hot enough to melt */
                point[k].energy = dice_between(&dice, 0.0, 3e6);
            if (material_breaks(&material) || strength_spreads(&material.strength)) {
                const double damage = 0.5 * dice_below(&dice, 3);
                point[k].history[HISTORY_damage] = damage;
                point[k].history[HISTORY_void_ratio] = damage == 1.0 && material_opens(&material)
                                                           ? dice_between(&dice, 0.0, VOIDS_MOST)
                                                           : 0.0;
                point[k].history[HISTORY_strength_scatter] = dice_between(&dice, -0.5, 0.5);
                point[k].history[HISTORY_overload] = dice_between(&dice, 0.0, 1.0);
            }
            motion[k].acceleration =
                vec3_make(dice_between(&dice, -1e10, 1e10), dice_between(&dice, -1e10, 1e10), 0.0);
            motion[k].length = 1e-4;
            if (strength_breaks(&material.strength))
                point[k].history[HISTORY_bulking] =
                    point[k].history[HISTORY_damage] * dice_between(&dice, 0.0, 1e9);
            put(&batch, k, &point[k], &motion[k]);
        }
        const bool given = m % 3 == 0;
        for (int k = 0; k < batch.count; k++)
            motion[k].energy = batch.energy[k];
        batch_step(&material, &batch, given ? ENERGY_GIVEN : ENERGY_BY_WORK);
        for (int k = 0; k < batch.count; k++) {
            const struct response response =
                given ? material_step(&material, &point[k], &motion[k])
                      : material_step_by_work(&material, &point[k], &motion[k]);
            check(&batch, k, &point[k], &response);
            broken += material_failed(&material, point[k].history);
            molten += melting_left(&material.melting, point[k].density, point[k].energy) < 1.0;
            whole += material_fails(&material) && !material_failed(&material, point[k].history);
        }
    }
    assert_true(broken > 1000 && whole > 1000 && molten > 1000);
}

static void what_batches_do_not_take_is_told(void **state)
{
    (void)state;
    struct material material = {.strength = {STRENGTH_johnson_cook, {.johnson_cook = hard}}};
    assert_true(batch_takes(&material));
    material.failure.kind = FAILURE_grady;
    assert_false(batch_takes(&material));
    material.failure.kind = FAILURE_spall;
    assert_true(batch_takes(&material));
    material.strength.kind = STRENGTH_drucker_prager;
    assert_false(batch_takes(&material));
    material.strength.kind = STRENGTH_NONE;
    material.eos.kind = EOS_hjc;
    assert_false(batch_takes(&material));
}

static void logarithm_and_powers_are_those_of_the_library(void **state)
{
    (void)state;
    struct dice dice = {5};
    for (int k = 0; k < 200000; k++) {
        const double x = k % 2 ? exp(some(&dice, 700.0)) : 1.0 + some(&dice, 0.3);
        const double wanted = log(x), n = dice_between(&dice, 0.01, 2.0);
        assert_near(logarithm(x), wanted, 4.5e-16 * fabs(wanted));
        const double base = exp(dice_between(&dice, -40.0, 4.0));
        assert_close(power(base, n), pow(base, n), 2e-14);
    }
    assert_true(logarithm(1.0) == 0.0 && power(0.0, 0.01) == 0.0 && power(1.0, 0.3) == 1.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_batch_does_to_each_point_what_a_step_alone_does),
        cmocka_unit_test(what_batches_do_not_take_is_told),
        cmocka_unit_test(logarithm_and_powers_are_those_of_the_library),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
