/* The ledger and the totals of particles and cells: what is booked is found again, exactly, in any
 * order. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "grid/cell_blocks.h"
#include "model/ledger.h"
#include "populations.h"

enum { COUNT = 1000 };

static double random_number(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53 - 0.5;
}

static struct vec3 random_vector(uint64_t *state)
{
    const double x = random_number(state), y = random_number(state), z = random_number(state);
    return vec3_make(x, y, z);
}

static void assert_same_totals(const struct totals *a, const struct totals *b)
{
    assert_memory_equal(a, b, sizeof *a);
}

static void a_booking_moves_mass_momentum_angular_momentum_and_energy(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    struct ledger ledger = {0};
    ledger_book(&ledger, LEDGER_WALLS, 2.0, vec3_make(3.0, 5.0, 7.0), vec3_make(0.5, 0.25, 2.0),
                11.0);
    const struct totals totals = ledger_totals(&ledger, &alone, LEDGER_WALLS);
    const double wanted[LEDGER_ENTRIES] = {
        2.0, 3.0, 5.0, 7.0, 0.25 * 7.0 - 2.0 * 5.0, 2.0 * 3.0 - 0.5 * 7.0, 0.5 * 5.0 - 0.25 * 3.0,
        11.0};
    assert_memory_equal(totals.entry, wanted, sizeof wanted);
    const struct totals all = ledger_totals(&ledger, &alone, LEDGER_CAUSES);
    assert_same_totals(&totals, &all);
    assert_string_equal(ledger_cause_name(LEDGER_WALLS), "walls");
}

static void a_joined_ledger_is_the_ledger_of_all_bookings(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    struct ledger whole = {0}, part[3] = {0}, joined = {0};
    uint64_t seed = 5;
    for (int i = 0; i < COUNT; i++) {
        const struct vec3 momentum = random_vector(&seed), position = random_vector(&seed);
        const double energy = 1e9 * random_number(&seed);
        ledger_book(&whole, LEDGER_WALLS, 0.0, momentum, position, energy);
        ledger_book(&part[i % 3], LEDGER_WALLS, 0.0, momentum, position, energy);
    }
    for (int i = 2; i >= 0; i--)
        ledger_join(&joined, &part[i]);
    const struct totals a = ledger_totals(&whole, &alone, LEDGER_CAUSES);
    const struct totals b = ledger_totals(&joined, &alone, LEDGER_CAUSES);
    assert_same_totals(&a, &b);
}

/* A visitor with one array in its memory: saves the first time, loads the second. */
struct memory_visitor {
    struct visitor visitor;
    bool loads;
    char bytes[65536];
};

static struct error *visit_memory(struct visitor *visitor, const char *name, enum number number,
                                  void *data, int64_t count, int components)
{
    struct memory_visitor *memory = (struct memory_visitor *)visitor;
    const size_t size = number_size(number) * (size_t)count * (size_t)components;
    assert_string_equal(name, "ledger");
    assert_true(size <= sizeof memory->bytes);
    if (memory->loads)
        memcpy(data, memory->bytes, size);
    else
        memcpy(memory->bytes, data, size);
    return NULL;
}

