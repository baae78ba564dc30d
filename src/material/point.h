/* A point of a material, what a step does to it, and what the parts of a material give back. */
#ifndef BOLIDE_POINT_H
#define BOLIDE_POINT_H

#include "base/vector.h"
#include "material/history.h"

/* Status bits of point physics. */
enum {
    POINT_OUT_OF_RANGE = 1, /* outside the range where the equation of state is defined */
    POINT_NO_SOUND = 2,     /* the square of the sound speed is not positive */
    POINT_BEYOND = 4,       /* outside the range of the source's form: eos_<identifier>_beyond() is
                               asked instead */
    POINT_SOUND_HELD = 8,   /* (dp/drho)_e is one of a least sound speed, not of the pressure */
};

struct eos_value {
    double pressure, dp_drho, dp_de;
    unsigned status;
};

/* One point of a material at one time level. */
struct point {
    double density, energy, pressure;
    struct sym3 deviator;
    double history[POINT_HISTORY];
};

/* What a step does to a point: its density after the step, the symmetric velocity gradient (with
 * its trace) and half the curl of velocity during it; and the specific internal energy after it, or
 * what follows from work (see material.h): the mean artificial viscous pressure. */
struct motion {
    double dt, density, energy;
    struct sym3 strain_rate;
    struct vec3 spin;
    struct vec3 acceleration; /* m/s^2; of what waits for its failure alone */
    double viscous_pressure;
    double time, length; /* at the end of the step, s; of the point, its diameter or spacing, m */
    double compaction;   /* rho/rho_0 lost to pores that closed in the step; the material sets it */
    double damage_gradient; /* |grad D| of damage that spreads, 1/m; the solver supplies it */
    double pressure;        /* before the step, where the strength asks; the material sets it */
};

/* What the Riemann problem and the time step need of a point: longitudinal and shear sound speed
 * (m/s), (dp/drho)_e, (dp/de)_rho, shear modulus and yield stress. */
struct response {
    double dp_drho, dp_de, shear_modulus, yield, sound_long, sound_shear;
    unsigned status;
};

/* What the burning of a point depends on: the time since its lighting (s), its length (m),
 * rho_0/rho, and rho_0, kg/m^3. */
struct burning {
    double passed, length, volume, rest;
};

#endif
