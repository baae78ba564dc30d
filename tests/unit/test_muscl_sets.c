/* Nothing but the state decides the bits of the second-order method: not the instruction set, the
 * threads, the rows, nor a resume. */
#include "populations.h"
#include "second_order.h"

#include "base/isa.h"

typedef void muscl_loop_isa(const struct muscl_loop *, int32_t, int32_t);
ISA_DECLARE(muscl_loop_isa, muscl_loop_run);

/* Each kind of record, before a wall and under a contact law. */
#define BODIES(first, second)                       \
    "bodies:\n"                                     \
    "  first: {material: matter, box: " first "}\n" \
    "  second: {material: matter, box: " second "}\n"
#define CASE(dimension, strength, bodies)                                                   \
    "format: 1\nresolution: 1 mm\nsolver: {sph: {method: muscl}}\nrun: {until: 1 s}\n"      \
    "dimension: " dimension "\n"                                                            \
    "materials:\n"                                                                          \
    "  matter:\n"                                                                           \
    "    eos: {barotropic: {density: 2700 kg/m^3, bulk_modulus: 73 GPa}}\n" strength bodies \
    "contacts:\n  faces: {between: [first, second], shear: slip, tension: none}\n"          \
    "walls:\n  right: {mirror: x, at: 20 mm, side: high}\n"
#define ROUND "2\ngeometry: axisymmetric"
#define FLUID ""
#define SOLID "    strength: {perfect-plastic: {shear_modulus: 23 GPa, yield: 100 GPa}}\n"
#define LINE BODIES("{from: [0 mm], to: [9 mm]}", "{from: [9 mm], to: [20 mm]}")
#define PLANE \
    BODIES("{from: [12 mm, 0 mm], to: [20 mm, 5 mm]}", "{from: [12 mm, 5 mm], to: [20 mm, 9 mm]}")
#define SPACE                                                      \
    BODIES("{from: [15 mm, 0 mm, 0 mm], to: [20 mm, 5 mm, 3 mm]}", \
           "{from: [15 mm, 0 mm, 3 mm], to: [20 mm, 5 mm, 6 mm]}")
static const char *const cases[] = {CASE("1", SOLID, LINE),    CASE("2", FLUID, PLANE),
                                    CASE("2", SOLID, PLANE),   CASE(ROUND, FLUID, PLANE),
                                    CASE(ROUND, SOLID, PLANE), CASE("3", FLUID, SPACE),
                                    CASE("3", SOLID, SPACE)};

/* Particles off their sites in random motion, a few steps on: records of gradients that are not
 * zero. */
static struct running *begin_random(const char *text, struct dice *dice)
{
    struct running *run = begin_fresh(text, &plain);
    struct particles *p = particles_of(&run->simulation);
    for (int32_t i = 0; i < p->count; i++)
        for (int axis = 0; axis < p->dimension; axis++) {
            p->position[i][axis] += dice_between(dice, -2e-4, 2e-4);
            p->velocity[i][axis] = dice_between(dice, -300.0, 300.0);
        }
    step(run, 2);
    double *touch = particles_field(p, "touch");
    for (int32_t i = 0; i < p->count; i++)
        touch[i] = dice_between(dice, -1.0, 1.0) < 0.0 ? -1.0 : 1.0;
    prepare(run);
    return run;
}

/* The rates of all particles by SET, one array behind the other; *BYTES of them. */
static double *rates_by(muscl_loop_isa *set, struct running *run, size_t *bytes)
{
    const struct particles *p = particles_of(&run->simulation);
    const struct muscl_fields f = muscl_fields_of(&run->sph, &run->simulation);
    const struct muscl_kind kind = muscl_kind_of(&run->sph);
    const struct muscl_loop loop = loop_of(run);
    set(&loop, 0, p->count);
    const int dimension = kind.dimension;
    const struct {
        const void *of;
        int components;
    } part[] = {{f.sph.rates.acceleration, 3},
                {f.sph.rates.power, 1},
                {f.sph.rates.strain_rate, 6},
                {f.sph.rates.spin, 3},
                {f.sph.rates.wall, 3},
                {f.sph.rates.drift, f.sph.rates.drift ? 3 : 0},
                {f.own.force, 3},
                {f.own.correction, tensor_components(dimension)},
                {f.own.velocity_gradient, dimension * dimension},
                {f.own.stress_gradient, dimension * muscl_stresses(kind)},
                {f.sph.packing, f.sph.packing ? PACKING_NUMBERS : 0},
                {f.sph.volume, f.sph.volume ? VOLUME_NUMBERS : 0},
                {f.sph.rates.hoop_pull, f.sph.rates.hoop_pull ? 1 : 0}};
    double *all = malloc((size_t)p->count * 64 * sizeof *all), *to = all;
    for (size_t k = 0; k < COUNT_OF(part); k++) {
        size_t count = (size_t)p->count * (size_t)part[k].components;
        if (count)
            memcpy(to, part[k].of, count * sizeof *to);
        to += count;
    }
    *bytes = (size_t)(to - all) * sizeof *all;
    return all;
}

