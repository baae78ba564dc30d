/* From bodies to particles: lattices, masses, replacement, and the mistakes that are found on the
 * way. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "dice.h"
#include "populations.h"
#include "workshop.h"

static void a_box_has_its_exact_mass_and_every_particle_its_start_state(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    struct workshop w;
    struct simulation simulation;
    struct shape_box box = {VECTOR(-1.0, 0.0, 2.0), VECTOR(1.0, 0.5, 3.0)};
    open_workshop(&w, 3, 0.125);
    struct body_input *body = add_body(&w, "box", &box);
    body->velocity = (struct field_list){3, {{1.0, NULL}, {-2.0, NULL}, {3.0, NULL}}};
    body->start = (struct point){.density = 8.0, .energy = 5.0, .pressure = 7.0};
    assert_made(&w, &alone, &simulation);
    const struct particles *p = particles_of(&simulation);
    assert_int_equal(p->count, 16 * 4 * 8);
    assert_true(population_totals(population_of_particles(p), &alone, -1).entry[LEDGER_MASS] ==
                8.0);
    for (int i = 0; i < p->count; i++) {
        assert_true(p->mass[i] == 8.0 / 512.0 && p->density[i] == 8.0 && p->energy[i] == 5.0);
        assert_true(p->pressure[i] == 7.0 && p->material[i] == 0 && p->body[i] == 0);
        assert_true(p->velocity[i][0] == 1.0 && p->velocity[i][1] == -2.0 &&
                    p->velocity[i][2] == 3.0);
        const int64_t site = (int64_t)p->id[i];
        assert_true(p->position[i][0] == -1.0 + ((double)(site % 16) + 0.5) * 0.125);
        assert_true(p->position[i][1] == ((double)(site / 16 % 4) + 0.5) * 0.125);
        assert_true(p->position[i][2] == 2.0 + ((double)(site / 64) + 0.5) * 0.125);
    }
    end_simulation(&simulation);
}

static void the_spacing_is_adjusted_to_fill_the_bounds(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    struct workshop w;
    struct simulation simulation;
    struct shape_box box = {VECTOR(0.0), VECTOR(1.0)};
    open_workshop(&w, 1, 0.3);
    add_body(&w, "box", &box);
    assert_made(&w, &alone, &simulation);
    const struct particles *p = particles_of(&simulation);
    assert_int_equal(p->count, 3);
    assert_true(largest_diameter(&w.input) == 1.0 / 3.0);
    for (int i = 0; i < p->count; i++)
        assert_true(p->position[i][1] == 0.0 && p->position[i][2] == 0.0);
    end_simulation(&simulation);

    w.bodies[0].resolution = 5.0;
    assert_true(body_lattice(&w.input, 0).sites == 1.0);
    assert_true(largest_diameter(&w.input) == 1.0);
}

static void a_grain_that_replaces_its_matrix_cuts_a_hole_of_its_own_form(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    struct workshop w;
    struct simulation simulation;
    struct shape_box box = {VECTOR(0.0, 0.0), VECTOR(1.0, 1.0)};
    struct shape_ball ball = {VECTOR(0.5, 0.4), 0.25};
    open_workshop(&w, 2, 0.01);
    add_body(&w, "box", &box);
    add_body(&w, "ball", &ball)->replaces = (struct name_list){1, (char *[]){"matrix"}};
    assert_made(&w, &alone, &simulation);
    const struct particles *p = particles_of(&simulation);
    const double disc = M_PI * square(0.25) * 1e4;
    assert_true(fabs(count_of_body(p, 0) - (1e4 - disc)) < 0.01 * disc);
    assert_true(fabs(count_of_body(p, 1) - disc) < 0.01 * disc);
    for (int i = 0; i < p->count; i++) {
        const double *x = p->position[i];
        assert_int_equal(shape_inside(&w.bodies[1].shape, vec3_make(x[0], x[1], 0.0)), p->body[i]);
    }

    struct body_summary summary[2];
    assert_null(generate_summary(&w.input, NULL, summary));
    for (int body = 0; body < 2; body++) {
        assert_int_equal(summary[body].particles, count_of_body(p, body));
        const double mass =
            population_totals(population_of_particles(p), &alone, body).entry[LEDGER_MASS];
        assert_true(fabs(summary[body].mass - mass) <= 1e-12 * mass);
        assert_true(fabs(summary[body].diameter - 0.01) < 1e-15);
    }
    end_simulation(&simulation);
}

static void an_overlap_without_replacement_is_told_once(void **state)
{
    (void)state;
    struct workshop w;
    struct shape_box box = {VECTOR(0.0, 0.0), VECTOR(1.0, 1.0)};
    struct shape_ball ball = {VECTOR(0.5, 0.4), 0.25};
    open_workshop(&w, 2, 0.05);
    struct body_input *matrix = add_body(&w, "box", &box), *grain = add_body(&w, "ball", &ball);
    assert_refused(&w, 1, "bodies.matrix: overlaps \"grain\"");
    matrix->replaces = (struct name_list){1, (char *[]){"grain"}};
    grain->replaces = (struct name_list){1, (char *[]){"matrix"}};
    assert_refused(&w, 1, "only one");
    grain->replaces.count = 0;
    assert_refused(&w, 1, "bodies.grain: no particle");
}

static void bodies_that_touch_do_not_overlap(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    struct workshop w;
    struct simulation simulation;
    struct shape_box left = {VECTOR(0.0), VECTOR(0.1)}, right = {VECTOR(0.1), VECTOR(0.7)};
    open_workshop(&w, 1, 0.001);
    add_body(&w, "box", &left);
    add_body(&w, "box", &right);
    assert_made(&w, &alone, &simulation);
    assert_int_equal(count_of_body(particles_of(&simulation), 0), 100);
    assert_int_equal(count_of_body(particles_of(&simulation), 1), 600);
    end_simulation(&simulation);
}

static void all_mistakes_of_a_case_come_in_one_go(void **state)
{
    (void)state;
    struct workshop w;
    struct shape_box low = {VECTOR(-1.0, 0.0), VECTOR(0.0, 1.0)};
    struct shape_box high = {VECTOR(0.0, 2.0), VECTOR(1.0, 3.0)};
    struct shape_repeat sparse = {shape_of("ball", &(struct shape_ball){VECTOR(5.0, 1.0), 0.01}),
                                  VECTOR(2.0, 1.0), VECTOR(1.0, 0.0), 0};
    open_workshop(&w, 2, 0.1);
    add_body(&w, "box", &low);
    add_body(&w, "box", &high);
    add_body(&w, "repeat", &sparse);
    add_wall(&w, 0, SIDE_LOW, 0.0);
    add_wall(&w, 1, SIDE_HIGH, 2.0);
    assert_refused(&w, 3,
                   "bodies.matrix: the particle at [-0.95 m, 0.05 m] lies behind wall \"floor\"");
    assert_refused(&w, 3, "lies behind wall \"lid\"");
    assert_refused(&w, 3, "bodies.flyer: no particle");
}

static void a_body_beyond_an_outflow_is_refused(void **state)
{
    (void)state;
    struct workshop w;
    struct shape_box box = {VECTOR(0.0, 0.0), VECTOR(1.0, 1.0)};
    struct boundary_input face = {
        .kind = BOUNDARY_OUTFLOW, .axis = 1, .side = SIDE_HIGH, .at = 0.95, .place = 0.95};
    open_workshop(&w, 2, 0.1);
    add_body(&w, "box", &box);
    w.input.boundaries = (struct named_map){1, (char *[]){"top"}, &face, {0}};
    const struct ranks alone = ranks_alone();
    struct simulation simulation;
    assert_made(&w, &alone, &simulation); /* the last row stands on the face */
    end_simulation(&simulation);
    face.at = face.place = 0.85;
    assert_refused(&w, 1,
                   "bodies.matrix: the particle at [0.05 m, 0.95 m] lies behind outflow \"top\"");
}

