/* The physics of a point: equations of state against independent values and differences, strength
 * against what rotation, yield and uniaxial strain must give. */
#include "dice.h"

#include "material/material.h"

static const struct material gas = {.eos = {EOS_ideal_gas, {.ideal_gas = {1500.0, 3.0}}}};
static const struct material liquid = {.eos = {EOS_barotropic, {.barotropic = {2700.0, 73e9}}}};
static const struct eos_mie_grueneisen aluminium_eos = {2700.0, 5350.0, 1.35,
                                                        2.17,   73e9,   EOS_EXTENDED};
static const struct material aluminium = {
    .eos = {EOS_mie_grueneisen,
            {.mie_grueneisen = {2700.0, 5350.0, 1.35, 2.17, 73e9, EOS_EXTENDED}}},
    .strength = {STRENGTH_perfect_plastic, {.perfect_plastic = {23e9, 0.4e9}}}};
static const struct strength_perfect_plastic aluminium_strength = {23e9, 0.4e9};

static double pressure(const struct material *material, double density, double energy)
{
    struct eos_value value = eos_evaluate(&material->eos, density, energy, NULL);
    assert_int_equal(value.status & ~(unsigned)POINT_SOUND_HELD, 0);
    return value.pressure;
}

/* Both derivatives against central differences. */
static void check_derivatives(const struct material *material, double density, double energy,
                              double energy_scale)
{
    struct eos_value value = eos_evaluate(&material->eos, density, energy, NULL);
    double d = 1e-5 * density, e = 1e-5 * energy_scale;
    double by_density =
        (pressure(material, density + d, energy) - pressure(material, density - d, energy)) /
        (2.0 * d);
    double by_energy =
        (pressure(material, density, energy + e) - pressure(material, density, energy - e)) /
        (2.0 * e);
    double scale = fabs(value.dp_drho) + fabs(value.pressure) / density;
    if (!(value.status & POINT_SOUND_HELD))
        assert_near(value.dp_drho, by_density, 1e-8 * scale);
    assert_near(value.dp_de, by_energy,
                1e-8 * (fabs(value.dp_de) + scale * density / energy_scale));
}

static void ideal_gas_has_its_pressure_and_sound(void **state)
{
    (void)state;
    /* The left side of acceptance test T2: p = 30 kPa, c = sqrt(gamma p/rho). */
    double energy = 3e4 / (2.0 * 1500.0);
    assert_close(pressure(&gas, 1500.0, energy), 3e4, 1e-15);
    struct point point = {.density = 1500.0, .energy = energy};
    struct response response = material_evaluate(&gas, &point);
    assert_close(response.sound_long, 7.745966692414834, 1e-15);
    assert_true(response.sound_shear == 0.0);
    assert_close(point.pressure, 3e4, 1e-15);
    for (double density = 10.0; density < 1e4; density *= 3.0)
        check_derivatives(&gas, density, energy, energy);
}

static void barotropic_liquid_follows_its_modulus(void **state)
{
    (void)state;
    /* Acceptance test T1-A: 4 GPa at 2700/(1 - 4/73). */
    assert_close(pressure(&liquid, 2700.0 / (1.0 - 4.0 / 73.0), 123.0), 4e9, 1e-13);
    assert_true(pressure(&liquid, 2700.0, 0.0) == 0.0);
    struct point point = {.density = 2700.0};
    struct response response = material_evaluate(&liquid, &point);
    assert_close(response.sound_long, sqrt(73e9 / 2700.0), 1e-15);
    for (double density = 2000.0; density < 5000.0; density *= 1.1)
        check_derivatives(&liquid, density, 0.0, 1.0);
}

/* Behind a shock of particle velocity U_p: U_s = C + S U_p, p = rho_0 U_s U_p, rho = rho_0 U_s/(U_s
 * - U_p), e = U_p^2/2. */
static void mie_grueneisen_passes_through_its_shock_adiabat(void **state)
{
    (void)state;
    const struct eos_mie_grueneisen *a = &aluminium_eos;
    for (double up = 1.0; up < 6000.0; up *= 1.5) {
        double us = a->sound + a->slope * up;
        double density = a->density * us / (us - up);
        double wanted = a->density * us * up;
        /* Rounding of the density shows amplified by density/(density - density_0). */
        double amplified = 4e-16 * density / (density - a->density);
        assert_close(pressure(&aluminium, density, 0.5 * square(up)), wanted, 1e-12 + amplified);
    }
}