static void a_saved_ledger_loads_with_every_digit(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    struct ledger ledger = {0}, loaded = {0};
    uint64_t seed = 6;
    for (int i = 0; i < COUNT; i++)
        ledger_book(&ledger, LEDGER_WALLS, 1e-300, random_vector(&seed), random_vector(&seed),
                    1e300);
    ledger_book(&ledger, LEDGER_WALLS, NAN, vec3_make(0.0, 0.0, 0.0), vec3_make(0.0, 0.0, 0.0),
                1.0);
    struct memory_visitor memory = {.visitor = {.visit = visit_memory}};
    assert_null(ledger_visit(&ledger, &alone, &memory.visitor));
    memory.loads = true;
    assert_null(ledger_visit(&loaded, &alone, &memory.visitor));
    ledger_book(&ledger, LEDGER_WALLS, 0.0, vec3_make(1.0, 0.0, 0.0), vec3_make(0.0, 1.0, 0.0),
                -1e300);
    ledger_book(&loaded, LEDGER_WALLS, 0.0, vec3_make(1.0, 0.0, 0.0), vec3_make(0.0, 1.0, 0.0),
                -1e300);
    const struct totals a = ledger_totals(&ledger, &alone, LEDGER_WALLS);
    const struct totals b = ledger_totals(&loaded, &alone, LEDGER_WALLS);
    assert_true(isnan(a.entry[LEDGER_MASS]) && isnan(b.entry[LEDGER_MASS]));
    for (int i = LEDGER_MOMENTUM_X; i < LEDGER_ENTRIES; i++)
        assert_true(a.entry[i] == b.entry[i]);
}

static void make_particles(struct particles *particles, int count)
{
    int32_t first;
    assert_null(particles_create(3, 1.0, NULL, 0, particles));
    assert_null(particles_append(particles, count, &first));
    for (int i = 0; i < count; i++)
        particles->id[i] = (uint64_t)i;
}

static void totals_of_the_particles_are_sums_of_what_each_has(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    struct particles particles;
    make_particles(&particles, 2);
    const double position[2][3] = {{1.0, 2.0, 3.0}, {-0.5, 0.0, 1.0}};
    const double velocity[2][3] = {{3.0, 4.0, 0.0}, {0.0, -1.0, 0.0}};
    for (int i = 0; i < 2; i++) {
        particles.mass[i] = i + 1.0;
        particles.energy[i] = 10.0 * (i + 1);
        particles.body[i] = (uint16_t)i;
        memcpy(particles.position[i], position[i], sizeof position[i]);
        memcpy(particles.velocity[i], velocity[i], sizeof velocity[i]);
    }
    assert_null(particles_commit(&particles));
    const struct totals totals = population_totals(population_of_particles(&particles), &alone, -1);
    const double wanted[LEDGER_ENTRIES] = {3.0,
                                           3.0,
                                           2.0,
                                           0.0,
                                           (2.0 * 0.0 - 3.0 * 4.0) - 1.0 * -2.0,
                                           3.0 * 3.0 - 1.0 * 0.0,
                                           (1.0 * 4.0 - 2.0 * 3.0) + -0.5 * -2.0,
                                           10.0 + 40.0 + 12.5 + 1.0};
    for (int i = 0; i < LEDGER_ENTRIES; i++)
        assert_true(totals.entry[i] == wanted[i]);
    assert_true(totals.kinetic == 13.5 && totals.internal == 50.0);
    assert_true(totals.momentum_scale == 5.0 + 2.0);
    const struct totals second = population_totals(population_of_particles(&particles), &alone, 1);
    assert_true(second.entry[LEDGER_MASS] == 2.0 && second.entry[LEDGER_ENERGY] == 41.0);
    particles_destroy(&particles);
}

static void totals_do_not_depend_on_the_order_of_the_particles(void **state)
{
    (void)state;
    const struct ranks alone = ranks_alone();
    struct particles particles[2];
    for (int run = 0; run < 2; run++) {
        make_particles(&particles[run], COUNT);
        uint64_t seed = 9;
        for (int i = 0; i < COUNT; i++) {
            const int place = run ? COUNT - 1 - i : i;
            const struct vec3 x = random_vector(&seed), u = random_vector(&seed);
            particles[run].mass[place] = exp(20.0 * random_number(&seed));
            particles[run].energy[place] = exp(20.0 * random_number(&seed));
            memcpy(particles[run].position[place], &x, sizeof x);
            memcpy(particles[run].velocity[place], &u, sizeof u);
        }
        particles[run].count = COUNT;
    }
    const struct totals a = population_totals(population_of_particles(&particles[0]), &alone, -1);
    const struct totals b = population_totals(population_of_particles(&particles[1]), &alone, -1);
    assert_same_totals(&a, &b);
    particles_destroy(&particles[0]);
    particles_destroy(&particles[1]);
}

