/* The heat loop: against sums written straight from the fluxes (1.42)-(1.47), (1.51), against
 * itself on other instruction sets, and what it must keep. */
#include "scene.h"

#include "base/isa.h"
#include "sph/conduction/kernel.h"

typedef void heat_loop_isa(const struct heat_loop *, int32_t, int32_t);
ISA_DECLARE(heat_loop_isa, heat_loop_run);

/* A scene whose store keeps temperature, conductivity and sqrt(diffusivity) in `energy`, `pressure`
 * and `plastic_strain`, a depth in the velocity; and the loop over it. */
struct trial {
    struct scene scene;
    struct heat_loop loop;
    double *record;
};

static void pack(const struct trial *t, int32_t i, image_code image, double *record)
{
    const struct particles *p = &t->scene.particles;
    const int dimension = t->loop.kind.dimension;
    const double *x = p->position[i], depth = t->loop.kind.depth ? p->velocity[i][0] : 1.0;
    struct vec3 place = image_position(&t->scene.mirrors, image, vec3_make(x[0], x[1], x[2]));
    const double at[3] = {place.x, place.y, place.z};
    memset(record, 0, HEAT_STRIDE * sizeof *record);
    memcpy(record, at, (size_t)dimension * sizeof *at);
    record[dimension] = t->scene.reach.diameter[i];
    record[heat_record_volume(dimension)] = p->mass[i] / (p->density[i] * depth);
    record[heat_record_temperature(dimension)] = p->energy[i];
    record[heat_record_conductivity(dimension)] = p->pressure[i];
    record[heat_record_diffusivity(dimension)] = p->plastic_strain[i];
    if (t->loop.kind.depth)
        record[heat_record_depth(dimension)] = image % 3 == 1 ? -depth : depth;
}

/* Builds rows and records of a scene whose particles are in place. */
static void trial_prepare(struct trial *t)
{
    struct scene *scene = &t->scene;
    scene_build(scene);
    const struct ghosts *ghosts = &scene->neighbours.ghosts;
    int32_t count = scene->particles.count;
    /* Exactly as many doubles as there are records, so that a sanitizer sees what lies beyond. */
    size_t bytes = (size_t)(count + ghosts->count + 1) * HEAT_STRIDE * sizeof(double);
    t->record = aligned_alloc(64, bytes);
    memset(t->record, 0, bytes);
    for (int32_t i = 0; i < count; i++)
        pack(t, i, 0, t->record + (size_t)i * HEAT_STRIDE);
    for (int32_t g = 0; g < ghosts->count; g++)
        pack(t, ghosts->source[g], ghosts->image[g], t->record + (size_t)(count + g) * HEAT_STRIDE);
    t->loop.record = t->record;
    t->loop.empty = count + ghosts->count;
    t->loop.smoothing = scene->reach.smoothing;
    t->loop.neighbours = &scene->neighbours;
    t->loop.density = scene->particles.density;
    t->loop.rate = calloc((size_t)count, sizeof(double));
}

static void random_matter(struct scene *scene, int dimension, struct dice *dice)
{
    struct particles *p = &scene->particles;
    for (int32_t i = 0; i < p->count; i++) {
        p->density[i] = pow(10.0, dice_between(dice, -3.0, 4.0));
        p->velocity[i][0] = dice_between(dice, 0.5, 4.0);
        p->mass[i] =
            p->density[i] * pow(scene_diameter(scene)[i], dimension) * dice_between(dice, 0.5, 1.5);
        p->energy[i] = dice_between(dice, 300.0, 1e4);
        p->pressure[i] = p->id[i] % 7 == 0 ? 0.0 : pow(10.0, dice_between(dice, -2.0, 3.0));
        p->plastic_strain[i] = sqrt(p->pressure[i] / (p->density[i] * 900.0));
    }
}

static void trial_create(struct trial *t, int dimension, bool depth, enum heat_form form, int count,
                         bool walls, double skin, uint64_t seed)
{
    struct dice dice = {seed};
    struct scene *scene = &t->scene;
    const double size = pow(count, 1.0 / dimension);
    *t = (struct trial){.loop = {.kind = {dimension, depth, form}}};
    scene_create(scene, dimension, count, 3.0, skin);
    for (int32_t i = 0; i < count; i++) {
        for (int axis = 0; axis < dimension; axis++)
            scene->particles.position[i][axis] = dice_between(&dice, 0.0, size);
        scene_diameter(scene)[i] = dice_between(&dice, 0.5, 1.5);
    }
    for (int axis = 0; axis < dimension && walls; axis++) {
        scene->mirrors.low[axis] = -0.1;
        scene->mirrors.high[axis] = axis == 1 ? (double)NAN : size + 0.1;
    }
    random_matter(scene, dimension, &dice);
    trial_prepare(t);
}

static void trial_destroy(struct trial *t)
{
    free(t->loop.rate);
    free(t->record);
    scene_destroy(&t->scene);
}

