/* Loops over the fields of a store; see field.h. */
#include "base/field.h"

#include <stdlib.h>
#include <string.h>

#include "base/chance.h"
#include "base/memory.h"

size_t fields_bytes(const struct field *field, int fields, unsigned kind)
{
    size_t bytes = 0;
    for (int k = 0; k < fields; k++)
        if (!kind || field[k].declaration.kind & kind)
            bytes += field_bytes(&field[k]);
    return bytes;
}

void *fields_find(const struct field *field, int fields, const char *name)
{
    /* solvers bind their fields in each step by the names that they declared them with */
    for (int k = 0; k < fields; k++)
        if (field[k].declaration.name == name)
            return field[k].data;
    for (int k = 0; k < fields; k++)
        if (!strcmp(field[k].declaration.name, name))
            return field[k].data;
    return NULL;
}

static uint64_t member_hash(const struct field *field, int fields, int64_t i)
{
    uint64_t hash = 0;
    for (int k = 0; k < fields; k++) {
        const struct field_declaration *declaration = &field[k].declaration;
        if (!(declaration->kind & FIELD_STATE))
            continue;
        const size_t size = number_size(declaration->number);
        const char *data = (const char *)field[k].data + (size_t)i * field_bytes(&field[k]);
        for (int c = 0; c < declaration->components; c++) {
            uint64_t word = 0;
            memcpy(&word, data + (size_t)c * size, size);
            hash = mix_bits(hash * 0x9e3779b97f4a7c15u + word + 1);
        }
    }
    return hash;
}

uint64_t fields_hash(const struct field *field, int fields, int64_t count)
{
    uint64_t sum = 0;
    for (int64_t i = 0; i < count; i++)
        sum += member_hash(field, fields, i);
    return sum;
}

struct error *fields_visit(const char *store, const struct field *field, int fields, int64_t count,
                           struct visitor *visitor)
{
    struct error *error = NULL;
    for (int k = 0; k < fields && !error; k++) {
        const struct field_declaration *declaration = &field[k].declaration;
        if (!(declaration->kind & FIELD_STATE))
            continue;
        char *name = text_format("%s/%s", store, declaration->name);
        error = name ? visitor->visit(visitor, name, declaration->number, field[k].data, count,
                                      declaration->components)
                     : out_of_memory();
        free(name);
    }
    return error;
}
