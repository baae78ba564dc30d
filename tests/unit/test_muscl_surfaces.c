/* What the second-order contact method does where matter ends and where it meets again: the force
 * that is expected at free surfaces, thin plates that ring out, and density that follows the
 * packing of particles. */
#include "populations.h"
#include "second_order.h"
#include "sph/kernel.h"

/* Uniform stress, and particles that know no slopes and stand still: a loop over records of this
 * very moment. */
static void sum_uniform_stress(struct running *run, const double stress[6])
{
    const struct particles *p = particles_of(&run->simulation);
    const struct muscl_fields f = muscl_fields_of(&run->sph, &run->simulation);
    const struct muscl_kind kind = muscl_kind_of(&run->sph);
    const double mean = (stress[0] + stress[1] + stress[2]) / 3.0;
    prepare(run); /* corrections */
    for (int32_t i = 0; i < p->count; i++) {
        p->pressure[i] = -mean;
        for (int c = 0; c < 6; c++)
            p->deviator[i][c] = stress[c] - (c < 3 ? mean : 0.0);
    }
    const size_t axes = (size_t)p->count * (size_t)kind.dimension, size = sizeof(double);
    memset(f.own.velocity_gradient, 0, axes * (size_t)kind.dimension * size);
    memset(f.own.stress_gradient, 0, axes * (size_t)muscl_stresses(kind) * size);
    run->sph.ahead = 0.0;
    muscl_pack(&run->sph, &run->simulation);
    const struct muscl_loop loop = loop_of(run);
    muscl_loop_run(&loop, 0, p->count);
}

/* Forces at a free plane of a lattice over its traction sigma.n/D: what is expected there, and what
 * the pairs make of it in the first layer and in all. Directions are exact; with one neighbour to
 * the other side so is the amount. */
static void the_force_expected_at_a_free_plane_is_its_traction_over_a_layer(void **state)
{
    (void)state;
    static const double stress[6] = {-2e8, -5e7, -1e8, 4e7, 2e7, -5e7}; /* no tension */
    static const struct {
        const char *text, *smoothing;
        double expected, pairs;
    } faces[] = {
        {BODY("1", METAL, "metal", "{from: [0 mm], to: [12 mm]}"), "1", 1.0, 1.0},
        {BODY("1", METAL, "metal", "{from: [0 mm], to: [12 mm]}"), "1.2", 0.9452, 0.9561},
        {BODY("2", METAL, "metal", "{from: [0 mm, 0 mm], to: [12 mm, 12 mm]}"), "1", 1.0679,
         0.9369},
        {BODY("2", METAL, "metal", "{from: [0 mm, 0 mm], to: [12 mm, 12 mm]}"), "1.2", 0.9824,
         0.8947},
        {BODY("3", METAL, "metal", "{from: [0 mm, 0 mm, 0 mm], to: [11 mm, 11 mm, 11 mm]}"), "1",
         1.0875, 0.8922},
        {BODY("3", METAL, "metal", "{from: [0 mm, 0 mm, 0 mm], to: [11 mm, 11 mm, 11 mm]}"), "1.2",
         1.0011, 0.8470}};
    for (size_t k = 0; k < COUNT_OF(faces); k++) {
        char setting[64];
        snprintf(setting, sizeof setting, "solver.sph.smoothing=%s", faces[k].smoothing);
        const struct variant variant = {"", 1, 1.0, setting, false};
        struct running *run = begin_fresh(faces[k].text, &variant);
        const struct particles *p = particles_of(&run->simulation);
        sum_uniform_stress(run, stress);
        const struct muscl_fields f = muscl_fields_of(&run->sph, &run->simulation);
        const double traction[3] = {stress[0], stress[3], stress[5]};
        double all[3] = {0.0};
        for (int32_t i = 0; i < p->count; i++) {
            bool middle = p->position[i][0] < 5e-3;
            for (int axis = 1; axis < p->dimension; axis++) /* one row across the face */
                middle = middle && fabs(p->position[i][axis] - 5.6e-3) < 0.5e-3;
            for (int axis = 0; axis < p->dimension && middle; axis++) {
                const double pairs = f.sph.rates.acceleration[i][axis] * p->density[i];
                const double scale = traction[axis] / 1e-3;
                all[axis] += pairs;
                if (p->position[i][0] > 1e-3)
                    continue;
                assert_near(f.own.force[i][axis] / scale, faces[k].expected, 1e-4);
                assert_near(pairs / scale, faces[k].pairs, 1e-4);
            }
        }
        for (int axis = 0; axis < p->dimension; axis++)
            assert_close(all[axis], traction[axis] / 1e-3, 1e-9);
        end(run);
    }
}

