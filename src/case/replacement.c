/* Bodies that give way to others, as pairs; see case.h. */
#include <stdlib.h>

#include "base/memory.h"
#include "case/case.h"

static int by_pair(const void *left, const void *right)
{
    const struct replacement *a = left, *b = right;
    return a->by != b->by ? (a->by > b->by) - (a->by < b->by) : (a->of > b->of) - (a->of < b->of);
}

struct error *case_replacements(const struct simulation_case *input, struct replacements *result)
{
    size_t room = 1;
    *result = (struct replacements){0};
    for (int body = 0; body < input->bodies.count; body++)
        room += (size_t)case_body(input, body)->replaces.count;
    result->at = memory_allocate(room * sizeof *result->at);
    if (!result->at)
        return out_of_memory();
    for (int body = 0; body < input->bodies.count; body++) {
        const struct name_list *names = &case_body(input, body)->replaces;
        for (int i = 0; i < names->count; i++) {
            const int other = case_find_body(input, names->names[i]);
            if (other >= 0)
                result->at[result->count++] = (struct replacement){body, other};
        }
    }
    qsort(result->at, (size_t)result->count, sizeof *result->at, by_pair);
    return NULL;
}

bool replaces(const struct replacements *replacements, int by, int of)
{
    const struct replacement wanted = {by, of};
    return replacements->count > 0 &&
           bsearch(&wanted, replacements->at, (size_t)replacements->count, sizeof *replacements->at,
                   by_pair);
}
