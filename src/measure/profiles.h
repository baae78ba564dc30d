/* Profiles: how fields are distributed along an axis, as means over bins with their scatter, at
 * every snapshot. The spread in one bin is the non-uniformity of the flow across the axis
 * (Parshikov 2013, chapter 3, projects every particle; a bin keeps the mean, the deviation and the
 * extremes). */
#ifndef BOLIDE_PROFILES_H
#define BOLIDE_PROFILES_H

#include "measure/fields.h"

struct profile {
    const char *name;
    const struct profile_input *input;
    int body; /* of `of`; -1: all */
    struct chosen_fields fields;
};

struct profiles {
    int count;
    struct profile *item;
};

/* Readies the profiles of a case; all mistakes come joined in one ERROR_INPUT. */
struct error *profiles_prepare(const struct simulation *simulation,
                               const struct population *population, struct profiles *profiles);
void profiles_free(struct profiles *profiles);

/* Writes FOLDER/profiles/NAME-NNNNNN.csv of each, NNNNNN the NUMBER of the snapshot. Collective. */
struct error *profiles_write(const struct profiles *profiles, const struct simulation *simulation,
                             const struct population *population, const char *folder,
                             int64_t number);

#endif
