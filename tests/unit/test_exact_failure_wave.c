/* The two waves of glass that runs into a wall against figures of another program, and the laws of
 * conservation. Glass: Parshikov (2013), table 2.2. */
#include "exact_solution.h"

#include "exact/failure_wave.h"

static struct exact_failure_wave glass(double impact)
{
    return (struct exact_failure_wave){.impact = impact,
                                       .density = 2480.0,
                                       .bulk_modulus = 43.36e9,
                                       .shear_modulus = 28.55e9,
                                       .speed = 1600.0,
                                       .failed = 1.1e9,
                                       .failed_slope = 0.2};
}

static void states_have_the_figures(void **state)
{
    (void)state;
    static const struct {
        double impact;
        const char *figure[12];
    } rows[] = {
        {400,
         {"2651.0", "369.6", "-5.252", "-1.569", "2.797", "3.683", "2702.3", "3.568", "-5.381",
          "-2.661", "2.720", "1569.6"}},
        {500,
         {"2692.6", "452.4", "-6.429", "-1.921", "3.423", "4.508", "2775.2", "4.612", "-6.634",
          "-3.600", "3.033", "1552.4"}},
        {600,
         {"2735.2", "534.6", "-7.597", "-2.270", "4.045", "5.327", "2851.8", "5.653", "-7.883",
          "-4.537", "3.346", "1534.6"}},
        {700,
         {"2778.8", "616.1", "-8.756", "-2.616", "4.662", "6.140", "2932.5", "6.690", "-9.129",
          "-5.471", "3.657", "1516.1"}},
        {800,
         {"2823.5", "697.0", "-9.905", "-2.959", "5.275", "6.946", "3017.6", "7.725", "-10.370",
          "-6.403", "3.968", "1497.0"}},
        {900,
         {"2869.2", "777.2", "-11.045", "-3.300", "5.881", "7.745", "3107.6", "8.757", "-11.608",
          "-7.331", "4.277", "1477.2"}},
        {1000,
         {"2916.0", "856.7", "-12.174", "-3.637", "6.483", "8.537", "3202.8", "9.786", "-12.843",
          "-8.257", "4.586", "1456.7"}},
        {1100,
         {"2963.8", "935.4", "-13.292", "-3.971", "7.078", "9.321", "3303.7", "10.811", "-14.073",
          "-9.180", "4.893", "1435.4"}},
        {1200,
         {"3012.8", "1013.3", "-14.399", "-4.302", "7.668", "10.097", "3410.8", "11.833", "-15.299",
          "-10.100", "5.200", "1413.3"}},
        {1300,
         {"3062.8", "1090.3", "-15.494", "-4.629", "8.251", "10.865", "3524.7", "12.851", "-16.522",
          "-11.016", "5.505", "1390.3"}},
        {1400,
         {"3113.9", "1166.5", "-16.577", "-4.952", "8.827", "11.624", "3646.0", "13.867", "-17.740",
          "-11.930", "5.810", "1366.5"}},
    };
    static const struct {
        const char *name;
        double unit;
    } numbers[12] = {{"elastic density", 1.0},     {"elastic velocity", 1.0},
                     {"elastic stress", 1e9},      {"elastic lateral stress", 1e9},
                     {"elastic pressure", 1e9},    {"elastic Mises stress", 1e9},
                     {"failed density", 1.0},      {"failed pressure", 1e9},
                     {"failed stress", 1e9},       {"failed lateral stress", 1e9},
                     {"failed Mises stress", 1e9}, {"failure wave speed", 1.0}};
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        const struct exact_failure_wave problem = glass(rows[r].impact);
        struct solution solution = solve(&exact_failure_wave_class, &problem, 1e-6);
        for (int k = 0; k < 12; k++)
            assert_printed(numbers[k].name, number(&solution, numbers[k].name), numbers[k].unit,
                           rows[r].figure[k]);
        release(&solution);
    }
}

/* At a front of speed V: rho (u - V) and rho (u - V) u - sigma stay. */
static void jumps_conserve_mass_and_momentum(void **state)
{
    (void)state;
    const struct exact_failure_wave problem = glass(1000.0);
    struct solution solution = solve(&exact_failure_wave_class, &problem, 1e-6);
    const double places[] = {1e-3, 3e-3, 6e-3};
    const char *const fronts[] = {"failure wave speed", "elastic wave speed"};
    for (int k = 0; k < 2; k++) {
        const struct exact_class *class = solution.class;
        const struct exact_state a = class->sample(solution.solved, SIDE_LEFT, places[k], 1e-6),
                                 b = class->sample(solution.solved, SIDE_LEFT, places[k + 1], 1e-6);
        const double speed = number(&solution, fronts[k]);
        const double flow = a.density * (a.velocity - speed);
        assert_true(fabs(flow / (b.density * (b.velocity - speed)) - 1.0) < 1e-9);
        assert_true(fabs((flow * (a.velocity - b.velocity) - (a.stress - b.stress)) / a.stress) <
                    1e-9);
    }
    release(&solution);
}

static void a_speed_without_a_failure_wave_is_refused(void **state)
{
    (void)state;
    const struct exact_failure_wave problem = glass(20000.0);
    assert_refused(&exact_failure_wave_class, &problem);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(states_have_the_figures),
        cmocka_unit_test(jumps_conserve_mass_and_momentum),
        cmocka_unit_test(a_speed_without_a_failure_wave_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