static void mie_grueneisen_has_an_independent_value(void **state)
{
    (void)state;
    /* rho = 3000: v_0 - v = 1/27000, p_r = 5350^2 27000/8.65^2 = 10.328544 GPa, e_r = 191269.3
     * J/kg. */
    double curve = 5350.0 * 5350.0 * 27000.0 / (8.65 * 8.65), reference = 0.5 * curve / 27000.0;
    assert_near(curve, 10.328544221e9, 1.0);
    assert_near(reference, 191269.3374, 1e-4);
    double wanted = curve + 2.17 * 3000.0 * (5e5 - reference);
    assert_close(pressure(&aluminium, 3000.0, 5e5), wanted, 1e-13);
    /* In tension: rho = 2600, p_r = 73e9 (1 - 27/26). */
    double tension = 73e9 * (1.0 - 2700.0 / 2600.0);
    double energy = 0.5 * tension * (1.0 / 2700.0 - 1.0 / 2600.0);
    assert_close(pressure(&aluminium, 2600.0, energy), tension, 1e-13);
    assert_close(pressure(&aluminium, 2600.0, energy + 1e4), tension + 2.17 * 2600.0 * 1e4, 1e-13);
}

static void mie_grueneisen_is_continuous_where_tension_begins(void **state)
{
    (void)state;
    for (double energy = 0.0; energy < 1e6; energy += 2.5e5) {
        double below = pressure(&aluminium, 2700.0 * (1.0 - 1e-12), energy);
        double at = pressure(&aluminium, 2700.0, energy);
        double above = pressure(&aluminium, 2700.0 * (1.0 + 1e-12), energy);
        assert_near(below, at, 1.0);
        assert_near(above, at, 1.0);
        assert_close(at + 1.0, 2.17 * 2700.0 * energy + 1.0, 1e-14);
    }
}

static void mie_grueneisen_derivatives_are_those_of_its_pressure(void **state)
{
    (void)state;
    for (double density = 1500.0; density < 6000.0; density *= 1.07)
        for (double energy = 0.0; energy < 3e7; energy = 3.0 * energy + 1e4)
            check_derivatives(&aluminium, density, energy, 1e6);
}

static void mie_grueneisen_is_bounded_below_absolute_zero(void **state)
{
    (void)state;
    const double deepest = 0.01 * square(aluminium.eos.of.mie_grueneisen.sound);
    struct eos source = aluminium.eos;
    source.of.mie_grueneisen.form = EOS_SOURCE;
    for (double density = 2450.0; density < 3500.0; density *= 1.01) {
        const struct eos_value edge = eos_evaluate(&aluminium.eos, density, -deepest, NULL);
        assert_true(edge.pressure == eos_evaluate(&source, density, -deepest, NULL).pressure);
        const double least = edge.pressure - edge.dp_de * deepest;
        for (double energy = -1.0001 * deepest; energy > -1e12; energy *= 2.0) {
            check_derivatives(&aluminium, density, energy, 1e6);
            const double p = eos_evaluate(&aluminium.eos, density, energy, NULL).pressure;
            assert_true(p <= edge.pressure && p >= least - 1e-9 * fabs(least));
        }
    }
}

static void mie_grueneisen_says_when_it_is_compressed_beyond_its_adiabat(void **state)
{
    (void)state;
    /* v_0 - S (v_0 - v) = 0 at rho = rho_0 S/(S - 1) = 10414. */
    struct eos source = aluminium.eos;
    source.of.mie_grueneisen.form = EOS_SOURCE;
    struct eos_value value = eos_evaluate(&source, 10500.0, 0.0, NULL);
    assert_int_equal(value.status, POINT_OUT_OF_RANGE);
    assert_true(isfinite(value.pressure) && isfinite(value.dp_drho));
    value = eos_evaluate(&source, 10300.0, 0.0, NULL);
    assert_int_equal(value.status, 0);
}

static void sound_speeds_follow_from_pressure_along_the_isentrope(void **state)
{
    (void)state;
    /* c_b^2 = dp/drho along de = p drho/rho^2, by differences; with shear C_l^2 = c_b^2 + 4G/(3
     * rho). */
    struct point point = {.density = 3100.0, .energy = 7e5};
    struct response response = material_evaluate(&aluminium, &point);
    double d = 1e-5 * point.density, p = point.pressure;
    double up =
        pressure(&aluminium, point.density + d, point.energy + d * p / square(point.density));
    double down =
        pressure(&aluminium, point.density - d, point.energy - d * p / square(point.density));
    double wanted = (up - down) / (2.0 * d) + 4.0 / 3.0 * 23e9 / point.density;
    assert_close(square(response.sound_long), wanted, 1e-8);
    assert_close(response.sound_shear, sqrt(23e9 / point.density), 1e-15);
    assert_true(response.yield == 0.4e9 && response.shear_modulus == 23e9);
}

