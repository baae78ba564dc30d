/* Bands of points along a line, against the same found one point after another. */
#include "dice.h"

#include <stdlib.h>
#include <string.h>

#include "measure/bands.h"

enum { POINTS = 2000 };

static const struct ranks alone = {0, 1, false};

static int compare(const void *first, const void *second)
{
    const struct band *a = first, *b = second;
    return (a->at > b->at) - (a->at < b->at);
}

/* SPREAD of the points over a line; noise far less than the width of the bands, or far more. */
static void assert_bands_of(double spread, double width)
{
    struct dice dice = {17};
    struct band point[POINTS], sorted[POINTS];
    for (int i = 0; i < POINTS; i++)
        point[i] = (struct band){dice_below(&dice, 300) + dice_between(&dice, 0.0, spread),
                                 dice_between(&dice, -1.0, 1.0), dice_between(&dice, 1.0, 2.0)};
    memcpy(sorted, point, sizeof sorted);
    qsort(sorted, POINTS, sizeof *sorted, compare);
    struct bands bands;
    assert_success(bands_make(&alone, point, POINTS, width, &bands));
    int64_t found = 0;
    for (int i = 0; i < POINTS; found++) {
        double at = sorted[i].at, first = 0.0, second = 0.0;
        int begin = i;
        for (; i < POINTS && sorted[i].at - at < width; i++) {
            first += sorted[i].first;
            second += sorted[i].second;
        }
        assert_true(found < bands.count);
        assert_true(bands.band[found].at == at);
        assert_near(bands.band[found].first, first / (i - begin), 1e-14);
        assert_near(bands.band[found].second, second / (i - begin), 1e-14);
    }
    assert_int_equal(found, bands.count);
    bands_free(&bands);
}

static void rows_of_a_lattice_are_bands(void **state)
{
    (void)state;
    assert_bands_of(0.0, 1e-3);
    assert_bands_of(1e-4, 1e-3);
}

static void points_anywhere_are_in_bands_that_begin_with_the_lowest(void **state)
{
    (void)state;
    assert_bands_of(1.0, 1e-3);
    assert_bands_of(1.0, 7.5);
    assert_bands_of(1.0, 1e6);
}

static void lost_points_are_in_no_band(void **state)
{
    (void)state;
    struct band point[] = {{NAN, 1.0, 1.0}, {2.0, 3.0, 4.0}, {INFINITY, 1.0, 1.0}};
    struct bands bands;
    assert_success(bands_make(&alone, point, 3, 1.0, &bands));
    assert_int_equal(bands.count, 1);
    assert_true(bands.band[0].first == 3.0 && bands.band[0].second == 4.0);
    bands_free(&bands);
    assert_success(bands_make(&alone, point, 0, 1.0, &bands));
    assert_int_equal(bands.count, 0);
    bands_free(&bands);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_of_a_lattice_are_bands),
        cmocka_unit_test(points_anywhere_are_in_bands_that_begin_with_the_lowest),
        cmocka_unit_test(lost_points_are_in_no_band),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
