/* Random packings of grains: how much they fill, that none overlap, and that they depend on the
 * seed alone. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "sample.h"
#include "shape/grains.h"

static const struct shape_packing discs = {.from = VECTOR(-1.0, 2.0),
                                           .to = VECTOR(1.0, 3.0),
                                           .fraction = 0.75,
                                           .radius = 0.03,
                                           .largest = NAN,
                                           .gap = 0.0,
                                           .seed = 1};

static const struct shape_packing spheres = {.from = VECTOR(0.0, 0.0, 0.0),
                                             .to = VECTOR(1.0, 1.0, 2.0),
                                             .fraction = 0.55,
                                             .radius = 0.08,
                                             .largest = NAN,
                                             .gap = 0.0,
                                             .seed = 1};

static void prepare(struct shape_packing *packing)
{
    const struct one_of shape = shape_of("packing", packing);
    const char *text = shape_wrong(&shape, packing->from.count);
    if (text)
        fail_msg("%s", text);
    assert_non_null(packing->grains);
}

/* The distance of two grains, of the nearest images where the box is periodic. */
static double distance_of(const struct grains *grains, int64_t a, int64_t b)
{
    double sum = 0.0;
    for (int axis = 0; axis < grains->wanted.dimension; axis++) {
        double apart = fabs(grains->center[a][axis] - grains->center[b][axis]);
        if (grains->wanted.periodic[axis])
            apart = minimum(apart, grains->extent[axis] - apart);
        sum += square(apart);
    }
    return sqrt(sum);
}

/* Two at a time, all. */
static void assert_apart(const struct grains *grains)
{
    for (int64_t a = 0; a < grains->count; a++)
        for (int64_t b = 0; b < a; b++)
            if (distance_of(grains, a, b) <
                grains->radius[a] + grains->radius[b] + grains->wanted.gap * (1.0 - 1e-12))
                fail_msg("grains %d and %d overlap", (int)a, (int)b);
}

static double exact_fraction(const struct grains *grains)
{
    double sum = 0.0, volume = 1.0;
    for (int64_t grain = 0; grain < grains->count; grain++) {
        const double r = grains->radius[grain];
        sum += grains->wanted.dimension == 2 ? M_PI * r * r : 4.0 / 3.0 * M_PI * r * r * r;
    }
    for (int axis = 0; axis < grains->wanted.dimension; axis++)
        volume *= grains->extent[axis];
    return sum / volume;
}

/* Whole numbers of grains of every fraction, seed and distribution: exact, and found again on a
 * lattice of points. */
static void check_packing(struct shape_packing packing, int points)
{
    prepare(&packing);
    assert_apart(packing.grains);
    assert_near(exact_fraction(packing.grains), packing.fraction, 1e-12);
    const struct one_of shape = shape_of("packing", &packing);
    double volume = packing.fraction;
    for (int axis = 0; axis < packing.from.count; axis++)
        volume *= packing.to.at[axis] - packing.from.at[axis];
    assert_near(sampled_volume(&shape, packing.from.count, points), volume, 5e-3);
    free(packing.grains);
}

static void dense_discs_fill_their_fraction(void **state)
{
    (void)state;
    for (int seed = 1; seed <= 3; seed++) {
        struct shape_packing packing = discs;
        packing.seed = seed;
        check_packing(packing, 400);
        packing.largest = 0.06;
        check_packing(packing, 400);
        packing.fraction = 0.3;
        packing.gap = 0.01;
        check_packing(packing, 400);
    }
}

static void dense_spheres_fill_their_fraction(void **state)
{
    (void)state;
    for (int seed = 1; seed <= 2; seed++) {
        struct shape_packing packing = spheres;
        packing.seed = seed;
        check_packing(packing, 120);
        packing.radius = 0.05;
        packing.largest = 0.075;
        check_packing(packing, 120);
    }
}

static void grains_of_a_periodic_packing_continue_at_the_other_face(void **state)
{
    (void)state;
    struct shape_packing packing = discs;
    packing.periodic = (struct name_list){2, (char *[]){"x", "y"}};
    check_packing(packing, 400);
    prepare(&packing);
    const struct one_of shape = shape_of("packing", &packing);
    bool is_cut = false;
    for (int i = 0; i < 1000; i++) {
        const double y = 2.0 + (i + 0.5) / 1000.0;
        const bool low = shape_inside(&shape, vec3_make(-1.0, y, 0.0));
        is_cut = is_cut || low;
        assert_int_equal(low, shape_inside(&shape, vec3_make(nextafter(1.0, 0.0), y, 0.0)));
    }
    assert_true(is_cut);
    assert_false(shape_inside(&shape, vec3_make(1.0, 2.5, 0.0)));
    free(packing.grains);

    packing = spheres;
    packing.periodic = (struct name_list){1, (char *[]){"z"}};
    check_packing(packing, 120);
}

