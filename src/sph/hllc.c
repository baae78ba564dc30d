/* SPH with corrected kernel gradients as the solver sees it: what it may be asked for, its fields, its records, and the
 * rates of a level. Source: Wang et al., Explosion and Shock Waves 44 (2024) 081431, section 2. */
#include <string.h>

#include "base/clock.h"
#include "sph/hllc_internal.h"

/* Both methods come with terms of their own for what other methods are asked for. */
static const char *wrong_parameter(const struct sph_parameters *parameters, int dimension,
                                   const char **key)
{
    bool viscous = parameters->method == SPH_MONAGHAN;
    *key = "sph.contact";
    if (parameters->contact >= 0)
        return "hllc and monaghan have pairs of their own: leave this out";
    *key = "sph.motion";
    if (parameters->motion >= 0 && parameters->motion != SPH_MOTION_PARTICLE)
        return "with hllc and monaghan a particle moves by its own velocity: `particle`";
    *key = "sph.rotation";
    if (parameters->rotation == SPH_ROTATION_CORRECTED)
        return "corrected goes with `method: contact` and `contact: acoustic`";
    *key = "sph.conduction";
    if (parameters->conduction != SPH_CONDUCTION_NONE)
        return "heat is not conducted with hllc and monaghan: use another method";
    *key = "sph.reconstruction";
    if (viscous && parameters->reconstruction != SPH_RECONSTRUCTION_NONE)
        return "this goes with `method: hllc`";
    if (dimension > 1 && parameters->reconstruction == SPH_RECONSTRUCTION_ALL)
        return "all goes with one dimension; in more, give velocity";
    return NULL;
}

struct hllc_kind hllc_kind_of(const struct sph_parameters *parameters, int dimension, bool depth)
{
    return (struct hllc_kind){dimension, depth, parameters->method == SPH_MONAGHAN,
                              parameters->reconstruction != SPH_RECONSTRUCTION_NONE};
}

struct error *hllc_choose(struct sph *sph, const struct simulation *simulation, bool laws)
{
    const char *key;
    struct sph_parameters *parameters = &sph->parameters;
    const char *wrong = wrong_parameter(parameters, simulation->dimension, &key);
    if (wrong)
        return input_error(simulation->input, "solver", key, "%s", wrong);
    if (simulation->geometry == GEOMETRY_PLANE_STRESS)
        return input_error(simulation->input, "geometry", NULL,
                           "plane stress is not for hllc and monaghan: use another method");
    if (laws)
        return input_error(simulation->input, "contacts", NULL,
                           "with hllc and monaghan all bodies stick and carry tension: use another "
                           "method");
    parameters->motion = SPH_MOTION_PARTICLE;
    parameters->contact = SPH_CONTACT_ACOUSTIC;
    sph->kind = (struct pair_kind){.dimension = simulation->dimension,
                                   .depth = sph_axisymmetric(simulation)};
    sph->hllc = hllc_kind_of(parameters, simulation->dimension, sph_axisymmetric(simulation));
    return NULL;
}

int hllc_declare(const struct sph_parameters *parameters, struct field_declaration *fields)
{
    static const struct field_declaration table[HLLC_FIELDS] = {
        {"correction", NULL, "inverse second moment of the kernel", NUMBER_DOUBLE, 6,
         FIELD_DERIVED},
        {"dp_drho", NULL, "derivative of pressure by density", NUMBER_DOUBLE, 1, FIELD_DERIVED},
        {"dp_de", NULL, "derivative of pressure by energy", NUMBER_DOUBLE, 1, FIELD_DERIVED},
        {"density_rate", NULL, "rate of density", NUMBER_DOUBLE, 1, FIELD_DERIVED},
        {"level", NULL, "state and rates of level n", NUMBER_DOUBLE,
         sizeof(struct hllc_level) / sizeof(double), FIELD_DERIVED},
        {"slopes", NULL, "gradients of density, pressure, deviator", NUMBER_DOUBLE, 3,
         FIELD_DERIVED}};
    int count =
        parameters->reconstruction == SPH_RECONSTRUCTION_ALL ? HLLC_FIELDS : HLLC_FIELDS - 1;
    memcpy(fields, table, (size_t)count * sizeof *table);
    return count;
}

