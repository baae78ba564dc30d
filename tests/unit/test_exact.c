/* The gas Riemann problem and the impedance match: against the printed tables of the reference
 * cases, against the conservation laws across jumps and inside fans, and against their mirror
 * images. */
#include "exact_solution.h"

#include "exact/choices.h"
#include "exact/gas_riemann.h"
#include "exact/impedance_match.h"
#include "material/material.h"

static struct solution mirrored_gas(const struct exact_gas_riemann *problem)
{
    struct exact_gas_riemann mirror = {{problem->gas[SIDE_RIGHT], problem->gas[SIDE_LEFT]},
                                       -problem->at};
    mirror.gas[SIDE_LEFT].velocity *= -1.0;
    mirror.gas[SIDE_RIGHT].velocity *= -1.0;
    return solve(&exact_gas_riemann_class, &mirror, 0.0);
}

static const struct exact_gas_riemann gas_t2 = {{{1500.0, 0.0, 3e4, 3.0}, {1200.0, 0.0, 1e4, 3.0}},
                                                0.05};
static const struct exact_gas_riemann gas_t3 = {{{1.0, 0.0, 3e10, 1.3}, {1.0, 0.0, 1e5, 1.4}},
                                                0.05};

static void gas_discontinuity_has_the_printed_digits(void **state)
{
    (void)state;
    static const struct row rows[] = {
        {"star pressure", 1.0, "18592.310924"},
        {"star velocity", 1.0, "1.1418764645"},
        {"left star density", 1.0, "1278.876573"},
        {"right star density", 1.0, "1467.171695"},
        {"left energy", 1.0, "10.0000000"},
        {"right energy", 1.0, "4.1666667"},
        {"left star energy", 1.0, "7.2690013"},
        {"right star energy", 1.0, "6.3361061"},
        {"left sound speed", 1.0, "7.7459667"},
        {"right sound speed", 1.0, "5.0000000"},
        {"left star sound speed", 1.0, "6.6040902"},
        {"left fan head speed", 1.0, "-7.7459667"},
        {"left fan tail speed", 1.0, "-5.4622138"},
        {"right shock speed", 1.0, "6.2706075"},
        {"left fan head place", 1e-3, "19.016"},
        {"left fan tail place", 1e-3, "28.151"},
        {"contact place", 1e-3, "54.568"},
        {"right shock place", 1e-3, "75.082"},
        {0},
    };
    struct solution solution = solve(&exact_gas_riemann_class, &gas_t2, 4e-3);
    assert_rows(&solution, rows);
    assert_jumps_conserve(&solution);
    assert_fans_flow(&solution);
    assert_contact_balanced(&solution);
    release(&solution);
}

static void blast_wave_has_the_printed_digits(void **state)
{
    (void)state;
    static const struct row rows[] = {
        {"star pressure", 1.0, "1.4205672612e10"},
        {"star velocity", 1.0, "1.0880202183e5"},
        {"left star density", 1.0, "0.5626806223"},
        {"right star density", 1.0, "5.9997536300"},
        {"left energy", 1.0, "1.000000000e11"},
        {"right energy", 1.0, "2.500000000e5"},
        {"left star energy", 1.0, "8.4154741e10"},
        {"right star energy", 1.0, "5.9192733e9"},
        {"left sound speed", 1.0, "197484.1766"},
        {"right sound speed", 1.0, "374.1657"},
        {"left star sound speed", 1.0, "181163.8733"},
        {"left fan head speed", 1.0, "-197484.1766"},
        {"left fan tail speed", 1.0, "-72361.8515"},
        {"right shock speed", 1.0, "130563.4985"},
        {"left fan head place", 1e-3, "10.503"},
        {"left fan tail place", 1e-3, "35.528"},
        {"contact place", 1e-3, "71.760"},
        {"right shock place", 1e-3, "76.113"},
        {0},
    };
    struct solution solution = solve(&exact_gas_riemann_class, &gas_t3, 2e-7);
    assert_rows(&solution, rows);
    assert_jumps_conserve(&solution);
    assert_fans_flow(&solution);
    assert_contact_balanced(&solution);
    release(&solution);
}

static void equal_gases_stay_as_they_are(void **state)
{
    (void)state;
    struct exact_gas gas = {1.3, -17.0, 1.1e5, 1.4};
    struct exact_gas_riemann problem = {{gas, gas}, 0.2};
    struct solution solution = solve(&exact_gas_riemann_class, &problem, 0.0);
    struct exact_state star = solution.class->star(solution.solved, SIDE_LEFT);
    assert_true(star.density == 1.3 && star.velocity == -17.0 && star.pressure == 1.1e5);
    assert_true(solution.class->contact(solution.solved, 2.0) == 0.2 - 34.0);
    release(&solution);
}

