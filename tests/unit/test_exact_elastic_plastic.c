/* The elastic-plastic Riemann problem: against the printed tables of the reference case, against
 * the conservation laws and the material's own laws, and against its mirror image. */
#include "exact_solution.h"

#include "exact/elastic_plastic_riemann.h"

static struct solution mirrored_solid(const struct exact_elastic_plastic_riemann *problem)
{
    struct exact_elastic_plastic_riemann mirror = {
        {problem->solid[SIDE_RIGHT], problem->solid[SIDE_LEFT]}, -problem->at};
    mirror.solid[SIDE_LEFT].velocity *= -1.0;
    mirror.solid[SIDE_RIGHT].velocity *= -1.0;
    return solve(&exact_elastic_plastic_riemann_class, &mirror, 0.0);
}

static const struct exact_solid aluminium = {.reference_density = 2700.0,
                                             .bulk_modulus = 73e9,
                                             .shear_modulus = 23e9,
                                             .yield = 0.3e9,
                                             .density = NAN};

/* T1-A presses the left half; T1-D gives it a smaller reference density instead. */
static struct exact_elastic_plastic_riemann elastic_plastic_case(bool pressed)
{
    struct exact_elastic_plastic_riemann problem = {{aluminium, aluminium}, 0.05};
    double reference = 2700.0 * (1.0 - 4.0 / 73.0);
    if (pressed) {
        problem.solid[SIDE_LEFT].density = 2700.0 / (1.0 - 4.0 / 73.0);
    } else {
        problem.solid[SIDE_LEFT].reference_density = reference;
        problem.solid[SIDE_LEFT].density = 2700.0;
    }
    return problem;
}

static void assert_elastic_plastic_case(bool pressed, const struct row *rows)
{
    static const struct row common[] = {
        {"right elastic limit normal pressure", 1e9, "0.67454"},
        {"right elastic limit velocity", 1.0, "40.299"},
        {"right elastic limit density", 1.0, "2717.67"},
        {"right elastic limit pressure", 1e9, "0.47454"},
        {"left elastic limit normal pressure", 1e9, "3.34853"},
        {"left star deviator", 1e9, "0.2"},
        {"right star deviator", 1e9, "-0.2"},
        {"right plastic speed", 1.0, "5206.2"},
        {"right elastic speed", 1.0, "6199.4"},
        {"right plastic place", 1e-3, "76.03"},
        {"right elastic place", 1e-3, "81.00"},
        {0},
    };
    struct exact_elastic_plastic_riemann problem = elastic_plastic_case(pressed);
    struct solution solution = solve(&exact_elastic_plastic_riemann_class, &problem, 5e-6);
    assert_rows(&solution, common);
    assert_rows(&solution, rows);
    assert_jumps_conserve(&solution);
    assert_fans_flow(&solution);
    assert_contact_balanced(&solution);
    struct solution mirror = mirrored_solid(&problem);
    assert_mirrored(&solution, &mirror);
    release(&mirror);
    release(&solution);
}

static void pressed_aluminium_has_the_printed_digits(void **state)
{
    (void)state;
    static const struct row rows[] = {
        /* The table says 38.630; quadrature of sqrt(-dp/dV) to 30 digits gives 38.6294750546. */
        {"left elastic limit velocity", 1.0, "38.6294750546"},
        {"left elastic limit density", 1.0, "2837.95"},
        {"star normal pressure", 1e9, "1.99981"},
        {"star velocity", 1.0, "134.697"},
        {"left star density", 1.0, "2783.89"},
        {"right star density", 1.0, "2768.25"},
        {"left star pressure", 1e9, "2.19981"},
        {"right star pressure", 1e9, "1.79981"},
        {"left elastic head speed", 1.0, "-5906.9"},
        {"left elastic tail speed", 1.0, "-5900.9"},
        {"left plastic speed", 1.0, "-4908.3"},
        {"left elastic head place", 1e-3, "20.5"},
        {"left plastic place", 1e-3, "25.46"},
        {"contact place", 1e-3, "50.67"},
        {0},
    };
    assert_elastic_plastic_case(true, rows);
}