/* Gas in 2 x 2 x 2 blocks around the origin, from which it flows away. */
enum { SIDE = 8, BLOCKS = 8, CELLS = BLOCKS * SIDE * SIDE * SIDE };
struct cube {
    struct cell_block block[BLOCKS];
    uint16_t body[CELLS];
    double mass[CELLS], energy[CELLS], position[CELLS][3], velocity[CELLS][3];
};

static void fill_block(struct cube *cube, struct cell_block *block, int layers, bool flowing)
{
    *block =
        (struct cell_block){.key = block->key,
                            .count = {SIDE, SIDE, layers},
                            .corner = {(block->key & 1) ? 0 : -SIDE, (block->key & 2) ? 0 : -SIDE,
                                       (block->key & 4) ? 0 : -SIDE},
                            .first = block->first};
    for (int c = 0; c < SIDE * SIDE * layers; c++) {
        const int at[3] = {c % SIDE, c / SIDE % SIDE, c / (SIDE * SIDE)}, i = block->first + c;
        double square_of_radius = 0.0;
        for (int axis = 0; axis < 3; axis++) {
            cube->position[i][axis] = ((double)(block->corner[axis] + at[axis]) + 0.5) * 0.1;
            square_of_radius += square(cube->position[i][axis]);
        }
        const double law = exp(-square_of_radius);
        cube->mass[i] = 1.0 + law / 3.0;
        cube->energy[i] = 1e5 * (1.0 + law);
        for (int axis = 0; axis < 3; axis++)
            cube->velocity[i][axis] = flowing ? law * cube->position[i][axis] : 0.0;
    }
}

/* The last block has only so many LAYERS of cells along z. */
static struct population make_cube(struct cube *cube, bool reversed, int layers, bool flowing)
{
    int32_t first = 0;
    memset(cube, 0, sizeof *cube);
    for (int b = 0; b < BLOCKS; b++) {
        struct cell_block *block = &cube->block[b];
        block->key = (uint64_t)(reversed ? BLOCKS - 1 - b : b);
        block->first = first;
        const int of = block->key == BLOCKS - 1 ? layers : SIDE;
        fill_block(cube, block, of, flowing);
        first += SIDE * SIDE * of;
    }
    return (struct population){.kind = POPULATION_OF_CELLS,
                               .dimension = 3,
                               .threads = 1,
                               .count = first,
                               .body = cube->body,
                               .mass = cube->mass,
                               .energy = cube->energy,
                               .position = (const double(*)[3])cube->position,
                               .velocity = (const double(*)[3])cube->velocity,
                               .blocks = BLOCKS,
                               .block = cube->block};
}

static void totals_of_cells_do_not_depend_on_the_order_of_blocks_or_threads(void **state)
{
    (void)state;
    static struct cube cubes[2];
    const struct ranks alone = ranks_alone();
    const struct totals a = population_totals(make_cube(&cubes[0], false, 5, true), &alone, -1);
    for (int threads = 1; threads <= 3; threads++) {
        struct population other = make_cube(&cubes[1], true, 5, true);
        other.threads = threads;
        const struct totals b = population_totals(other, &alone, -1);
        assert_same_totals(&a, &b);
    }
}

static void totals_of_cells_are_exact_but_for_rounding(void **state)
{
    (void)state;
    static struct cube cube;
    const struct ranks alone = ranks_alone();
    const struct population cells = make_cube(&cube, false, 5, true);
    struct population particles = cells; /* whose sums are exact */
    particles.blocks = 0;
    particles.block = NULL;
    const struct totals rounded = population_totals(cells, &alone, -1),
                        exact = population_totals(particles, &alone, -1);
    const double mass = exact.entry[LEDGER_MASS], energy = exact.entry[LEDGER_ENERGY],
                 momentum = exact.momentum_scale;
    assert_float_equal(rounded.entry[LEDGER_MASS], mass, 3e-16 * mass);
    assert_float_equal(rounded.entry[LEDGER_ENERGY], energy, 3e-16 * energy);
    assert_float_equal(rounded.kinetic, exact.kinetic, 3e-16 * exact.kinetic);
    assert_float_equal(rounded.momentum_scale, momentum, 3e-16 * momentum);
    for (int entry = LEDGER_MOMENTUM_X; entry <= LEDGER_ANGULAR_Z; entry++)
        assert_float_equal(rounded.entry[entry], exact.entry[entry], 3e-16 * momentum);
}

