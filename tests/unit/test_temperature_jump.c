/* The decay of a jump of temperature: against the table of the reference case, against the equation
 * of heat conduction, and what is conserved. */
#include "exact_solution.h"

#include "exact/temperature_jump.h"

static const struct exact_heat_body aluminium = {2700.0, 880.0, 200.0, 300.0};
static const struct exact_heat_body brass = {8700.0, 380.0, 85.5, 1000.0};
static const struct exact_heat_body lead = {11350.0, 130.0, 35.0, 1000.0};
static const struct exact_heat_body porcelain = {2500.0, 920.0, 1.68, 1000.0};
static const struct exact_heat_body gas = {3.75e-3, 5200.0, 2.3, 10000.0};

static struct exact_temperature_jump pair(struct exact_heat_body left, struct exact_heat_body right,
                                          bool finite)
{
    return (struct exact_temperature_jump){
        {left, right}, 0.0, finite ? -0.05 : NAN, finite ? 0.05 : NAN};
}

static double temperature(const struct solution *solution, double x, double time)
{
    return solution->class->sample(solution->solved, x < 0.0 ? SIDE_LEFT : SIDE_RIGHT, x, time)
        .temperature;
}

enum { PLACES = 11 };
static const double places[PLACES] = {-50, -30, -20, -10, -5, -2, 2, 5, 10, 20, 50};

static void assert_table(struct exact_heat_body left, struct exact_heat_body right, double time,
                         bool finite, const char *contact, const char *heat,
                         const char *const printed[PLACES])
{
    struct exact_temperature_jump problem = pair(left, right, finite);
    struct solution solution = solve(&exact_temperature_jump_class, &problem, time);
    assert_printed("contact temperature", number(&solution, "contact temperature"), 1.0, contact);
    assert_printed("heat", number(&solution, "heat crossed, infinite rod"), 1.0, heat);
    for (int i = 0; i < PLACES; i++) {
        /* The reference's insulated rods are solutions on a fine grid, good to a hundredth. */
        if (finite)
            assert_near(temperature(&solution, 1e-3 * places[i], time), atof(printed[i]), 1.0,
                        0.01);
        else
            assert_printed("temperature", temperature(&solution, 1e-3 * places[i], time), 1.0,
                           printed[i]);
    }
    release(&solution);
}

static void infinite_rods_have_the_printed_digits(void **state)
{
    (void)state;
    struct exact_heat_body hot = aluminium;
    hot.temperature = 1000.0;
    assert_table(aluminium, hot, 2.0, false, "650.000", "1.21752e7",
                 (const char *[]){"302.25", "335.72", "396.51", "505.02", "574.84", "619.62",
                                  "680.38", "725.16", "794.98", "903.49", "997.75"});
    assert_table(aluminium, brass, 3.0, false, "604.799", "1.29858e7",
                 (const char *[]){"307.95", "355.44", "413.84", "500.05", "551.13", "583.18",
                                  "655.21", "728.05", "833.18", "957.17", "999.98"});
    assert_table(aluminium, lead, 4.0, false, "473.549", "8.53781e6",
                 (const char *[]){"309.37", "342.98", "376.51", "421.48", "447.03", "462.89",
                                  "534.32", "622.73", "753.68", "922.85", "999.85"});
    assert_table(aluminium, porcelain, 10.0, false, "357.901", "4.50377e6",
                 (const char *[]){"312.91", "326.91", "336.24", "346.75", "352.28", "355.65",
                                  "614.23", "877.48", "994.29", "1000.00", "1000.00"});
}