/* (1.5) */
static double naive_slope(double r, double h, int dimension)
{
    static const double pi = 3.14159265358979323846;
    double phi = r / h, norm = dimension == 1   ? 6.0 * h * h
                               : dimension == 2 ? 2.8 * pi * h * h * h
                                                : 4.0 * pi * h * h * h * h;
    double tail = phi < 2.0 ? 2.0 - phi : 0.0;
    return (phi < 1.0 ? -12.0 * phi + 9.0 * phi * phi : -3.0 * tail * tail) / norm;
}

/* What the image of J gives to I: V_j W' (q_i + q_j)/rho_i by way of the contact temperature; *SIZE
 * grows by the magnitude of its terms. */
static double naive_pair(const struct trial *t, int32_t i, int32_t j, image_code image,
                         double *size)
{
    const struct particles *p = &t->scene.particles;
    double own[HEAT_STRIDE], other[HEAT_STRIDE], r2 = 0.0;
    const int n = t->loop.kind.dimension;
    pack(t, i, 0, own);
    pack(t, j, image, other);
    for (int axis = 0; axis < n; axis++)
        r2 += square(other[axis] - own[axis]);
    double r = sqrt(r2), h = 0.5 * t->loop.smoothing * (own[n] + other[n]);
    if (r >= 2.0 * h)
        return 0.0;
    double ti = p->energy[i], tj = p->energy[j], li = p->pressure[i], lj = p->pressure[j];
    if (li == 0.0 || lj == 0.0)
        return 0.0;
    double s =
        t->loop.kind.form == HEAT_CONTACT ? p->plastic_strain[i] / p->plastic_strain[j] : 1.0;
    double contact = (li * ti + lj * tj * s) / (li + lj * s); /* (1.51), (1.47) */
    double qi = -li * (contact - ti) / (0.5 * r), qj = -lj * (tj - contact) / (0.5 * r);
    double weight = other[heat_record_volume(n)] * naive_slope(r, h, n) / p->density[i];
    if (t->loop.kind.depth)
        weight *= 0.5 * fabs(own[heat_record_depth(n)] + other[heat_record_depth(n)]) /
                  own[heat_record_depth(n)];
    *size += fabs(weight) * (li + lj) * (ti + tj) / r;
    return weight * (qi + qj);
}

static void compare_with_naive(const struct trial *t, int32_t i)
{
    double rate = 0.0, size = 0.0;
    for (int32_t j = 0; j < t->scene.particles.count; j++)
        for (int image = 0; image < IMAGE_CODES; image++)
            if (scene_has_image(&t->scene, image) && (i != j || image != 0))
                rate += naive_pair(t, i, j, (image_code)image, &size);
    assert_near(t->loop.rate[i], rate, 1e-13 * size);
}

/* K = 0 .. 15: one to three dimensions and a plane with depths, both forms, with walls and
 * without. */
static void trial_of(struct trial *t, unsigned k, int count, double skin)
{
    static const int dimension[4] = {1, 2, 3, 2};
    trial_create(t, dimension[k / 4], k / 4 == 3, k & 1 ? HEAT_HARMONIC : HEAT_CONTACT, count,
                 k & 2, skin, 40 + k);
}
enum { KINDS = 16 };

static void the_fast_loop_agrees_with_the_fluxes(void **state)
{
    (void)state;
    for (unsigned k = 0; k < KINDS; k++) {
        struct trial t;
        trial_of(&t, k, 90, 0.15);
        heat_loop_run(&t.loop, 0, 90);
        for (int32_t i = 0; i < 90; i++)
            compare_with_naive(&t, i);
        trial_destroy(&t);
    }
}

static void all_instruction_sets_give_the_same_bits(void **state)
{
    (void)state;
    heat_loop_isa *const set[] = {ISA_LIST(heat_loop_run)};
    for (unsigned k = 0; k < KINDS; k++) {
        struct trial t;
        trial_of(&t, k, 200, 0.15);
        double *first = t.loop.rate;
        set[0](&t.loop, 0, 200);
        for (int s = 1; s < isa_count(); s++) {
            t.loop.rate = calloc(200, sizeof(double));
            set[s](&t.loop, 0, 200);
            assert_memory_equal(t.loop.rate, first, 200 * sizeof *first);
            free(t.loop.rate);
        }
        t.loop.rate = first;
        trial_destroy(&t);
    }
}

static void the_skin_does_not_change_a_bit(void **state)
{
    (void)state;
    for (unsigned k = 0; k < KINDS; k++) {
        struct trial a, b;
        trial_of(&a, k, 200, 0.15);
        trial_of(&b, k, 200, 0.8);
        heat_loop_run(&a.loop, 0, 200);
        heat_loop_run(&b.loop, 0, 200);
        assert_memory_equal(a.scene.particles.id, b.scene.particles.id, 200 * sizeof(uint64_t));
        assert_memory_equal(a.loop.rate, b.loop.rate, 200 * sizeof(double));
        trial_destroy(&a);
        trial_destroy(&b);
    }
}