static void a_state_without_sound_says_so(void **state)
{
    (void)state;
    struct point point = {.density = 1500.0, .energy = -1.0};
    struct response response = material_evaluate(&gas, &point);
    assert_true(response.status & POINT_NO_SOUND);
    assert_true(response.sound_long == 0.0);
}

static struct sym3 random_deviator(struct dice *dice, double size)
{
    struct sym3 s;
    s.xx = dice_between(dice, -size, size);
    s.yy = dice_between(dice, -size, size);
    s.zz = -s.xx - s.yy;
    s.xy = dice_between(dice, -size, size);
    s.yz = dice_between(dice, -size, size);
    s.zx = dice_between(dice, -size, size);
    return s;
}

static double determinant(struct sym3 s)
{
    return s.xx * (s.yy * s.zz - s.yz * s.yz) - s.xy * (s.xy * s.zz - s.yz * s.zx) +
           s.zx * (s.xy * s.yz - s.yy * s.zx);
}

static void rotation_keeps_the_invariants(void **state)
{
    (void)state;
    struct dice dice = {1};
    for (int k = 0; k < 1000; k++) {
        struct sym3 s = random_deviator(&dice, 1.0);
        double size = pow(10.0, dice_between(&dice, -8.0, -1.7));
        struct vec3 angle = {dice_between(&dice, -size, size), dice_between(&dice, -size, size),
                             dice_between(&dice, -size, size)};
        struct sym3 turned = sym3_rotate(s, angle);
        assert_near(sym3_trace(turned), sym3_trace(s), 1e-14);
        assert_close(sym3_square(turned), sym3_square(s), 1e-14);
        assert_near(determinant(turned), determinant(s), 1e-14);
    }
    /* The series end: half a radian is kept to eight digits. */
    struct sym3 s = random_deviator(&dice, 1.0);
    struct sym3 turned = sym3_rotate(s, vec3_make(0.3, -0.3, 0.25));
    assert_close(sym3_square(turned), sym3_square(s), 3e-8);
}

static void rotation_turns_a_stress_with_the_right_hand(void **state)
{
    (void)state;
    /* About z by 0.05: the xx stress appears along (cos, sin, 0). */
    struct sym3 s = {1.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    struct sym3 turned = sym3_rotate(s, vec3_make(0.0, 0.0, 0.05));
    assert_near(turned.xx, square(cos(0.05)), 1e-15);
    assert_near(turned.yy, square(sin(0.05)), 1e-13);
    assert_near(turned.xy, sin(0.05) * cos(0.05), 1e-13);
    turned = sym3_rotate(s, vec3_make(0.0, 0.05, 0.0)); /* x turns towards -z */
    assert_near(turned.zx, -sin(0.05) * cos(0.05), 1e-13);
    s = (struct sym3){0.0, 1.0, 0.0, 0.0, 0.0, 0.0};
    turned = sym3_rotate(s, vec3_make(0.05, 0.0, 0.0));
    assert_near(turned.yz, sin(0.05) * cos(0.05), 1e-13);
}

/* Section 7.4 of the method: S_w = S + dt (W S - S W), W_ab = (dU^a/dx^b - dU^b/dx^a)/2, spin =
 * curl U/2. */
static void rotation_is_the_jaumann_rate_to_first_order(void **state)
{
    (void)state;
    struct dice dice = {2};
    for (int k = 0; k < 100; k++) {
        double gradient[3][3], w[3][3], product[3][3] = {{0.0}};
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++)
                gradient[a][b] = dice_between(&dice, -1.0, 1.0);
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++)
                w[a][b] = 0.5 * (gradient[a][b] - gradient[b][a]);
        struct vec3 spin = {0.5 * (gradient[2][1] - gradient[1][2]),
                            0.5 * (gradient[0][2] - gradient[2][0]),
                            0.5 * (gradient[1][0] - gradient[0][1])};
        struct sym3 s = random_deviator(&dice, 1.0);
        double full[3][3] = {{s.xx, s.xy, s.zx}, {s.xy, s.yy, s.yz}, {s.zx, s.yz, s.zz}};
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++)
                for (int c = 0; c < 3; c++)
                    product[a][b] += w[a][c] * full[c][b] - full[a][c] * w[c][b];
        for (double dt = 1e-3; dt > 1e-6; dt *= 0.1) {
            struct sym3 turned = sym3_rotate(s, vec3_scale(dt, spin));
            double error = 20.0 * square(dt);
            assert_near(turned.xx, s.xx + dt * product[0][0], error);
            assert_near(turned.yy, s.yy + dt * product[1][1], error);
            assert_near(turned.zz, s.zz + dt * product[2][2], error);
            assert_near(turned.xy, s.xy + dt * product[0][1], error);
            assert_near(turned.yz, s.yz + dt * product[1][2], error);
            assert_near(turned.zx, s.zx + dt * product[2][0], error);
        }
    }
}

