/* What a run would take, for `bolide check`: nothing is computed but the lattice. */
#ifndef BOLIDE_ESTIMATE_H
#define BOLIDE_ESTIMATE_H

#include "model/generate.h"

/* A material as it stands in one body at the start. */
struct body_estimate {
    struct body_summary summary;
    double sound_long, sound_shear; /* m/s */
    double step;                    /* s, that it allows */
    struct vec3 middle, velocity;   /* of its bounds; there, at the start, m/s */
};

struct estimate {
    int bodies;
    struct body_estimate *body;
    int64_t particles;
    double cells; /* beside them */
    double mass;
    double *material_mass; /* of each material of the case */
    struct bounds box;     /* of all bodies; on an axis with two walls what lies between them */
    double mean_density;   /* of that box, kg/m^3: voids count */
    double step;           /* s: the smallest that a body allows at the start */
    int step_body;         /* whose it is */
    double impact;         /* the fastest, over the lower speed of sound of what meets */
    double bytes;          /* of all particles and cells */
};

/* Also finds what a run would refuse before its first step; then ESTIMATE holds nothing. */
struct error *estimate_run(const struct simulation_case *input, struct estimate *estimate);
/* The same of a case that is known to be right, or is about to be run. */
struct error *estimate_size(const struct simulation_case *input, struct estimate *estimate);
void estimate_free(struct estimate *estimate);

#endif
