/* Records of the contact schemes from the states of particles; see kernel.h for their order. */
#include <string.h>

#include "material/material.h"
#include "sph/contact/contact.h"
#include "sph/record.h"

/* The tension along a contact and the shear stress across it at which a contact of particle I
 * breaks: those of the threshold; none where it has failed; and no limits otherwise. */
static void pack_breaking(const struct simulation *simulation, const struct particles *p, int32_t i,
                          double breaking[2])
{
    const struct material *material = &simulation->problem->material[p->material[i]];
    const struct failure_threshold *threshold = &material->failure.of.threshold;
    breaking[0] = breaking[1] = INFINITY;
    if (failure_traits(&material->failure).at_contacts) {
        const double *scatter = p->history[HISTORY_strength_scatter];
        const double relative = scatter ? 1.0 + scatter[i] : 1.0;
        breaking[0] = relative * threshold->strength;
        breaking[1] = isnan(threshold->shear) ? breaking[0] : relative * threshold->shear;
    } else if (material_breaks(material) && p->history[HISTORY_damage][i] >= 1.0) {
        breaking[0] = 0.0;
    }
}

/* Record of particle I. What KIND has beyond the plain is a constant where this is inlined. */
BOLIDE_INLINE void pack_owned(const struct contact_state *state,
                              const struct simulation *simulation, const struct sph_fields *f,
                              struct pair_kind kind, int32_t i, double *record)
{
    bool shear = kind.shear;
    const struct particles *p = f->particles;
    int dimension = simulation->problem->dimension, k = 0;
    for (int axis = 0; axis < dimension; axis++)
        record[k++] = p->position[i][axis];
    record[k++] = f->diameter[i];
    record[k++] = kind.depth ? sph_volume(simulation, f, i) : p->mass[i] / p->density[i];
    for (int axis = 0; axis < dimension; axis++)
        record[k++] = p->velocity[i][axis];
    const double *s = p->deviator[i];
    double pressure = p->pressure[i] + (f->viscosity ? f->viscosity[i] : 0.0);
    record[k++] = s[0] - pressure;
    if (shear && dimension == 2) {
        record[k++] = s[1] - pressure;
        record[k++] = s[3];
    }
    if (shear && dimension == 3) {
        record[k++] = s[1] - pressure;
        record[k++] = s[2] - pressure;
        memcpy(record + k, s + 3, 3 * sizeof *s);
        k += 3;
    }
    record[k++] = p->density[i] * f->sound_long[i];
    if (shear)
        record[k++] = p->density[i] * f->sound_shear[i];
    if (record_has_shock_slope(kind)) {
        record[k++] = p->density[i];
        record[k++] = state->shock_slope[p->material[i]];
    }
    if (kind.depth)
        record[k++] = sph_depth(simulation, f, i);
    if (kind.turn) {
        const double *spin = f->rates.spin[i];
        memcpy(record + k, dimension == 2 ? spin + 2 : spin,
               (dimension == 2 ? 1 : 3) * sizeof *spin);
        k += dimension == 2 ? 1 : 3;
    }
    if (kind.breaks)
        pack_breaking(simulation, p, i, record + k);
}

/* Turns the record of a particle into that of its image: place mirrored, normal velocity and the
 * shear stresses with one normal index negated, spin as a pseudovector; behind the axis a radius is
 * negative. */
static void reflect(const struct sph *sph, const struct simulation *simulation, image_code image,
                    double *record)
{
    const struct contact_state *state = sph->state;
    const struct pair_kind kind = state->kind;
    int dimension = simulation->problem->dimension;
    struct vec3 sign = image_sign(&simulation->problem->images, image);
    sph_reflect_motion(simulation, image, record);
    if (kind.shear)
        sph_reflect_tensor(dimension, sign, record + record_stress(dimension));
    if (sph_axisymmetric(simulation) && image % 3 == 1)
        record[record_depth(kind)] *= -1.0;
    double *spin = record + record_spin(kind);
    if (kind.turn && dimension == 2)
        spin[0] *= sign.x * sign.y;
    if (kind.turn && dimension == 3) {
        spin[0] *= sign.y * sign.z;
        spin[1] *= sign.z * sign.x;
        spin[2] *= sign.x * sign.y;
    }
}

struct sph_records contact_records(const struct sph *sph)
{
    return (struct sph_records){sph->record, sph->stride, reflect, NULL};
}

void contact_pack(struct sph *sph, const struct simulation *simulation,
                  const struct sph_fields *fields)
{
    const struct contact_state *state = sph->state;
    const struct pair_kind kind = state->kind;
    const struct sph_records records = contact_records(sph);
    const bool plain = !kind.depth && !kind.turn;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < sph->particles->count; i++) {
        double *record = sph->record + (size_t)i * sph->stride;
        if (plain) {
            const struct pair_kind same = {kind.dimension, kind.shear, kind.star,  kind.drift,
                                           false,          false,      kind.breaks};
            pack_owned(state, simulation, fields, same, i, record);
        } else {
            pack_owned(state, simulation, fields, kind, i, record);
        }
    }
    double *empty = sph_records_start(sph, simulation, &records);
    /* The Riemann problem of the record that fills up lanes must have an answer. */
    if (record_has_shock_slope(kind)) {
        const int dimension = kind.dimension,
                  shock_slope = record_shock_slope(dimension, kind.shear);
        empty[record_stress(dimension)] = -1.0;
        empty[record_impedance(dimension, kind.shear)] = 1.0;
        empty[shock_slope] = 1.0;
        empty[shock_slope + 1] = 2.0;
    }
}
