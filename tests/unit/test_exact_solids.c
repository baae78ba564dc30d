/* The elastic-plastic Riemann problem with equations of state that know energy: the printed tables
 * of the reference cases, the laws that every solution obeys, free surfaces, overdriven shocks. */
#include "exact_solution.h"

#include "exact/elastic_plastic_riemann.h"
#include "exact/gas_riemann.h"
#include "material/eos.h"

static const struct choice gas_choice = {.size = sizeof(struct eos_stiffened_gas)};
static const struct choice metal_choice = {.size = sizeof(struct eos_grueneisen_eta)};

static struct eos_stiffened_gas soft = {2700.0, 5380.0, 2.67};
static struct eos_grueneisen_eta wilkins = {2785.0, 5328.0, 1.338, 2.0, EOS_EXTENDED};
static struct eos_grueneisen_eta red = {8930.0, 3940.0, 1.490, 2.0, EOS_EXTENDED};

static struct exact_solid solid_of(double shear_modulus, double yield, double velocity)
{
    return (struct exact_solid){.reference_density = NAN,
                                .bulk_modulus = NAN,
                                .shear_modulus = shear_modulus,
                                .yield = yield,
                                .density = NAN,
                                .velocity = velocity,
                                .eos = {.index = -1}};
}

static struct exact_solid metal(struct eos_grueneisen_eta *eos, double shear_modulus, double yield,
                                double velocity)
{
    struct exact_solid solid = solid_of(shear_modulus, yield, velocity);
    solid.eos = (struct one_of){EOS_grueneisen_eta, &metal_choice, eos};
    return solid;
}

static struct exact_solid aluminium(double velocity)
{
    return metal(&wilkins, 27.6e9, 300e6, velocity);
}

static struct exact_solid copper(double velocity) { return metal(&red, 45e9, 90e6, velocity); }

static struct exact_solid soft_aluminium(double velocity, double deviator)
{
    struct exact_solid solid = solid_of(26.5e9, 300e6, velocity);
    solid.eos = (struct one_of){EOS_stiffened_gas, &gas_choice, &soft};
    solid.deviator = deviator;
    return solid;
}

static struct solution solved(struct exact_solid left, struct exact_solid right, double at,
                              double time)
{
    struct exact_elastic_plastic_riemann problem = {{left, right}, at};
    return solve(&exact_elastic_plastic_riemann_class, &problem, time);
}

static void assert_lawful(const struct solution *solution)
{
    assert_jumps_conserve(solution);
    assert_fans_flow(solution);
    assert_contact_balanced(solution);
}

static void aluminium_at_yield_has_the_printed_digits(void **state)
{
    (void)state;
    static const struct row rows[] = {
        {"left star density", 1.0, "2798.835"},
        {"right star density", 1.0, "2798.895"},
        {"star velocity", 1.0, "3.1262"},
        {"left star pressure", 1e6, "2963.518"},
        {"right star pressure", 1e6, "2963.518"},
        {"left star deviator", 1e6, "-200.000"},
        {"star normal pressure", 1e6, "3163.518"},
        {"right elastic limit density", 1.0, "2715.326"},
        {"right elastic limit velocity", 1.0, "-163.232"},
        {"right elastic limit pressure", 1e6, "446.677"},
        {"right elastic limit normal pressure", 1e6, "646.677"},
        {"left plastic speed", 1.0, "-5375.14"},
        {"right plastic speed", 1.0, "5408.49"},
        {"right elastic speed", 1.0, "6314.09"},
        {"left plastic place", 1e-3, "-537.514"},
        {"right plastic place", 1e-3, "540.849"},
        {"right elastic place", 1e-3, "631.409"},
        {"contact place", 1e-3, "0.3126"},
        {0},
    };
    struct solution solution =
        solved(soft_aluminium(200.0, -200e6), soft_aluminium(-200.0, 0.0), 0.0, 0.1e-3);
    assert_rows(&solution, rows);
    assert_lawful(&solution);
    /* Yielding at the start, the left sends out no precursor. */
    double before = -0.5376;
    struct exact_state ahead = solution.class->sample(solution.solved, SIDE_LEFT, before, 0.1e-3);
    assert_near(ahead.velocity, 200.0, 200.0, 1e-15);
    release(&solution);
}

