/* The population of solvers whose members are cells; see cell_population.h. */
#include "model/cell_population.h"

static struct population members(const void *store)
{
    const struct cell_blocks *cells = store;
    return (struct population){.kind = POPULATION_OF_CELLS,
                               .dimension = cells->dimension,
                               .threads = cells->threads,
                               .count = cells->count,
                               .order = cells->order,
                               .id = cells->id,
                               .material = cells->material,
                               .body = cells->body,
                               .mass = cells->mass,
                               .density = cells->density,
                               .energy = cells->energy,
                               .pressure = cells->pressure,
                               .position = (const double(*)[3])cells->position,
                               .velocity = (const double(*)[3])cells->velocity,
                               .fraction = fields_find(cells->field, cells->fields, "fraction"),
                               .edge = cells->edge,
                               .size = cells->size,
                               .blocks = cells->blocks,
                               .block = cells->block,
                               .fields = cells->fields,
                               .field = cells->field};
}

static void add(void *store, const struct field_declaration *more, int count)
{
    cell_blocks_declare(store, more, count);
}

static bool changed(const void *store)
{
    (void)store;
    return false;
}

static struct error *commit(void *store)
{
    (void)store;
    return NULL;
}

static struct error *distribute(void *store) { return cell_blocks_distribute(store, NULL, true); }

static struct error *visit(void *store, struct visitor *visitor)
{
    return cell_blocks_visit(store, visitor);
}

static uint64_t hash(const void *store) { return cell_blocks_hash(store); }

const struct population_class cell_population = {.members = members,
                                                 .add = add,
                                                 .changed = changed,
                                                 .commit = commit,
                                                 .distribute = distribute,
                                                 .visit = visit,
                                                 .hash = hash};