static void all_instruction_sets_give_the_same_bits(void **state)
{
    (void)state;
    muscl_loop_isa *const set[] = {ISA_LIST(muscl_loop_run)};
    struct dice dice = {1};
    const int sets = isa_count();
    print_message("%d instruction sets\n", sets);
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        struct running *run = begin_random(cases[k], &dice);
        size_t bytes;
        double *first = rates_by(set[0], run, &bytes);
        for (int s = 1; s < sets; s++) {
            double *other = rates_by(set[s], run, &bytes);
            assert_memory_equal(first, other, bytes);
            free(other);
        }
        free(first);
        end(run);
    }
}

/* Blocks strike in a corner, with faces that slip; a grain of other matter adheres. */
static const char plane_strike[] =
    HEAD("2") "materials:\n" METAL LIQUID "bodies:\n"
              "  striker: {material: metal, box: {from: [-10 mm, 2 mm], to: [0 mm, 14 mm]}, "
              "velocity: [900 m/s, -300 m/s]}\n"
              "  target: {material: metal, box: {from: [0 mm, 0 mm], to: [14 mm, 18 mm]}}\n"
              "  grain: {material: liquid, ball: {center: [6 mm, 8 mm], radius: 3 mm}, replaces: "
              "target}\n"
              "contacts:\n  faces: {between: [striker, target], shear: slip, tension: none}\n"
              "walls:\n"
              "  floor: {mirror: y, at: -0.2 mm, side: low}\n"
              "  back: {mirror: x, at: 14.2 mm, side: high}\n";
static const char space_strike[] = HEAD(
    "3") "materials:\n" METAL LIQUID "bodies:\n"
         "  drop: {material: liquid, box: {from: [-5 mm, 0 mm, 0 mm], to: [0 mm, 6 mm, 6 mm]}, "
         "velocity: [1200 m/s, 100 m/s, 50 m/s]}\n"
         "  plate: {material: metal, box: {from: [0 mm, 0 mm, 0 mm], to: [4 mm, 7 mm, 7 mm]}}\n"
         "walls:\n"
         "  below: {mirror: y, at: -0.2 mm, side: low}\n"
         "  behind: {mirror: z, at: 0 mm, side: low}\n";

/* Blocks close on a gap, and are packed densely there: no velocity gradient knows it. */
#define GAP(dimension, left, right)                                            \
    HEAD(dimension)                                                            \
    "materials:\n" METAL "bodies:\n"                                           \
    "  left: {material: metal, box: " left ", velocity: [2000 m/s, 10 m/s]}\n" \
    "  right: {material: metal, box: " right ", velocity: [-2000 m/s, 0 m/s]}\n"
static const char plane_gap[] = GAP("2", "{from: [0 mm, 0 mm], to: [8 mm, 12 mm]}",
                                    "{from: [8.1 mm, 0 mm], to: [16.1 mm, 12 mm]}");
/* On lattices that do not match: particles touch one after the other. Without a contact law, and
 * under one. */
#define APART_BODIES                                    \
    GAP("2", "{from: [0 mm, 0 mm], to: [8 mm, 12 mm]}", \
        "{from: [8.9 mm, 0.4 mm], to: [16.9 mm, 12.4 mm]}")
static const char apart_gap[] = APART_BODIES;
static const char law_gap[] =
    APART_BODIES "contacts:\n  faces: {between: [left, right], shear: slip, tension: none}\n";

static void threads_rows_and_a_resume_do_not_change_a_bit(void **state)
{
    (void)state;
    static const struct variant variants[] = {
        {"2 threads", 2, 1.0, NULL, false},
        {"3, 2 and 1 threads by turns", -3, 1.0, NULL, false},
        {"small cells and a thin skin", 1, 0.37, "solver.sph.skin=0.02", false},
        {"rows of every step", 1, 1.0, "solver.sph.rebuild=1", false},
        {"resumed", 1, 1.0, NULL, true},
        {"resumed with 2 threads, large cells", 2, 1.7, NULL, true}};
    const char *const texts[] = {plane_strike, space_strike, plane_gap, law_gap, apart_gap};
    for (size_t t = 0; t < COUNT_OF(texts); t++) {
        const uint64_t wanted = hash_after(texts[t], &plain, &plain, 20);
        for (size_t k = 0; k < COUNT_OF(variants); k++) {
            uint64_t hash = hash_after(texts[t], &plain, &variants[k], 20);
            if (hash != wanted)
                print_error("%s: %016llx, not %016llx\n", variants[k].name,
                            (unsigned long long)hash, (unsigned long long)wanted);
            assert_true(hash == wanted);
        }
    }
}