/* Three layers, 5 mm each, in the first mode of their thickness. Stress has no slope in it: but for
 * the traction that ends at the faces, half a step ahead would know no force, and the mode would
 * grow a hundredfold in a millisecond. */
#define PLATE(dimension, box, walls)                                                          \
    "format: 1\ndimension: " dimension "\nresolution: 5 mm\nsolver: {sph: {method: muscl}}\n" \
    "run: {until: 1 s}\n"                                                                     \
    "materials:\n"                                                                            \
    "  rubber:\n"                                                                             \
    "    eos: {rubber: {density: 1200 kg/m^3, sound: 850 m/s}}\n"                             \
    "    strength: {perfect-plastic: {shear_modulus: 190.7 MPa, yield: 1e9 GPa}}\n"           \
    "bodies:\n  plate: {material: rubber, box: " box "}\n"                                    \
    "walls:\n"                                                                                \
    "  left: {mirror: x, at: 0 mm, side: low}\n"                                              \
    "  right: {mirror: x, at: 20 mm, side: high}\n" walls

static double kinetic_energy(const struct particles *p)
{
    double sum = 0.0;
    for (int32_t i = 0; i < p->count; i++)
        for (int axis = 0; axis < 3; axis++)
            sum += 0.5 * p->mass[i] * square(p->velocity[i][axis]);
    return sum;
}

static void a_plate_of_three_layers_that_is_shaken_in_its_thickness_comes_to_rest(void **state)
{
    (void)state;
    static const char *const plates[] = {
        PLATE("2", "{from: [0 mm, 0 mm], to: [20 mm, 15 mm]}", ""),
        PLATE("3", "{from: [0 mm, 0 mm, 0 mm], to: [20 mm, 15 mm, 20 mm]}",
              "  near: {mirror: z, at: 0 mm, side: low}\n"
              "  far: {mirror: z, at: 20 mm, side: high}\n")};
    static const char *const courants[] = {"solver.sph.courant=0.4", "solver.sph.courant=0.45",
                                           "solver.sph.courant=0.2"};
    for (size_t k = 0; k < COUNT_OF(plates); k++)
        for (size_t c = 0; c < COUNT_OF(courants); c++) {
            const struct variant variant = {"", 1, 1.0, courants[c], false};
            struct running *run = begin_fresh(plates[k], &variant);
            struct particles *p = particles_of(&run->simulation);
            for (int32_t i = 0; i < p->count; i++)
                p->velocity[i][1] = fabs(p->position[i][1] - 7.5e-3) < 2e-3 ? -2.0 : 1.0;
            const double start = kinetic_energy(p);
            while (run->simulation.time < 1e-3)
                step(run, 1);
            assert_true(start > 0.0 && kinetic_energy(p) < 1e-6 * start);
            end(run);
        }
}

static const char *const lattices[] = {
    BODY("2", METAL, "metal", "{from: [-5 mm, -5 mm], to: [5 mm, 5 mm]}"),
    BODY("3", METAL, "metal", "{from: [-4 mm, -4 mm, -4 mm], to: [4 mm, 4 mm, 4 mm]}")};

/* Volumes stay, the space that they stand in becomes SPACE of what it was. */
static void put_into(struct running *run, double space)
{
    struct particles *p = particles_of(&run->simulation);
    const double by = pow(space, 1.0 / p->dimension);
    for (int32_t i = 0; i < p->count; i++)
        for (int axis = 0; axis < p->dimension; axis++)
            p->position[i][axis] *= by;
}

