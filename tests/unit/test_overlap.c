/* Which bodies may overlap, against a loop over all pairs. */
#include <stdio.h>
#include <stdlib.h>

#include "build_case.h"
#include "dice.h"
#include "model/overlap.h"

enum { BODIES = 300 };

/* BODIES boxes, some large, some one beside the other; a few replace others. */
struct heap {
    struct simulation_case input;
    struct body_input body[BODIES];
    struct shape_box box[BODIES];
    char name[BODIES][16], *names[BODIES], *replaced[BODIES];
};

static void fill_heap(struct heap *heap, int dimension, uint32_t seed)
{
    struct dice dice = {seed};
    *heap = (struct heap){0};
    heap->input.dimension = dimension;
    for (int b = 0; b < BODIES; b++) {
        snprintf(heap->name[b], sizeof heap->name[b], "b%d", b);
        heap->names[b] = heap->name[b];
        heap->box[b].from.count = heap->box[b].to.count = dimension;
        for (int axis = 0; axis < dimension; axis++) {
            const double size = b % 50 ? 1.0 : 20.0;
            heap->box[b].from.at[axis] = floor(dice_between(&dice, 0.0, axis ? 10.0 : 60.0));
            heap->box[b].to.at[axis] = heap->box[b].from.at[axis] + size;
        }
        heap->body[b].shape = shape_of("box", &heap->box[b]);
        heap->replaced[b] = heap->names[(7 * b + 3) % BODIES];
        if (b % 3 == 0 && (7 * b + 3) % BODIES < b)
            heap->body[b].replaces = (struct name_list){1, &heap->replaced[b]};
    }
    heap->input.bodies = (struct named_map){BODIES, heap->names, heap->body, {0}};
}

static bool names(const struct heap *heap, int body, int other)
{
    return heap->body[body].replaces.count && heap->replaced[body] == heap->names[other];
}

static void check_body(const struct heap *heap, const struct overlaps *overlaps, int body)
{
    struct rival *rivals;
    int count, at = 0;
    assert_null(overlaps_rivals(overlaps, body, &rivals, &count));
    const struct bounds own = shape_bounds(&heap->body[body].shape);
    for (int other = 0; other < BODIES; other++) {
        const struct bounds bounds = shape_bounds(&heap->body[other].shape);
        if (other == body || !bounds_meet(&own, &bounds) || names(heap, body, other))
            continue;
        assert_true(at < count);
        assert_int_equal(rivals[at].body, other);
        assert_int_equal(rivals[at].overlap,
                         names(heap, other, body) ? OVERLAP_DROP : OVERLAP_MISTAKE);
        at++;
    }
    assert_int_equal(at, count);
    free(rivals);
}

static void rivals_are_those_that_a_loop_over_all_finds(void **state)
{
    (void)state;
    static struct heap heap;
    for (int dimension = 1; dimension <= 3; dimension++) {
        struct overlaps overlaps;
        fill_heap(&heap, dimension, (uint32_t)dimension);
        const struct place whole = place_whole(&heap.input);
        assert_null(overlaps_make(&whole, &overlaps));
        for (int body = 0; body < BODIES; body++)
            check_body(&heap, &overlaps, body);
        overlaps_free(&overlaps);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rivals_are_those_that_a_loop_over_all_finds)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
