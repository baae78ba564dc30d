/* A scene with random states of matter, its records and the pair loop over it, packed apart from
 * the solver; and the comparison of its sums with the naive ones. */
#ifndef BOLIDE_TEST_TRIAL_H
#define BOLIDE_TEST_TRIAL_H

#include "scene.h"

#include "naive_pairs.h"

/* A scene whose store keeps the stress in `deviator`, the longitudinal and the shear impedance in
 * `energy` and `plastic_strain`; and the loop over it. */
struct trial {
    struct scene scene;
    struct pair_loop loop;
    double *record;
    int32_t records;
};

static inline double shock_slope_of(uint64_t id) { return 1.25 + 0.25 * (double)(id % 3); }

/* Depth and spin of a particle, where the kind has them. */
static inline double depth_of(struct pair_kind kind, uint64_t id)
{
    return kind.depth ? 0.4 + 0.3 * (double)(id % 5) : 1.0;
}
static inline double spin_of(struct pair_kind kind, uint64_t id, int axis)
{
    bool has = kind.turn && (kind.dimension == 3 || axis == 2);
    return has ? 700.0 * ((double)((id + (uint64_t)axis) % 7) - 3.0) : 0.0;
}

/* What contacts of a particle bear along and across them, where they break: some bear anything. */
static inline double bears_of(uint64_t id, int across)
{
    return id % 4 == 3 ? INFINITY : 4e8 * (double)((id + (uint64_t)across) % 4);
}

static inline void random_state(struct scene *scene, struct pair_kind kind, struct dice *dice)
{
    struct particles *p = &scene->particles;
    for (int32_t i = 0; i < p->count; i++) {
        p->density[i] = dice_between(dice, 500.0, 9000.0);
        p->mass[i] = p->density[i] * pow(scene_diameter(scene)[i], kind.dimension) *
                     dice_between(dice, 0.5, 1.5);
        for (int axis = 0; axis < kind.dimension; axis++)
            p->velocity[i][axis] = dice_between(dice, -1e3, 1e3);
        bool fluid = !kind.shear || p->id[i] % 4 == 0;
        bool gas = kind.star == STAR_EXACT_GAS;
        double pressure = dice_between(dice, gas ? 1e8 : -1e9, 3e9);
        for (int k = 0; k < 6; k++)
            p->deviator[i][k] =
                (k < 3 ? -pressure : 0.0) + (fluid ? 0.0 : dice_between(dice, -1e9, 1e9));
        p->energy[i] = p->density[i] * dice_between(dice, 1e3, 6e3);
        if (gas)
            p->energy[i] = sqrt(shock_slope_of(p->id[i]) * pressure * p->density[i]);
        p->plastic_strain[i] = fluid ? 0.0 : p->density[i] * dice_between(dice, 5e2, 3e3);
    }
}

static inline void pack(const struct trial *t, int32_t i, double *record)
{
    static const int stresses_of[4][6] = {{0}, {0}, {0, 1, 3}, {0, 1, 2, 3, 4, 5}};
    const struct particles *p = &t->scene.particles;
    const int dimension = t->loop.kind.dimension;
    const bool shear = t->loop.kind.shear;
    for (int axis = 0; axis < dimension; axis++) {
        record[axis] = p->position[i][axis];
        record[record_velocity(dimension) + axis] = p->velocity[i][axis];
    }
    record[record_diameter(dimension)] = t->scene.reach.diameter[i];
    const struct pair_kind kind = t->loop.kind;
    record[record_volume(dimension)] = p->mass[i] / (p->density[i] * depth_of(kind, p->id[i]));
    for (int k = 0; k < record_stresses(dimension, shear); k++)
        record[record_stress(dimension) + k] = p->deviator[i][stresses_of[dimension][k]];
    record[record_impedance(dimension, shear)] = p->energy[i];
    if (shear)
        record[record_impedance(dimension, shear) + 1] = p->plastic_strain[i];
    if (record_has_shock_slope(t->loop.kind)) {
        record[record_shock_slope(dimension, shear)] = p->density[i];
        record[record_shock_slope(dimension, shear) + 1] = shock_slope_of(p->id[i]);
    }
    if (kind.depth)
        record[record_depth(kind)] = depth_of(kind, p->id[i]);
    for (int axis = dimension == 2 ? 2 : 0, k = 0; kind.turn && axis < 3; axis++)
        record[record_spin(kind) + k++] = spin_of(kind, p->id[i], axis);
    for (int across = 0; kind.breaks && across < 2; across++)
        record[record_breaking(kind) + across] = bears_of(p->id[i], across);
}