/* A lattice at rest without stress, to the last digit. */
static struct running *begin_lattice(const char *text)
{
    struct running *run = begin_fresh(text, &plain);
    struct particles *p = particles_of(&run->simulation);
    memset(p->pressure, 0, (size_t)p->count * sizeof *p->pressure);
    return run;
}

/* What the volumes about particle I fill of its space: the trace of its second moment over that of
 * a complete lattice. */
static double packing_of(const struct running *run, int32_t i)
{
    const struct particles *p = particles_of(&run->simulation);
    const double *diameter = particles_field(p, "diameter");
    double sum = 0.0;
    for (int32_t j = 0; j < p->count; j++) {
        const double x = p->position[j][0] - p->position[i][0];
        const double y = p->position[j][1] - p->position[i][1];
        const double z = p->position[j][2] - p->position[i][2];
        const double r = sqrt(x * x + y * y + z * z), both = diameter[i] + diameter[j];
        const double share = 2.0 * diameter[i] / both;
        sum -= share * p->mass[j] / p->density[j] * r *
               kernel_slope(r, 2.0 / (run->sph.parameters.smoothing * both), p->dimension);
    }
    return sum / p->dimension;
}

/* The mean of what packing exceeds START by over the neighbours of one size and density. */
static double mean_excess_of(const struct running *run, int32_t i)
{
    const struct particles *p = particles_of(&run->simulation);
    const struct sph_fields f = sph_fields_of(&run->sph, &run->simulation);
    double sum = 0.0, weight = 0.0;
    for (int32_t j = 0; j < p->count; j++) {
        const double x = p->position[j][0] - p->position[i][0];
        const double y = p->position[j][1] - p->position[i][1];
        const double z = p->position[j][2] - p->position[i][2];
        const double w =
            kernel_value(sqrt(x * x + y * y + z * z),
                         1.0 / (run->sph.parameters.smoothing * f.diameter[i]), p->dimension);
        sum += w * minimum(0.1, maximum(-0.05, f.packing[j][PACKING_EXCESS]));
        weight += w;
    }
    return sum / weight;
}

/* There are no rates; what is kept is what packing exceeds START by, less 0.003. Gives how many
 * particles have an excess. */
static int32_t assert_squeeze(const struct running *run, const double *start)
{
    const struct particles *p = particles_of(&run->simulation);
    const struct sph_fields f = sph_fields_of(&run->sph, &run->simulation);
    int32_t squeezed = 0;
    for (int32_t i = 0; i < p->count; i++) {
        const double over = packing_of(run, i) - maximum(1.0, start[i]) - 0.003;
        for (int c = 0; c < 6; c++)
            assert_near(f.rates.strain_rate[i][c], 0.0, 1e-12 * f.sound_long[i] / f.diameter[i]);
        assert_near(f.packing[i][PACKING_EXCESS], over, 1e-12);
        assert_true(f.rates.power[i] == 0.0 && f.rates.acceleration[i][0] == 0.0);
        squeezed += over > 0.0;
    }
    return squeezed;
}

static double *packing_of_all(const struct running *run)
{
    const struct particles *p = particles_of(&run->simulation);
    double *packing = malloc((size_t)p->count * sizeof *packing);
    for (int32_t i = 0; i < p->count; i++)
        packing[i] = packing_of(run, i);
    return packing;
}

static void a_lattice_at_rest_is_not_squeezed(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(lattices); k++) {
        struct running *run = begin_lattice(lattices[k]);
        double *start = packing_of_all(run);
        for (int more = 0; more < 2; more++) {
            prepare(run);
            assert_int_equal(assert_squeeze(run, start), 0);
        }
        free(start);
        end(run);
    }
}

