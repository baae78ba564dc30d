/* The particle store; see particles.h. */
#include "particle/particles.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

static const struct field_declaration core_fields[] = {
    {"id", "", "what made the particle", NUMBER_UINT64, 1, FIELD_STATE},
    {"material", "", "index of the material", NUMBER_UINT16, 1, FIELD_STATE},
    {"body", "", "index of the body", NUMBER_UINT16, 1, FIELD_STATE},
    {"mass", "kg", "mass", NUMBER_DOUBLE, 1, FIELD_STATE | FIELD_POSITIVE},
    {"density", "kg/m^3", "density", NUMBER_DOUBLE, 1, FIELD_STATE | FIELD_POSITIVE},
    {"energy", "J/kg", "specific internal energy", NUMBER_DOUBLE, 1, FIELD_STATE},
    {"pressure", "Pa", "pressure, positive in compression", NUMBER_DOUBLE, 1, FIELD_DERIVED},
    {"position", "m", "place", NUMBER_DOUBLE, 3, FIELD_STATE},
    {"velocity", "m/s", "material velocity", NUMBER_DOUBLE, 3, FIELD_STATE},
    {"deviator", "Pa", "stress deviator, positive in tension", NUMBER_DOUBLE, 6, FIELD_STATE},
    {"plastic_strain", "", "equivalent plastic strain", NUMBER_DOUBLE, 1,
     FIELD_STATE | FIELD_NOT_NEGATIVE},
};

/* A particle of no body waits for its deletion. */
enum { BODY_DELETED = 0xffff };

/* Points the core's members at their fields, after any of them has moved. */
static void bind_core(struct particles *p)
{
    void **member[] = {(void **)&p->id,       (void **)&p->material,      (void **)&p->body,
                       (void **)&p->mass,     (void **)&p->density,       (void **)&p->energy,
                       (void **)&p->pressure, (void **)&p->position,      (void **)&p->velocity,
                       (void **)&p->deviator, (void **)&p->plastic_strain};
    static_assert(COUNT_OF(member) == COUNT_OF(core_fields), "one member for each core field");
    for (size_t k = 0; k < COUNT_OF(member); k++)
        *member[k] = p->field[k].data;
    for (int slot = 0; slot < POINT_HISTORY; slot++)
        for (int k = 0; k < p->fields; k++)
            if (!strcmp(p->field[k].declaration.name, history_slots[slot].name))
                p->history[slot] = p->field[k].data;
}

struct error *particles_create(int dimension, double cell, const struct field_declaration *more,
                               int count, struct particles *particles)
{
    static const struct ranks alone = {0, 1, false};
    static const int one = 1;
    *particles = (struct particles){.name = "particles",
                                    .dimension = dimension,
                                    .cell = cell,
                                    .ranks = &alone,
                                    .threads = &one};
    for (size_t k = 0; k < COUNT_OF(core_fields); k++)
        particles->field[particles->fields++].declaration = core_fields[k];
    particles_declare(particles, more, count);
    return NULL;
}

void particles_declare(struct particles *particles, const struct field_declaration *more, int count)
{
    assert(particles->fields + count <= PARTICLES_FIELDS && particles->capacity == 0);
    for (int k = 0; k < count; k++)
        particles->field[particles->fields++].declaration = more[k];
}

void particles_destroy(struct particles *particles)
{
    for (int k = 0; k < particles->fields; k++)
        free(particles->field[k].data);
    free(particles->block);
    free(particles->scratch.memory);
    *particles = (struct particles){0};
}

void *particles_field(const struct particles *particles, const char *name)
{
    return fields_find(particles->field, particles->fields, name);
}

static struct error *particles_reserve(struct particles *particles, int64_t needed)
{
    if (needed > INT32_MAX / 2)
        return error_new(ERROR_INPUT, "%lld particles are too many for one rank",
                         (long long)needed);
    int64_t kept = (int64_t)particles->count + particles->pending;
    int64_t capacity = particles->capacity;
    for (int k = 0; k < particles->fields; k++) {
        struct field *field = &particles->field[k];
        capacity = particles->capacity;
        if (!memory_reserve(&field->data, &capacity, needed, kept, field_bytes(field)))
            return out_of_memory_for("%lld particles", (long long)needed);
    }
    particles->capacity = capacity;
    bind_core(particles);
    return NULL;
}

struct error *particles_append(struct particles *particles, int32_t count, int32_t *first)
{
    int64_t end = (int64_t)particles->count + particles->pending;
    TRY(particles_reserve(particles, end + count));
    for (int k = 0; count > 0 && k < particles->fields; k++) {
        size_t bytes = field_bytes(&particles->field[k]);
        memset((char *)particles->field[k].data + (size_t)end * bytes, 0, (size_t)count * bytes);
    }
    particles->pending += count;
    *first = (int32_t)end;
    return NULL;
}

void particles_delete(struct particles *particles, int32_t index)
{
    particles->deleted += particles->body[index] != BODY_DELETED;
    particles->body[index] = BODY_DELETED;
}

bool particles_is_deleted(const struct particles *particles, int32_t index)
{
    return particles->body[index] == BODY_DELETED;
}

struct error *particles_commit(struct particles *particles)
{
    int32_t total = particles->count + particles->pending, kept = 0;
    for (int32_t i = 0; i < total; i++) {
        if (particles->body[i] == BODY_DELETED)
            continue;
        for (int k = 0; k < particles->fields && kept != i; k++) {
            size_t bytes = field_bytes(&particles->field[k]);
            char *data = particles->field[k].data;
            memcpy(data + (size_t)kept * bytes, data + (size_t)i * bytes, bytes);
        }
        kept++;
    }
    particles->count = kept;
    particles->pending = particles->deleted = 0;
    return particles_sort(particles);
}

/* The number of all ranks' particles, and with it room for this rank's share of those that are
 * loaded. */
static struct error *visit_count(struct particles *particles, struct visitor *visitor)
{
    const struct ranks *ranks = particles->ranks;
    int64_t before = ranks_sum(ranks, particles->count), total = before;
    char name[64];
    snprintf(name, sizeof name, "%s/count", particles->name);
    TRY(visitor->visit(visitor, name, NUMBER_INT64, &total, 1, 1));
    if (total < 0 || (visitor->most && total > visitor->most))
        return error_new(ERROR_SYSTEM, "%s is %lld: a file of this size has 0 to %lld", name,
                         (long long)total, (long long)visitor->most);
    visitor->first = ranks_before(ranks, particles->count);
    visitor->total = total;
    if (total == before)
        return NULL;
    struct slice slice = ranks_slice(ranks, total);
    int32_t first, count = (int32_t)(slice.end - slice.begin);
    particles->count = particles->pending = 0;
    TRY(particles_append(particles, count, &first));
    particles->count = count;
    particles->pending = 0;
    visitor->first = slice.begin;
    return NULL;
}

struct error *particles_visit(struct particles *particles, struct visitor *visitor)
{
    struct error *error = visit_count(particles, visitor);
    if (!error)
        error = fields_visit(particles->name, particles->field, particles->fields, particles->count,
                             visitor);
    visitor->first = visitor->total = 0;
    return error;
}

uint64_t particles_hash(const struct particles *particles)
{
    const uint64_t own = fields_hash(particles->field, particles->fields, particles->count);
    return (uint64_t)ranks_sum(particles->ranks, (int64_t)own);
}

size_t particles_bytes(const struct particles *particles)
{
    return fields_bytes(particles->field, particles->fields, 0);
}
