/* Records of SPH with corrected gradients from the states of particles, for both passes; see
 * kernel.h for their order. */
#include <string.h>

#include "material/material.h"
#include "sph/hllc/hllc.h"

/* Writes the part that both records begin with, and returns its end. */
static double *pack_plain(const struct simulation *simulation, const struct hllc_fields *f,
                          int32_t i, double *record)
{
    const struct particles *p = f->sph.particles;
    int dimension = simulation->problem->dimension;
    memcpy(record, p->position[i], (size_t)dimension * sizeof *record);
    record[dimension] = f->sph.diameter[i];
    record[dimension + 1] = p->mass[i] / p->density[i];
    memcpy(record + dimension + 2, p->velocity[i], (size_t)dimension * sizeof *record);
    return record + 2 * dimension + 2;
}

/* Writes the components of a symmetric tensor, and returns their end. */
static double *pack_tensor(int dimension, const double *tensor, double less, double *record)
{
    *record++ = tensor[0] - less;
    if (dimension > 1) {
        *record++ = tensor[1] - less;
        *record++ = tensor[3];
    }
    return record;
}

static void pack_for_gradients(const struct simulation *simulation, const struct hllc_fields *f,
                               int32_t i, double *record)
{
    const struct particles *p = f->sph.particles;
    double *next = pack_plain(simulation, f, i, record);
    if (simulation->problem->dimension == 1) {
        next[0] = p->density[i];
        next[1] = p->pressure[i];
        next[2] = p->deviator[i][0];
    }
}

static void pack_for_forces(const struct hllc_kind kind, const struct simulation *simulation,
                            const struct hllc_fields *f, int32_t i, double *record)
{
    const struct particles *p = f->sph.particles;
    const struct material *material = &simulation->problem->material[p->material[i]];
    int dimension = simulation->problem->dimension;
    double *next = pack_plain(simulation, f, i, record);
    *next++ = p->density[i];
    next = pack_tensor(dimension, p->deviator[i], p->pressure[i], next);
    next = pack_tensor(dimension, f->own.correction[i], 0.0, next);
    if (kind.viscous) {
        *next++ = f->sph.sound_long[i];
    } else {
        struct point point = {.density = p->density[i], .pressure = p->pressure[i]};
        particle_load_history(p, i, point.history);
        *next++ = p->pressure[i];
        *next++ = f->own.dp_drho[i];
        *next++ = f->own.dp_de[i];
        *next++ = strength_shear_modulus(&material->strength);
        *next++ = strength_yield(&material->strength, &point);
    }
    if (!kind.reconstructed)
        return;
    *next++ = p->material[i];
    next = pack_tensor(dimension, f->sph.rates.strain_rate[i], 0.0, next);
    if (f->own.slopes)
        memcpy(next, f->own.slopes[i], sizeof f->own.slopes[i]);
    else if (dimension == 1)
        memset(next, 0, 3 * sizeof *next);
}

static void reflect_for_gradients(const struct sph *sph, const struct simulation *simulation,
                                  image_code image, double *record)
{
    (void)sph;
    sph_reflect_motion(simulation, image, record);
}

static void reflect_for_forces(const struct sph *sph, const struct simulation *simulation,
                               image_code image, double *record)
{
    const struct hllc_state *state = sph->state;
    const struct hllc_kind kind = state->kind;
    int dimension = simulation->problem->dimension;
    struct vec3 sign = image_sign(&simulation->problem->images, image);
    sph_reflect_motion(simulation, image, record);
    sph_reflect_tensor(dimension, sign, record + hllc_stress(dimension));
    sph_reflect_tensor(dimension, sign, record + hllc_correction(dimension));
    if (!kind.reconstructed)
        return;
    sph_reflect_tensor(dimension, sign, record + hllc_strain(kind));
    for (int s = 0; dimension == 1 && s < 3; s++)
        record[hllc_slopes(kind) + s] *= sign.x;
}

struct sph_records hllc_records(const struct sph *sph, bool forces)
{
    return forces ? (struct sph_records){sph->record, sph->stride, reflect_for_forces, NULL}
                  : (struct sph_records){sph->record, HLLC_GRADIENT_STRIDE, reflect_for_gradients,
                                         NULL};
}

void hllc_pack(struct sph *sph, const struct simulation *simulation, const struct hllc_fields *f,
               bool forces)
{
    const struct hllc_state *state = sph->state;
    const struct hllc_kind kind = state->kind;
    const struct sph_records records = hllc_records(sph, forces);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < sph->particles->count; i++) {
        double *record = records.first + (size_t)i * records.stride;
        if (forces)
            pack_for_forces(kind, simulation, f, i, record);
        else
            pack_for_gradients(simulation, f, i, record);
    }
    double *empty = sph_records_start(sph, simulation, &records);
    if (forces) { /* the record that fills up lanes must have a solvable Riemann problem */
        empty[hllc_density(kind.dimension)] = 1.0;
        empty[hllc_response(kind.dimension) + (kind.viscous ? 0 : 1)] = 1.0;
    }
}