struct hllc_fields hllc_fields_of(const struct sph *sph, const struct simulation *simulation)
{
    const struct particles *p = &simulation->particles;
    bool all = sph->parameters.reconstruction == SPH_RECONSTRUCTION_ALL;
    struct hllc_fields f = {.sph = sph_fields_of(sph, simulation),
                            .correction = particles_field(p, "correction"),
                            .slopes = all ? particles_field(p, "slopes") : NULL,
                            .dp_drho = particles_field(p, "dp_drho"),
                            .dp_de = particles_field(p, "dp_de"),
                            .level = particles_field(p, "level")};
    f.sph.density_rate = particles_field(p, "density_rate");
    for (int slot = 1; slot < POINT_HISTORY; slot++)
        if (p->history[slot])
            f.level_history = particles_field(p, "level_history");
    return f;
}

/* The section of a ring, which a stage may have taken through the axis. */
static double volume_of(const struct simulation *simulation, int32_t i)
{
    const struct particles *p = &simulation->particles;
    double depth = sph_axisymmetric(simulation) ? fabs(p->position[i][0]) : 1.0;
    return p->mass[i] / (p->density[i] * depth);
}

void hllc_start(const struct sph *sph, struct simulation *simulation)
{
    struct hllc_fields f = hllc_fields_of(sph, simulation);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < simulation->particles.count; i++) {
        struct response r = sph_evaluate_point(simulation, &f.sph, i);
        f.dp_drho[i] = r.dp_drho;
        f.dp_de[i] = r.dp_de;
        if (f.sph.diameter[i] == 0.0) /* fresh */
            f.sph.diameter[i] = diameter_of_volume(volume_of(simulation, i), simulation->dimension);
    }
}

/* What both records begin with; returns what comes behind. */
static double *pack_plain(const struct simulation *simulation, const struct hllc_fields *f,
                          int32_t i, double *record)
{
    const struct particles *p = &simulation->particles;
    int dimension = simulation->dimension;
    memcpy(record, p->position[i], (size_t)dimension * sizeof *record);
    record[dimension] = f->sph.diameter[i];
    record[dimension + 1] = volume_of(simulation, i);
    memcpy(record + dimension + 2, p->velocity[i], (size_t)dimension * sizeof *record);
    return record + 2 * dimension + 2;
}

/* The components of a symmetric tensor that a record has; returns what comes behind. */
static double *pack_tensor(int dimension, const double *tensor, double less, double *record)
{
    *record++ = tensor[0] - less;
    if (dimension > 1)
        *record++ = tensor[1] - less;
    if (dimension > 2)
        *record++ = tensor[2] - less;
    if (dimension > 1)
        *record++ = tensor[3];
    if (dimension > 2) {
        *record++ = tensor[4];
        *record++ = tensor[5];
    }
    return record;
}

static void pack_for_gradients(const struct sph *sph, const struct simulation *simulation,
                               const struct hllc_fields *f, int32_t i, double *record)
{
    const struct particles *p = &simulation->particles;
    double *next = pack_plain(simulation, f, i, record);
    (void)sph;
    if (simulation->dimension == 1) {
        next[0] = p->density[i];
        next[1] = p->pressure[i];
        next[2] = p->deviator[i][0];
    }
}

