/* The parts of a coupling: each has a place in the case of the run, a simulation and a solver.
 * Private to couple/. */
#ifndef BOLIDE_PART_H
#define BOLIDE_PART_H

#include "couple/couple.h"
#include "gas/gas_phases.h"
#include "mpm/mpm_phases.h"

struct coupled_part {
    struct place place;
    bool *elsewhere; /* of the place: bodies of which this part has nothing */
    struct simulation simulation;
    void *solver;
};

/* Memory that is freed with the solver. */
struct owned {
    void **memory;
    int64_t capacity;
    int count;
};
/* Zeroed; NULL when there is none. */
void *owned_new(struct owned *owned, size_t size);
void owned_free(struct owned *owned);

/* What the functions below make places in: whole cells of EDGE in DIMENSION dimensions. */
struct part_maker {
    struct owned *owned;
    double edge;
    int dimension;
};

/* The place of the part is that of all of INPUT, for the functions below to change. */
struct error *part_begin(const struct part_maker *maker, struct coupled_part *part,
                         const struct simulation_case *input);

/* Bodies of the part reach to the faces of the box of cells from LOW to HIGH; those beyond are
 * elsewhere. */
void part_cut_bodies(const struct part_maker *maker, struct coupled_part *part,
                     const int64_t low[3], const int64_t high[3]);

/* The cells from LOW to HIGH are another part's, where there are any. */
void part_block(const struct part_maker *maker, struct coupled_part *part, const int64_t low[3],
                const int64_t high[3]);

/* Of cells of several levels those from LOW to HIGH and around are of the finest, as box NUMBER of
 * PLACE. */
void part_pin(const struct part_maker *maker, struct place *place, int number, const int64_t low[3],
              const int64_t high[3]);

/* The faces of the box of CUT that are not open are closed where those of OUTER are, else
 * outflows. */
void part_close_faces(const struct part_maker *maker, struct coupled_part *part,
                      const struct gas_cut *cut, const struct place *outer);

/* Makes the simulation of the part's place and its solver, of TYPE with PARAMETERS. */
struct error *part_create(const struct part_maker *maker, struct coupled_part *part,
                          const struct simulation *simulation, const struct solver_class *type,
                          const void *parameters);
void part_free(struct coupled_part *part, const struct solver_class *type);

/* The part's own population is shown by the run; the part has the time of the run; the run gets
 * what the part has booked, and how long it took. */
void part_show(struct simulation *simulation, const struct coupled_part *part);
void part_share_time(struct coupled_part *part, const struct simulation *simulation);
void part_gather(struct simulation *simulation, struct coupled_part *part);

/* The edge of the cells of all parts. */
double part_edge(const struct mpm_parameters *mpm, const struct simulation_case *input);

/* The domain of a case in cells of EDGE: its faces, rounded. */
struct cell_blocks part_domain(const struct simulation_case *input, double edge);

/* The volume of the cell AT, ROUND: of a radian. */
double part_cell_volume(const struct part_maker *maker, bool round, const int64_t at[3]);

/* The body of PLACE to which particles of MATERIAL belong that are made in a run: the first of it,
 * or where the products of another case have none, the first of the case. */
int part_body_of(const struct place *place, int material);

/* Whether a BODY is none of gas. */
BOLIDE_INLINE bool is_solid(const struct simulation_case *input, int body)
{
    return !gas_computes(body_material(input, body));
}

/* Particles of a BODY along an axis, in a cell. */
int64_t part_particles_across(const struct mpm *mpm, int body);

/* The explosive of particle I has burnt. */
void part_burn(struct particles *particles, int32_t i);

/* The cell AT of the gas; -1 where another rank has it. */
int32_t part_cell(const struct cell_blocks *cells, const int64_t at[3], int32_t *block);

/* Members picked from many, in their order; its memory stays for the next time. */
struct picked {
    int32_t *index;
    int64_t count, capacity;
};

/* Those of COUNT members that WANTED takes, called by THREADS threads. False when memory is out. */
bool part_pick(struct picked *picked, int32_t count, int threads,
               bool (*wanted)(void *context, int32_t i), void *context);

/* Collective: COUNT numbers, of which one rank alone has each and the others have 0, become those
 * of all ranks, by sums of their BITS. */
void part_unite(const struct ranks *ranks, int64_t *bits, double *values, int64_t count);

/* Cells from LOW to HIGH, of the finest level, are not those that count: they have no mass. */
void part_hide_cells(struct cell_blocks *cells, const int64_t low[3], const int64_t high[3]);

/* The key `region`; and what is wrong with it at KEY of the solver, for cells whose domain, edge
 * and dimension CELLS has. */
extern const struct parameter region_table[];

/* The rows of both parts in the table of a coupling, with the parameters T. */
#define PART_ROWS(T)                                                                \
    PARAMETER(TABLE, T, mpm, OPTIONAL,                                              \
              "options of the material points; the gas has cells of the same edge", \
              .table = mpm_table),                                                  \
        PARAMETER(TABLE, T, gas, OPTIONAL, "options of the gas", .table = gas_table)
struct error *region_check(const struct couple_region *region, const char *key,
                           const struct simulation_case *input, const struct cell_blocks *cells);

/* Puts OUTSIDE, filled but for its box, around MPM in the box of CUT. */
void part_surround(struct mpm *mpm, struct mpm_outside *outside, const struct gas_cut *cut);

#endif
