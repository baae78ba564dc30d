/* What melting leaves of the strength of metals, and that nothing else loses it. */
#include "dice.h"

#include "material/whole.h"

static struct material aluminium(struct strength strength)
{
    struct material material = {.eos = {EOS_tillotson,
                                        {.tillotson = {2700.0, 0.5, 1.63, 75.2e9, 65e9, 5e6, 5.0,
                                                       5.0, 3e6, 13.9e6, NAN, EOS_EXTENDED}}},
                                .strength = strength};
    material_complete(&material);
    return material;
}

static struct strength plastic(void)
{
    return (struct strength){STRENGTH_perfect_plastic, {.perfect_plastic = {26e9, 0.3e9}}};
}

static struct strength softening(void)
{
    return (struct strength){STRENGTH_johnson_cook,
                             {.johnson_cook = {.shear_modulus = 26e9,
                                               .a = 324e6,
                                               .b = 114e6,
                                               .n = 0.42,
                                               .c = 0.002,
                                               .rate = 1.0,
                                               .m = 1.34,
                                               .room = 294.0,
                                               .melt = 925.0,
                                               .capacity = 896.0}}};
}

static void the_heat_of_melting_is_that_of_the_strength_or_of_expansion(void **state)
{
    (void)state;
    assert_close(aluminium(softening()).melting.heat, 896.0 * 631.0, 1e-14);
    /* c^2/Gamma: 0.65 MJ/kg, handbooks have 0.63 from room temperature to melting */
    assert_close(aluminium(plastic()).melting.heat, 0.05 * 75.2e9 / 2700.0 / 2.13, 1e-14);
}

static void hot_thin_metal_has_neither_deviator_nor_shear_waves(void **state)
{
    (void)state;
    const struct strength strengths[] = {plastic(), softening()};
    for (size_t k = 0; k < COUNT_OF(strengths); k++) {
        const struct material material = aluminium(strengths[k]);
        struct point point = {
            .density = 50.0, .energy = 13e6, .deviator = {1e8, -1e8, 0.0, 5e7, 0.0, 0.0}};
        const struct motion motion = {.dt = 1e-9,
                                      .density = 49.0,
                                      .energy = 13e6,
                                      .strain_rate = {2e6, -1e6, -1e6, 1e6, 0.0, 0.0}};
        const struct response response = material_step(&material, &point, &motion);
        assert_true(sym3_mises(point.deviator) == 0.0);
        assert_true(response.sound_shear == 0.0 && response.yield == 0.0);
        assert_true(point.history[HISTORY_plastic_strain] == 0.0);
        assert_true(response.sound_long < 6000.0);
    }
}

static void strength_fades_continuously_and_needs_heat_and_expansion(void **state)
{
    (void)state;
    const struct material material = aluminium(softening());
    const struct melting *melting = &material.melting;
    double last = 1.0;
    for (int k = 0; k <= 1000; k++) {
        const double at = k / 1000.0;
        const double left =
            melting_left(melting, 2700.0 * (1.0 - 0.25 * at), 2.5 * at * melting->heat);
        assert_true(left <= last && last - left < 5e-3 && left >= 0.0);
        last = left;
    }
    assert_true(last == 0.0);
    assert_true(melting_left(melting, 0.91 * 2700.0, 5e6) == 1.0);
    assert_true(melting_left(melting, 4000.0, 5e6) == 1.0);
    assert_true(melting_left(melting, 500.0, 0.9 * melting->heat) == 1.0);
}

static void what_is_left_bounds_the_stress(void **state)
{
    (void)state;
    const struct material material = aluminium(plastic());
    const double energy = 1.5 * material.melting.heat, density = 0.75 * 2700.0;
    struct point point = {
        .density = density, .energy = energy, .deviator = {2e8, -1e8, -1e8, 0.0, 0.0, 0.0}};
    const struct motion motion = {.dt = 1e-9,
                                  .density = density,
                                  .energy = energy,
                                  .strain_rate = {2e5, -1e5, -1e5, 0.0, 0.0, 0.0}};
    const struct response response = material_step(&material, &point, &motion);
    assert_close(response.yield, 0.15e9, 1e-6);
    assert_close(response.shear_modulus, 13e9, 1e-6);
    assert_close(sym3_mises(point.deviator), 0.15e9, 1e-6);
    /* stress that went with the strength is no flow; that of this step is */
    assert_close(point.history[HISTORY_plastic_strain], 2e-4, 1e-6);
}

static void what_is_no_metal_never_melts(void **state)
{
    (void)state;
    const struct strength kept[] = {
        {STRENGTH_drucker_prager, {.drucker_prager = {.shear_modulus = 1e9}}},
        {STRENGTH_hjc, {.hjc = {.shear_modulus = 1e9}}},
        {STRENGTH_failure_wave, {.failure_wave = {.shear_modulus = 1e9}}},
        {.kind = STRENGTH_NONE}};
    for (size_t k = 0; k < COUNT_OF(kept); k++) {
        const struct material material = aluminium(kept[k]);
        assert_true(melting_left(&material.melting, 1.0, 1e8) == 1.0);
    }
    struct material cold = {
        .eos = {EOS_barotropic, {.barotropic = {.density = 2700.0, .bulk_modulus = 75e9}}},
        .strength = plastic()};
    material_complete(&cold); /* its pressure knows no heat, as that of rubber and soil */
    assert_true(melting_left(&cold.melting, 1.0, 1e8) == 1.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_heat_of_melting_is_that_of_the_strength_or_of_expansion),
        cmocka_unit_test(hot_thin_metal_has_neither_deviator_nor_shear_waves),
        cmocka_unit_test(strength_fades_continuously_and_needs_heat_and_expansion),
        cmocka_unit_test(what_is_left_bounds_the_stress),
        cmocka_unit_test(what_is_no_metal_never_melts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
