/* Loads on the faces of rigid bodies; see faces.h. */
#include "output/faces.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/csv.h"
#include "base/file.h"
#include "base/memory.h"
#include "model/maps.h"
#include "parallel/ranks.h"

/* A face of an open cell, behind which a rigid body is. */
struct face_row {
    int32_t body, axis, side; /* index of boundaries; where the face looks: 0 low, 1 high */
    uint64_t cell;
    double position[3], value[MAPS_MAX];
};

struct faces {
    int64_t count, room;
    struct face_row *face;
};

/* Of the solver's cells: population and maps that it keeps. */
struct source {
    struct population population;
    int maps, map[MAPS_MAX];
    struct map_fields fields[MAPS_MAX];
};

static bool find_source(const struct simulation *simulation, struct source *source)
{
    for (int p = 0; p < simulation->populations; p++) {
        source->population = simulation_population_at(simulation, p);
        source->maps = 0;
        if (source->population.kind != POPULATION_OF_CELLS)
            continue;
        for (int k = 0; k < simulation->maps; k++)
            if (maps_find(&simulation->map[k], &source->population, &source->fields[source->maps]))
                source->map[source->maps++] = k;
        return true;
    }
    return false;
}

/* Whether cells keep a map; `bolide check` may not have filled them. */
static bool is_mapped(const struct simulation *simulation, const struct population *cells)
{
    for (int k = 0; k < simulation->maps; k++)
        if (maps_has(&simulation->map[k], cells))
            return true;
    return false;
}

const char *faces_missing(const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    struct source source;
    bool rigid = false;
    for (int b = 0; b < input->boundaries.count; b++)
        rigid |= case_boundary(input, b)->kind == BOUNDARY_RIGID_BODY;
    if (!rigid)
        return "no boundary of this case is a `rigid-body`, whose faces it would list";
    if (!find_source(simulation, &source))
        return "this solver has no cells: faces are those of cells of gas";
    if (!is_mapped(simulation, &source.population))
        return "there is nothing to list: give the solver's `ambient`, or `maps`";
    return NULL;
}

/* The faces of member I. */
static struct error *add_faces(const struct simulation *simulation, const struct source *source,
                               int32_t i, struct faces *faces)
{
    const struct population *cells = &source->population;
    for (int k = 0; k < 2 * cells->dimension; k++) {
        const int axis = k / 2, side = k % 2;
        struct face_row face = {.axis = axis, .side = 1 - side, .cell = cells->id[i]};
        double beyond[3] = {0.0};
        for (int n = 0; n < cells->dimension; n++)
            beyond[n] = face.position[n] = cells->position[i][n];
        beyond[axis] += side ? cells->edge : -cells->edge;
        face.position[axis] += side ? 0.5 * cells->edge : -0.5 * cells->edge;
        face.body = rigid_body_at(simulation->problem->input, vector_at(beyond));
        if (face.body < 0)
            continue;
        for (int n = 0; n < source->maps; n++)
            face.value[n] = source->fields[n].value[i];
        if (!memory_reserve((void **)&faces->face, &faces->room, faces->count + 1, faces->count,
                            sizeof *faces->face))
            return out_of_memory_for("the table of faces");
        faces->face[faces->count++] = face;
    }
    return NULL;
}

static int compare(const void *one, const void *other)
{
    const struct face_row *a = one, *b = other;
    if (a->body != b->body)
        return a->body < b->body ? -1 : 1;
    if (a->axis != b->axis)
        return a->axis < b->axis ? -1 : 1;
    if (a->side != b->side)
        return a->side < b->side ? -1 : 1;
    for (int axis = 0; axis < 3; axis++)
        if (a->position[axis] != b->position[axis])
            return a->position[axis] < b->position[axis] ? -1 : 1;
    return 0;
}

static struct error *write_table(const char *path, const struct simulation *simulation,
                                 const struct source *source, const struct faces *all)
{
    static const char *const looks[3][2] = {{"-x", "+x"}, {"-y", "+y"}, {"-z", "+z"}};
    static const char *const places[3] = {"position.x", "position.y", "position.z"};
    const struct simulation_case *input = simulation->problem->input;
    const int dimension = source->population.dimension;
    FILE *file;
    TRY(file_begin(path, &file));
    fputs("body,face", file);
    for (int axis = 0; axis < dimension; axis++) {
        putc(',', file);
        csv_put_head(file, places[axis], "m");
    }
    for (int n = 0; n < source->maps; n++) {
        const struct map *map = &simulation->map[source->map[n]];
        putc(',', file);
        csv_put_head(file, map->name, map->unit);
    }
    putc('\n', file);
    for (int64_t k = 0; k < all->count; k++) {
        const struct face_row *face = &all->face[k];
        csv_put_text(file, input->boundaries.names[face->body]);
        fprintf(file, ",%s", looks[face->axis][face->side]);
        for (int n = 0; n < dimension + source->maps; n++) {
            putc(',', file);
            csv_put_number(file, n < dimension ? face->position[n] : face->value[n - dimension]);
        }
        putc('\n', file);
    }
    return file_end(path, file);
}

struct error *faces_write(const char *path, const struct simulation *simulation,
                          const struct ranks *ranks)
{
    struct source source;
    struct faces own = {0}, all = {0};
    struct error *error = NULL;
    if (!find_source(simulation, &source))
        return NULL;
    for (int32_t i = 0; i < source.population.count && !error; i++)
        if (population_has(&source.population, i))
            error = add_faces(simulation, &source, i, &own);
    error = ranks_agree(ranks, error);
    if (!error)
        error = ranks_gather(ranks, 0, own.face, own.count, sizeof *own.face, (void **)&all.face,
                             &all.count);
    if (!error && ranks->rank == 0) {
        qsort(all.face, (size_t)all.count, sizeof *all.face, compare);
        error = write_table(path, simulation, &source, &all);
    }
    free(own.face);
    free(all.face);
    return ranks_agree(ranks, error);
}