static void copper_on_aluminium_has_the_printed_digits(void **state)
{
    (void)state;
    static const struct row rows[] = {
        /* The table says 8938.935; 8930 exp(0.001) = 8938.93447. */
        {"left elastic limit density", 1.0, "8938.934"},
        {"left elastic limit velocity", 1.0, "55.2802"},
        {"left elastic limit pressure", 1e6, "139.030"},
        {"left elastic limit normal pressure", 1e6, "199.030"},
        {"left star density", 1.0, "8971.996"},
        {"left star pressure", 1e6, "658.514"},
        {"left star deviator", 1e6, "-60.000"},
        {"star velocity", 1.0, "40.6464"},
        {"star normal pressure", 1e6, "718.514"},
        {"right star density", 1.0, "2803.017"},
        {"right star pressure", 1e6, "518.514"},
        {"right star deviator", 1e6, "-200.000"},
        {"right elastic limit density", 1.0, "2800.177"},
        {"right elastic limit velocity", 1.0, "35.1784"},
        {"right elastic limit pressure", 1e6, "435.879"},
        {"left elastic speed", 1.0, "-4662.18"},
        {"left plastic speed", 1.0, "-3915.99"},
        {"right plastic speed", 1.0, "5432.16"},
        {"right elastic speed", 1.0, "6490.43"},
        {"left elastic place", 1e-3, "15.676"},
        {"left plastic place", 1e-3, "17.168"},
        {"contact place", 1e-3, "25.0813"},
        {"right plastic place", 1e-3, "35.864"},
        {"right elastic place", 1e-3, "37.981"},
        {0},
    };
    struct solution solution = solved(copper(60.0), aluminium(0.0), 25e-3, 2e-6);
    assert_rows(&solution, rows);
    assert_lawful(&solution);
    /* The digits that tests of the contact solver start from. */
    assert_near(number(&solution, "star velocity"), 40.646381, 40.6, 1e-8);
    assert_near(number(&solution, "star normal pressure"), 718.513845e6, 718.5e6, 1e-9);
    release(&solution);
}

static void star_state_on_both_sides_stays_as_it_is(void **state)
{
    (void)state;
    struct solution first = solved(copper(60.0), aluminium(0.0), 0.0, 0.0);
    struct exact_state left = first.class->star(first.solved, SIDE_LEFT);
    struct exact_state right = first.class->star(first.solved, SIDE_RIGHT);
    struct exact_solid back = copper(left.velocity), forth = aluminium(right.velocity);
    back.density = left.density, back.energy = left.energy, back.deviator = left.deviator;
    forth.density = right.density, forth.energy = right.energy, forth.deviator = right.deviator;
    struct solution again = solved(back, forth, 0.0, 0.0);
    assert_near(number(&again, "star velocity"), left.velocity, left.velocity, 1e-12);
    assert_near(number(&again, "star normal pressure"), -left.stress, -left.stress, 1e-12);
    release(&first);
    release(&again);
}

/* The plateau behind the plastic shock of the plate impact. */
static struct exact_solid shocked_aluminium(void)
{
    struct solution impact = solved(aluminium(800.0), aluminium(0.0), 5e-3, 5e-6);
    struct exact_state star = impact.class->star(impact.solved, SIDE_RIGHT);
    struct exact_solid shocked = aluminium(star.velocity);
    shocked.density = star.density;
    shocked.energy = star.energy;
    shocked.deviator = star.deviator;
    release(&impact);
    return shocked;
}