static void volumes_that_overlap_are_squeezed_and_volumes_apart_are_not(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(lattices); k++) {
        struct running *run = begin_lattice(lattices[k]);
        const struct particles *p = particles_of(&run->simulation);
        double *start = packing_of_all(run);
        prepare(run);
        run->simulation.step++;
        put_into(run, 1.05);
        prepare(run);
        assert_int_equal(assert_squeeze(run, start), 0);
        put_into(run, 1.0 / square(1.05));
        prepare(run);
        prepare(run); /* now neighbours tell of the same places */
        assert_true(assert_squeeze(run, start) > p->count / 8);

        /* one step: density follows with C/D, the deviator and the energy do not; cold matter of
         * more density has no heat to pay for it */
        const struct sph_fields f = sph_fields_of(&run->sph, &run->simulation);
        int32_t most = 0, cold = -1;
        for (int32_t i = 0; i < p->count; i++) {
            assert_near(f.packing[i][PACKING_MEAN], mean_excess_of(run, i), 1e-12);
            if (f.packing[i][PACKING_MEAN] > f.packing[most][PACKING_MEAN])
                most = i;
            if (i != most && f.packing[i][PACKING_MEAN] > 0.0)
                cold = i;
        }
        assert_true(cold >= 0 && cold != most);
        p->density[cold] *= 1.1;
        const double density = p->density[most], dense = p->density[cold], dt = run->limit.dt;
        const double rate = f.packing[most][PACKING_MEAN] * f.sound_long[most] / f.diameter[most];
        assert_success(run->solver->advance(&run->sph, &run->simulation, dt));
        assert_close(p->density[most], density * (1.0 + dt * rate), 1e-12);
        assert_close(p->density[cold], dense, 1e-12);
        for (int32_t i = 0; i < p->count; i++) {
            assert_near(p->energy[i], 0.0, 1e-12);
            for (int c = 0; c < 6; c++)
                assert_near(p->deviator[i][c], 0.0, 1e-4);
        }

        /* apart again, it gives back what it has got, and no more */
        assert_close(f.packing[most][PACKING_GROWTH], dt * rate, 1e-12);
        put_into(run, 1.1);
        for (int more = 0; more < 50; more++) {
            for (int32_t i = 0; i < p->count; i++)
                p->velocity[i][0] = p->velocity[i][1] = p->velocity[i][2] = 0.0;
            prepare(run);
            for (int32_t i = 0; i < p->count; i++) {
                memset(f.rates.acceleration[i], 0, sizeof f.rates.acceleration[i]);
                memset(f.rates.strain_rate[i], 0, sizeof f.rates.strain_rate[i]);
                memset(f.volume[i], 0, sizeof f.volume[i]);
                f.rates.power[i] = 0.0;
            }
            assert_success(run->solver->advance(&run->sph, &run->simulation, dt));
        }
        assert_true(f.packing[most][PACKING_GROWTH] == 0.0);
        assert_close(p->density[most], density, 1.01 * square(dt * rate));
        free(start);
        end(run);
    }
}

/* Rings, and what a case begins with, may be packed more densely than a lattice. */
static void packing_counts_from_that_of_the_start(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(lattices); k++) {
        struct running *run = begin_lattice(lattices[k]);
        const struct particles *p = particles_of(&run->simulation);
        const double(*kept)[PACKING_NUMBERS] = particles_field(p, "packing");
        put_into(run, 0.95);
        double *start = packing_of_all(run);
        prepare(run);
        run->simulation.step++;
        assert_int_equal(assert_squeeze(run, start), 0);
        for (int32_t i = 0; i < p->count; i++)
            assert_close(kept[i][PACKING_START], maximum(1.0, start[i]), 1e-13);
        put_into(run, 0.95);
        prepare(run);
        assert_true(assert_squeeze(run, start) > p->count / 8);
        free(start);
        end(run);
    }
}

/* Plastic flow draws a block out to two and a half times its length: columns of particles stand
 * further apart than the support of a lattice reaches, which lets density go astray by half a per
 * cent. */