static void a_lattice_beyond_the_ids_is_refused(void **state)
{
    (void)state;
    struct workshop w;
    struct shape_box box = {VECTOR(0.0, 0.0, 0.0), VECTOR(1.0, 1.0, 1.0)};
    open_workshop(&w, 3, 1e-5);
    add_body(&w, "box", &box);
    assert_refused(&w, 1, "choose a coarser resolution");
    w.input.resolution = 1e-200;
    assert_refused(&w, 1, "choose a coarser resolution");
}

/* Copies that lie over one another, in a repetition of a repetition; and too many sites. */
static void what_takes_too_long_to_count_is_refused(void **state)
{
    (void)state;
    struct workshop w;
    const struct ranks alone = ranks_alone();
    struct shape_ball ball = {VECTOR(0.0, 0.0), 3.0};
    struct shape_repeat inner = {shape_of("ball", &ball), VECTOR(300.0, 300.0), VECTOR(0.01, 0.01),
                                 0};
    struct shape_repeat outer = {shape_of("repeat", &inner), VECTOR(300.0, 300.0),
                                 VECTOR(0.01, 0.01), 0};
    struct shape_ball disc = {VECTOR(0.0, 0.0), 0.5};
    open_workshop(&w, 2, 0.1);
    add_body(&w, "repeat", &outer);
    assert_true(generate_work(&w.input, &alone) > GENERATE_MOST);
    assert_refused(&w, 1, "bodies.matrix: its 1.4e+04 sites, at each of which up to 8.1e+09");
    inner.count = outer.count = (struct vector_value)VECTOR(3.0, 3.0);
    assert_true(generate_work(&w.input, &alone) < GENERATE_LONG);
    open_workshop(&w, 2, 5e-6);
    add_body(&w, "ball", &disc);
    assert_refused(&w, 1, "take too long to count: choose a coarser resolution");
}

