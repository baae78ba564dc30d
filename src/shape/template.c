/* The sites of a map that bear one letter; 2-D. Bodies that take one letter each of the same map
 * touch and do not overlap. Parshikov (2013), section 5.3. */
#include <string.h>

#include "base/chance.h"
#include "base/memory.h"
#include "shape/kinds.h"

const struct parameter shape_template_table[] = {
    PARAMETER(NAMES, struct shape_template, rows, REQUIRED,
              "the map: one text per row, the top row first, one letter per site"),
    PARAMETER(TEXT, struct shape_template, letter, REQUIRED,
              "the letter whose sites are the shape"),
    PARAMETER(NUMBER, struct shape_template, site, REQUIRED, "edge of a square site", .unit = "m",
              .above = 0.0, .below = INFINITY),
    PARAMETER(VECTOR, struct shape_template, from, REQUIRED,
              "the corner of the map with the low coordinates", .unit = "m"),
    PARAMETER(INTEGER, struct shape_template, seed, "0",
              "0: the map as it is written; else its letters change places at random: the rows "
              "give their numbers, and the same seed the same map, for every letter",
              .below = 1e15, .closed = true, .owned = offsetof(struct shape_template, shuffled)),
    PARAMETER_END,
};

static bool inside(const void *shape, struct vec3 point)
{
    const struct shape_template *map = shape;
    const double columns = (double)strlen(map->rows.names[0]), rows = map->rows.count;
    const double x = floor((point.x - map->from.at[0]) / map->site);
    const double y = floor((point.y - map->from.at[1]) / map->site);
    if (!(x >= 0.0 && x < columns && y >= 0.0 && y < rows))
        return false;
    const int64_t row = map->rows.count - 1 - (int)y;
    const char letter = map->shuffled ? map->shuffled[row * (int64_t)columns + (int64_t)x]
                                      : map->rows.names[row][(int)x];
    return letter == map->letter[0];
}

/* Of the whole map: the lattice is the same for every letter. */
static struct bounds bounds(const void *shape)
{
    const struct shape_template *map = shape;
    const double columns = (double)strlen(map->rows.names[0]), rows = map->rows.count;
    const struct vec3 low = vec3_of(&map->from);
    return (struct bounds){low,
                           vec3_add(low, vec3_make(columns * map->site, rows * map->site, 0.0))};
}

static const char *wrong(const void *shape, int dimension)
{
    const struct shape_template *map = shape;
    if (dimension != 2 || map->from.count != 2)
        return "a template needs two dimensions, and two numbers in `from`";
    if (strlen(map->letter) != 1)
        return "the `letter` of a template is one character";
    if (map->rows.count < 1)
        return "a template needs at least one row";
    bool found = false;
    for (int i = 0; i < map->rows.count; i++) {
        if (strlen(map->rows.names[i]) != strlen(map->rows.names[0]))
            return "the `rows` of a template must be of one length";
        found = found || strchr(map->rows.names[i], map->letter[0]);
    }
    return found ? NULL : "the `letter` of this template is nowhere in its `rows`";
}

/* Shuffles the map, every order as likely (Fisher and Yates). */
static const char *prepare(void *shape, int dimension)
{
    (void)dimension;
    struct shape_template *map = shape;
    if (map->seed == 0 || map->shuffled)
        return NULL;
    const size_t columns = strlen(map->rows.names[0]);
    const int64_t sites = (int64_t)columns * map->rows.count;
    char *letters = memory_allocate((size_t)sites);
    if (!letters)
        return "there is no memory for the sites of this template";
    for (int i = 0; i < map->rows.count; i++)
        memcpy(letters + (size_t)i * columns, map->rows.names[i], columns);
    for (int64_t last = sites - 1; last > 0; last--) {
        const int64_t other =
            (int64_t)((double)(last + 1) * chance_of((uint64_t)last, (uint64_t)map->seed));
        const char letter = letters[last];
        letters[last] = letters[other];
        letters[other] = letter;
    }
    map->shuffled = letters;
    return NULL;
}

const struct shape_class shape_template_class = {inside, bounds, wrong, NULL, NULL, prepare, NULL};