static void what_flow_draws_out_keeps_its_neighbours_and_its_density(void **state)
{
    (void)state;
    static const char *const block = HEAD(
        "2") "materials:\n" METAL
             "bodies:\n  body: {material: metal, box: {from: [-8 mm, -8 mm], to: [8 mm, 8 mm]}, "
             "velocity: [5e4 1/s*x, -5e4 1/s*y]}\n";
    static const struct variant soft = {
        "", 1, 1.0, "materials.metal.strength.perfect-plastic.yield=1 MPa", false};
    for (int strong = 0; strong < 2; strong++) {
        struct running *run = begin_fresh(block, strong ? &plain : &soft);
        const struct particles *p = particles_of(&run->simulation);
        double widest = 1.0;
        while (run->simulation.time < (strong ? 2e-6 : 24e-6)) {
            step(run, 1);
            const struct sph_fields f = sph_fields_of(&run->sph, &run->simulation);
            for (int32_t i = 0; i < p->count; i++)
                widest = maximum(widest, f.support[i] / f.diameter[i]);
        }
        for (int32_t i = 0; i < p->count && !strong; i++)
            assert_near(p->density[i], 2700.0, 0.003 * 2700.0);
        if (strong) /* what springs back has not flowed, and its elastic strain is small */
            assert_true(widest < 1.05);
        else
            assert_true(widest > 1.2 && widest <= 3.0);
        end(run);
    }
}

/* The force on the particle in the middle of a body under uniform stress, per unit of mass: it was
 * moved by SHIFT along x, and its place is known since a step. */
static double force_on_the_middle(const char *text, double stress, double shift)
{
    const double uniform[6] = {stress, stress, stress, 0.0, 0.0, 0.0};
    struct running *run = begin_fresh(text, &plain);
    struct particles *p = particles_of(&run->simulation);
    int32_t middle = 0;
    double nearest = 1.0;
    for (int32_t i = 0; i < p->count; i++) {
        const struct vec3 x = vector_at(p->position[i]);
        if (vec3_dot(x, x) < nearest) {
            nearest = vec3_dot(x, x);
            middle = i;
        }
    }
    p->position[middle][0] += shift;
    sum_uniform_stress(run, uniform);
    const struct muscl_fields f = muscl_fields_of(&run->sph, &run->simulation);
    const double force = f.sph.rates.acceleration[middle][0];
    end(run);
    return force;
}

/* Under pressure what is open pushes it back; in tension the closure does. */
static void a_particle_beside_its_place_is_drawn_back_in_tension_as_well(void **state)
{
    (void)state;
    static const char *const texts[] = {
        BODY("2", METAL, "metal", "{from: [-5.5 mm, -5.5 mm], to: [5.5 mm, 5.5 mm]}"),
        BODY("2", LIQUID, "liquid", "{from: [-5.5 mm, -5.5 mm], to: [5.5 mm, 5.5 mm]}"),
        BODY("2", METAL, "metal", "{from: [-6 mm, -6 mm], to: [6 mm, 6 mm]}, lattice: hexagonal"),
        BODY("3", METAL, "metal",
             "{from: [-4.5 mm, -4.5 mm, -4.5 mm], to: [4.5 mm, 4.5 mm, 4.5 mm]}"),
        BODY("3", LIQUID, "liquid",
             "{from: [-4.5 mm, -4.5 mm, -4.5 mm], to: [4.5 mm, 4.5 mm, 4.5 mm]}")};
    for (size_t k = 0; k < COUNT_OF(texts); k++) {
        const double shift = 1e-5, stress = 1e8;
        const double pushed = force_on_the_middle(texts[k], -stress, shift) -
                              force_on_the_middle(texts[k], -stress, 0.0);
        const double drawn = force_on_the_middle(texts[k], stress, shift) -
                             force_on_the_middle(texts[k], stress, 0.0);
        assert_true(pushed < 0.0);
        assert_true(drawn < 0.0);
        assert_true(drawn > pushed); /* softer than under pressure */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_force_expected_at_a_free_plane_is_its_traction_over_a_layer),
        cmocka_unit_test(a_plate_of_three_layers_that_is_shaken_in_its_thickness_comes_to_rest),
        cmocka_unit_test(a_lattice_at_rest_is_not_squeezed),
        cmocka_unit_test(volumes_that_overlap_are_squeezed_and_volumes_apart_are_not),
        cmocka_unit_test(packing_counts_from_that_of_the_start),
        cmocka_unit_test(what_flow_draws_out_keeps_its_neighbours_and_its_density),
        cmocka_unit_test(a_particle_beside_its_place_is_drawn_back_in_tension_as_well),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
