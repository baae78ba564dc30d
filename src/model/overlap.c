/* Bodies that may overlap; see overlap.h. */
#include "model/overlap.h"

#include <stdlib.h>

#include "base/memory.h"

bool bounds_meet(const struct bounds *a, const struct bounds *b)
{
    return a->low.x <= b->high.x && b->low.x <= a->high.x && a->low.y <= b->high.y &&
           b->low.y <= a->high.y && a->low.z <= b->high.z && b->low.z <= a->high.z;
}

/* The axis along which the bodies lie most one behind the other. */
static int best_axis(const struct overlaps *overlaps)
{
    double most = -INFINITY;
    int best = 0;
    for (int axis = 0; axis < overlaps->place->input->dimension; axis++) {
        double low = INFINITY, high = -INFINITY, sum = 0.0;
        for (int i = 0; i < overlaps->place->input->bodies.count; i++) {
            const struct bounds *bounds = &overlaps->bounds[i];
            low = minimum(low, vec3_at(bounds->low, axis));
            high = maximum(high, vec3_at(bounds->high, axis));
            sum += vec3_at(bounds->high, axis) - vec3_at(bounds->low, axis);
        }
        if (sum > 0.0 && (high - low) / sum > most) {
            most = (high - low) / sum;
            best = axis;
        }
    }
    return best;
}

struct entry {
    double low;
    int body;
};

static int by_low(const void *left, const void *right)
{
    const struct entry *a = left, *b = right;
    return a->low != b->low ? (a->low > b->low) - (a->low < b->low)
                            : (a->body > b->body) - (a->body < b->body);
}

/* The tree of the entries from BEGIN up to END; returns the highest end. */
static double grow(struct overlaps *overlaps, int begin, int end)
{
    if (begin >= end)
        return -INFINITY;
    const int middle = begin + (end - begin) / 2;
    const double own = vec3_at(overlaps->bounds[overlaps->order[middle]].high, overlaps->axis);
    overlaps->highest[middle] =
        maximum(own, maximum(grow(overlaps, begin, middle), grow(overlaps, middle + 1, end)));
    return overlaps->highest[middle];
}

struct error *overlaps_make(const struct place *place, struct overlaps *overlaps)
{
    const struct simulation_case *input = place->input;
    const size_t count = (size_t)input->bodies.count;
    *overlaps = (struct overlaps){.place = place};
    TRY(case_replacements(input, &overlaps->replacements));
    overlaps->bounds = memory_allocate(count * sizeof *overlaps->bounds);
    overlaps->order = memory_allocate(count * sizeof *overlaps->order);
    overlaps->highest = memory_allocate(count * sizeof *overlaps->highest);
    struct entry *entry = memory_allocate(count * sizeof *entry);
    if (!overlaps->bounds || !overlaps->order || !overlaps->highest || !entry) {
        free(entry);
        return out_of_memory();
    }
    for (size_t i = 0; i < count; i++)
        overlaps->bounds[i] = shape_bounds(&case_body(input, (int)i)->shape);
    overlaps->axis = best_axis(overlaps);
    for (size_t i = 0; i < count; i++)
        entry[i] = (struct entry){vec3_at(overlaps->bounds[i].low, overlaps->axis), (int)i};
    qsort(entry, count, sizeof *entry, by_low);
    for (size_t i = 0; i < count; i++)
        overlaps->order[i] = entry[i].body;
    free(entry);
    grow(overlaps, 0, (int)count);
    return NULL;
}

void overlaps_free(struct overlaps *overlaps)
{
    free(overlaps->bounds);
    free(overlaps->order);
    free(overlaps->highest);
    free(overlaps->replacements.at);
    *overlaps = (struct overlaps){0};
}

static enum overlap overlap_of(const struct overlaps *overlaps, int body, int other)
{
    const bool gives_way = replaces(&overlaps->replacements, other, body);
    if (replaces(&overlaps->replacements, body, other))
        return gives_way ? OVERLAP_MISTAKE : OVERLAP_KEEP;
    return gives_way ? OVERLAP_DROP : OVERLAP_MISTAKE;
}

struct overlap_search {
    const struct overlaps *overlaps;
    int body, count;
    int64_t room;
    struct rival *found;
    bool out_of_memory;
};

static void note(struct overlap_search *search, int other)
{
    const struct overlaps *overlaps = search->overlaps;
    if (other == search->body ||
        !bounds_meet(&overlaps->bounds[search->body], &overlaps->bounds[other]))
        return;
    const enum overlap overlap = overlap_of(overlaps, search->body, other);
    if (overlap == OVERLAP_KEEP || search->out_of_memory)
        return;
    search->out_of_memory =
        !memory_reserve((void **)&search->found, &search->room, search->count + 1, search->count,
                        sizeof *search->found);
    if (!search->out_of_memory)
        search->found[search->count++] = (struct rival){other, overlap, overlaps->bounds[other]};
}

static void seek(struct overlap_search *search, int begin, int end)
{
    const struct overlaps *overlaps = search->overlaps;
    const struct bounds *own = &overlaps->bounds[search->body];
    while (begin < end) {
        const int middle = begin + (end - begin) / 2, other = overlaps->order[middle];
        if (overlaps->highest[middle] < vec3_at(own->low, overlaps->axis))
            return;
        seek(search, begin, middle);
        if (vec3_at(overlaps->bounds[other].low, overlaps->axis) >
            vec3_at(own->high, overlaps->axis))
            return;
        note(search, other);
        begin = middle + 1;
    }
}

static int by_body(const void *left, const void *right)
{
    const struct rival *a = left, *b = right;
    return (a->body > b->body) - (a->body < b->body);
}

struct error *overlaps_rivals(const struct overlaps *overlaps, int body, struct rival **rivals,
                              int *count)
{
    struct overlap_search search = {.overlaps = overlaps, .body = body};
    seek(&search, 0, overlaps->place->input->bodies.count);
    *rivals = search.found;
    *count = search.count;
    if (search.out_of_memory)
        return out_of_memory();
    if (search.count > 0)
        qsort(search.found, (size_t)search.count, sizeof *search.found, by_body);
    return NULL;
}
