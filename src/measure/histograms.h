/* Histograms: how the values of a field are distributed over the members, by mass, volume or
 * number, at every snapshot: histograms/NAME-NNNNNN.csv. */
#ifndef BOLIDE_HISTOGRAMS_H
#define BOLIDE_HISTOGRAMS_H

#include "measure/fields.h"

struct histogram {
    const char *name;
    const struct histogram_input *input;
    struct chosen_fields *field; /* one */
    int bodies;
    bool *counts; /* of each body, whether it does */
};

struct histograms {
    int count;
    struct histogram *item;
};

/* Readies the histograms of a case; all mistakes come joined in one ERROR_INPUT. */
struct error *histograms_prepare(const struct simulation *simulation,
                                 const struct population *population,
                                 struct histograms *histograms);
void histograms_free(struct histograms *histograms);

/* Writes FOLDER/histograms/NAME-NNNNNN.csv of each, NNNNNN the NUMBER of the snapshot: a row a bin
 * with its ends, what is in it, the fraction of all that this is, and that of the values up to its
 * end. Collective. */
struct error *histograms_write(const struct histograms *histograms,
                               const struct simulation *simulation,
                               const struct population *population, const char *folder,
                               int64_t number);

#endif
