/* What pictures and the viewer show of one moment: the members of all populations as a snapshot has
 * them, in single precision, in the order of their ids. A picture is therefore the same on any
 * number of ranks, during the run and from its files. */
#ifndef BOLIDE_FRAME_H
#define BOLIDE_FRAME_H

#include "base/error.h"

/* A field that is read, "pressure" or "velocity.x". */
struct frame_field {
    char name[72], unit[32];
    float *value; /* NAN where a member has none */
};
enum { FRAME_FIELDS = 24, FRAME_GROUPS = 4 };

/* The members of one population. */
struct frame_group {
    int64_t count;
    int cell_dimension; /* of cells; 0: particles */
    uint64_t *id;
    uint16_t *body, *material;
    float (*position)[3];
    float *diameter; /* of cells their edge */
    float *mass;
    int fields;
    struct frame_field field[FRAME_FIELDS];
};

struct frame_names {
    int count;
    char **name;
};

struct frame {
    double time;
    struct frame_names bodies, materials;
    int groups;
    struct frame_group group[FRAME_GROUPS];
};

void frame_free(struct frame *frame);
void frame_names_free(struct frame_names *names);
struct error *frame_names_copy(const struct frame_names *from, struct frame_names *to);

/* Sorts the members of GROUP by id, and drops cells without material and members at no place. */
struct error *frame_order(struct frame_group *group);

/* The field NAME of GROUP; NULL when there is none. */
const struct frame_field *frame_field(const struct frame_group *group, const char *name);

int64_t frame_members(const struct frame *frame);
int64_t frame_bytes(const struct frame *frame);

#endif
