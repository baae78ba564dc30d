/* JH-2, one element in uniaxial strain against figures of a program of its own
 * (tests/data/jh2-figures.txt), by each order of its step, and its tension; GPa. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dice.h"
#include "material/material.h"
#include "material/whole.h"
#include "source_folder.h"

struct set {
    const char *name;
    double density, g, a, b, c, m, n, tension, most, hel, hel_pressure, d1, d2, k1, k2, k3;
};

static const struct set sets[] = {
    {"B4C", 2510, 197, .927, .7, .005, .85, .67, .26, .2, 19.0, 8.71, .001, .5, 233, -593, 2800},
    {"glass-H95", 2530, 30.4, .93, .2, .003, 1, .77, .15, .5, 5.95, 2.92, .043, .85, 45.4, -138,
     290},
    {"glass-C03", 2530, 30.4, .93, .088, .003, .35, .77, .15, .5, 5.95, 2.92, .053, .85, 45.4, -138,
     290},
    {"JH94-A", 3700, 90.16, .93, 0, 0, .6, .6, .2, INFINITY, 2.79, 1.46, 0, 1, 130.95, 0, 0},
    {"JH94-B", 3700, 90.16, .93, .31, 0, .6, .6, .2, INFINITY, 2.79, 1.46, 0, 1, 130.95, 0, 0},
    {"JH94-C", 3700, 90.16, .93, .31, 0, .6, .6, .2, INFINITY, 2.79, 1.46, .005, 1, 130.95, 0, 0},
    {"AD995-A95", 3890, 152, .88, .45, .007, .6, .64, .462, 1, 6.57, 3.55, .0125, .7, 231, -160,
     2774},
    {"SiC-C03", 3163, 183, .96, .35, 0, 1, .65, .37, .8, 14.567, 5.9, .48, .48, 204.785, 0, 0},
    {"AlN-C03", 3226, 127, .85, .31, .013, .21, .29, .32, INFINITY, 9, 5, .02, 1.85, 201, 260, 0}};
static const char *const orders[] = {"substep", "consistent", "appendix", "openradioss"};

static struct material material_of(const char *name, const char *order, bool tension_limit)
{
    const struct set *set = sets;
    struct material material = {.eos = {.kind = EOS_polynomial}};
    for (size_t k = 0; k < COUNT_OF(sets); k++)
        if (!strcmp(sets[k].name, name))
            set = &sets[k];
    assert_string_equal(set->name, name);
    material.eos.of.polynomial =
        (struct eos_polynomial){set->density, set->k1 * 1e9, set->k2 * 1e9, set->k3 * 1e9};
    material.strength.kind = STRENGTH_johnson_holmquist;
    struct strength_johnson_holmquist *solid = &material.strength.of.johnson_holmquist;
    *solid = (struct strength_johnson_holmquist){.shear_modulus = set->g * 1e9,
                                                 .a = set->a,
                                                 .n = set->n,
                                                 .b = set->b,
                                                 .m = set->m,
                                                 .c = set->c,
                                                 .rate = 1.0,
                                                 .most = set->most,
                                                 .tension = set->tension * 1e9,
                                                 .hel = set->hel * 1e9,
                                                 .hel_pressure = set->hel_pressure * 1e9,
                                                 .d1 = set->d1,
                                                 .d2 = set->d2,
                                                 .bulking = 1.0,
                                                 .tension_limit = tension_limit};
    for (int k = 0; k < 4; k++)
        if (!strcmp(orders[k], order))
            solid->order = k;
    material_complete(&material);
    return material;
}

/* Takes POINT from one engineering strain to another in STEPS; RATE: 0, or that of the equivalent
 * strain, 1/s. */
static void strain(const struct material *material, double from, double to, int steps, double rate,
                   struct point *point)
{
    for (int k = 1; k <= steps; k++) {
        const double before = from + (to - from) * (k - 1) / steps,
                     after = from + (to - from) * k / steps;
        const double stretch = log((1.0 - after) / (1.0 - before));
        struct motion motion = {.density = material_density(material) / (1.0 - after)};
        motion.dt = rate > 0.0 ? 2.0 / 3.0 * fabs(stretch) / rate : 1.0;
        motion.strain_rate.xx = stretch / motion.dt;
        material_step(material, point, &motion);
    }
}

enum { FIGURES = 6 };
struct row {
    double strain, figure[FIGURES]; /* P, q, sx, D, Dp, eps_p */
};

static void figures_of(const struct point *point, double figure[FIGURES])
{
    figure[0] = point->pressure * 1e-9;
    figure[1] = sym3_mises(point->deviator) * 1e-9;
    figure[2] = (point->pressure - point->deviator.xx) * 1e-9;
    figure[3] = point->history[HISTORY_damage];
    figure[4] = point->history[HISTORY_bulking] * 1e-9;
    figure[5] = point->history[HISTORY_plastic_strain];
}

/* The largest deviation of a path in STEPS a row, relative to a figure; figures below NEAR of the
 * largest of their column by that. */
static double worst_of(const struct material *material, const struct row *rows, int count,
                       int steps, double rate, double near)
{
    struct point point = {.density = material_density(material)};
    double worst = 0.0, largest[FIGURES] = {0.0}, at = 0.0;
    for (int k = 0; k < count; k++)
        for (int c = 0; c < FIGURES; c++)
            largest[c] = fmax(largest[c], fabs(rows[k].figure[c]));
    for (int k = 0; k < count; at = rows[k++].strain) {
        double figure[FIGURES];
        strain(material, at, rows[k].strain, steps, rate, &point);
        figures_of(&point, figure);
        for (int c = 0; c < FIGURES; c++) {
            const double want = rows[k].figure[c];
            const double scale = fabs(want) > near * largest[c] ? fabs(want) : largest[c];
            const double off = scale > 0.0 ? fabs(figure[c] - want) / scale : fabs(figure[c]);
            if (off > worst && getenv("JH2"))
                printf("  strain %g column %d: %g for %g\n", rows[k].strain, c, figure[c], want);
            worst = fmax(worst, off);
        }
    }
    return worst;
}