static void gases_that_part_too_fast_are_refused(void **state)
{
    (void)state;
    struct exact_gas_riemann problem = {{{1.0, -600.0, 1e5, 1.4}, {1.0, 600.0, 1e5, 1.4}}, 0.0};
    double escape = 5.0 * sqrt(1.4e5);
    struct solution solution = solve(&exact_gas_riemann_class, &problem, 0.0);
    release(&solution);
    problem.gas[SIDE_LEFT].velocity = -1.0001 * escape;
    problem.gas[SIDE_RIGHT].velocity = 1.0001 * escape;
    assert_refused(&exact_gas_riemann_class, &problem);
}

static void a_thousand_random_gas_problems_are_solved_and_conserve(void **state)
{
    (void)state;
    uint64_t seed = 2013;
    int solved = 0;
    while (solved < 1000) {
        struct exact_gas_riemann problem;
        double escape = 0.0;
        for (int side = 0; side < 2; side++) {
            struct exact_gas *gas = &problem.gas[side];
            gas->density = pow(10.0, draw_between(&seed, -2.0, 4.0));
            gas->pressure = pow(10.0, draw_between(&seed, 0.0, 11.0));
            gas->gamma = draw_between(&seed, 1.05, 4.0);
            double sound = sqrt(gas->gamma * gas->pressure / gas->density);
            gas->velocity = sound * draw_between(&seed, -4.0, 4.0);
            escape += 2.0 * sound / (gas->gamma - 1.0);
        }
        problem.at = 0.25;
        if (problem.gas[1].velocity - problem.gas[0].velocity >= escape) {
            assert_refused(&exact_gas_riemann_class, &problem);
            continue;
        }
        struct solution solution = solve(&exact_gas_riemann_class, &problem, 0.0);
        struct solution mirror = mirrored_gas(&problem);
        assert_contact_balanced(&solution);
        assert_jumps_conserve(&solution);
        assert_mirrored(&solution, &mirror);
        for (int side = 0; side < 2; side++) {
            const struct exact_gas *gas = &problem.gas[side];
            struct exact_state star = solution.class->star(solution.solved, (enum exact_side)side);
            if (star.pressure >= gas->pressure)
                continue;
            /* Through a fan the entropy and the Riemann invariant keep. */
            double g = gas->gamma, outward = side == SIDE_LEFT ? -1.0 : 1.0;
            assert_near(log(star.pressure / gas->pressure), g * log(star.density / gas->density),
                        1.0 + fabs(log(star.pressure / gas->pressure)), 1e-13);
            double before = sqrt(g * gas->pressure / gas->density);
            double after = sqrt(g * star.pressure / star.density);
            assert_near(star.velocity - outward * 2.0 * after / (g - 1.0),
                        gas->velocity - outward * 2.0 * before / (g - 1.0),
                        largest_speed(&solution) + 2.0 * before / (g - 1.0), 1e-14);
        }
        release(&mirror);
        release(&solution);
        solved++;
    }
}

/* The slab of porous aluminium on a rigid wall, line U_s = 1850 + 1.97 U_p: the shock runs back
 * through the slab at U_s relative to it. */
static void porous_slab_on_a_wall_follows_its_line(void **state)
{
    (void)state;
    static const struct {
        double speed;
        const char *printed;
    } rows[] = {{1000.0, "3820"}, {1500.0, "4805"}, {2000.0, "5790"}, {2500.0, "6775"},
                {3000.0, "7760"}, {3500.0, "8745"}, {4000.0, "9730"}};
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        struct exact_shock_material slab = {2025.0, 1850.0, 1.97, rows[i].speed, NULL},
                                    image = slab;
        image.velocity = -rows[i].speed;
        struct exact_impedance_match problem = {{slab, image}, 0.0};
        struct solution solution = solve(&exact_impedance_match_class, &problem, 0.0);
        assert_printed("U_s", number(&solution, "left shock speed in the material"), 1.0,
                       rows[i].printed);
        assert_true(number(&solution, "star velocity") == 0.0);
        assert_jumps_conserve(&solution);
        release(&solution);
    }
}

