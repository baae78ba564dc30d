/* A self-similar solution of two half-spaces: a contact, and up to two waves on either side of it,
 * each a jump or a fan. What all exact solutions of this module share: a solved problem begins with
 * a struct waves, and waves_sample, waves_star and waves_contact serve as members of its
 * exact_class. */
#ifndef BOLIDE_EXACT_WAVES_H
#define BOLIDE_EXACT_WAVES_H

#include "exact/exact.h"

enum wave_kind {
    WAVE_SHOCK,
    WAVE_FAN,
    WAVE_ELASTIC,
    WAVE_ELASTIC_FAN,
    WAVE_PLASTIC,
    WAVE_PLASTIC_FAN,
    WAVE_KINDS
};

/* Speeds are those in the frame of the case, positive to the right; a jump has head = tail. */
struct wave {
    enum wave_kind kind;
    double head, tail;
    struct exact_state behind;
};

enum { WAVES_A_SIDE = 2 };

/* Waves are listed from the outermost (fastest) to the one beside the contact; at least one a side,
 * or none on a side where nothing is. */
struct waves {
    double at; /* m, place of the contact at time zero */
    struct exact_state start[2];
    int count[2];
    struct wave wave[2][WAVES_A_SIDE];
    /* The state inside the fan of a side where x - at = speed * time; NULL when there are no
     * fans. */
    struct exact_state (*in_fan)(const void *solved, enum exact_side side, double speed);
};

/* +1 for the waves of the right side, -1 for those of the left. */
static inline double side_direction(int side) { return side == SIDE_LEFT ? -1.0 : 1.0; }

struct exact_state waves_sample(const void *solved, enum exact_side side, double x, double time);
struct exact_state waves_star(const void *solved, enum exact_side side);
double waves_contact(const void *solved, double time);

/* A list of named numbers under construction. */
struct number_list {
    struct exact_number *numbers;
    int count;
};

void number_add(struct number_list *list, const char *name, const char *unit, double value);

/* Adds the speeds of all fronts and, when TIME > 0, the places of the fronts and of the contact. */
void waves_add_numbers(const struct waves *waves, double time, struct number_list *list);

#endif
