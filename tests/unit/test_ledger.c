/* The ledger and the totals of the particles: what is booked is found again, exactly, in any
 * order. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

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
        cmocka_unit_test(drift_is_measured_by_the_largest_energy_there_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