static void impact_of_two_materials_balances(void **state)
{
    (void)state;
    struct exact_shock_material copper = {8930.0, 3940.0, 1.489, 1200.0, NULL};
    struct exact_shock_material light = {2700.0, 5350.0, 1.34, -300.0, NULL};
    struct exact_impedance_match problem = {{copper, light}, 0.01};
    struct solution solution = solve(&exact_impedance_match_class, &problem, 1e-6);
    struct exact_state left = solution.class->star(solution.solved, SIDE_LEFT);
    struct exact_state right = solution.class->star(solution.solved, SIDE_RIGHT);
    assert_contact_balanced(&solution);
    assert_jumps_conserve(&solution);
    /* (1.65) at both densities. */
    double grow[2] = {1.0 - 8930.0 / left.density, 1.0 - 2700.0 / right.density};
    assert_near(8930.0 * square(3940.0) * grow[0] / square(1.0 - 1.489 * grow[0]), left.pressure,
                left.pressure, 1e-13);
    assert_near(2700.0 * square(5350.0) * grow[1] / square(1.0 - 1.34 * grow[1]), left.pressure,
                left.pressure, 1e-13);
    problem.material[SIDE_LEFT] = light;
    problem.material[SIDE_LEFT].velocity = 300.0;
    problem.material[SIDE_RIGHT] = copper;
    problem.material[SIDE_RIGHT].velocity = -1200.0;
    problem.at = -0.01;
    struct solution mirror = solve(&exact_impedance_match_class, &problem, 1e-6);
    assert_mirrored(&solution, &mirror);
    release(&mirror);
    release(&solution);
}

static void a_material_gives_what_is_left_out(void **state)
{
    (void)state;
    const struct material copper = {
        .eos = {.kind = EOS_mie_grueneisen,
                .of.mie_grueneisen = {.density = 8930.0, .sound = 3940.0, .slope = 1.489}}};
    const struct material gas = {.eos = {.kind = EOS_ideal_gas}};
    struct exact_shock_material given = {8930.0, 3940.0, 1.489, 500.0, NULL};
    struct exact_shock_material left = {NAN, NAN, NAN, 500.0, "copper"};
    struct exact_shock_material right = {9000.0, 3940.0, 1.5, 0.0, NULL};
    struct exact_impedance_match problem = {{left, right}, 0.0}, whole = {{given, right}, 0.0};
    const char *key;
    const struct exact_class *class = &exact_impedance_match_class;
    assert_string_equal(class->material_name(&problem, SIDE_LEFT, &key), "copper");
    assert_string_equal(key, "left.material");
    assert_null(class->material_name(&problem, SIDE_RIGHT, &key));
    assert_refused(class, &problem);
    class->take_material(&problem, SIDE_RIGHT, &copper); /* what is given stays */
    class->take_material(&problem, SIDE_LEFT, &copper);
    struct solution solution = solve(class, &problem, 0.0), other = solve(class, &whole, 0.0);
    assert_true(number(&solution, "star pressure") == number(&other, "star pressure"));
    release(&solution);
    release(&other);
    problem.material[SIDE_LEFT] = left;
    class->take_material(&problem, SIDE_LEFT, &gas); /* its adiabat is no straight line */
    assert_refused(class, &problem);
}

static void bodies_that_part_are_refused(void **state)
{
    (void)state;
    struct exact_shock_material copper = {8930.0, 3940.0, 1.489, 0.0, NULL};
    struct exact_impedance_match problem = {{copper, copper}, 0.0};
    struct solution solution = solve(&exact_impedance_match_class, &problem, 0.0);
    struct exact_state star = solution.class->star(solution.solved, SIDE_LEFT);
    assert_true(star.density == 8930.0 && star.velocity == 0.0 && star.pressure == 0.0);
    release(&solution);
    problem.material[SIDE_RIGHT].velocity = 1.0;
    assert_refused(&exact_impedance_match_class, &problem);
    /* A slope below one and more speed than the shock relation can bear. */
    problem.material[SIDE_LEFT] = (struct exact_shock_material){1000.0, 100.0, 0.5, 1000.0, NULL};
    problem.material[SIDE_RIGHT].velocity = -1000.0;
    assert_refused(&exact_impedance_match_class, &problem);
}

static void every_choice_has_a_table_and_a_class(void **state)
{
    (void)state;
    for (int i = 0; i < exact_choice_count; i++) {
        const struct exact_class *class = exact_choices[i].thing;
        assert_non_null(exact_choices[i].table);
        assert_true(exact_choices[i].size > 0 && class->size > 0);
        for (const struct parameter *p = exact_choices[i].table; !PARAMETER_IS_END(p); p++)
            assert_true(p->offset < exact_choices[i].size && p->help);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gas_discontinuity_has_the_printed_digits),
        cmocka_unit_test(blast_wave_has_the_printed_digits),
        cmocka_unit_test(equal_gases_stay_as_they_are),
        cmocka_unit_test(gases_that_part_too_fast_are_refused),
        cmocka_unit_test(a_thousand_random_gas_problems_are_solved_and_conserve),
        cmocka_unit_test(porous_slab_on_a_wall_follows_its_line),
        cmocka_unit_test(impact_of_two_materials_balances),
        cmocka_unit_test(a_material_gives_what_is_left_out),
        cmocka_unit_test(bodies_that_part_are_refused),
        cmocka_unit_test(every_choice_has_a_table_and_a_class),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
