/* Blast waves: the curves of Kingery and Bulmash beside their table, the Friedlander curve, the
 * point explosion beside Sedov's blast and the jump conditions, and what a gauge records. */
#include "exact_solution.h"

#include "exact/kingery_bulmash.h"
#include "exact/kingery_curves.h"
#include "exact/point_explosion.h"
#include "exact/radial.h"
#include "exact/sedov.h"
#include "measure/blast_record.h"

/* Z; incident and reflected overpressure, kPa, and impulse, kPa ms/kg^(1/3), arrival and duration,
 * ms/kg^(1/3), speed of the front, m/ms. */
static const struct {
    enum kingery_charge charge;
    double z, value[7];
} table[] = {
    {KINGERY_FREE_AIR, 0.1, {30827, 3.6699e+05, 775.38, 21839, 0.015666, NAN, 5.2922}},
    {KINGERY_FREE_AIR, 0.2, {15298, 1.5739e+05, 225.79, 6176.3, 0.038459, 0.18951, 3.7502}},
    {KINGERY_FREE_AIR, 0.3, {8996, 83303, 150.87, 3164.8, 0.068549, 0.18485, 2.9002}},
    {KINGERY_FREE_AIR, 0.5, {3884.8, 30353, 141.29, 1454.1, 0.15408, 0.31965, 1.9525}},
    {KINGERY_FREE_AIR, 0.8, {1521.4, 9383.4, 195.59, 751.98, 0.35212, 1.3459, 1.2603}},
    {KINGERY_FREE_AIR, 1, {934.86, 5005.5, 174.54, 559.03, 0.53184, 1.7949, 1.0113}},
    {KINGERY_FREE_AIR, 1.5, {373.07, 1505.8, 120.38, 334.1, 1.1393, 1.6767, 0.69233}},
    {KINGERY_FREE_AIR, 2, {194.67, 645.83, 92.122, 235.75, 1.944, 1.8459, 0.55341}},
    {KINGERY_FREE_AIR, 3, {81.589, 215.51, 64.331, 147.08, 3.9874, 2.6845, 0.44222}},
    {KINGERY_FREE_AIR, 4, {46.544, 110.08, 49.794, 106.47, 6.395, 3.0649, 0.40147}},
    {KINGERY_FREE_AIR, 5, {31.296, 70.048, 40.619, 83.317, 8.9953, 3.3334, 0.38262}},
    {KINGERY_FREE_AIR, 7, {18.316, 39.263, 29.661, 57.965, 14.431, 3.7487, 0.36583}},
    {KINGERY_FREE_AIR, 10, {11.091, 23.345, 21.131, 39.715, 22.722, 4.1995, 0.35575}},
    {KINGERY_FREE_AIR, 15, {6.52, 13.472, 14.278, 25.943, 36.663, 4.7334, 0.3495}},
    {KINGERY_FREE_AIR, 20, {4.4512, 9.0633, 10.752, 19.179, 50.968, 5.1425, 0.34683}},
    {KINGERY_FREE_AIR, 30, {2.5335, 5.1454, 7.162, 12.485, 80.62, 5.7307, 0.34363}},
    {KINGERY_FREE_AIR, 39.9, {1.7257, 3.5145, 5.3186, 9.1869, 109.21, 6.1604, 0.34311}},
    {KINGERY_SURFACE, 0.1, {38468, 4.6448e+05, 1404.6, 38509, 0.015612, NAN, 5.8642}},
    {KINGERY_SURFACE, 0.2, {17305, 1.8612e+05, 369.11, 10520, 0.037008, 0.24328, 4.0019}},
    {KINGERY_SURFACE, 0.3, {10196, 96958, 215.54, 5285, 0.065759, 0.22261, 3.0814}},
    {KINGERY_SURFACE, 0.5, {4874.6, 39493, 166.11, 2370.8, 0.14328, 0.28128, 2.1727}},
    {KINGERY_SURFACE, 0.8, {2135.3, 14420, 201.27, 1201.1, 0.31425, 0.81459, 1.4778}},
    {KINGERY_SURFACE, 1, {1356.7, 8144.9, 236.16, 884.77, 0.46751, 1.737, 1.1964}},
    {KINGERY_SURFACE, 1.5, {550.77, 2529, 176.89, 520.7, 0.98961, 2.1587, 0.8054}},
    {KINGERY_SURFACE, 2, {283.76, 1056.4, 134.3, 363.84, 1.6959, 2.0495, 0.62604}},
    {KINGERY_SURFACE, 3, {115.67, 330.71, 92.64, 224.29, 3.5442, 2.8305, 0.47927}},
    {KINGERY_SURFACE, 4, {64.907, 162.2, 72.049, 161.21, 5.7829, 3.4244, 0.42397}},
    {KINGERY_SURFACE, 5, {43.184, 100.68, 59.188, 125.57, 8.2449, 3.7855, 0.39766}},
    {KINGERY_SURFACE, 7, {24.872, 54.681, 43.516, 86.892, 13.484, 4.2641, 0.37408}},
    {KINGERY_SURFACE, 10, {14.807, 31.544, 30.977, 59.327, 21.635, 4.7876, 0.36086}},
    {KINGERY_SURFACE, 15, {8.6964, 18.021, 20.93, 38.72, 35.574, 5.4491, 0.35267}},
    {KINGERY_SURFACE, 20, {6.0685, 12.407, 15.847, 28.669, 49.876, 5.9351, 0.34875}},
    {KINGERY_SURFACE, 30, {3.5594, 7.2366, 10.616, 18.763, 78.902, 6.6074, 0.34527}},
    {KINGERY_SURFACE, 39.9, {2.3712, 4.7855, 7.9303, 13.892, 107.27, 7.1419, 0.34342}},
};

