/* The pictures of a run, drawn from its snapshots: by the run when it ends, and by `bolide
 * picture`. */
#ifndef BOLIDE_RUN_PICTURES_H
#define BOLIDE_RUN_PICTURES_H

#include "case/case.h"
#include "model/population.h"
#include "model/simulation.h"

struct pictures_request {
    const char *folder;
    const struct simulation_case *input;
    const struct ranks *ranks;
    int threads;
    int size[2];      /* pixels; 0: as the page needs */
    const char *into; /* the folder for the pictures, which is there; NULL: pictures of FOLDER */
    bool lenient;     /* a snapshot that cannot be read is left out, instead of an error */
    /* What is drawn; the ranges are those of all frames all the same. */
    int count;                /* of names; 0: every picture */
    const char *const *names; /* of pictures */
    bool last_alone;
    double at;                                      /* s: the snapshot that is nearest; NAN: any */
    void (*drawn)(void *context, const char *path); /* on the rank that drew it; NULL: nobody */
    void *context;
};

/* Collective: draws them as pictures/NAME-NNNNNN.png; ranks share the frames. *COUNT pictures were
 * drawn, 0 where there are no snapshots. */
struct error *pictures_draw(const struct pictures_request *request, int64_t *count);

/* The pictures of the case that cannot be drawn of SHOWN, the population that a run shows. */
struct error *pictures_check(const struct simulation *simulation, const struct population *shown,
                             bool fragments);

/* Removes the snapshots in FOLDER. */
struct error *pictures_drop_snapshots(const char *folder);

#endif