/* The record of a ghost from its particle, reflected. */
static inline void reflect(const struct trial *t, image_code image, double *record)
{
    const int dimension = t->loop.kind.dimension;
    struct vec3 sign = image_sign(&t->scene.mirrors, image), x = {record[0], 0.0, 0.0};
    x.y = dimension > 1 ? record[1] : 0.0;
    x.z = dimension > 2 ? record[2] : 0.0;
    x = image_position(&t->scene.mirrors, image, x);
    double place[3] = {x.x, x.y, x.z}, signs[3] = {sign.x, sign.y, sign.z};
    for (int axis = 0; axis < dimension; axis++) {
        record[axis] = place[axis];
        record[record_velocity(dimension) + axis] *= signs[axis];
    }
    double *stress = record + record_stress(dimension);
    if (t->loop.kind.shear && dimension == 2)
        stress[2] *= sign.x * sign.y;
    if (t->loop.kind.shear && dimension == 3) {
        stress[3] *= sign.x * sign.y;
        stress[4] *= sign.y * sign.z;
        stress[5] *= sign.z * sign.x;
    }
    if (t->loop.kind.depth && image % 3 == 1)
        record[record_depth(t->loop.kind)] *= -1.0;
    const double turned[3] = {sign.y * sign.z, sign.z * sign.x, sign.x * sign.y};
    for (int axis = dimension == 2 ? 2 : 0, k = 0; t->loop.kind.turn && axis < 3; axis++)
        record[record_spin(t->loop.kind) + k++] *= turned[axis];
}

static inline struct pair_rates rates_new(int32_t count)
{
    struct pair_rates rates = {.acceleration = calloc((size_t)count, 3 * sizeof(double)),
                               .power = calloc((size_t)count, sizeof(double)),
                               .strain_rate = calloc((size_t)count, 6 * sizeof(double)),
                               .spin = calloc((size_t)count, 3 * sizeof(double)),
                               .wall = calloc((size_t)count, 3 * sizeof(double)),
                               .drift = calloc((size_t)count, 3 * sizeof(double)),
                               .hoop_pull = calloc((size_t)count, sizeof(double)),
                               .hoop_strain = calloc((size_t)count, sizeof(double)),
                               .broken = calloc((size_t)count, sizeof(double))};
    return rates;
}

static inline void rates_free(struct pair_rates *rates)
{
    free(rates->acceleration);
    free(rates->power);
    free(rates->strain_rate);
    free(rates->spin);
    free(rates->wall);
    free(rates->drift);
    free(rates->hoop_pull);
    free(rates->hoop_strain);
    free(rates->broken);
}

/* Builds rows and records of a scene whose particles are in place. */
static inline void trial_prepare(struct trial *t, struct pair_kind kind)
{
    struct scene *scene = &t->scene;
    scene_build(scene);
    int32_t count = scene->particles.count, ghosts = scene->neighbours.ghosts.count;
    size_t stride = (size_t)record_stride(kind);
    t->records = count + ghosts + 1;
    /* Exactly as many doubles as there are records, so that a sanitizer sees what lies beyond. */
    free(t->record);
    t->record = aligned_alloc(64, (size_t)t->records * stride * sizeof(double));
    memset(t->record, 0, (size_t)t->records * stride * sizeof(double));
    t->loop = (struct pair_loop){.kind = kind,
                                 .record = t->record,
                                 .empty = count + ghosts,
                                 .smoothing = scene->reach.smoothing,
                                 .neighbours = &scene->neighbours,
                                 .groups = &scene->groups,
                                 .body = scene->particles.body,
                                 .density = scene->particles.density,
                                 .rates = rates_new(count)};
    for (int32_t i = 0; i < count; i++)
        pack(t, i, t->record + (size_t)i * stride);
    for (int32_t g = 0; g < ghosts; g++) {
        double *record = t->record + (size_t)(count + g) * stride;
        memcpy(record, t->record + (size_t)scene->neighbours.ghosts.source[g] * stride,
               stride * sizeof *record);
        reflect(t, scene->neighbours.ghosts.image[g], record);
    }
    if (record_has_shock_slope(kind)) { /* the empty record: a gas without volume */
        double *empty = t->record + (size_t)(count + ghosts) * stride;
        empty[record_stress(kind.dimension)] = -1.0;
        empty[record_impedance(kind.dimension, kind.shear)] = 1.0;
        empty[record_shock_slope(kind.dimension, kind.shear)] = 1.0;
        empty[record_shock_slope(kind.dimension, kind.shear) + 1] = 2.0;
    }
}

static inline void trial_destroy(struct trial *t)
{
    rates_free(&t->loop.rates);
    free(t->record);
    scene_destroy(&t->scene);
}

enum { WALLS = 1, LAWS = 2 };