static void plate_impact_has_the_printed_digits(void **state)
{
    (void)state;
    static const struct row rows[] = {
        {"right star density", 1.0, "2985.629"},
        {"star velocity", 1.0, "400.000"},
        {"right star pressure", 1e6, "6435.879"},
        {"star normal pressure", 1e6, "6635.879"},
        {"right plastic speed", 1.0, "5908.52"},
        {"right elastic limit density", 1.0, "2800.177"},
        {"right elastic limit velocity", 1.0, "35.178"},
        {"right elastic limit pressure", 1e6, "435.879"},
        {"right elastic limit normal pressure", 1e6, "635.879"},
        {"right elastic speed", 1.0, "6490.43"},
        {"right plastic place", 1e-3, "34.543"},
        {"right elastic place", 1e-3, "37.452"},
        {0},
    };
    struct solution impact = solved(aluminium(800.0), aluminium(0.0), 5e-3, 5e-6);
    assert_rows(&impact, rows);
    assert_lawful(&impact);
    release(&impact);
}

static void shocked_plate_is_released_by_its_free_surface_as_printed(void **state)
{
    (void)state;
    static const struct row rows[] = {
        {"right elastic limit density", 1.0, "2953.352"},
        {"right elastic limit velocity", 1.0, "325.354"},
        {"right elastic limit pressure", 1e6, "5313.59"},
        {"right elastic limit normal pressure", 1e6, "5113.59"},
        {"right star density", 1.0, "2789.78"},
        {"star velocity", 1.0, "7.02"},
        {"right star pressure", 1e6, "200.0"},
        {"right star deviator", 1e6, "200.0"},
        {"star normal pressure", 1e6, "0.000"},
        {0},
    };
    struct exact_solid nothing = solid_of(0.0, 0.0, 0.0);
    nothing.free = true;
    struct solution release_wave = solved(nothing, shocked_aluminium(), 0.0, 0.0);
    assert_rows(&release_wave, rows);
    assert_jumps_conserve(&release_wave);
    assert_fans_flow(&release_wave);
    struct exact_state void_state = release_wave.class->star(release_wave.solved, SIDE_LEFT);
    assert_true(void_state.density == 0.0 && void_state.stress == 0.0);
    release(&release_wave);
}

static void strong_shock_swallows_its_precursor(void **state)
{
    (void)state;
    struct solution solution = solved(aluminium(4000.0), aluminium(0.0), 0.0, 0.0);
    for (int i = 0; i < solution.count; i++)
        assert_null(strstr(solution.numbers[i].name, "elastic"));
    assert_near(number(&solution, "star velocity"), 2000.0, 2000.0, 1e-14);
    assert_lawful(&solution);
    release(&solution);
    /* Just where it does, the star state is steady. */
    double last = 0.0;
    for (int i = 0; i < 200; i++) {
        double speed = 1000.0 + 10.0 * i;
        solution = solved(aluminium(speed), aluminium(0.0), 0.0, 0.0);
        double normal = number(&solution, "star normal pressure");
        if (i > 1)
            assert_near(normal - last, 0.5 * 10.0 * 2785.0 * 6500.0, normal, 0.02);
        last = normal;
        release(&solution);
    }
}

static void bodies_that_part_send_two_fans_a_side(void **state)
{
    (void)state;
    struct exact_solid left = shocked_aluminium(), right = left;
    left.velocity = -100.0;
    right.velocity = 100.0;
    struct solution solution = solved(left, right, 0.0, 1e-6);
    number(&solution, "left elastic head speed");
    number(&solution, "left plastic head speed");
    number(&solution, "right elastic tail place");
    number(&solution, "right plastic tail place");
    assert_lawful(&solution);
    release(&solution);
}