static void insulated_rods_have_the_printed_digits(void **state)
{
    (void)state;
    struct exact_heat_body hot = aluminium;
    hot.temperature = 1000.0;
    assert_table(aluminium, hot, 2.0, true, "650.000", "1.21752e7",
                 (const char *[]){"304.50", "335.77", "396.51", "505.02", "574.84", "619.62",
                                  "680.38", "725.16", "794.98", "903.49", "995.50"});
    assert_table(aluminium, brass, 3.0, true, "604.799", "1.29858e7",
                 (const char *[]){"315.90", "356.01", "413.95", "500.07", "551.14", "583.19",
                                  "655.21", "728.05", "833.18", "957.17", "999.95"});
    assert_table(aluminium, lead, 4.0, true, "473.549", "8.53781e6",
                 (const char *[]){"318.75", "344.19", "376.87", "421.57", "447.08", "462.92",
                                  "534.34", "622.73", "753.68", "922.85", "999.70"});
    assert_table(aluminium, porcelain, 10.0, true, "357.901", "4.50377e6",
                 (const char *[]){"325.85", "332.08", "339.37", "348.74", "353.98", "357.25",
                                  "614.56", "877.49", "994.29", "1000.00", "1000.00"});
}

static struct exact_temperature_jump hot_gas(void)
{
    struct exact_temperature_jump problem = {{porcelain, gas}, 1e-5, 0.0, 1e-4};
    problem.body[SIDE_LEFT].temperature = 300.0;
    return problem;
}

static void porcelain_against_hot_gas_has_the_printed_digits(void **state)
{
    (void)state;
    static const struct {
        double place;
        const char *printed;
    } rows[] = {{-0.1, "306.28"},  {0.5, "458.48"},   {1.5, "709.43"},
                {2.5, "959.99"},   {5.5, "1706.63"},  {10.5, "2919.01"},
                {20.5, "5122.58"}, {40.5, "8188.84"}, {60.5, "9527.36"}};
    struct exact_temperature_jump problem = hot_gas();
    problem.from = problem.to = NAN;
    struct solution solution = solve(&exact_temperature_jump_class, &problem, 4e-9);
    assert_printed("contact temperature", number(&solution, "contact temperature"), 1.0, "332.935");
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        enum exact_side side = rows[i].place < 0.0 ? SIDE_LEFT : SIDE_RIGHT;
        double x = 1e-5 + 1e-6 * rows[i].place;
        double got = solution.class->sample(solution.solved, side, x, 4e-9).temperature;
        assert_printed("temperature", got, 1.0, rows[i].printed);
    }
    release(&solution);
}

/* Heat stays, the equation of conduction holds on either side, and temperature and flux are
 * continuous at the contact. */
static void assert_conducts(const struct exact_temperature_jump *problem, double time)
{
    struct solution solution = solve(&exact_temperature_jump_class, problem, time);
    double heat = 0.0, start = 0.0;
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        const struct exact_heat_body *body = &problem->body[side];
        double end = side == SIDE_LEFT ? problem->from : problem->to;
        double length = fabs(end - problem->at), capacity = body->density * body->capacity;
        enum { POINTS = 4000 };
        for (int i = 0; i < POINTS; i++) {
            double x = problem->at + (end - problem->at) * (i + 0.5) / POINTS;
            heat += capacity * length / POINTS *
                    solution.class->sample(solution.solved, side, x, time).temperature;
        }
        start += capacity * length * body->temperature;
        double x = problem->at + 0.4 * (end - problem->at), step = 1e-3 * length;
        double a = body->conductivity / capacity, moment = 1e-3 * square(length) / a;
        if (moment > 0.1 * time)
            moment = 1e-3 * time;
        double t[3], later, sooner;
        for (int k = 0; k < 3; k++)
            t[k] =
                solution.class->sample(solution.solved, side, x + (k - 1) * step, time).temperature;
        later = solution.class->sample(solution.solved, side, x, time + moment).temperature;
        sooner = solution.class->sample(solution.solved, side, x, time - moment).temperature;
        double rate = (later - sooner) / (2.0 * moment);
        double curvature = a * (t[2] - 2.0 * t[1] + t[0]) / square(step);
        assert_near(rate, curvature, fabs(rate) + 1e-6 * t[1] / time, 1e-3);
    }
    assert_near(heat, start, start, 1e-6);
    double at = problem->at, value[2], flux[2];
    for (int side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        double end = side == SIDE_LEFT ? problem->from : problem->to, out = 1e-4 * (end - at), t[3];
        for (int k = 0; k < 3; k++)
            t[k] = solution.class->sample(solution.solved, side, at + k * out, time).temperature;
        value[side] = t[0];
        flux[side] =
            problem->body[side].conductivity * (4.0 * t[1] - 3.0 * t[0] - t[2]) / (2.0 * out);
    }
    assert_near(value[0], value[1], value[0], 1e-10);
    assert_near(flux[0], flux[1], fabs(flux[0]), 1e-3);
    release(&solution);
}