static void curves_are_those_of_the_table(void **state)
{
    (void)state;
    static const enum kingery_quantity order[7] = {
        KINGERY_PRESSURE, KINGERY_REFLECTED_PRESSURE, KINGERY_IMPULSE, KINGERY_REFLECTED_IMPULSE,
        KINGERY_ARRIVAL,  KINGERY_DURATION,           KINGERY_SPEED};
    for (size_t i = 0; i < COUNT_OF(table); i++)
        for (int k = 0; k < 7; k++) {
            const double value = kingery_curve(table[i].charge, order[k], table[i].z);
            if (isnan(table[i].value[k]))
                assert_true(isnan(value));
            else
                assert_near(value, table[i].value[k], table[i].value[k], 1e-4);
        }
}

/* From Z = 0.05 to 40 by steps of a hundredth: pressures fall, waves arrive later, a wall gets more
 * than passes, and pieces of a curve meet within 2 %. */
static void curves_are_sane_over_their_range(void **state)
{
    (void)state;
    for (int charge = 0; charge < 2; charge++) {
        struct blast_wave before = {NAN, NAN, NAN, NAN}, wall_before = before;
        int inside = 0;
        for (double z = 0.05; z < 40.0; z *= 1.01) {
            const struct blast_wave wave = kingery_wave((enum kingery_charge)charge, 1.0, z, false),
                                    wall = kingery_wave((enum kingery_charge)charge, 1.0, z, true);
            if (z < kingery_nearest((enum kingery_charge)charge)) {
                assert_true(isnan(wave.overpressure));
                continue;
            }
            inside++;
            assert_true(wave.overpressure > 0.0 && wave.impulse > 0.0 && wave.arrival > 0.0);
            assert_true(wall.overpressure > 1.9 * wave.overpressure);
            assert_true(wall.impulse > wave.impulse);
            assert_true(isnan(wave.duration) || wave.duration > 0.0);
            if (inside == 1)
                assert_true(isnan(before.arrival));
            else {
                assert_true(wave.overpressure < before.overpressure);
                assert_true(wall.overpressure < wall_before.overpressure);
                assert_true(wall.impulse < wall_before.impulse);
                assert_true(wave.arrival > before.arrival);
                assert_true(fabs(wave.impulse / before.impulse - 1.0) < 0.05);
            }
            before = wave;
            wall_before = wall;
        }
        assert_true(inside > 600);
    }
    static const double joints[] = {0.792, 0.888, 2.28};
    for (size_t k = 0; k < COUNT_OF(joints); k++) {
        const struct blast_wave low =
            kingery_wave(KINGERY_FREE_AIR, 1.0, joints[k] * (1 - 1e-9), false);
        const struct blast_wave high =
            kingery_wave(KINGERY_FREE_AIR, 1.0, joints[k] * (1 + 1e-9), false);
        assert_near(low.impulse, high.impulse, low.impulse, 0.02);
        assert_near(low.duration, high.duration, low.duration, 0.02);
    }
}

static void the_wave_scales_with_the_cube_root_of_the_mass(void **state)
{
    (void)state;
    const struct blast_wave one = kingery_wave(KINGERY_SURFACE, 1.0, 2.0, true),
                            big = kingery_wave(KINGERY_SURFACE, 1000.0, 20.0, true);
    assert_near(big.overpressure, one.overpressure, one.overpressure, 1e-12);
    assert_near(big.arrival, 10.0 * one.arrival, big.arrival, 1e-12);
    assert_near(big.duration, 10.0 * one.duration, big.duration, 1e-12);
    assert_near(big.impulse, 10.0 * one.impulse, big.impulse, 1e-12);
}