static void what_mirrored_blocks_have_cancels_exactly(void **state)
{
    (void)state;
    static struct cube cube;
    const struct ranks alone = ranks_alone();
    const struct totals totals = population_totals(make_cube(&cube, false, SIDE, true), &alone, -1);
    for (int entry = LEDGER_MOMENTUM_X; entry <= LEDGER_ANGULAR_Z; entry++)
        assert_true(totals.entry[entry] == 0.0);
    assert_true(totals.kinetic > 0.0);
}

static void cells_at_rest_have_mass_and_internal_energy(void **state)
{
    (void)state;
    static struct cube cube;
    const struct ranks alone = ranks_alone();
    struct population cells = make_cube(&cube, false, SIDE, false);
    struct totals totals = population_totals(cells, &alone, -1);
    assert_true(totals.kinetic == 0.0 && totals.momentum_scale == 0.0);
    assert_true(totals.entry[LEDGER_MASS] > CELLS);
    assert_true(totals.entry[LEDGER_ENERGY] == totals.internal && totals.internal > 1e5 * CELLS);
    cube.velocity[CELLS - 1][1] = 1.0; /* one moves, of another body */
    cube.body[CELLS - 1] = 1;
    totals = population_totals(cells, &alone, -1);
    assert_true(totals.entry[LEDGER_MOMENTUM_Y] == cube.mass[CELLS - 1]);
    assert_true(population_totals(cells, &alone, 1).entry[LEDGER_MASS] == cube.mass[CELLS - 1]);
    assert_true(population_totals(cells, &alone, 0).kinetic == 0.0);
    cube.energy[7] = NAN;
    assert_true(isnan(population_totals(cells, &alone, -1).internal));
}

static void drift_is_measured_by_the_largest_energy_there_is(void **state)
{
    (void)state;
    struct totals start = {0}, now = {0}, booked = {0};
    assert_true(energy_drift(&now, &booked, &start) == 0.0);
    now.entry[LEDGER_ENERGY] = 1.0;
    now.kinetic = 5.0;
    now.internal = -4.0;
    assert_true(energy_drift(&now, &booked, &start) == 0.2);
    start.released = 100.0;
    assert_true(energy_drift(&now, &booked, &start) == 0.01);
    booked.entry[LEDGER_ENERGY] = 3.0;
    assert_true(energy_drift(&now, &booked, &start) == -0.02);
    start.internal = 200.0;
    assert_true(energy_drift(&now, &booked, &start) == -0.01);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_booking_moves_mass_momentum_angular_momentum_and_energy),
        cmocka_unit_test(a_joined_ledger_is_the_ledger_of_all_bookings),
        cmocka_unit_test(a_saved_ledger_loads_with_every_digit),
        cmocka_unit_test(totals_of_the_particles_are_sums_of_what_each_has),
        cmocka_unit_test(totals_do_not_depend_on_the_order_of_the_particles),
        cmocka_unit_test(totals_of_cells_do_not_depend_on_the_order_of_blocks_or_threads),
        cmocka_unit_test(totals_of_cells_are_exact_but_for_rounding),
        cmocka_unit_test(what_mirrored_blocks_have_cancels_exactly),
        cmocka_unit_test(cells_at_rest_have_mass_and_internal_energy),
        cmocka_unit_test(drift_is_measured_by_the_largest_energy_there_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