static void radial_return_puts_the_stress_on_yield(void **state)
{
    (void)state;
    struct dice dice = {3};
    const struct motion still = {.dt = 1e-9};
    for (int k = 0; k < 1000; k++) {
        struct sym3 trial = random_deviator(&dice, 1e9);
        struct point point = {.deviator = trial, .history = {0.125}};
        strength_perfect_plastic(&aluminium_strength, &still, 0.0, &point);
        const struct sym3 s = point.deviator;
        const double plastic = point.history[HISTORY_plastic_strain];
        double mises = sym3_mises(trial);
        if (mises <= 0.4e9) {
            assert_true(plastic == 0.125 && s.xx == trial.xx && s.zx == trial.zx);
            continue;
        }
        assert_close(sym3_mises(s), 0.4e9, 1e-14);
        assert_close(s.xy, trial.xy * 0.4e9 / mises, 1e-14);
        assert_near(sym3_trace(s), 0.0, 1e-5);
        assert_close(plastic - 0.125, (mises - 0.4e9) / (3.0 * 23e9), 1e-12);
    }
}

/* What the return takes is dissipated, never gained: S : plastic strain = equivalent stress times
 * equivalent plastic strain. */
static void plastic_work_is_positive(void **state)
{
    (void)state;
    struct dice dice = {4};
    for (int k = 0; k < 1000; k++) {
        struct sym3 start = random_deviator(&dice, 0.15e9), rate = random_deviator(&dice, 1e6);
        const double dt = 1e-8;
        const struct motion motion = {.dt = dt, .strain_rate = rate};
        struct point point = {.deviator = start};
        strength_perfect_plastic(&aluminium_strength, &motion, 0.0, &point);
        const struct sym3 s = point.deviator;
        const double plastic = point.history[HISTORY_plastic_strain];
        assert_true(plastic >= 0.0);
        /* Plastic strain: the strain of the step less the elastic strain (S - start)/(2 G). */
        struct sym3 elastic = sym3_scale(1.0 / 46e9, sym3_add(s, sym3_scale(-1.0, start)));
        struct sym3 part = sym3_add(sym3_scale(dt, rate), sym3_scale(-1.0, elastic));
        double work = s.xx * part.xx + s.yy * part.yy + s.zz * part.zz +
                      2.0 * (s.xy * part.xy + s.yz * part.yz + s.zx * part.zx);
        assert_near(work, sym3_mises(s) * plastic, 1e-9 * 0.4e9 * (dt * 1e6 + plastic));
        assert_true(work >= -1e-3);
    }
}

static void elastic_uniaxial_strain_gives_four_thirds_of_the_shear_modulus(void **state)
{
    (void)state;
    struct point point = {.density = 2700.0};
    struct motion motion = {.dt = 1e-9, .density = 2700.0, .strain_rate = {.xx = 1e5}};
    struct response response = material_step(&aluminium, &point, &motion);
    const double strain = 1e-4;
    assert_close(point.deviator.xx, 4.0 / 3.0 * 23e9 * strain, 1e-14);
    assert_close(point.deviator.yy, -2.0 / 3.0 * 23e9 * strain, 1e-14);
    assert_close(point.deviator.zz, -2.0 / 3.0 * 23e9 * strain, 1e-14);
    assert_true(point.deviator.xy == 0.0 && point.history[0] == 0.0);
    assert_true(response.status == 0);
    /* Far on, |S_xx| stays at 2/3 of the yield stress (2.4). */
    for (int k = 0; k < 400; k++)
        material_step(&aluminium, &point, &motion);
    assert_close(point.deviator.xx, 2.0 / 3.0 * 0.4e9, 1e-13);
    assert_true(point.history[0] > 0.0);
}

static void simple_shear_strains_by_the_whole_angle(void **state)
{
    (void)state;
    /* dU^x/dy = g: e_xy = g/2, so S_xy = G g dt before the stress turns. */
    struct point point = {.density = 2700.0};
    struct motion motion = {
        .dt = 1e-9, .density = 2700.0, .strain_rate = {.xy = 0.5e5}, .spin = {0.0, 0.0, -0.5e5}};
    material_step(&aluminium, &point, &motion);
    assert_close(point.deviator.xy, 23e9 * 1e-4, 1e-7);
    /* It turns clockwise: what is along xy leans towards +xx. */
    assert_true(point.deviator.xx > 0.0 && point.deviator.yy < 0.0);
}

