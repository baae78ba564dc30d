/* A solid that one side of a contact sends waves into: an elastic one, and a plastic one behind it
 * where that does not suffice. Two solids that meet come to one velocity and one normal pressure; a
 * free surface to none. Source: Wang, Chen and Huang (2024), section 1; see solid_wave.h for the
 * waves. */
#ifndef BOLIDE_EXACT_SOLID_PATH_H
#define BOLIDE_EXACT_SOLID_PATH_H

#include "base/parameter.h"
#include "exact/solid_wave.h"
#include "exact/waves.h"

/* A solid and its state at the start, as a case gives them. */
struct exact_solid {
    double reference_density, bulk_modulus; /* of a barotropic solid; NAN: eos is given */
    double shear_modulus, yield;
    double density, velocity; /* at the start; density NAN: the reference density */
    double energy, deviator;  /* at the start */
    struct one_of eos;
    bool free; /* nothing is there: the other side's surface is free */
};

extern const struct parameter exact_solid_table[];
extern const char *const exact_side_names[2]; /* "left", "right" */

enum load { COMPRESSION, EXPANSION };

/* A solid as its waves see it. It points to itself: no copy of it works. */
struct solid_path {
    struct eos eos;
    bool free, fluid;
    double velocity;
    struct solid_base start;     /* elastic; of a fluid, as plastic */
    double limit[2];             /* strains at yield by enum load: <= 0, >= 0; zero: a fluid */
    double flow[2];              /* the deviators there */
    struct solid_place yield[2]; /* behind the elastic waves that end there */
};

struct error *solid_path_of(const struct exact_solid *solid, const char *side,
                            struct solid_path *path);

/* Makes PATH that of the same solid in STATE. */
struct error *solid_path_restart(struct solid_path *path, const struct exact_state *state,
                                 const char *side);

/* The state that the waves of PATH run into. */
struct exact_state solid_path_start(const struct solid_path *path);

/* The waves of one side, from the outermost: each from its base to its place. */
struct solid_response {
    int count;
    bool reached; /* the solid bears the pressure */
    struct solid_base base[WAVES_A_SIDE];
    struct solid_place behind[WAVES_A_SIDE];
};

/* What two solids come to at their contact, or one at its free surface. */
struct solid_meeting {
    double pressure, velocity; /* normal pressure */
    struct solid_response response[2];
};

/* ERROR_INPUT where both are free, or an equation of state does not come to what the meeting asks
 * for. */
struct error *solid_meet(const struct solid_path path[2], struct solid_meeting *meeting);

struct exact_state solid_state(const struct solid_place *place, double velocity);

/* Whether wave INDEX of RESPONSE is a fan; else it is a jump. */
static inline bool solid_wave_is_fan(const struct solid_response *response, int index)
{
    const struct solid_place *behind = &response->behind[index];
    return behind->strain > 0.0 && behind->chord == behind->stiffness;
}

#endif