static void pack_for_forces(const struct sph *sph, const struct simulation *simulation,
                            const struct hllc_fields *f, int32_t i, double *record)
{
    const struct particles *p = &simulation->particles;
    const struct material *material = &simulation->material[p->material[i]];
    int dimension = simulation->dimension;
    double *next = pack_plain(simulation, f, i, record);
    *next++ = p->density[i];
    next = pack_tensor(dimension, p->deviator[i], p->pressure[i], next);
    next = pack_tensor(dimension, f->correction[i], 0.0, next);
    if (sph->hllc.viscous) {
        *next++ = f->sph.sound_long[i];
    } else {
        struct point point = {.density = p->density[i], .pressure = p->pressure[i]};
        particle_load_history(p, i, point.history);
        *next++ = p->pressure[i];
        *next++ = f->dp_drho[i];
        *next++ = f->dp_de[i];
        *next++ = strength_shear_modulus(&material->strength);
        *next++ = strength_yield(&material->strength, &point);
    }
    if (sph->hllc.depth)
        *next++ = p->position[i][0];
    if (!sph->hllc.reconstructed)
        return;
    *next++ = p->material[i];
    next = pack_tensor(dimension, f->sph.rates.strain_rate[i], 0.0, next);
    if (f->slopes)
        memcpy(next, f->slopes[i], sizeof f->slopes[i]);
    else if (dimension == 1)
        memset(next, 0, 3 * sizeof *next);
}

/* Turns the record of a particle into that of its image; FORCES: that of the second pass. */
static void reflect(const struct sph *sph, const struct simulation *simulation, image_code image,
                    bool forces, double *record)
{
    int dimension = simulation->dimension;
    struct vec3 sign = image_sign(image);
    sph_reflect_motion(simulation, image, record);
    if (!forces)
        return;
    sph_reflect_tensor(dimension, sign, record + hllc_stress(dimension));
    sph_reflect_tensor(dimension, sign, record + hllc_correction(dimension));
    if (sph->hllc.depth && image % 3 == 1)
        record[hllc_depth(sph->hllc)] *= -1.0;
    if (!sph->hllc.reconstructed)
        return;
    sph_reflect_tensor(dimension, sign, record + hllc_strain(sph->hllc));
    for (int s = 0; dimension == 1 && s < 3; s++)
        record[hllc_slopes(sph->hllc) + s] *= sign.x;
}

/* The records of ghosts BEGIN .. END - 1, which are images. */
static void pack_images(struct sph *sph, const struct simulation *simulation, bool forces,
                        int32_t begin, int32_t end)
{
    const struct ghosts *ghosts = &sph->neighbours.ghosts;
    size_t stride = (size_t)(forces ? hllc_stride(sph->hllc) : HLLC_GRADIENT_STRIDE);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t g = begin; g < end; g++) {
        double *record = sph->record + (size_t)(simulation->particles.count + g) * stride;
        memcpy(record, sph->record + (size_t)ghosts->source[g] * stride, stride * sizeof *record);
        reflect(sph, simulation, ghosts->image[g], forces, record);
    }
}

/* Records of owned particles, then of ghosts, then the one that fills up lanes: it has no volume, and its contact
 * problem must only have an answer. */
static void pack(struct sph *sph, const struct simulation *simulation, const struct hllc_fields *f,
                 bool forces)
{
    const struct particles *p = &simulation->particles;
    struct ghosts *ghosts = &sph->neighbours.ghosts;
    size_t stride = (size_t)(forces ? hllc_stride(sph->hllc) : HLLC_GRADIENT_STRIDE);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++)
        (forces ? pack_for_forces : pack_for_gradients)(sph, simulation, f, i,
                                                        sph->record + (size_t)i * stride);
    ghosts_start(ghosts, sph->record, p->count, stride * sizeof *sph->record);
    pack_images(sph, simulation, forces, ghosts->remotes, ghosts->early);
    double *empty = sph->record + (size_t)(p->count + ghosts->count) * stride;
    memset(empty, 0, stride * sizeof *empty);
    if (forces) {
        empty[hllc_density(simulation->dimension)] = 1.0;
        empty[hllc_response(simulation->dimension) + (sph->hllc.viscous ? 0 : 1)] = 1.0;
    }
}

/* Records of other ranks' particles, and of their images. */
static void pack_rest(struct sph *sph, const struct simulation *simulation, bool forces)
{
    struct ghosts *ghosts = &sph->neighbours.ghosts;
    ghosts_finish(ghosts);
    pack_images(sph, simulation, forces, ghosts->early, ghosts->count);
}