static void a_box_of_any_number_of_sites_is_counted_at_once(void **state)
{
    (void)state;
    struct workshop w;
    struct shape_box box = {VECTOR(0.0, 0.0, 0.0), VECTOR(1.0, 1.0, 1.0)};
    open_workshop(&w, 3, 1e-4);
    add_body(&w, "box", &box);
    assert_refused(&w, 1, "1e+12 particles are more than");
}

static double within(struct dice *dice, double most) { return dice_between(dice, 0.0, most); }

/* A box is counted as the intersection of itself, whose sites are looked at one by one. */
static void a_box_is_counted_as_its_sites_are(void **state)
{
    (void)state;
    struct dice dice = {5};
    for (int trial = 0; trial < 60; trial++) {
        const int dimension = 1 + trial % 3;
        struct body_summary summary[2];
        struct error *error[2];
        const double low[3] = {within(&dice, 1.0), within(&dice, 1.0), within(&dice, 1.0)};
        struct shape_box box = {.from.count = dimension, .to.count = dimension};
        for (int k = 0; k < dimension; k++) {
            box.from.at[k] = low[k];
            box.to.at[k] = low[k] + 0.05 + within(&dice, 1.0);
        }
        struct one_of item = shape_of("box", &box);
        struct shape_intersection same = {{1, &item}};
        const struct bounds window = {vec3_make(low[0] + 0.1, low[1] + 0.1, low[2] - 0.1),
                                      vec3_make(low[0] + 0.5, low[1] + 0.7, low[2] + 0.5)};
        const double wall = low[0] + dice_between(&dice, -0.5, 0.5);
        for (int k = 0; k < 2; k++) {
            struct workshop w;
            open_workshop(&w, dimension, 0.04);
            w.input.geometry = dimension == 2 && trial % 2   ? GEOMETRY_AXISYMMETRIC
                               : dimension == 1 && trial % 2 ? GEOMETRY_SPHERICAL
                                                             : GEOMETRY_PLANE_STRAIN;
            add_body(&w, k ? "intersection" : "box", k ? (void *)&same : (void *)&box);
            if (trial % 4 == 0)
                add_wall(&w, 0, trial % 8 ? SIDE_LOW : SIDE_HIGH, wall);
            error[k] = generate_summary(&w.input, trial % 5 ? &window : NULL, &summary[k]);
        }
        assert_int_equal(error[0] != NULL, error[1] != NULL);
        if (error[0])
            assert_string_equal(error_message(error[0], 0), error_message(error[1], 0));
        assert_int_equal(summary[0].particles, summary[1].particles);
        assert_int_equal(summary[0].counted, summary[1].counted);
        assert_float_equal(summary[0].mass, summary[1].mass, 1e-12 * summary[1].mass);
        assert_float_equal(summary[0].diameter, summary[1].diameter, 1e-12);
        error_free(error[0]);
        error_free(error[1]);
    }
}