/* Fluids of an equation of state are gases too: the shock tube of Sod. */
static void gases_agree_with_their_own_solution(void **state)
{
    (void)state;
    struct eos_ideal_gas air = {1.0, 1.4};
    const struct choice air_choice = {.size = sizeof air};
    struct exact_gas_riemann tube = {{{1.0, 0.0, 1.0, 1.4}, {0.125, 0.0, 0.1, 1.4}}, 0.0};
    struct exact_solid side[2];
    for (int i = 0; i < 2; i++) {
        side[i] = solid_of(0.0, 0.0, 0.0);
        side[i].eos = (struct one_of){EOS_ideal_gas, &air_choice, &air};
        side[i].density = tube.gas[i].density;
        side[i].energy = tube.gas[i].pressure / (0.4 * side[i].density);
    }
    struct solution gas = solve(&exact_gas_riemann_class, &tube, 0.0);
    struct solution solution = solved(side[SIDE_LEFT], side[SIDE_RIGHT], 0.0, 0.0);
    assert_lawful(&solution);
    for (int i = -120; i <= 200; i++) {
        double speed = 0.01 * i;
        enum exact_side here = exact_side_at(gas.class, gas.solved, speed, 1.0);
        struct exact_state a = gas.class->sample(gas.solved, here, speed, 1.0);
        struct exact_state b = solution.class->sample(solution.solved, here, speed, 1.0);
        assert_near(a.density, b.density, 1.0, 1e-9);
        assert_near(a.velocity, b.velocity, 1.0, 1e-9);
        assert_near(a.pressure, b.pressure, 1.0, 1e-9);
        assert_near(a.energy, b.energy, 1.0, 1e-9);
    }
    release(&solution);
    release(&gas);
}

static void impossible_solids_are_refused(void **state)
{
    (void)state;
    struct exact_elastic_plastic_riemann problem = {{aluminium(0.0), aluminium(0.0)}, 0.0};
    problem.solid[SIDE_LEFT].deviator = 200.1e6;
    assert_refused(&exact_elastic_plastic_riemann_class, &problem);
    problem.solid[SIDE_LEFT] = solid_of(27.6e9, 300e6, 0.0);
    assert_refused(&exact_elastic_plastic_riemann_class, &problem);
    problem.solid[SIDE_LEFT] = aluminium(0.0);
    problem.solid[SIDE_LEFT].bulk_modulus = 73e9;
    assert_refused(&exact_elastic_plastic_riemann_class, &problem);
    problem.solid[SIDE_LEFT] = aluminium(-5e4);
    assert_refused(&exact_elastic_plastic_riemann_class, &problem);
    problem.solid[SIDE_LEFT].free = problem.solid[SIDE_RIGHT].free = true;
    assert_refused(&exact_elastic_plastic_riemann_class, &problem);
}

static void random_metals_conserve_and_flow(void **state)
{
    (void)state;
    uint64_t seed = 1973;
    for (int round = 0; round < 100; round++) {
        struct exact_solid solid[2] = {copper(draw_between(&seed, -400.0, 400.0)),
                                       aluminium(draw_between(&seed, -400.0, 400.0))};
        if (round % 5 == 0)
            solid[SIDE_LEFT] = soft_aluminium(draw_between(&seed, -400.0, 400.0), 0.0);
        for (int side = 0; side < 2; side++) {
            solid[side].energy = draw_between(&seed, 0.0, 2e5);
            solid[side].deviator = 2.0 / 3.0 * solid[side].yield * draw_between(&seed, -1.0, 1.0);
        }
        struct solution solution = solved(solid[0], solid[1], 0.1, 0.0);
        assert_lawful(&solution);
        struct exact_solid mirror[2] = {solid[1], solid[0]};
        mirror[0].velocity = -mirror[0].velocity;
        mirror[1].velocity = -mirror[1].velocity;
        struct solution mirrored = solved(mirror[0], mirror[1], -0.1, 0.0);
        assert_mirrored(&solution, &mirrored);
        release(&mirrored);
        release(&solution);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(aluminium_at_yield_has_the_printed_digits),
        cmocka_unit_test(copper_on_aluminium_has_the_printed_digits),
        cmocka_unit_test(star_state_on_both_sides_stays_as_it_is),
        cmocka_unit_test(plate_impact_has_the_printed_digits),
        cmocka_unit_test(shocked_plate_is_released_by_its_free_surface_as_printed),
        cmocka_unit_test(strong_shock_swallows_its_precursor),
        cmocka_unit_test(bodies_that_part_send_two_fans_a_side),
        cmocka_unit_test(gases_agree_with_their_own_solution),
        cmocka_unit_test(impossible_solids_are_refused),
        cmocka_unit_test(random_metals_conserve_and_flow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