static void aluminium_of_literal_densities_has_the_printed_digits(void **state)
{
    (void)state;
    static const struct row rows[] = {
        {"left elastic limit velocity", 1.0, "39.733"},
        {"left elastic limit density", 1.0, "2682.45"},
        {"star normal pressure", 1e9, "2.02645"},
        {"star velocity", 1.0, "136.595"},
        {"left star density", 1.0, "2632.34"},
        {"right star density", 1.0, "2769.29"},
        {"left star pressure", 1e9, "2.22645"},
        {"right star pressure", 1e9, "1.82645"},
        {"left elastic head speed", 1.0, "-6075.7"},
        {"left elastic tail speed", 1.0, "-6069.6"},
        {"left plastic speed", 1.0, "-5048.6"},
        {"left elastic head place", 1e-3, "19.6"},
        {"left plastic place", 1e-3, "24.76"},
        {"contact place", 1e-3, "50.68"},
        {0},
    };
    assert_elastic_plastic_case(false, rows);
}

static void weak_impact_of_solids_is_elastic_only(void **state)
{
    (void)state;
    struct exact_elastic_plastic_riemann problem = {{aluminium, aluminium}, 0.0};
    problem.solid[SIDE_LEFT].velocity = 2e-3;
    struct solution solution = solve(&exact_elastic_plastic_riemann_class, &problem, 0.0);
    struct exact_state star = solution.class->star(solution.solved, SIDE_RIGHT);
    double impedance = sqrt(2700.0 * (73e9 + 4.0 / 3.0 * 23e9));
    assert_near(star.velocity, 1e-3, 1e-3, 1e-14);
    assert_near(-star.stress, impedance * 1e-3, impedance * 1e-3, 1e-6);
    assert_near(number(&solution, "right elastic speed"), impedance / 2700.0, impedance / 2700.0,
                1e-6);
    assert_jumps_conserve(&solution);
    release(&solution);
}

static void liquids_have_one_wave_a_side(void **state)
{
    (void)state;
    struct exact_solid water = {.reference_density = 1000.0, .bulk_modulus = 2e9, .density = NAN};
    struct exact_elastic_plastic_riemann problem = {{water, water}, 0.0};
    problem.solid[SIDE_LEFT].velocity = 100.0;
    struct solution solution = solve(&exact_elastic_plastic_riemann_class, &problem, 0.0);
    struct exact_state star = solution.class->star(solution.solved, SIDE_LEFT);
    /* The impedance of p = K (1 - V/V_0) is the same at any strength. */
    assert_near(star.velocity, 50.0, 50.0, 1e-15);
    assert_near(star.pressure, sqrt(1000.0 * 2e9) * 50.0, star.pressure, 1e-14);
    assert_true(star.deviator == 0.0);
    assert_jumps_conserve(&solution);
    release(&solution);
}

static void equal_solids_stay_as_they_are(void **state)
{
    (void)state;
    struct exact_solid solid = aluminium;
    solid.density = 2750.0;
    solid.velocity = 321.0;
    struct exact_elastic_plastic_riemann problem = {{solid, solid}, 0.0};
    struct solution solution = solve(&exact_elastic_plastic_riemann_class, &problem, 0.0);
    struct exact_state star = solution.class->star(solution.solved, SIDE_LEFT);
    struct exact_state start = solution.class->sample(solution.solved, SIDE_LEFT, 0.0, 0.0);
    assert_near(start.density, 2750.0, 2750.0, 1e-15);
    assert_true(star.density == start.density && star.velocity == 321.0);
    assert_true(star.stress == start.stress && star.deviator == 0.0 && star.energy == 0.0);
    release(&solution);
}