static inline void trial_create(struct trial *t, struct pair_kind kind, int count, unsigned with,
                                uint64_t seed)
{
    struct dice dice = {seed};
    struct scene *scene = &t->scene;
    *t = (struct trial){.record = NULL};
    const double size = pow(count, 1.0 / kind.dimension);
    scene_create(scene, kind.dimension, count, 3.0, 0.15);
    for (int32_t i = 0; i < count; i++) {
        for (int axis = 0; axis < kind.dimension; axis++)
            scene->particles.position[i][axis] = dice_between(&dice, 0.0, size);
        scene_diameter(scene)[i] = dice_between(&dice, 0.5, 1.5);
    }
    if (with & WALLS)
        for (int axis = 0; axis < kind.dimension; axis++) {
            scene->mirrors.low[axis] = -0.1;
            scene->mirrors.high[axis] = axis == 1 ? (double)NAN : size + 0.1;
        }
    if (with & LAWS)
        scene->groups = (struct contact_groups){scene_group_of_body, scene_law, SCENE_BODIES, NULL};
    random_state(scene, kind, &dice);
    trial_prepare(t, kind);
}

static inline struct naive_particle naive_of(const struct trial *t, int32_t i, image_code image)
{
    static const int slot[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    const struct particles *p = &t->scene.particles;
    const int dimension = t->loop.kind.dimension;
    struct naive_particle n = {.mass = p->mass[i],
                               .density = p->density[i],
                               .diameter = t->scene.reach.diameter[i],
                               .z_long = p->energy[i],
                               .z_shear = dimension > 1 ? p->plastic_strain[i] : 0.0,
                               .shock_slope = shock_slope_of(p->id[i]),
                               .bears = {bears_of(p->id[i], 0), bears_of(p->id[i], 1)}};
    struct vec3 s = image_sign(&t->scene.mirrors, image),
                x = image_position(
                    &t->scene.mirrors, image,
                    vec3_make(p->position[i][0], p->position[i][1], p->position[i][2]));
    double sign[3] = {s.x, s.y, s.z}, place[3] = {x.x, x.y, x.z};
    const double turned[3] = {s.y * s.z, s.z * s.x, s.x * s.y};
    n.depth =
        depth_of(t->loop.kind, p->id[i]) * (t->loop.kind.depth && image % 3 == 1 ? -1.0 : 1.0);
    for (int a = 0; a < 3; a++) {
        n.x[a] = place[a];
        n.u[a] = sign[a] * p->velocity[i][a];
        n.spin[a] = turned[a] * spin_of(t->loop.kind, p->id[i], a);
        for (int b = 0; b < 3; b++)
            if (a < dimension && b < dimension)
                n.stress[a][b] = sign[a] * sign[b] * p->deviator[i][slot[a][b]];
    }
    return n;
}

static inline void compare_with_naive(const struct trial *t, int32_t i)
{
    const struct scene *scene = &t->scene;
    const struct contact_groups *g = &scene->groups;
    struct naive_particle own = naive_of(t, i, 0);
    struct naive_sums sums = {.power = 0.0};
    for (int32_t j = 0; j < scene->particles.count; j++)
        for (int image = 0; image < IMAGE_CODES; image++) {
            if (!scene_has_image(scene, image) || (i == j && image == 0))
                continue;
            struct naive_particle other = naive_of(t, j, (image_code)image);
            unsigned law = g->law[g->of_body[scene->particles.body[i]] * g->groups +
                                  g->of_body[scene->particles.body[j]]];
            naive_pair(t->loop.kind, t->loop.smoothing, law, &own, &other, image != 0, &sums);
        }
    const struct pair_rates *rates = &t->loop.rates;
    const double fraction = 1e-12, *strain = rates->strain_rate[i];
    for (int a = 0; a < 3; a++) {
        assert_near(rates->acceleration[i][a], sums.acceleration[a],
                    fraction * sums.acceleration_size);
        assert_near(rates->wall[i][a], sums.wall[a], fraction * sums.acceleration_size);
        assert_near(strain[a], sums.gradient[a][a], fraction * sums.gradient_size);
        assert_near(strain[3 + a],
                    0.5 * (sums.gradient[a][(a + 1) % 3] + sums.gradient[(a + 1) % 3][a]),
                    fraction * sums.gradient_size);
        assert_near(rates->spin[i][a], sums.spin[a], fraction * sums.gradient_size);
    }
    assert_near(rates->power[i], sums.power, fraction * sums.power_size);
    if (t->loop.kind.breaks)
        assert_near(rates->broken[i], sums.weight < 0.0 ? sums.broken / sums.weight : 0.0, 1e-12);
    if (t->loop.kind.depth) {
        double both = sums.hoop_outside + sums.hoop_inside;
        double missing = both > 0.0 ? square(sums.hoop_outside - sums.hoop_inside) / both : 0.0;
        assert_near(rates->hoop_pull[i], sums.hoop_pull + missing, fraction * sums.hoop_size);
        assert_near(rates->hoop_strain[i], both + missing, fraction * sums.hoop_size);
    }
    for (int a = 0; t->loop.kind.drift && sums.weight < 0.0 && a < 3; a++)
        assert_near(rates->drift[i][a], sums.drift[a] / sums.weight,
                    fraction * sums.gradient_size / fabs(sums.weight));
}

#endif