/* Where the spacing survives the particles keep it; beyond that nothing is made. */
static void a_body_too_far_from_the_origin_is_refused(void **state)
{
    (void)state;
    static const double spacings[] = {1e-9, 1e-4, 0.1, 1e6};
    const struct ranks alone = ranks_alone();
    for (size_t k = 0; k < COUNT_OF(spacings); k++)
        for (int axis = 0; axis < 2; axis++)
            for (double sign = -1.0; sign <= 1.0; sign += 2.0) {
                const double h = spacings[k];
                double near = sign * 4e12 * h, far = sign * 1e13 * h;
                struct shape_box box = {VECTOR(-h, -h), VECTOR(h, h)};
                struct workshop w;
                struct simulation simulation;
                open_workshop(&w, 2, h);
                add_body(&w, "box", &box);
                box.from.at[axis] = near - 2.0 * h;
                box.to.at[axis] = near + 2.0 * h;
                assert_made(&w, &alone, &simulation);
                end_simulation(&simulation);
                box.from.at[axis] = far - 2.0 * h;
                box.to.at[axis] = far + 2.0 * h;
                assert_refused(&w, 1, "move the case to within");
                box.from.at[axis] = box.to.at[axis] = far;
                assert_refused(&w, 1, "to within 4.5e+");
                box.from.at[axis] = -fabs(far);
                box.to.at[axis] = fabs(far);
                assert_refused(&w, 1, "choose a coarser resolution");
            }
}

static void the_slices_of_three_ranks_make_the_particles_of_one(void **state)
{
    (void)state;
    struct workshop w;
    struct shape_box box = {VECTOR(0.0, 0.0), VECTOR(1.0, 1.0)};
    struct shape_ball ball = {VECTOR(0.5, 0.5), 0.25};
    open_workshop(&w, 2, 0.03);
    add_body(&w, "box", &box);
    add_body(&w, "ball", &ball)->replaces = (struct name_list){1, (char *[]){"matrix"}};
    assert_slices_agree(&w);
}

/* An odd and an even number of sites across, where one would be on the axis and none. */
static void a_ball_on_the_axis_is_cut_there_and_has_its_mass(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    for (int across = 199; across <= 200; across++) {
        struct workshop w;
        struct simulation simulation;
        struct shape_ball ball = {VECTOR(0.0, 0.5), 1.0};
        open_workshop(&w, 2, 2.0 / across);
        w.input.geometry = GEOMETRY_AXISYMMETRIC;
        add_body(&w, "ball", &ball)->start.density = 3.0;
        assert_made(&w, &alone, &simulation);
        const struct particles *p = particles_of(&simulation);
        for (int i = 0; i < p->count; i++)
            assert_true(p->position[i][0] >= 0.49 * w.input.resolution);
        const double mass =
            population_totals(population_of_particles(p), &alone, -1).entry[LEDGER_MASS];
        assert_float_equal(mass, 3.0 * 2.0 / 3.0, 0.002 * 2.0); /* rho 4/3 pi R^3 over 2 pi */
        end_simulation(&simulation);
    }
}

static void a_bar_on_the_axis_is_cut_there_and_has_its_exact_mass(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    for (int across = 9; across <= 10; across++) {
        struct workshop w;
        struct simulation simulation;
        struct shape_box box = {VECTOR(-1.0, 0.0), VECTOR(1.0, 3.0)};
        open_workshop(&w, 2, 2.0 / across);
        w.input.geometry = GEOMETRY_AXISYMMETRIC;
        add_body(&w, "box", &box)->start.density = 8.0;
        assert_made(&w, &alone, &simulation);
        const double mass =
            population_totals(simulation_population(&simulation), &alone, -1).entry[LEDGER_MASS];
        assert_float_equal(mass, 8.0 * 3.0 * 0.5, 1e-12); /* rho pi R^2 L over 2 pi */
        end_simulation(&simulation);
    }
}

static void a_ring_lattice_is_cut_at_the_axis_too(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    struct workshop w;
    struct simulation simulation;
    struct shape_ball ball = {VECTOR(0.0, 0.0), 1.0};
    open_workshop(&w, 2, 0.04);
    w.input.geometry = GEOMETRY_AXISYMMETRIC;
    struct body_input *body = add_body(&w, "ball", &ball);
    struct lattice_rings rings = {.count = 0};
    body->lattice = lattice_of(LATTICE_RINGS, &rings);
    body->start.density = 3.0;
    assert_made(&w, &alone, &simulation);
    const double mass =
        population_totals(simulation_population(&simulation), &alone, -1).entry[LEDGER_MASS];
    assert_float_equal(mass, 2.0, 0.01);
    end_simulation(&simulation);
}