static void a_fluid_keeps_no_deviator(void **state)
{
    (void)state;
    struct point point = {.density = 1500.0, .energy = 10.0};
    struct motion motion = {.dt = 1e-3,
                            .density = 1600.0,
                            .energy = 12.0,
                            .strain_rate = {.xx = 1.0, .xy = 2.0},
                            .spin = {1.0, 0.0, 0.0}};
    material_step(&gas, &point, &motion);
    assert_true(sym3_square(point.deviator) == 0.0);
    assert_close(point.pressure, 2.0 * 1600.0 * 12.0, 1e-15);
}

/* The tensile parts of S and of -S add up to S, have nothing in common, and are what remains of the
 * principal stresses; in a plane likewise. */
static void the_tensile_part_of_a_stress_has_its_positive_principal_stresses(void **state)
{
    (void)state;
    struct dice dice = {7};
    for (int k = 0; k < 2000; k++) {
        double principal[3] = {dice_between(&dice, -1e6, 1e6), dice_between(&dice, -1e6, 1e6),
                               dice_between(&dice, -1e6, 1e6)};
        if (k % 5 == 1)
            principal[1] = principal[0];
        if (k % 7 == 1)
            principal[2] = 0.0;
        const struct vec3 angle =
            vec3_make(k % 2 ? 0.0 : dice_between(&dice, -0.4, 0.4),
                      k % 2 ? 0.0 : dice_between(&dice, -0.4, 0.4), dice_between(&dice, -0.4, 0.4));
        struct sym3 s = {principal[0], principal[1], principal[2], 0.0, 0.0, 0.0};
        struct sym3 tensile = {maximum(principal[0], 0.0),
                               maximum(principal[1], 0.0),
                               maximum(principal[2], 0.0),
                               0.0,
                               0.0,
                               0.0};
        s = sym3_rotate(s, angle);
        tensile = sym3_rotate(tensile, angle);
        struct sym3 off = sym3_add(sym3_tensile(s), sym3_scale(-1.0, tensile));
        assert_near(sqrt(sym3_square(off)), 0.0, 2e-2); /* the root of a rounding: cosines near 1 */
        if (k % 2 == 0)
            continue;
        tensile.zz = 0.0;
        off = sym3_add(sym3_tensile_in_plane(s), sym3_scale(-1.0, tensile));
        assert_near(sqrt(sym3_square(off)), 0.0, 1e-6);
    }
    for (double size = 1.0; size > 0.0; size *= 1e-5) {
        const struct sym3 s = {size, -0.3 * size, 0.2 * size, 0.5 * size, -0.1 * size, 0.4 * size};
        assert_true(isfinite(sym3_square(sym3_tensile(s)) + sym3_extreme(s, -1.0)));
    }
    assert_true(sym3_square(sym3_tensile((struct sym3){0})) == 0.0);
    assert_true(sym3_square(sym3_tensile_in_plane((struct sym3){0})) == 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ideal_gas_has_its_pressure_and_sound),
        cmocka_unit_test(barotropic_liquid_follows_its_modulus),
        cmocka_unit_test(mie_grueneisen_passes_through_its_shock_adiabat),
        cmocka_unit_test(mie_grueneisen_has_an_independent_value),
        cmocka_unit_test(mie_grueneisen_is_continuous_where_tension_begins),
        cmocka_unit_test(mie_grueneisen_derivatives_are_those_of_its_pressure),
        cmocka_unit_test(mie_grueneisen_is_bounded_below_absolute_zero),
        cmocka_unit_test(mie_grueneisen_says_when_it_is_compressed_beyond_its_adiabat),
        cmocka_unit_test(sound_speeds_follow_from_pressure_along_the_isentrope),
        cmocka_unit_test(a_state_without_sound_says_so),
        cmocka_unit_test(rotation_keeps_the_invariants),
        cmocka_unit_test(rotation_turns_a_stress_with_the_right_hand),
        cmocka_unit_test(rotation_is_the_jaumann_rate_to_first_order),
        cmocka_unit_test(radial_return_puts_the_stress_on_yield),
        cmocka_unit_test(plastic_work_is_positive),
        cmocka_unit_test(elastic_uniaxial_strain_gives_four_thirds_of_the_shear_modulus),
        cmocka_unit_test(simple_shear_strains_by_the_whole_angle),
        cmocka_unit_test(a_fluid_keeps_no_deviator),
        cmocka_unit_test(the_tensile_part_of_a_stress_has_its_positive_principal_stresses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