struct history {
    const struct blast_wave *wave;
};

static double pressure_at(const void *context, double time)
{
    return blast_wave_at(((const struct history *)context)->wave, time);
}

/* Over the positive phase, which begins with the peak and ends at zero. */
static void the_friedlander_curve_has_the_impulse(void **state)
{
    (void)state;
    for (int charge = 0; charge < 2; charge++)
        for (double z = 0.06; z < 39.0; z *= 1.3) {
            const struct blast_wave wave = kingery_wave((enum kingery_charge)charge, 2.0, z, z > 1);
            if (isnan(wave.overpressure))
                continue;
            const struct history history = {&wave};
            const double span = isnan(wave.duration) ? 40.0 * wave.impulse / wave.overpressure
                                                     : wave.duration,
                         impulse = radial_integral(pressure_at, &history, wave.arrival,
                                                   wave.arrival + span, 400);
            assert_near(impulse, wave.impulse, wave.impulse, 1e-6);
            assert_near(blast_wave_at(&wave, wave.arrival), wave.overpressure, wave.overpressure,
                        1e-12);
            assert_true(blast_wave_at(&wave, 0.99 * wave.arrival) == 0.0);
            if (!isnan(wave.duration))
                assert_true(blast_wave_at(&wave, wave.arrival + 1.001 * wave.duration) == 0.0);
        }
    for (double b = 0.01; b < 1e3; b *= 1.7) {
        const double fraction = 1.0 / b + expm1(-b) / (b * b);
        assert_near(blast_wave_decay(fraction), b, b, 1e-6);
    }
}

/* Face-on it is the reflected wave, edge-on the incident one, and in between of either a part. */
static void a_load_goes_with_the_angle(void **state)
{
    (void)state;
    const struct blast_wave passing = kingery_wave(KINGERY_FREE_AIR, 8.0, 4.0, false),
                            wall = kingery_wave(KINGERY_FREE_AIR, 8.0, 4.0, true);
    for (double part = 0.0; part < 1.2; part += 0.1) {
        const double time = passing.arrival + part * passing.duration + 1e-9;
        const double incident = blast_wave_at(&passing, time),
                     reflected = blast_wave_at(&wall, time);
        assert_near(kingery_load(KINGERY_FREE_AIR, 8.0, 4.0, 1.0, time), reflected,
                    wall.overpressure, 1e-12);
        assert_near(kingery_load(KINGERY_FREE_AIR, 8.0, 4.0, 1e-9, time), incident,
                    passing.overpressure, 1e-8);
        assert_near(kingery_load(KINGERY_FREE_AIR, 8.0, 4.0, 0.5, time),
                    0.25 * incident + 0.25 * reflected, wall.overpressure, 1e-12);
        assert_true(kingery_load(KINGERY_FREE_AIR, 8.0, 4.0, -0.5, time) == 0.0);
    }
    assert_true(kingery_load(KINGERY_FREE_AIR, 8.0, 4.0, 1.0, 0.999 * passing.arrival) == 0.0);
}

static struct exact_kingery_bulmash charge_of(double mass)
{
    return (struct exact_kingery_bulmash){.mass = mass, .ambient = 101325.0, .distance = NAN};
}

static void the_front_arrives_when_it_is_there(void **state)
{
    (void)state;
    const struct exact_kingery_bulmash charge = charge_of(5.0);
    struct solution s = solve(&exact_kingery_bulmash_class, &charge, 0.0);
    for (double r = 0.2; r < 60.0; r *= 1.5) {
        const struct blast_wave wave = s.class->blast(s.solved, r);
        assert_near(s.class->front(s.solved, wave.arrival), r, r, 1e-9);
        const struct exact_state peak =
            s.class->sample(s.solved, SIDE_LEFT, -r, wave.arrival * (1.0 + 1e-12));
        assert_near(peak.pressure, charge.ambient + wave.overpressure, peak.pressure, 1e-8);
    }
    assert_true(isnan(s.class->front(s.solved, 1e-7)));
    assert_true(isnan(s.class->front(s.solved, 10.0)));
    release(&s);
    struct exact_kingery_bulmash far = charge_of(5.0);
    far.distance = 1000.0;
    assert_refused(&exact_kingery_bulmash_class, &far);
}

static struct exact_point_explosion explosion(int geometry)
{
    static const struct dimension energy_of[] = {{.mass = 1, .time = -2},
                                                 {.length = 1, .mass = 1, .time = -2},
                                                 {.length = 2, .mass = 1, .time = -2}};
    return (struct exact_point_explosion){.geometry = geometry,
                                          .energy = {3e5, energy_of[geometry]},
                                          .density = 1.2,
                                          .pressure = 1e5};
}