static void a_body_beyond_the_axis_is_told_to_move(void **state)
{
    (void)state;
    struct workshop w;
    struct shape_box box = {VECTOR(-2.0, 0.0), VECTOR(-1.0, 1.0)};
    open_workshop(&w, 2, 0.1);
    w.input.geometry = GEOMETRY_AXISYMMETRIC;
    add_body(&w, "box", &box);
    assert_refused(&w, 1, "the whole body is at x < 0; move it to x > 0");
}

/* A low mirror, a high one, and both; lattices of lines and of rings. */
static void a_ball_about_the_axis_is_cut_by_mirrors_too(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    static const double mirrors[][2] = {
        {0.0, INFINITY}, {-INFINITY, 0.0}, {-0.5, 0.5}, {0.123, INFINITY}};
    for (int kind = LATTICE_SQUARE; kind <= LATTICE_RINGS; kind++)
        for (size_t k = 0; k < COUNT_OF(mirrors); k++) {
            struct workshop w;
            struct simulation simulation;
            struct shape_ball ball = {VECTOR(0.0, 0.0), 1.0};
            struct lattice_rings rings = {.count = 0};
            const double low = maximum(mirrors[k][0], -1.0), high = minimum(mirrors[k][1], 1.0);
            open_workshop(&w, 2, 0.011);
            w.input.geometry = GEOMETRY_AXISYMMETRIC;
            struct body_input *body = add_body(&w, "ball", &ball);
            body->start.density = 3.0;
            body->lattice =
                lattice_of((enum lattice_kind)kind, kind == LATTICE_RINGS ? &rings : NULL);
            if (isfinite(mirrors[k][0]))
                add_wall(&w, 1, SIDE_LOW, low);
            if (isfinite(mirrors[k][1]))
                add_wall(&w, 1, SIDE_HIGH, high);
            assert_made(&w, &alone, &simulation);
            const struct particles *p = particles_of(&simulation);
            for (int i = 0; i < p->count; i++)
                assert_true(p->position[i][1] > low && p->position[i][1] < high);
            /* pi (1 - y^2) dy over 2 pi */
            const double wanted =
                3.0 * 0.5 * (high - low - (high * high * high - low * low * low) / 3.0);
            const double mass =
                population_totals(population_of_particles(p), &alone, -1).entry[LEDGER_MASS];
            assert_float_equal(mass, wanted, 0.01 * wanted);
            end_simulation(&simulation);
        }
}

/* The volume of what is in SHAPE and between LOW and HIGH, of POINTS points along each axis. */
static double volume_between(const struct one_of *shape, int dimension, const double low[3],
                             const double high[3], int points)
{
    const int count[3] = {points, dimension > 1 ? points : 1, dimension > 2 ? points : 1};
    double inside = 0.0, cell = 1.0;
    for (int axis = 0; axis < dimension; axis++)
        cell *= (high[axis] - low[axis]) / points;
    for (int k = 0; k < count[2]; k++)
        for (int j = 0; j < count[1]; j++)
            for (int i = 0; i < count[0]; i++) {
                const int at[3] = {i, j, k};
                double x[3] = {0.0};
                for (int axis = 0; axis < dimension; axis++)
                    x[axis] = low[axis] + (at[axis] + 0.5) * (high[axis] - low[axis]) / points;
                inside += shape_inside(shape, vec3_make(x[0], x[1], x[2]));
            }
    return inside * cell;
}

/* Mirrors on none, one or both sides of every axis, at places drawn by chance, one often through
 * the center; balls, boxes, shells and an oblique cylinder. */
