/* The fields of the members of a run, particles or cells: their descriptions, their storage, and
 * the ids of the members. */
#ifndef BOLIDE_FIELD_H
#define BOLIDE_FIELD_H

#include "base/visitor.h"

enum field_kind {
    FIELD_STATE = 1,   /* saved, migrated */
    FIELD_DERIVED = 2, /* found again from the state */
    FIELD_PASSING = 4, /* not kept when members are sorted */
    /* What a number of it can be; without any of these, whatever is finite. */
    FIELD_POSITIVE = 8,
    FIELD_NOT_NEGATIVE = 16,
    FIELD_FRACTION = 32, /* from 0 to 1, but for rounding */
};

struct field_declaration {
    const char *name, *unit, *help;
    enum number number;
    int components;
    unsigned kind;
};

struct field {
    struct field_declaration declaration;
    void *data;
};

/* Bytes of one member's numbers. */
BOLIDE_INLINE size_t field_bytes(const struct field *field)
{
    return number_size(field->declaration.number) * (size_t)field->declaration.components;
}

/* Bytes of a member in those of FIELDS that have a bit of KIND; 0: in all. */
size_t fields_bytes(const struct field *field, int fields, unsigned kind);

/* The data of the one called NAME of FIELDS, NULL where there is none. */
void *fields_find(const struct field *field, int fields, const char *name);

/* One number for the bits of the STATE ones of FIELDS of COUNT members, whatever their order. */
uint64_t fields_hash(const struct field *field, int fields, int64_t count);

/* Shows the STATE ones of FIELDS of COUNT members to VISITOR, as "STORE/NAME". */
struct error *fields_visit(const char *store, const struct field *field, int fields, int64_t count,
                           struct visitor *visitor);

/* An id identifies the origin of a particle: a body and the index of its lattice site. */
enum { PARTICLE_SITE_BITS = 48 };
#define PARTICLE_SITE (((uint64_t)1 << PARTICLE_SITE_BITS) - 1)
/* Part of the sites of particles that are created during a run, which have no place at the
 * start. */
#define PARTICLE_CREATED ((uint64_t)1 << (PARTICLE_SITE_BITS - 1))
BOLIDE_INLINE uint64_t particle_id(int body, int64_t site)
{
    return (uint64_t)body << PARTICLE_SITE_BITS | (uint64_t)site;
}

#endif
