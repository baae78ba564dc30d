/* The fields that SPH adds to the store, and where their pointers go. */
#include "sph/scheme.h"

#define AT(member) .offset = offsetof(struct sph_fields, member)

const struct field_row sph_rows[] = {
    {.field = {"diameter", "m", "particle diameter (m/rho)^(1/dimension)", NUMBER_DOUBLE, 1,
               FIELD_DERIVED},
     .state_when = SPH_SUPPORT_KEPT,
     AT(diameter)},
    {.field = {"sound_long", "m/s", "longitudinal sound speed", NUMBER_DOUBLE, 1, FIELD_DERIVED},
     AT(sound_long)},
    {.field = {"sound_shear", "m/s", "shear wave speed", NUMBER_DOUBLE, 1, FIELD_DERIVED},
     AT(sound_shear)},
    {.field = {"acceleration", NULL, "acceleration", NUMBER_DOUBLE, 3, FIELD_PASSING},
     AT(rates.acceleration)},
    {.field = {"power", NULL, "specific power of the contact forces", NUMBER_DOUBLE, 1,
               FIELD_PASSING},
     AT(rates.power)},
    {.field = {"strain_rate", NULL, "symmetric velocity gradient", NUMBER_DOUBLE, 6, FIELD_PASSING},
     AT(rates.strain_rate)},
    {.field = {"spin", NULL, "half the curl of velocity", NUMBER_DOUBLE, 3, FIELD_PASSING},
     .state_when = SPH_SPIN_KEPT,
     AT(rates.spin)},
    {.field = {"wall_acceleration", NULL, "acceleration by walls", NUMBER_DOUBLE, 3, FIELD_PASSING},
     .when = SPH_WALLS,
     AT(rates.wall)},
    {.field = {"hoop_pull", NULL, "acceleration by hoop stress", NUMBER_DOUBLE, 1, FIELD_PASSING},
     .when = SPH_AXISYMMETRIC,
     AT(rates.hoop_pull)},
    {.field = {"hoop_strain", NULL, "part of u/r that is strain rate", NUMBER_DOUBLE, 1,
               FIELD_PASSING},
     .when = SPH_AXISYMMETRIC,
     AT(rates.hoop_strain)},
    {.field = {"drift", NULL, "mean contact velocity less own velocity", NUMBER_DOUBLE, 3,
               FIELD_PASSING},
     .when = SPH_DRIFT,
     AT(rates.drift)},
    {.field = {"broken", "", "share of a particle's contacts that are broken", NUMBER_DOUBLE, 1,
               FIELD_DERIVED},
     .when = SPH_BREAKS,
     .where = "a material with failure and method: contact or standard",
     AT(rates.broken)},
    {.field = {"heat_rate", NULL, "specific power of conduction", NUMBER_DOUBLE, 1, FIELD_PASSING},
     .when = SPH_CONDUCTION,
     AT(heat_rate)},
    {.field = {"damage_gradient", NULL, "gradient of damage that spreads", NUMBER_DOUBLE, 1,
               FIELD_PASSING},
     .when = SPH_SPREADS,
     AT(damage_gradient)},
    {.field = {"viscosity", "Pa", "artificial viscous pressure", NUMBER_DOUBLE, 1, FIELD_DERIVED},
     .when = SPH_VISCOUS,
     .where = "method: standard",
     AT(viscosity)},
    {.field = {"density_rate", NULL, "rate of density", NUMBER_DOUBLE, 1, FIELD_DERIVED},
     .when = SPH_DENSITY_RATE,
     AT(density_rate)},
    {.field = {"packing", NULL, "how volumes fill space, and lack neighbours", NUMBER_DOUBLE,
               PACKING_NUMBERS, FIELD_STATE},
     .when = SPH_PACKING,
     AT(packing)},
    {.field = {"density_start", "kg/m^3", "density at the start", NUMBER_DOUBLE, 1,
               FIELD_STATE | FIELD_POSITIVE},
     .when = SPH_PACKING,
     .where = "method: muscl in 2-D and 3-D",
     AT(density_start)},
    {.field = {"volume_rate", NULL, "how volumes follow places", NUMBER_DOUBLE, VOLUME_NUMBERS,
               FIELD_PASSING},
     .when = SPH_PACKING,
     AT(volume)},
    {.field = {"support", "m", "diameter that sets the support of the kernel", NUMBER_DOUBLE, 1,
               FIELD_STATE | FIELD_POSITIVE},
     .when = SPH_PACKING,
     .where = "method: muscl in 2-D and 3-D",
     AT(support)},
    {.field = {"thickness", "", "thickness relative to the start", NUMBER_DOUBLE, 1,
               FIELD_STATE | FIELD_POSITIVE},
     .when = SPH_THIN,
     .where = "geometry: plane-stress",
     AT(thickness)},
    FIELD_ROWS_END,
};

/* What the rows of a run with TRAITS depend on; SIZE has room for SPH_SIZES. */
static struct field_needs needs_of(unsigned traits, int dimension, int *size)
{
    const int tensor = dimension * (dimension + 1) / 2;
    size[SPH_SIZE_TENSOR] = tensor;
    size[SPH_SIZE_GRADIENT] = dimension * dimension;
    size[SPH_SIZE_STRESS_GRADIENT] = dimension * (traits & SPH_SHEAR ? tensor : 1);
    return (struct field_needs){traits, size};
}

void sph_bind_fields(const struct sph *sph, const struct simulation *simulation,
                     const struct field_row *rows, void *fields)
{
    int size[SPH_SIZES];
    const struct field_needs needs = needs_of(sph->traits, simulation->problem->dimension, size);
    field_rows_bind(rows, &needs, sph->particles, fields);
}

struct sph_fields sph_fields_of(const struct sph *sph, const struct simulation *simulation)
{
    struct sph_fields fields;
    sph_bind_fields(sph, simulation, sph_rows, &fields);
    fields.particles = sph->particles;
    return fields;
}

int sph_declare_fields(const struct sph_scheme *scheme, unsigned traits, int dimension,
                       struct field_declaration *fields)
{
    int size[SPH_SIZES];
    const struct field_needs needs = needs_of(traits, dimension, size);
    const int own = field_rows_declare(scheme->rows, &needs, fields);
    return own + field_rows_declare(sph_rows, &needs, fields + own);
}