static void mirrors_cut_bodies_in_any_dimension(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    struct dice dice = {20};
    for (int round = 0; round < 40; round++) {
        const int dimension = 1 + round % 3;
        struct workshop w;
        struct simulation simulation;
        struct shape_ball ball = {{dimension, {0.0, 0.0, 0.0}}, 1.0};
        struct shape_box box = {{dimension, {-1.0, -0.9, -0.8}}, {dimension, {0.9, 1.0, 1.0}}};
        struct shape_shell shell = {
            .center = {dimension, {0.0, 0.0, 0.0}}, .inner = 0.5, .outer = 1.0};
        struct shape_cylinder cylinder = {VECTOR(-0.5, -0.5, -0.5), VECTOR(0.5, 0.6, 0.7), 0.5,
                                          0.0};
        void *const shapes[] = {&ball, &box, &shell, &cylinder};
        static const char *const names[] = {"ball", "box", "shell", "cylinder"};
        const int kind = dimension == 1 ? 1 : round / 3 % (dimension == 2 ? 3 : 4);
        const double most = dimension == 3 ? 0.06 : 0.01;
        open_workshop(&w, dimension, most);
        struct body_input *body = add_body(&w, names[kind], shapes[kind]);
        body->start.density = 3.0;
        const struct bounds shape = shape_bounds(&body->shape);
        double low[3] = {shape.low.x, shape.low.y, shape.low.z};
        double high[3] = {shape.high.x, shape.high.y, shape.high.z};
        for (int axis = 0; axis < dimension; axis++) {
            const int sides = dice_below(&dice, 4);
            const double at = dice_below(&dice, 2) ? 0.0 : dice_between(&dice, -0.4, 0.0);
            if (sides & 1)
                add_wall(&w, axis, SIDE_LOW, low[axis] = at);
            if (sides & 2)
                add_wall(&w, axis, SIDE_HIGH, high[axis] = dice_between(&dice, 0.2, 0.5));
        }
        assert_made(&w, &alone, &simulation);
        const struct particles *p = particles_of(&simulation);
        for (int i = 0; i < p->count; i++)
            for (int axis = 0; axis < dimension; axis++)
                assert_true(p->position[i][axis] > low[axis] && p->position[i][axis] < high[axis]);
        const double wanted =
            3.0 * volume_between(&body->shape, dimension, low, high, dimension == 3 ? 80 : 300);
        const double mass =
            population_totals(population_of_particles(p), &alone, -1).entry[LEDGER_MASS];
        assert_float_equal(mass, wanted, 0.04 * wanted);
        end_simulation(&simulation);
    }
}

static void a_body_wholly_behind_a_mirror_stays_a_mistake(void **state)
{
    (void)state;
    struct workshop w;
    struct shape_box box = {VECTOR(0.0, -2.0), VECTOR(1.0, 0.0)};
    open_workshop(&w, 2, 0.1);
    w.input.geometry = GEOMETRY_AXISYMMETRIC;
    add_body(&w, "box", &box);
    add_wall(&w, 1, SIDE_LOW, 0.0);
    assert_refused(&w, 1, "lies behind wall \"floor\"");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ball_on_the_axis_is_cut_there_and_has_its_mass),
        cmocka_unit_test(a_bar_on_the_axis_is_cut_there_and_has_its_exact_mass),
        cmocka_unit_test(a_ring_lattice_is_cut_at_the_axis_too),
        cmocka_unit_test(a_body_beyond_the_axis_is_told_to_move),
        cmocka_unit_test(what_takes_too_long_to_count_is_refused),
        cmocka_unit_test(a_box_of_any_number_of_sites_is_counted_at_once),
        cmocka_unit_test(a_box_is_counted_as_its_sites_are),
        cmocka_unit_test(a_body_too_far_from_the_origin_is_refused),
        cmocka_unit_test(a_ball_about_the_axis_is_cut_by_mirrors_too),
        cmocka_unit_test(mirrors_cut_bodies_in_any_dimension),
        cmocka_unit_test(a_body_wholly_behind_a_mirror_stays_a_mistake),
        cmocka_unit_test(a_box_has_its_exact_mass_and_every_particle_its_start_state),
        cmocka_unit_test(the_spacing_is_adjusted_to_fill_the_bounds),
        cmocka_unit_test(a_grain_that_replaces_its_matrix_cuts_a_hole_of_its_own_form),
        cmocka_unit_test(an_overlap_without_replacement_is_told_once),
        cmocka_unit_test(bodies_that_touch_do_not_overlap),
        cmocka_unit_test(all_mistakes_of_a_case_come_in_one_go),
        cmocka_unit_test(a_body_beyond_an_outflow_is_refused),
        cmocka_unit_test(a_lattice_beyond_the_ids_is_refused),
        cmocka_unit_test(the_slices_of_three_ranks_make_the_particles_of_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
