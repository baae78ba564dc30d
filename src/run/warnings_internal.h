/* The watch of a run; private to warnings*.c. */
#ifndef BOLIDE_RUN_WARNINGS_INTERNAL_H
#define BOLIDE_RUN_WARNINGS_INTERNAL_H

#include "model/solver.h"
#include "run/warnings.h"

/* Densities at which the energy of 0 K is tabulated, in steps of this fraction of the reference
 * density. */
enum { COLDEST = 256 };
#define COLDEST_STEP 0.02

struct material_watch {
    double limit[WARNING_ENERGY]; /* INFINITY: none */
    bool estimated;               /* the tension: no strength is known */
    bool warm;                    /* it has a temperature */
    double coldest[COLDEST];      /* J/kg */
};

/* The tension of a body so far: numbers only, as a checkpoint takes them. */
struct body_tension {
    double time;  /* of the last row, s */
    double rate;  /* then, at which BORNE grows, 1/s; 0: too little of it is in tension */
    double borne; /* without a break until then, of what the method holds a body in */
};
enum { TENSION_NUMBERS = sizeof(struct body_tension) / sizeof(double) };

/* What is needed for that. */
struct tension_watch {
    double wave;    /* the speed of longitudinal waves over the spacing, 1/s */
    double modulus; /* of these waves, Pa; 0: the body is not watched */
    double creep;   /* the rate of small strains, of WAVE */
};

/* Memory M * WARNING_ENERGY + KIND is that of KIND in material M; that of the energy follows, then
 * one a probe, and one a load. */
struct warnings {
    const struct judgement *judgement;
    int materials, of_energy, of_loads, memories; /* first indices; how many */
    struct material_watch *watch;
    struct warning_memory *memory;
    bool *prescribed; /* by body: it has a prescribed motion */
    double speed;     /* the largest that needs no warning, so far, m/s */
    int bodies;
    struct body_tension *tension;
    struct tension_watch *tension_watch;
};

/* Readies the watch of tension that lasts; false when memory is out. */
bool tension_create(struct warnings *warnings, const struct simulation *simulation);

/* Collective: follows it from the last row of the history to this one. False when memory is out on
 * this rank. */
bool tension_follow(struct warnings *warnings, const struct simulation *simulation,
                    const struct population *p);

/* What the body of member I has borne, where it is too much and I is in tension; else 0. */
double tension_of(const struct warnings *warnings, const struct population *p, int32_t i);
bool tension_check_loaded(const struct warnings *warnings);

/* "tension in copper", and the whole line, of memory INDEX. Owned by the caller; NULL when memory
 * is out. */
char *warning_name(const struct warnings *warnings, const struct simulation *simulation, int index);
char *warning_text(const struct warnings *warnings, const struct simulation *simulation, int index);
/* What a run says when it first occurs: the whole text, or the name alone where it is expected. */
char *warning_line(const struct warnings *warnings, const struct simulation *simulation, int index);

#endif
