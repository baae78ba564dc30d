/* Cases of the second-order method, and its pair loop in the hands of a test. */
#ifndef BOLIDE_TEST_SECOND_ORDER_H
#define BOLIDE_TEST_SECOND_ORDER_H

#include "populations.h"
#include "running.h"

#define METAL                                                                                \
    "  metal:\n"                                                                             \
    "    eos: {mie-grueneisen: {density: 2700 kg/m^3, sound: 5350 m/s, slope: 1.35, gamma: " \
    "2.17, bulk_modulus: 73 GPa}}\n"                                                         \
    "    strength: {perfect-plastic: {shear_modulus: 23 GPa, yield: 100 GPa}}\n"
#define LIQUID "  liquid: {eos: {barotropic: {density: 1500 kg/m^3, bulk_modulus: 20 GPa}}}\n"
#define HEAD(dimension)                                       \
    "format: 1\ndimension: " dimension "\nresolution: 1 mm\n" \
    "solver: {sph: {method: muscl, smoothing: 1.2}}\n"        \
    "run: {until: 1 s}\n"
#define BODY(dimension, matter, of, box) \
    HEAD(dimension) "materials:\n" matter "bodies:\n  body: {material: " of ", box: " box "}\n"

static const struct variant plain = {"plain", 1, 1.0, NULL, false};

static inline void prepare(struct running *run)
{
    assert_success(run->solver->prepare(&run->sph, &run->simulation, &run->limit));
}

/* The loop over RUN's records as they are packed, into the store's fields. */
static inline struct muscl_loop loop_of(const struct running *run)
{
    const struct particles *p = particles_of(&run->simulation);
    const struct muscl_fields f = muscl_fields_of(&run->sph, &run->simulation);
    return (struct muscl_loop){.kind = muscl_kind_of(&run->sph),
                               .record = run->sph.record,
                               .empty = p->count + run->sph.neighbours.ghosts.count,
                               .place = run->sph.place,
                               .smoothing = run->sph.parameters.smoothing,
                               .neighbours = &run->sph.neighbours,
                               .groups = &run->sph.groups,
                               .body = p->body,
                               .density = p->density,
                               .velocity = (const double(*)[3])p->velocity,
                               .rates = {f.sph.rates, f.own.correction, f.own.velocity_gradient,
                                         f.own.stress_gradient, f.own.force, f.sph.packing,
                                         f.sph.volume, f.own.closure, f.own.credit}};
}

#endif