/* What the next step starts from is saved: a run that forgets one of them goes on otherwise. */
static void expected_forces_packing_and_supports_belong_to_the_state(void **state)
{
    (void)state;
    static const char *const names[] = {"expected_force", "closure", "heat_at_rest",
                                        "credit",         "packing", "support"};
    static const size_t components[] = {3, 3, 1, 1, 4, 1};
    const uint64_t wanted = hash_after(plane_gap, &plain, &plain, 20);
    for (size_t k = 0; k < COUNT_OF(names); k++) {
        struct running *run = begin_fresh(plane_gap, &plain);
        struct particles *p = particles_of(&run->simulation);
        step(run, 10);
        const uint64_t before = particles_hash(p);
        double *value = particles_field(p, names[k]);
        const double kept = value[0];
        value[0] = nextafter(kept, 1e9);
        assert_true(particles_hash(p) != before);
        value[0] = kept;
        run = resume(run, plane_gap, &plain);
        p = particles_of(&run->simulation);
        assert_true(((double *)particles_field(p, names[k]))[0] == kept);
        memset(particles_field(p, names[k]), 0, (size_t)p->count * components[k] * sizeof kept);
        step(run, 10);
        assert_true(particles_hash(p) != wanted);
        end(run);
    }
}

/* Bodies that are apart do not act on each other; what touches is saved; and momentum stays. */
static void check_touch(const char *text)
{
    struct running *run = begin_fresh(text, &plain);
    struct particles *p = particles_of(&run->simulation);
    step(run, 1);
    for (int32_t i = 0; i < p->count; i++)
        assert_true(((double *)particles_field(p, "touch"))[i] == -1.0 &&
                    fabs(p->velocity[i][0]) == 2000.0);
    step(run, 5);
    int touching = 0;
    double *touch = particles_field(p, "touch");
    for (int32_t i = 0; i < p->count; i++)
        touching += touch[i] > 0.0;
    assert_true(touching > 0 && touching < p->count);
    const uint64_t before = particles_hash(p);
    touch[0] = -touch[0];
    assert_true(particles_hash(p) != before);
    touch[0] = -touch[0];
    step(run, 20);
    double momentum[2] = {0.0, 0.0}, all = 0.0;
    for (int32_t i = 0; i < p->count; i++) {
        all += 2000.0 * p->mass[i];
        for (int axis = 0; axis < 2; axis++)
            momentum[axis] += p->mass[i] * p->velocity[i][axis];
    }
    assert_true(fabs(momentum[0]) < 1e-13 * all);
    assert_true(fabs(momentum[1] - 0.5 * 10.0 / 2000.0 * all) < 1e-13 * all);
    end(run);
}

static void what_touches_belongs_to_the_state(void **state)
{
    (void)state;
    check_touch(law_gap);
    check_touch(apart_gap);
}

/* A chain of bodies, the last but one across a periodic face; and one that is apart. */
static void bodies_are_apart_unless_others_connect_them(void **state)
{
    (void)state;
    static const char text[] =
        HEAD("2") "materials:\n" METAL "bodies:\n"
                  "  first: {material: metal, box: {from: [4 mm, 0 mm], to: [8 mm, 4 mm]}}\n"
                  "  apart: {material: metal, box: {from: [14 mm, 0 mm], to: [18 mm, 4 mm]}}\n"
                  "  layer: {material: metal, box: {from: [3 mm, 0 mm], to: [4 mm, 4 mm]}}\n"
                  "  second: {material: metal, box: {from: [0 mm, 0 mm], to: [3 mm, 4 mm]}}\n"
                  "  across: {material: metal, box: {from: [20 mm, 0 mm], to: [24 mm, 4 mm]}}\n"
                  "boundaries: {x: {kind: periodic, axis: x}}\n"
                  "domain: {low: [0 mm, 0 mm], high: [24 mm, 4 mm]}\n";
    struct running *run = begin_fresh(text, &plain);
    step(run, 1);
    const uint16_t wanted[] = {0, 1, 0, 0, 0};
    assert_memory_equal(run->sph.cluster, wanted, sizeof wanted);
    run = resume(run, text, &plain);
    step(run, 1);
    assert_memory_equal(run->sph.cluster, wanted, sizeof wanted);
    assert_non_null(run->sph.groups.cluster);
    end(run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_instruction_sets_give_the_same_bits),
        cmocka_unit_test(threads_rows_and_a_resume_do_not_change_a_bit),
        cmocka_unit_test(expected_forces_packing_and_supports_belong_to_the_state),
        cmocka_unit_test(what_touches_belongs_to_the_state),
        cmocka_unit_test(bodies_are_apart_unless_others_connect_them),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
