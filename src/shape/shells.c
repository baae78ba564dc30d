/* The closed surfaces of a mesh: which triangles belong together, which surface lies within which
 * other, and what they enclose together. See shells.h. */
#include "shape/shells.h"

#include <stdlib.h>
#include <string.h>

/* An edge of a triangle, the lower end first. */
struct side {
    double end[2][3];
    int64_t of;
};

static int compare_sides(const void *a, const void *b)
{
    const struct side *one = a, *other = b;
    for (int k = 0; k < 6; k++) {
        const double x = one->end[k / 3][k % 3], y = other->end[k / 3][k % 3];
        if (x != y)
            return x < y ? -1 : 1;
    }
    return (one->of > other->of) - (one->of < other->of);
}

static bool same_ends(const struct side *a, const struct side *b)
{
    return memcmp(a->end, b->end, sizeof a->end) == 0;
}

static bool is_lower(const double a[3], const double b[3])
{
    for (int axis = 0; axis < 3; axis++)
        if (a[axis] != b[axis])
            return a[axis] < b[axis];
    return false;
}

static int64_t root_of(int64_t *parent, int64_t i)
{
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static void list_sides(const double (*corners)[3][3], int64_t count, struct side *sides)
{
    for (int64_t i = 0; i < 3 * count; i++) {
        const double *from = corners[i / 3][i % 3], *to = corners[i / 3][(i + 1) % 3];
        const bool up = is_lower(from, to);
        memcpy(sides[i].end[0], up ? from : to, sizeof sides[i].end[0]);
        memcpy(sides[i].end[1], up ? to : from, sizeof sides[i].end[1]);
        sides[i].of = i / 3;
    }
    qsort(sides, 3 * (size_t)count, sizeof *sides, compare_sides);
}

/* Joins the triangles of each edge that two have; where four or more meet, surfaces touch. */
static void join_sides(const struct side *sides, int64_t count, int64_t *parent)
{
    for (int64_t i = 0; i < count; i++)
        parent[i] = i;
    for (int64_t i = 0, same; i < 3 * count; i += same) {
        for (same = 1; i + same < 3 * count && same_ends(&sides[i], &sides[i + same]);)
            same++;
        const int64_t a = root_of(parent, sides[i].of),
                      b = root_of(parent, sides[i + (same == 2)].of);
        parent[a < b ? b : a] = a < b ? a : b;
    }
}

/* The root of a tree is its lowest number. */
static void number_shells(int64_t *parent, int64_t count, int32_t *shell, int32_t *shells)
{
    for (int64_t i = 0; i < count; i++) {
        const int64_t root = root_of(parent, i);
        shell[i] = root == i ? (*shells)++ : shell[root];
    }
}

/* Puts the triangles into SORTED by SHELL, which is sorted too. */
static bool sort_by_shell(const double (*corners)[3][3], int64_t count, int32_t *shell,
                          int32_t shells, double (*sorted)[3][3])
{
    int64_t *next = calloc((size_t)shells + 1, sizeof *next);
    if (!next)
        return false;
    for (int64_t i = 0; i < count; i++)
        next[shell[i] + 1]++;
    for (int32_t k = 0; k < shells; k++)
        next[k + 1] += next[k];
    for (int64_t i = 0; i < count; i++)
        memcpy(sorted[next[shell[i]]++], corners[i], sizeof sorted[0]);
    for (int64_t i = 0, k = 0; i < count; i++) {
        while (i >= next[k]) /* where the next shell begins by now */
            k++;
        shell[i] = (int32_t)k;
    }
    free(next);
    return true;
}

bool shells_sort(double (*corners)[3][3], int64_t count, int32_t *shell, int32_t *shells)
{
    struct side *sides = malloc(3 * (size_t)count * sizeof *sides);
    int64_t *parent = malloc((size_t)count * sizeof *parent);
    double(*sorted)[3][3] = malloc((size_t)count * sizeof *sorted);
    bool made = sides && parent && sorted;
    *shells = 0;
    if (made) {
        list_sides((const double(*)[3][3])corners, count, sides);
        join_sides(sides, count, parent);
        number_shells(parent, count, shell, shells);
        made = sort_by_shell((const double(*)[3][3])corners, count, shell, *shells, sorted);
    }
    if (made) {
        memcpy(corners, sorted, (size_t)count * sizeof *corners);
    }
    free(sides);
    free(parent);
    free(sorted);
    return made;
}

static bool lies_within(const struct shell_nest *nest, int32_t outer)
{
    for (int k = 0; k < nest->depth; k++)
        if (nest->outer[k] == outer)
            return true;
    return false;
}

void shells_nest(struct shell_nest *nest, bool first, const int32_t *around, int count, int32_t own)
{
    if (first) {
        nest->depth = 0;
        for (int k = 0; k < count && nest->depth < SHELLS_DEEP; k++)
            if (around[k] != own)
                nest->outer[nest->depth++] = around[k];
        return;
    }
    int kept = 0;
    for (int k = 0; k < nest->depth; k++) {
        bool still = false;
        for (int i = 0; i < count; i++)
            still |= around[i] == nest->outer[k];
        if (still)
            nest->outer[kept++] = nest->outer[k];
    }
    nest->depth = kept;
}

bool shells_enclose(const struct shell_nest *nest, const int32_t *around, int count)
{
    for (int k = 0; k < count; k++) {
        if (nest[around[k]].depth % 2 == 1)
            continue;
        bool is_cavity = false;
        for (int i = 0; i < count; i++)
            is_cavity |= nest[around[i]].depth % 2 == 1 && lies_within(&nest[around[i]], around[k]);
        if (!is_cavity)
            return true;
    }
    return false;
}
