/* Lattices: how many sites, how far apart, how much each weighs, and what cannot have them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "populations.h"
#include "workshop.h"

static const double density = 8.0; /* of every body of the workshop */

/* The particles of one body on LATTICE, in SIMULATION, which looks into W. */
static void make_body(struct workshop *w, struct simulation *simulation, const char *shape,
                      void *value, enum lattice_kind lattice, void *parameters, double resolution)
{
    static const struct ranks alone = {0, 1, false};
    open_workshop(w, 2, resolution);
    add_body(w, shape, value)->lattice = lattice_of(lattice, parameters);
    assert_null(lattice_wrong(&w->bodies[0].lattice, &w->bodies[0].shape, 2));
    assert_made(w, &alone, simulation);
}

static double total_mass(const struct particles *p)
{
    double mass = 0.0;
    for (int i = 0; i < p->count; i++)
        mass += p->mass[i];
    return mass;
}

static void assert_near(double value, double wanted, double within)
{
    if (!(fabs(value - wanted) <= within * fabs(wanted)))
        fail_msg("%.12g is not within %g of %.12g", value, within, wanted);
}

static double distance(const struct particles *p, int i, int j)
{
    return hypot(p->position[i][0] - p->position[j][0], p->position[i][1] - p->position[j][1]);
}

static void a_particle_of_a_hexagonal_lattice_has_six_neighbours(void **state)
{
    (void)state;
    struct workshop w;
    struct simulation simulation;
    struct shape_box box = {VECTOR(0.0, 0.0), VECTOR(12.0, 20.0 * sqrt(0.75))};
    make_body(&w, &simulation, "box", &box, LATTICE_HEXAGONAL, NULL, 1.0);
    const struct particles *p = particles_of(&simulation);
    assert_int_equal(p->count, 12 * 20);
    int interior = 0;
    for (int i = 0; i < p->count; i++) {
        assert_near(p->mass[i], sqrt(0.75) * density, 1e-14);
        const double *x = p->position[i];
        if (x[0] < 2.0 || x[0] > 10.0 || x[1] < 2.0 || x[1] > box.to.at[1] - 2.0)
            continue;
        int near = 0;
        for (int j = 0; j < p->count; j++) {
            near += j != i && fabs(distance(p, i, j) - 1.0) < 1e-12;
            assert_true(j == i || distance(p, i, j) > 1.0 - 1e-12);
        }
        assert_int_equal(near, 6);
        interior++;
    }
    assert_true(interior > 100);
    end_simulation(&simulation);
}

static void a_hexagonal_lattice_fills_any_box(void **state)
{
    (void)state;
    struct workshop w;
    struct simulation simulation;
    struct shape_box box = {VECTOR(-1.0, 3.0), VECTOR(0.37, 4.1)};
    make_body(&w, &simulation, "box", &box, LATTICE_HEXAGONAL, NULL, 0.0213);
    assert_near(total_mass(particles_of(&simulation)), density * 1.37 * 1.1, 1e-12);
    end_simulation(&simulation);
}

/* The counts of the beryllium shell, 80 to 100 mm, that the literature's rings have. */
static void rings_have_the_count_and_the_mass_of_their_shell(void **state)
{
    (void)state;
    static const double resolution[3] = {2.0, 1.0, 0.667};
    static const int count[3] = {2827, 11309, 25435};
    struct shape_shell shell = {VECTOR(3.0, -7.0), 80.0, 100.0};
    struct lattice_rings rings = {.count = 0};
    for (int i = 0; i < 3; i++) {
        struct workshop w;
        struct simulation simulation;
        make_body(&w, &simulation, "shell", &shell, LATTICE_RINGS, &rings, resolution[i]);
        const struct particles *p = particles_of(&simulation);
        assert_int_equal(p->count, count[i]);
        assert_near(total_mass(p), density * M_PI * 3600.0, 1e-12);
        for (int k = 0; k < p->count; k++)
            assert_near(p->mass[k], density * square(resolution[i]), 2e-3);
        end_simulation(&simulation);
    }
}

static void rings_fill_a_disc_to_its_middle(void **state)
{
    (void)state;
    struct workshop w;
    struct simulation simulation;
    struct shape_ball disc = {VECTOR(0.0, 0.0), 0.1};
    struct lattice_rings rings = {.count = 0};
    make_body(&w, &simulation, "ball", &disc, LATTICE_RINGS, &rings, 2.55e-3);
    const struct particles *p = particles_of(&simulation);
    assert_int_equal(p->count, 4804);
    assert_near(total_mass(p), density * M_PI * 0.01, 1e-12);
    double moment[2] = {0.0}, inertia = 0.0;
    for (int i = 0; i < p->count; i++) {
        moment[0] += p->mass[i] * p->position[i][0];
        moment[1] += p->mass[i] * p->position[i][1];
        inertia += p->mass[i] * (square(p->position[i][0]) + square(p->position[i][1]));
        assert_near(p->mass[i], density * square(2.55e-3), 0.06);
    }
    assert_true(fabs(moment[0]) < 1e-15 && fabs(moment[1]) < 1e-15);
    assert_near(inertia, 0.5 * total_mass(p) * 0.01, 1e-3);
    end_simulation(&simulation);

    struct shape_ball speck = {VECTOR(2.0, 3.0), 0.2};
    make_body(&w, &simulation, "ball", &speck, LATTICE_RINGS, &rings, 1.0);
    assert_int_equal(particles_of(&simulation)->count, 1);
    assert_true(particles_of(&simulation)->position[0][0] == 2.0);
    end_simulation(&simulation);
}