static void heat_is_conserved_and_walls_pass_none(void **state)
{
    (void)state;
    for (unsigned k = 0; k < KINDS; k++) {
        struct trial t;
        trial_of(&t, k, 300, 0.15);
        heat_loop_run(&t.loop, 0, 300);
        double sum = 0.0, size = 0.0;
        for (int32_t i = 0; i < 300; i++) {
            sum += t.scene.particles.mass[i] * t.loop.rate[i];
            size += fabs(t.scene.particles.mass[i] * t.loop.rate[i]);
        }
        assert_true(size > 0.0);
        /* An image of one particle near another passes heat, but what it passes is passed back
         * behind the wall. */
        assert_near(sum, 0.0, 1e-13 * size);
        trial_destroy(&t);
    }
}

static void a_particle_and_its_image_pass_nothing(void **state)
{
    (void)state;
    struct trial t = {.loop = {.kind = {.dimension = 1}}};
    struct dice dice = {3};
    scene_create(&t.scene, 1, 1, 3.0, 0.15);
    t.scene.particles.position[0][0] = 0.3;
    scene_diameter(&t.scene)[0] = 1.0;
    t.scene.mirrors.low[0] = 0.0;
    random_matter(&t.scene, 1, &dice);
    t.scene.particles.pressure[0] = 200.0;
    trial_prepare(&t);
    heat_loop_run(&t.loop, 0, 1);
    assert_int_equal(t.scene.neighbours.row[0].count, 1);
    assert_true(t.loop.rate[0] == 0.0);
    trial_destroy(&t);
}

static void on_a_line_with_h_equal_to_d_the_loop_is_the_laplacian(void **state)
{
    (void)state;
    enum { COUNT = 60 };
    const double d = 0.75;
    for (int form = 0; form < 2; form++) {
        struct trial t = {.loop = {.kind = {1, false, (enum heat_form)form}}};
        struct dice dice = {9};
        scene_create(&t.scene, 1, COUNT, 3.0, 0.15);
        t.scene.reach.smoothing = 1.0;
        struct particles *p = &t.scene.particles;
        for (int32_t i = 0; i < COUNT; i++) {
            p->position[i][0] = i * d;
            scene_diameter(&t.scene)[i] = d;
            p->density[i] = 2700.0;
            p->mass[i] = 2700.0 * d;
            p->energy[i] = dice_between(&dice, 300.0, 1000.0);
            p->pressure[i] = 200.0;
            p->plastic_strain[i] = sqrt(200.0 / (2700.0 * 880.0));
        }
        trial_prepare(&t);
        heat_loop_run(&t.loop, 0, COUNT);
        for (int32_t i = 1; i < COUNT - 1; i++) {
            double at[3] = {0.0, 0.0, 0.0};
            int32_t own = 0;
            for (int32_t j = 0; j < COUNT; j++)
                for (int k = 0; k < 3; k++)
                    if (p->position[j][0] == (i + k - 1) * d) {
                        at[k] = p->energy[j];
                        own = k == 1 ? j : own;
                    }
            double wanted = 200.0 / 2700.0 * (at[0] - 2.0 * at[1] + at[2]) / square(d);
            assert_near(t.loop.rate[own], wanted, 1e-14 * 200.0 / 2700.0 * 4000.0 / square(d));
        }
        trial_destroy(&t);
    }
}

static void the_forms_agree_where_diffusivities_do(void **state)
{
    (void)state;
    struct dice dice = {11};
    for (int k = 0; k < 1000; k++) {
        double li = pow(10.0, dice_between(&dice, -3.0, 3.0)), root = dice_between(&dice, 1e-4, 1);
        double lj = pow(10.0, dice_between(&dice, -3.0, 3.0)), other = dice_between(&dice, 1e-4, 1);
        double harmonic = heat_pair_conductivity(HEAT_HARMONIC, li, root, lj, root);
        assert_close(heat_pair_conductivity(HEAT_CONTACT, li, root, lj, root), harmonic, 1e-15);
        for (int form = 0; form < 2; form++)
            assert_true(heat_pair_conductivity((enum heat_form)form, li, root, lj, other) ==
                        heat_pair_conductivity((enum heat_form)form, lj, other, li, root));
    }
    /* Porcelain and hot gas: the coefficients of the reference case. */
    double porcelain = sqrt(1.68 / (2500.0 * 920.0)), gas = sqrt(2.3 / (3.75e-3 * 5200.0));
    assert_near(heat_pair_conductivity(HEAT_HARMONIC, 1.68, porcelain, 2.3, gas), 3.88342, 5e-6);
    assert_near(heat_pair_conductivity(HEAT_CONTACT, 1.68, porcelain, 2.3, gas), 4.59579, 5e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_fast_loop_agrees_with_the_fluxes),
        cmocka_unit_test(all_instruction_sets_give_the_same_bits),
        cmocka_unit_test(the_skin_does_not_change_a_bit),
        cmocka_unit_test(heat_is_conserved_and_walls_pass_none),
        cmocka_unit_test(a_particle_and_its_image_pass_nothing),
        cmocka_unit_test(on_a_line_with_h_equal_to_d_the_loop_is_the_laplacian),
        cmocka_unit_test(the_forms_agree_where_diffusivities_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