/* Sedov's blast with the same energy, whose front the explosion follows at first. */
static void an_explosion_begins_as_a_strong_blast(void **state)
{
    (void)state;
    for (int geometry = 0; geometry < RADIAL_GEOMETRIES; geometry++) {
        const struct exact_point_explosion problem = explosion(geometry);
        const struct exact_sedov strong = {geometry, problem.energy, problem.density, 1.4, 0.0};
        struct solution e = solve(&exact_point_explosion_class, &problem, 0.0),
                        s = solve(&exact_sedov_class, &strong, 0.0);
        for (double time = 1e-14; time < 2e-9; time *= 10.0) {
            const double r = e.class->front(e.solved, time);
            assert_near(r, s.class->front(s.solved, time), r, 3e-4);
            assert_near(e.class->blast(e.solved, r).arrival, time, time, 1e-9);
        }
        release(&e);
        release(&s);
    }
}

/* The speed of the front by differences is that of a shock of the overpressure. */
static void the_front_moves_as_its_jump_says(void **state)
{
    (void)state;
    for (int geometry = 0; geometry < RADIAL_GEOMETRIES; geometry++) {
        const struct exact_point_explosion problem = explosion(geometry);
        struct solution e = solve(&exact_point_explosion_class, &problem, 0.0);
        const double sound = sqrt(1.4 * 1e5 / 1.2);
        for (double time = 1e-7; time < 1.0; time *= 1.7) {
            const double r = e.class->front(e.solved, time), dt = 1e-4 * time;
            const double over = e.class->blast(e.solved, r).overpressure / problem.pressure;
            const double speed =
                (e.class->front(e.solved, time + dt) - e.class->front(e.solved, time - dt)) /
                (2.0 * dt);
            assert_near(speed, sound * sqrt(1.0 + 6.0 / 7.0 * over), speed, 2e-4);
        }
        const struct exact_state ahead = e.class->sample(e.solved, SIDE_LEFT, 1e3, 1e-3);
        assert_near(ahead.pressure, 1e5, 1e5, 1e-15);
        release(&e);
    }
    struct exact_point_explosion wrong = explosion(RADIAL_BALL);
    wrong.energy.dimension.length = 1;
    assert_refused(&exact_point_explosion_class, &wrong);
}

/* A Friedlander wave that a grid has smeared over four rows. */
static void a_record_has_peak_arrival_duration_and_impulse(void **state)
{
    (void)state;
    enum { ROWS = 4000 };
    const struct blast_wave wave = {1e-3, 2e5, 2e-3, 100.0};
    static double time[ROWS], pressure[ROWS];
    for (int i = 0; i < ROWS; i++) {
        time[i] = 1e-6 * i;
        const double since = time[i] - wave.arrival;
        pressure[i] = 1e5 + blast_wave_at(&wave, time[i] + 2e-6) *
                                (since < 2e-6 ? maximum(0.0, 0.5 + since / 4e-6) : 1.0);
    }
    struct blast_wave seen = blast_record(time, pressure, ROWS, NAN);
    assert_near(seen.overpressure, wave.overpressure, wave.overpressure, 0.02);
    assert_near(seen.arrival, wave.arrival, 1e-6, 2.0);
    assert_near(seen.duration, wave.duration, wave.duration, 2e-3);
    assert_near(seen.impulse, wave.impulse, wave.impulse, 0.01);
    /* a record that ends in the positive phase */
    seen = blast_record(time, pressure, 2500, NAN);
    assert_near(seen.arrival, wave.arrival, 1e-6, 2.0);
    assert_true(isnan(seen.duration) && isnan(seen.impulse));
    /* no wave */
    seen = blast_record(time, pressure, 900, NAN);
    assert_true(seen.overpressure == 0.0 && isnan(seen.arrival));
    assert_true(isnan(blast_record(time, pressure, 0, NAN).overpressure));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(curves_are_those_of_the_table),
        cmocka_unit_test(curves_are_sane_over_their_range),
        cmocka_unit_test(the_wave_scales_with_the_cube_root_of_the_mass),
        cmocka_unit_test(the_friedlander_curve_has_the_impulse),
        cmocka_unit_test(a_load_goes_with_the_angle),
        cmocka_unit_test(the_front_arrives_when_it_is_there),
        cmocka_unit_test(an_explosion_begins_as_a_strong_blast),
        cmocka_unit_test(the_front_moves_as_its_jump_says),
        cmocka_unit_test(a_record_has_peak_arrival_duration_and_impulse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