/* The cylinders of Parshikov (2013), 2.6: 135 = 3 x 45 and 540 = 6 x 90 sectors of one area. */
static void rings_of_one_count_have_particles_of_one_mass(void **state)
{
    (void)state;
    struct shape_shell shell = {VECTOR(0.0, 0.0), 27.5, 42.5};
    struct lattice_rings rings = {.count = 45};
    for (int finer = 1; finer <= 2; finer++) {
        struct workshop w;
        struct simulation simulation;
        rings.count = 45 * finer;
        make_body(&w, &simulation, "shell", &shell, LATTICE_RINGS, &rings, 4.94 / finer);
        const struct particles *p = particles_of(&simulation);
        assert_int_equal(p->count, 135 * finer * finer);
        for (int i = 0; i < p->count; i++)
            assert_near(p->mass[i], density * M_PI * 1050.0 / p->count, 1e-12);
        assert_near(largest_diameter(simulation.problem->input), sqrt(M_PI * 1050.0 / p->count),
                    1e-12);
        end_simulation(&simulation);
    }
}

static void rings_are_mirror_images_about_their_start(void **state)
{
    (void)state;
    struct shape_shell shell = {VECTOR(1.0, 0.0), 27.5, 42.5};
    struct lattice_rings rings = {.count = 45, .start = M_PI / 3.0};
    struct workshop w;
    struct simulation simulation;
    make_body(&w, &simulation, "shell", &shell, LATTICE_RINGS, &rings, 4.94);
    const struct particles *p = particles_of(&simulation);
    const double c = cos(2.0 * rings.start), s = sin(2.0 * rings.start);
    for (int i = 0; i < p->count; i++) {
        const double x = p->position[i][0] - 1.0, y = p->position[i][1];
        double nearest = INFINITY;
        for (int j = 0; j < p->count; j++)
            nearest = minimum(nearest, hypot(p->position[j][0] - 1.0 - (c * x + s * y),
                                             p->position[j][1] - (s * x - c * y)));
        assert_true(nearest < 1e-12);
    }
    end_simulation(&simulation);
}

static void rings_may_stand_about_any_point(void **state)
{
    (void)state;
    struct workshop w;
    struct simulation simulation;
    struct shape_box plate = {VECTOR(0.0, 0.0), VECTOR(1.0, 1.0)};
    struct lattice_rings rings = {.center = VECTOR(0.3, 1.2)};
    make_body(&w, &simulation, "box", &plate, LATTICE_RINGS, &rings, 0.02);
    const struct particles *p = particles_of(&simulation);
    assert_near(total_mass(p), density, 0.01);
    for (int i = 0; i < p->count; i++) {
        const double r = hypot(p->position[i][0] - 0.3, p->position[i][1] - 1.2) / 0.02;
        assert_true(fabs(r - (floor(r) + 0.5)) < 1e-9);
        assert_true(shape_inside(&(struct one_of){0, &shape_choices[0], &plate},
                                 vec3_make(p->position[i][0], p->position[i][1], 0.0)));
    }
    end_simulation(&simulation);
}

static void rings_follow_a_shell_that_is_cut(void **state)
{
    (void)state;
    struct workshop w;
    struct simulation simulation;
    struct shape_shell shell = {VECTOR(0.0, 0.0), 8.0, 10.0};
    struct shape_half_space half = {VECTOR(0.0, 0.001), VECTOR(0.0, -1.0)};
    struct one_of items[2] = {shape_of("shell", &shell), shape_of("half_space", &half)};
    struct shape_intersection upper = {{2, items}};
    struct lattice_rings rings = {.count = 0};
    make_body(&w, &simulation, "intersection", &upper, LATTICE_RINGS, &rings, 0.25);
    const struct particles *p = particles_of(&simulation);
    assert_near(total_mass(p), 0.5 * density * M_PI * 36.0, 0.01);
    double low = INFINITY, high = 0.0;
    for (int i = 0; i < p->count; i++) {
        const double r = hypot(p->position[i][0], p->position[i][1]);
        low = minimum(low, r);
        high = maximum(high, r);
    }
    assert_near(low, 8.125, 1e-12);
    assert_near(high, 9.875, 1e-12);
    end_simulation(&simulation);
}

