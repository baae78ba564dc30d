/* A place: what a solver is started on. The whole domain of a case, or the part of it that a
 * coupling gives it. */
#ifndef BOLIDE_PLACE_H
#define BOLIDE_PLACE_H

#include "case/case.h"
#include "shape/shape.h"

/* What is outside a whole face. */
struct face {
    int kind; /* enum boundary_kind; -1: nothing is said of it, or of parts of it */
    double at;
    bool cuts;       /* bodies are cut there, where it is closed */
    double pressure; /* outside an outflow, Pa; NAN: that of what leaves */
    int boundary;    /* of the case, that says so; -1: none */
};

BOLIDE_INLINE bool face_closes(const struct face *face) { return boundary_kind_closes(face->kind); }
BOLIDE_INLINE bool face_lets_out(const struct face *face) { return face->kind == BOUNDARY_OUTFLOW; }

enum { PLACE_PINNED = 2 };

struct place {
    const struct simulation_case *input;
    struct face face[3][2]; /* low and high across each axis */
    bool is_part; /* another solver computes the rest, and what couples them the surfaces */
    const bool *elsewhere; /* by body: another solver has all of its members; NULL: none has */
    struct bounds box;     /* bodies are cut to it */
    struct bounds blocked; /* cells with centres in it are not computed; low above high: none */
    double resolution;     /* of cells */
    /* Of cells of several levels those in these are of the finest; as BLOCKED. */
    struct bounds pinned[PLACE_PINNED];
};

/* The whole domain of INPUT. */
struct place place_whole(const struct simulation_case *input);

BOLIDE_INLINE bool place_has(const struct place *place, int body)
{
    return !place->elsewhere || !place->elsewhere[body];
}

/* Whether no cell whose centre is at AT is computed. */
bool place_blocks(const struct place *place, struct vec3 at);
bool place_blocks_any(const struct place *place);

/* Whether some face is what TEST says. */
bool place_has_face(const struct place *place, bool (*test)(const struct face *face));

#endif