/* The hoop stress, and the hoop strain u/r, which gradients of this method need no correction for. */
static void add_hoop(const struct sph *sph, const struct simulation *simulation,
                     const struct hllc_fields *f)
{
    const struct particles *p = &simulation->particles;
    for (int32_t i = 0; i < p->count; i++)
        f->sph.rates.hoop_strain[i] = 1.0;
    sph_add_hoop(sph, simulation, &f->sph);
    for (int32_t i = 0; i < p->count; i++)
        f->sph.density_rate[i] -= p->density[i] * f->sph.rates.strain_rate[i][2];
}

static struct hllc_options options_of(const struct sph_parameters *parameters)
{
    return (struct hllc_options){
        .others_share = parameters->correction == SPH_CORRECTION_SYMMETRIC ? 0.5 : 0.0,
        .scalars_share = parameters->reconstruction == SPH_RECONSTRUCTION_ALL ? 1.0 : 0.0,
        .parting = parameters->approach_switch ? 0.0 : (double)INFINITY,
        .squares = parameters->pair_stress == SPH_PAIR_STRESS_SQUARES ? 1.0 : 0.0,
        .alpha = parameters->viscosity_alpha,
        .beta = parameters->viscosity_beta};
}

void hllc_find_rates(struct sph *sph, struct simulation *simulation, const struct hllc_fields *f)
{
    const struct particles *p = &simulation->particles;
    const struct pair_rates *rates = &f->sph.rates;
    struct hllc_loop loop = {.kind = sph->hllc,
                             .options = options_of(&sph->parameters),
                             .record = sph->record,
                             .empty = p->count + sph->neighbours.ghosts.count,
                             .smoothing = sph->parameters.smoothing,
                             .neighbours = &sph->neighbours,
                             .by_mass = sph->parameters.continuity == SPH_CONTINUITY_MASS,
                             .rates = {f->correction, f->slopes, rates->strain_rate, rates->spin,
                                       f->sph.density_rate, rates->acceleration, rates->power,
                                       rates->wall, rates->hoop_pull}};
    for (int pass = 0; pass < 2; pass++) {
        double begin = clock_seconds();
        pack(sph, simulation, f, pass == 1);
        simulation_spend(simulation, "records", clock_seconds() - begin);
        begin = clock_seconds();
        for (int rest = 0; rest < 2; rest++) {
            if (rest)
                pack_rest(sph, simulation, pass == 1);
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
            for (int32_t b = 0; b < p->blocks; b++)
                if (neighbours_inner(&sph->neighbours, b) != rest)
                    (pass ? hllc_find_forces : hllc_find_gradients)(
                        &loop, p->block[b].first, p->block[b].first + p->block[b].count);
        }
        simulation_spend(simulation, pass ? "pairs" : "gradients", clock_seconds() - begin);
    }
    if (sph->hllc.depth)
        add_hoop(sph, simulation, f);
}

void hllc_limit_step(const struct sph *sph, const struct simulation *simulation,
                     const struct hllc_fields *f, struct limit *limit)
{
    const struct particles *p = &simulation->particles;
    double ratio = sph->parameters.courant * sph->parameters.smoothing;
    double smallest = (double)INFINITY;
    uint64_t id = UINT64_MAX;
#pragma omp parallel for schedule(static) num_threads(simulation->threads) reduction(min : smallest)
    for (int32_t i = 0; i < p->count; i++)
        smallest = minimum(smallest, ratio * f->sph.diameter[i] / f->sph.sound_long[i]);
#pragma omp parallel for schedule(static) num_threads(simulation->threads) reduction(min : id)
    for (int32_t i = 0; i < p->count; i++)
        if (ratio * f->sph.diameter[i] / f->sph.sound_long[i] == smallest && p->id[i] < id)
            id = p->id[i];
    *limit = sph_least_limit(simulation, (struct limit){smallest, "sound speed", id});
}
