/* The second-order pair loop gives the same bits on every instruction set that this processor has. */
#include "running.h"

typedef void muscl_loop_isa(const struct muscl_loop *, int32_t, int32_t);
muscl_loop_isa muscl_loop_run_v2;
#if defined(__x86_64__)
muscl_loop_isa muscl_loop_run_v3, muscl_loop_run_v4;
#endif

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

/* The instruction sets of this processor, the least first. */
static int instruction_sets(muscl_loop_isa *set[3])
{
    int count = 0;
    set[count++] = muscl_loop_run_v2;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
        __builtin_cpu_supports("bmi2"))
        set[count++] = muscl_loop_run_v3;
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
        set[count++] = muscl_loop_run_v4;
#endif
    return count;
}

/* Particles off their sites in random motion, a few steps on: records of gradients that are not zero. */
static struct running *begin_random(const char *text, struct dice *dice)
{
    static const struct variant plain = {"plain", 1, 1.0, NULL, false};
    struct running *run = begin_fresh(text, &plain);
    struct particles *p = &run->simulation.particles;
    for (int32_t i = 0; i < p->count; i++)
        for (int axis = 0; axis < p->dimension; axis++) {
            p->position[i][axis] += dice_between(dice, -2e-4, 2e-4);
            p->velocity[i][axis] = dice_between(dice, -300.0, 300.0);
        }
    step(run, 2);
    assert_success(run->solver->prepare(&run->sph, &run->simulation, &run->limit));
    return run;
}

/* The rates of all particles by SET, one array behind the other; *BYTES of them. */
static double *rates_by(muscl_loop_isa *set, struct running *run, size_t *bytes)
{
    const struct particles *p = &run->simulation.particles;
    const struct sph_fields f = sph_fields_of(&run->sph, &run->simulation);
    const struct muscl_kind kind = muscl_kind_of(&run->sph);
    const struct muscl_loop loop = {.kind = kind,
                                    .record = run->sph.record,
                                    .empty = p->count + run->sph.neighbours.ghosts.count,
                                    .place = run->sph.place,
                                    .smoothing = run->sph.parameters.smoothing,
                                    .neighbours = &run->sph.neighbours,
                                    .groups = &run->sph.groups,
                                    .body = p->body,
                                    .density = p->density,
                                    .velocity = (const double(*)[3])p->velocity,
                                    .rates = {f.rates, f.correction, f.velocity_gradient,
                                              f.stress_gradient, f.force, f.packing}};
    set(&loop, 0, p->count);
    const int dimension = kind.dimension;
    const struct {
        const void *of;
        int components;
    } part[] = {{f.rates.acceleration, 3},
                {f.rates.power, 1},
                {f.rates.strain_rate, 6},
                {f.rates.spin, 3},
                {f.rates.wall, 3},
                {f.rates.drift, f.rates.drift ? 3 : 0},
                {f.force, 3},
                {f.correction, tensor_components(dimension)},
                {f.velocity_gradient, dimension * dimension},
                {f.stress_gradient, dimension * muscl_stresses(kind)},
                {f.rates.hoop_pull, f.rates.hoop_pull ? 1 : 0}};
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
    muscl_loop_isa *set[3];
    struct dice dice = {1};
    const int sets = instruction_sets(set);
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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_instruction_sets_give_the_same_bits)};
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