enum { ROWS = 64 };

/* Reads the next path of FILE; false at its end. */
static bool read_path(FILE *file, char name[32], char order[32], int *steps, double *rate,
                      struct row *rows, int *count)
{
    char line[256];
    bool begun = false;
    long back = ftell(file);
    for (*count = 0; fgets(line, sizeof line, file); back = ftell(file)) {
        if (line[0] == '#')
            continue;
        if (line[0] != ' ' && begun) {
            fseek(file, back, SEEK_SET);
            return true;
        }
        if (line[0] != ' ') {
            begun = sscanf(line, "%31s %31s %d %lf", name, order, steps, rate) == 4;
            assert_true(begun);
            continue;
        }
        struct row *row = &rows[(*count)++];
        double *f = row->figure, mu;
        assert_true(*count <= ROWS && sscanf(line, "%lf %lf %lf %lf %lf %lf %lf %lf", &row->strain,
                                             &mu, f, f + 1, f + 2, f + 3, f + 4, f + 5) == 8);
    }
    return begun;
}

static void an_element_follows_the_figures(void **state)
{
    (void)state;
    char path[4096], name[32], order[32];
    snprintf(path, sizeof path, "%s/tests/data/jh2-figures.txt", source_folder);
    FILE *file = fopen(path, "r");
    struct row rows[ROWS];
    int steps, count, paths = 0;
    double rate;
    assert_non_null(file);
    for (; read_path(file, name, order, &steps, &rate, rows, &count); paths++) {
        const struct material material = material_of(name, order, false);
        const double fine = worst_of(&material, rows, count, steps, rate, 0.1);
        const double coarse =
            worst_of(&material, rows, count, (100 + count - 1) / count, rate, 1.0);
        printf("%s %s rate %g: %.3g %%, 100 steps %.3g %%\n", name, order, rate, 100.0 * fine,
               100.0 * coarse);
        if (!strcmp(order, "substep"))
            assert_true(fine < 0.005 && coarse < 0.01);
        else
            assert_true(fine < 0.005);
    }
    fclose(file);
    assert_int_equal(paths, 20);
}

static void tension_peaks_where_it_is_limited(void **state)
{
    (void)state;
    const struct {
        const char *name;
        double stress;
    } peaks[] = {{"JH94-C", 0.3036}, {"glass-H95", 0.2114}, {"B4C", 0.4706}, {"AlN-C03", 1.0264}};
    for (size_t k = 0; k < COUNT_OF(peaks); k++) {
        const struct material material = material_of(peaks[k].name, "substep", true);
        struct point point = {.density = material_density(&material)};
        double peak = 0.0;
        for (int i = 0; i < 20000; i++) {
            strain(&material, -1e-6 * i, -1e-6 * (i + 1), 1, 0.0, &point);
            peak = fmax(peak, point.deviator.xx - point.pressure);
        }
        printf("%s: %.4f GPa\n", peaks[k].name, peak * 1e-9);
        assert_close(peak * 1e-9, peaks[k].stress, 0.02);
        assert_true(point.history[HISTORY_damage] == 1.0 && point.pressure >= 0.0);
        assert_true(point.history[HISTORY_void_ratio] > 0.0);
    }
}

/* What is failed and drawn apart, and closed again, has the pressure of its bulking at the density
 * of rest. */
static void voids_close_again(void **state)
{
    (void)state;
    const struct material material = material_of("glass-H95", "substep", true);
    struct point point = {.density = material_density(&material)};
    strain(&material, 0.0, 0.15, 1000, 0.0, &point);
    const double bulking = point.history[HISTORY_bulking];
    assert_close(bulking, 1.46e9, 0.005);
    strain(&material, 0.15, -0.3, 1000, 0.0, &point);
    assert_near(point.pressure, 0.0, 1e-3);
    assert_true(point.history[HISTORY_void_ratio] > 0.2);
    assert_near(sym3_mises(point.deviator), 0.0, 1e3);
    strain(&material, -0.3, 0.0, 1000, 0.0, &point);
    assert_true(point.history[HISTORY_void_ratio] == 0.0);
    assert_close(point.pressure, bulking, 1e-9);
}

static void elastic_limits_are_computed(void **state)
{
    (void)state;
    const struct {
        const char *name;
        double slow, fast;
    } limits[] = {{"B4C", 15.798, 18.222},     {"glass-H95", 5.108, 5.542},
                  {"JH94-C", 2.8066, 2.8066},  {"AD995-A95", 5.546, 6.618},
                  {"SiC-C03", 23.651, 23.651}, {"AlN-C03", 7.266, 8.856}};
    for (size_t k = 0; k < COUNT_OF(limits); k++) {
        const struct material material = material_of(limits[k].name, "substep", true);
        assert_close(material_elastic_limit(&material, 1.0) * 1e-9, limits[k].slow, 1e-4);
        assert_close(material_elastic_limit(&material, 1e5) * 1e-9, limits[k].fast, 1e-4);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_element_follows_the_figures),
        cmocka_unit_test(tension_peaks_where_it_is_limited),
        cmocka_unit_test(voids_close_again),
        cmocka_unit_test(elastic_limits_are_computed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