static void insulated_rods_keep_their_heat_and_conduct(void **state)
{
    (void)state;
    struct exact_temperature_jump problem = pair(aluminium, porcelain, true);
    assert_conducts(&problem, 10.0);
    assert_conducts(&problem, 1000.0);
    problem = pair(lead, aluminium, true);
    problem.to = 0.013;
    assert_conducts(&problem, 4.0);
    problem = hot_gas();
    assert_conducts(&problem, 4e-7);
}

static void ends_that_the_jump_has_not_reached_do_not_matter(void **state)
{
    (void)state;
    struct exact_temperature_jump finite = pair(aluminium, lead, true), infinite = finite;
    infinite.from = infinite.to = NAN;
    struct solution a = solve(&exact_temperature_jump_class, &finite, 0.22);
    struct solution b = solve(&exact_temperature_jump_class, &infinite, 0.22);
    /* At 0.2 s the insulated rod is taken for an infinite one, at 0.22 s its series is summed. */
    for (int i = -40; i <= 40; i++)
        for (int k = 0; k < 2; k++) {
            double time = k ? 0.22 : 0.2, x = 1e-3 * i;
            assert_near(temperature(&a, x, time), temperature(&b, x, time), 1000.0, 1e-12);
        }
    release(&a);
    release(&b);
}

static void a_rod_of_one_material_has_no_seam(void **state)
{
    (void)state;
    struct exact_heat_body hot = aluminium;
    hot.temperature = 1000.0;
    struct exact_temperature_jump problem = pair(aluminium, hot, true);
    struct solution solution = solve(&exact_temperature_jump_class, &problem, 5.0);
    for (int i = 0; i <= 50; i++)
        assert_near(temperature(&solution, -1e-3 * i, 5.0) + temperature(&solution, 1e-3 * i, 5.0),
                    1300.0, 1300.0, 1e-13);
    assert_near(temperature(&solution, 0.05, 1e4), 650.0, 650.0, 1e-13);
    release(&solution);
}

static void a_rod_with_one_end_is_refused(void **state)
{
    (void)state;
    struct exact_temperature_jump problem = pair(aluminium, lead, true);
    problem.from = NAN;
    assert_refused(&exact_temperature_jump_class, &problem);
    problem = pair(aluminium, lead, true);
    problem.at = 0.06;
    assert_refused(&exact_temperature_jump_class, &problem);
    problem = hot_gas();
    problem.to = 1.1e-5; /* the gas equalises ten million times faster than the porcelain */
    problem.from = -1e-3;
    assert_refused(&exact_temperature_jump_class, &problem);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(infinite_rods_have_the_printed_digits),
        cmocka_unit_test(insulated_rods_have_the_printed_digits),
        cmocka_unit_test(porcelain_against_hot_gas_has_the_printed_digits),
        cmocka_unit_test(insulated_rods_keep_their_heat_and_conduct),
        cmocka_unit_test(ends_that_the_jump_has_not_reached_do_not_matter),
        cmocka_unit_test(a_rod_of_one_material_has_no_seam),
        cmocka_unit_test(a_rod_with_one_end_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