static void the_slices_of_every_lattice_agree(void **state)
{
    (void)state;
    struct shape_box box = {VECTOR(-1.0, -1.0), VECTOR(1.0, 1.0)};
    struct shape_ball ball = {VECTOR(0.1, 0.2), 0.6};
    struct lattice_rings rings = {.count = 0};
    for (int kind = 0; kind < LATTICE_KINDS; kind++) {
        struct workshop w;
        open_workshop(&w, 2, 0.03);
        add_body(&w, "box", &box);
        struct body_input *grain = add_body(&w, "ball", &ball);
        grain->replaces = (struct name_list){1, (char *[]){"matrix"}};
        grain->lattice = lattice_of((enum lattice_kind)kind, &rings);
        assert_slices_agree(&w);
    }
}

static void rivals_are_found_from_every_lattice(void **state)
{
    (void)state;
    struct shape_ball disc = {VECTOR(0.0, 0.0), 1.0}, hole = {VECTOR(0.5, 0.3), 0.2};
    struct lattice_rings rings = {.count = 0};
    static const struct ranks alone = {0, 1, false};
    for (int kind = 0; kind < LATTICE_KINDS; kind++) {
        struct workshop w;
        struct simulation simulation;
        open_workshop(&w, 2, 0.02);
        add_body(&w, "ball", &disc)->lattice = lattice_of((enum lattice_kind)kind, &rings);
        add_body(&w, "ball", &hole)->replaces = (struct name_list){1, (char *[]){"matrix"}};
        assert_made(&w, &alone, &simulation);
        const struct particles *p = particles_of(&simulation);
        for (int i = 0; i < p->count; i++)
            if (p->body[i] == 0)
                assert_false(shape_inside(&w.bodies[1].shape,
                                          vec3_make(p->position[i][0], p->position[i][1], 0.0)));
        assert_near(total_mass(p), density * M_PI, 0.02);
        end_simulation(&simulation);
    }
}

static void assert_lattice_wrong(enum lattice_kind kind, void *parameters, const char *shape,
                                 void *value, int dimension, const char *words)
{
    const struct one_of lattice = lattice_of(kind, parameters), of = shape_of(shape, value);
    const char *text = lattice_wrong(&lattice, &of, dimension);
    if (!text || !strstr(text, words))
        fail_msg("\"%s\" does not tell of \"%s\"", text ? text : "nothing", words);
}

static void what_cannot_have_a_lattice_is_told(void **state)
{
    (void)state;
    struct shape_box box = {VECTOR(0.0, 0.0), VECTOR(1.0, 1.0)};
    struct lattice_rings rings = {.count = 0}, oblique = {.center = VECTOR(1.0, 2.0, 3.0)};
    assert_lattice_wrong(LATTICE_HEXAGONAL, NULL, "box", &box, 3, "two dimensions");
    assert_lattice_wrong(LATTICE_RINGS, &rings, "box", &box, 3, "two dimensions");
    assert_lattice_wrong(LATTICE_RINGS, &rings, "box", &box, 2, "no center");
    assert_lattice_wrong(LATTICE_RINGS, &oblique, "box", &box, 2, "two numbers");
}

static void rings_beyond_the_ids_are_refused(void **state)
{
    (void)state;
    struct workshop w;
    struct shape_ball ball = {VECTOR(0.0, 0.0), 1.0};
    static const double resolution[] = {1e-8, 1e-30, 1e-200};
    for (int i = 0; i < 3; i++)
        for (int count = 0; count < 2; count++) {
            struct lattice_rings rings = {.count = count * 7};
            open_workshop(&w, 2, resolution[i]);
            add_body(&w, "ball", &ball)->lattice = lattice_of(LATTICE_RINGS, &rings);
            assert_refused(&w, 1, "choose a coarser resolution");
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_particle_of_a_hexagonal_lattice_has_six_neighbours),
        cmocka_unit_test(a_hexagonal_lattice_fills_any_box),
        cmocka_unit_test(rings_have_the_count_and_the_mass_of_their_shell),
        cmocka_unit_test(rings_fill_a_disc_to_its_middle),
        cmocka_unit_test(rings_of_one_count_have_particles_of_one_mass),
        cmocka_unit_test(rings_are_mirror_images_about_their_start),
        cmocka_unit_test(rings_may_stand_about_any_point),
        cmocka_unit_test(rings_follow_a_shell_that_is_cut),
        cmocka_unit_test(the_slices_of_every_lattice_agree),
        cmocka_unit_test(rivals_are_found_from_every_lattice),
        cmocka_unit_test(what_cannot_have_a_lattice_is_told),
        cmocka_unit_test(rings_beyond_the_ids_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
