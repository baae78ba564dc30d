/* The slope of the shock adiabat of every equation of state, against differences of its sound speed
 * and against shocks themselves; what has none is an error of the case. */
#include "running.h"

#include "every_eos.h"
#include "messages.h"
#include "riemann/shock_slope.h"

static double slope_of(const struct eos *eos)
{
    const struct material material = {.eos = *eos};
    return riemann_shock_slope(&material);
}

static void every_equation_of_state_has_a_slope(void **state)
{
    (void)state;
    for (int k = 0; k < EOS_KINDS; k++) {
        assert_true(slope_of(&all[k]) >= 0.05 && slope_of(&all[k]) < 10.0);
    }
    assert_true(slope_of(&all[EOS_ideal_gas]) == 1.2);
    assert_true(slope_of(&all[EOS_mie_grueneisen]) == 1.35);
    assert_true(slope_of(&all[EOS_rubber]) == 0.5);
    assert_true(slope_of(&all[EOS_barotropic]) == 0.05);
}

/* What is struck by far more than its pressure follows the limit of strong shocks, all else that of
 * weak ones. */
static void slopes_are_half_the_fundamental_derivative_at_rest(void **state)
{
    (void)state;
    for (int k = 0; k < EOS_KINDS; k++)
        if (isnan(eos_ratio_of_heats(&all[k])))
            assert_near(slope_of(&all[k]), maximum(riemann_weak_shock_slope(&all[k]), 0.05), 2e-4);
}

/* The speed of a shock that drives EOS from rest to PARTICLE, by bisection for the density that
 * meets all three laws. */
static double shock_speed(const struct eos *eos, double particle)
{
    const double none[POINT_HISTORY] = {0.0}, rest = eos_reference_density(eos);
    const double pressure = eos_evaluate(eos, rest, 0.0, none).pressure;
    double low = 0.0, high = 0.5; /* of 1 - rho_0/rho */
    for (int k = 0; k < 60; k++) {
        const double middle = 0.5 * (low + high), speed = particle / middle;
        const double behind = pressure + rest * speed * particle;
        const double energy = 0.5 * (behind + pressure) * middle / rest;
        const bool dense = eos_evaluate(eos, rest / (1.0 - middle), energy, none).pressure > behind;
        low = dense ? low : middle;
        high = dense ? middle : high;
    }
    return particle / (0.5 * (low + high));
}

static void weak_shocks_run_along_the_slope(void **state)
{
    (void)state;
    const double none[POINT_HISTORY] = {0.0};
    for (int k = 0; k < EOS_KINDS; k++) {
        const struct eos *eos = &all[k];
        /* tension may have another modulus */
        const double density = (1.0 + 1e-9) * eos_reference_density(eos);
        const struct eos_value rest = eos_evaluate(eos, density, 0.0, none);
        /* of an ideal gas it is the limit of strong shocks; where the energy does not matter, a
         * shock loses some */
        if (!isnan(eos_ratio_of_heats(eos)) || rest.dp_de == 0.0)
            continue;
        const struct response r = material_response(&rest, density, 0.0, 0.0);
        const double u = 1e-3 * r.sound_long;
        assert_near((shock_speed(eos, u) - r.sound_long) / u, slope_of(eos), 5e-3);
    }
}

#define MEDIUM(energy)                                                                      \
    "format: 1\ndimension: 1\nsolver: sph\nmaterials:\n"                                    \
    "  products: {eos: {jwl: {density: 1 kg/m^3, a: 0 Pa, "                                 \
    "b: 0 Pa, r1: 4, r2: 1, omega: 0.4, energy: " energy "}}}\n"                            \
    "bodies: {all: {material: products, box: {from: [0 m], to: [1 m]}, energy: 1 MJ/kg}}\n" \
    "resolution: 10 mm\nrun: {until: 1 ms}\n"

static void a_material_without_sound_at_rest_is_an_error_of_the_case(void **state)
{
    (void)state;
    static const char *const texts[] = {MEDIUM("0 Pa"), MEDIUM("1 MPa")};
    for (int k = 0; k < 2; k++) {
        struct running *run = open_case(texts[k], &(struct variant){.threads = 1, .cell = 1.0});
        struct error *error =
            run->solver->create(&run->sph, &run->simulation, run->input->solver.value);
        if (k == 0) {
            char *text = messages(error);
            assert_non_null(strstr(text, "case.yaml:5:"));
            assert_non_null(strstr(text, "materials.products: its shock adiabat has no slope"));
            free(text);
            error_free(error);
        } else {
            assert_success(error);
            assert_close(((const struct muscl_state *)run->sph.state)->shock_slope[0], 0.6,
                         1e-14); /* (gamma + 1)/4 of gamma = 1.4 */
        }
        end(run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_equation_of_state_has_a_slope),
        cmocka_unit_test(slopes_are_half_the_fundamental_derivative_at_rest),
        cmocka_unit_test(weak_shocks_run_along_the_slope),
        cmocka_unit_test(a_material_without_sound_at_rest_is_an_error_of_the_case),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