/* Beyond half of the bulk modulus the pressure goes on with the exponent of Tait's water. */
static void solids_pressed_beyond_the_line_have_a_solution(void **state)
{
    (void)state;
    struct exact_elastic_plastic_riemann problem = {{aluminium, aluminium}, 0.0};
    const struct exact_solid *solid = &problem.solid[SIDE_LEFT];
    problem.solid[SIDE_LEFT].velocity = 3.0 * 5200.0;
    struct solution solution = solve(&exact_elastic_plastic_riemann_class, &problem, 0.0);
    assert_contact_balanced(&solution);
    assert_jumps_conserve(&solution);
    const struct exact_state star = solution.class->star(solution.solved, SIDE_LEFT);
    const double half = 0.5 * solid->bulk_modulus,
                 x = 0.5 * star.density / solid->reference_density;
    assert_true(x > 1.0);
    assert_near(star.pressure, half + half * (pow(x, 7.0) - 1.0) / 7.0, solid->bulk_modulus, 1e-12);
    release(&solution);
}

static void random_solid_problems_conserve_and_obey_their_laws(void **state)
{
    (void)state;
    uint64_t seed = 1956;
    for (int round = 0; round < 500; round++) {
        struct exact_elastic_plastic_riemann problem = {.at = 0.1};
        double soft = INFINITY;
        for (int side = 0; side < 2; side++) {
            struct exact_solid *solid = &problem.solid[side];
            solid->reference_density = draw_between(&seed, 800.0, 20000.0);
            solid->bulk_modulus = pow(10.0, draw_between(&seed, 10.0, 11.0));
            solid->shear_modulus = round % 7 == side ? 0.0 : solid->bulk_modulus * draw(&seed);
            solid->yield = solid->shear_modulus * pow(10.0, draw_between(&seed, -3.0, 0.0));
            solid->density = solid->reference_density * draw_between(&seed, 0.97, 1.03);
            soft = minimum(soft, sqrt(solid->bulk_modulus / solid->reference_density));
        }
        for (int side = 0; side < 2; side++)
            problem.solid[side].velocity = soft * draw_between(&seed, -0.12, 0.12);
        struct solution solution = solve(&exact_elastic_plastic_riemann_class, &problem, 0.0);
        struct solution mirror = mirrored_solid(&problem);
        assert_contact_balanced(&solution);
        assert_jumps_conserve(&solution);
        assert_fans_flow(&solution);
        assert_mirrored(&solution, &mirror);
        for (int side = 0; side < 2; side++) {
            const struct exact_solid *solid = &problem.solid[side];
            struct exact_state star = solution.class->star(solution.solved, (enum exact_side)side);
            double law = solid->bulk_modulus * (1.0 - solid->reference_density / star.density);
            double shear = 4.0 / 3.0 * solid->shear_modulus * log(solid->density / star.density);
            double flow = 2.0 / 3.0 * solid->yield;
            assert_near(star.pressure, law, solid->bulk_modulus, 1e-13);
            assert_near(star.stress, star.deviator - star.pressure, solid->bulk_modulus, 1e-15);
            assert_true(fabs(star.deviator) <= flow * (1.0 + 1e-14));
            if (fabs(star.deviator) < flow * (1.0 - 1e-12))
                assert_near(star.deviator, shear, solid->bulk_modulus, 1e-13);
        }
        release(&mirror);
        release(&solution);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pressed_aluminium_has_the_printed_digits),
        cmocka_unit_test(aluminium_of_literal_densities_has_the_printed_digits),
        cmocka_unit_test(weak_impact_of_solids_is_elastic_only),
        cmocka_unit_test(liquids_have_one_wave_a_side),
        cmocka_unit_test(equal_solids_stay_as_they_are),
        cmocka_unit_test(solids_pressed_beyond_the_line_have_a_solution),
        cmocka_unit_test(random_solid_problems_conserve_and_obey_their_laws),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