static void whole_grains_stay_half_a_gap_off_the_faces(void **state)
{
    (void)state;
    struct shape_packing packing = discs;
    packing.fraction = 0.6;
    packing.gap = 0.004;
    prepare(&packing);
    for (int64_t grain = 0; grain < packing.grains->count; grain++) {
        const double reach = packing.grains->radius[grain] + 0.5 * packing.gap - 1e-12;
        const double *at = packing.grains->center[grain];
        assert_true(at[0] - reach >= -1.0 && at[0] + reach <= 1.0);
        assert_true(at[1] - reach >= 2.0 && at[1] + reach <= 3.0);
    }
    free(packing.grains);
}

/* The same places to the bit from the same numbers, others from another seed. */
static void places_follow_from_the_seed_alone(void **state)
{
    (void)state;
    struct shape_packing first = discs, again = discs, other = discs;
    other.seed = 2;
    prepare(&first);
    prepare(&again);
    prepare(&other);
    const size_t bytes = (size_t)first.grains->count * sizeof *first.grains->center;
    assert_memory_equal(first.grains->center, again.grains->center, bytes);
    assert_memory_not_equal(first.grains->center, other.grains->center, bytes);
    free(first.grains);
    free(again.grains);
    free(other.grains);
}

/* Every radius lies between the two, each fourth of the range has its fourth of the grains. */
static void radii_are_evenly_distributed(void **state)
{
    (void)state;
    struct shape_packing packing = discs;
    packing.fraction = 0.5;
    packing.radius = 0.005;
    packing.largest = 0.01;
    prepare(&packing);
    int quarters[4] = {0};
    const double scale = packing.grains->reach / packing.largest;
    for (int64_t grain = 0; grain < packing.grains->count; grain++) {
        const double part = (packing.grains->radius[grain] / scale - packing.radius) /
                            (packing.largest - packing.radius);
        assert_true(part > 0.0 && part < 1.0);
        quarters[(int)(4.0 * part)]++;
    }
    for (int i = 0; i < 4; i++)
        assert_near(quarters[i], 0.25 * (double)packing.grains->count, 0.1);
    free(packing.grains);
}

static void packings_that_cannot_be_are_refused(void **state)
{
    (void)state;
    struct shape_packing packing = discs;
    packing.fraction = 0.95;
    assert_wrong("packing", &packing, 2, "was not reached");
    packing.fraction = 0.75;
    packing.gap = 0.02;
    assert_wrong("packing", &packing, 2, "was not reached");
    packing = discs;
    packing.radius = 0.4;
    assert_wrong("packing", &packing, 2, "two of its largest grains");
    packing = discs;
    packing.fraction = 1e-4;
    assert_wrong("packing", &packing, 2, "no whole number");
    packing.radius = 1e-6;
    packing.fraction = 0.5;
    assert_wrong("packing", &packing, 2, "50000 grains");
    packing = discs;
    packing.largest = 0.02;
    assert_wrong("packing", &packing, 2, "must not be below");
    packing = discs;
    assert_wrong("packing", &packing, 1, "two or three dimensions");
    assert_wrong("packing", &packing, 3, "as many numbers");
    packing.periodic = (struct name_list){1, (char *[]){"z"}};
    assert_wrong("packing", &packing, 2, "axes");
    packing = discs;
    packing.to.at[1] = 2.0;
    assert_wrong("packing", &packing, 2, "below that of `to`");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dense_discs_fill_their_fraction),
        cmocka_unit_test(dense_spheres_fill_their_fraction),
        cmocka_unit_test(grains_of_a_periodic_packing_continue_at_the_other_face),
        cmocka_unit_test(whole_grains_stay_half_a_gap_off_the_faces),
        cmocka_unit_test(places_follow_from_the_seed_alone),
        cmocka_unit_test(radii_are_evenly_distributed),
        cmocka_unit_test(packings_that_cannot_be_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
