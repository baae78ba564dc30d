/* The search for the neighbours of one point: against brute force, by each instruction set of this
 * processor. */
#include "dice.h"

#include <stdlib.h>

#include "base/isa.h"
#include "particle/row_kernel.h"

typedef int32_t row_find_isa(const struct candidates *, const struct row_point *, uint32_t *,
                             uint32_t *, uint32_t *);
ISA_DECLARE(row_find_isa, row_find);

enum { MOST = 700, ROOM = MOST + CANDIDATES_STEP };

/* Candidates in a box, their keys in no order; the first is the point itself. */
struct crowd {
    double x[ROOM], y[ROOM], z[ROOM], reach[ROOM];
    uint32_t key[ROOM], entry[ROOM];
    struct candidates candidates;
    struct row_point own;
};

static void fill(struct crowd *crowd, int32_t count, double size, struct dice *dice)
{
    for (int32_t k = 0; k < count; k++) {
        crowd->x[k] = dice_between(dice, -size, size);
        crowd->y[k] = dice_between(dice, -size, size);
        crowd->z[k] = dice_between(dice, -size, size);
        crowd->reach[k] = dice_between(dice, 0.2, 0.8);
        crowd->key[k] = (uint32_t)k * 2654435761u; /* odd: all differ, over the whole range */
        crowd->entry[k] = (uint32_t)k + 7;
    }
    crowd->candidates = (struct candidates){count,        crowd->x,   crowd->y,    crowd->z,
                                            crowd->reach, crowd->key, crowd->entry};
    crowd->own =
        (struct row_point){crowd->x[0], crowd->y[0], crowd->z[0], crowd->reach[0], crowd->key[0]};
}

/* By the key, one neighbour after the other. */
static int32_t find_slowly(const struct crowd *c, uint32_t *row)
{
    int32_t found = 0;
    for (int64_t last = -1;;) {
        int32_t next = -1;
        for (int32_t k = 1; k < c->candidates.count; k++) {
            double dx = c->x[k] - c->own.x, dy = c->y[k] - c->own.y, dz = c->z[k] - c->own.z;
            double range = c->own.reach + c->reach[k];
            if (dx * dx + dy * dy + dz * dz < range * range && (int64_t)c->key[k] > last &&
                (next < 0 || c->key[k] < c->key[next]))
                next = k;
        }
        if (next < 0)
            return found;
        row[found++] = c->entry[next];
        last = (int64_t)c->key[next];
    }
}

static void every_instruction_set_finds_the_row_of_brute_force(void **state)
{
    (void)state;
    row_find_isa *set[] = {ISA_LIST(row_find)};
    static const int32_t counts[] = {1, 2, 7, 8, 9, 16, 17, 100, 333, MOST};
    struct dice dice = {1};
    struct crowd *crowd = malloc(sizeof *crowd);
    uint32_t expected[ROOM], key[ROOM], entry[ROOM], row[ROOM];
    int32_t longest = 0;
    for (size_t c = 0; c < COUNT_OF(counts); c++)
        for (double size = 0.3; size < 5.0; size *= 2.0) {
            fill(crowd, counts[c], size, &dice);
            int32_t length = find_slowly(crowd, expected);
            longest = length > longest ? length : longest;
            for (int s = 0; s < isa_count(); s++) {
                assert_int_equal(set[s](&crowd->candidates, &crowd->own, key, entry, row), length);
                assert_memory_equal(row, expected, (size_t)length * sizeof *row);
            }
        }
    assert_true(longest > 500);
    free(crowd);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_instruction_set_finds_the_row_of_brute_force),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
