/* Maps over the time: they hold what the field has been, go through checkpoints, and begin with
 * what a run in 1-D has kept. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "model/columns.h"
#include "model/maps.h"
#include "running.h"

#define MAPS                                               \
    "output: {maps: {top: {peak: pressure},"               \
    " came: {arrival: {field: pressure, above: 110 kPa}}," \
    " push: {impulse: {field: pressure, above: 100 kPa}}}}\n"
#define AIR "{material: air, density: 1.2 kg/m^3, pressure: 100 kPa, box: "

static const char blast[] =
    "format: 1\ndimension: 1\ngeometry: spherical\nresolution: 10 mm\n"
    "solver: gas\nmaterials: {air: {eos: {ideal-gas: {density: 1.2 kg/m^3, gamma: 1.4}}}}\n"
    "bodies: {air: " AIR "{from: [0 m], to: [1 m]}},"
    " ball: {material: air, replaces: air, density: 12 kg/m^3,"
    " pressure: 10 MPa, box: {from: [0 m], to: [0.1 m]}}}\n"
    "run: {until: 0.3 ms}\n" MAPS;
static const char whole[] =
    "format: 1\ndimension: 2\ngeometry: axisymmetric\nresolution: 20 mm\n"
    "solver: gas\nstart: {from: blast.yaml}\n"
    "materials: {air: {eos: {ideal-gas: {density: 1.2 kg/m^3, gamma: 1.4}}}}\n"
    "bodies: {air: " AIR "{from: [0 m, 0 m], to: [1 m, 1 m]}}}\n"
    "boundaries: {low: {kind: symmetry, axis: y, at: 0 m, side: low}}\n"
    "run: {until: 0.3 ms}\n" MAPS;
static const char rod[] =
    "format: 1\ndimension: 1\nresolution: 0.1 mm\nsolver: sph\n"
    "materials: {aluminium: {eos: {mie-grueneisen: {density: 2700 kg/m^3,"
    " sound: 5350 m/s, slope: 1.35, gamma: 2.17, bulk_modulus: 73 GPa}}}}\nbodies:\n"
    "  a: {material: aluminium, box: {from: [-2 mm], to: [0 mm]},"
    " velocity: [500 m/s]}\n"
    "  b: {material: aluminium, box: {from: [0 mm], to: [4 mm]}}\n"
    "run: {until: 1 us}\n"
    "output: {maps: {top: {peak: stress.yy},"
    " came: {arrival: {field: speed, above: 100 m/s}}}}\n";
static const struct variant base = {"base", 1, 1.0, NULL, false};

enum { STEPS = 40 };

static void step_with_maps(struct running *run, int steps)
{
    for (int k = 0; k < steps; k++) {
        const double before = run->simulation.time;
        step_of(run, (double)INFINITY);
        maps_update(&run->simulation, run->simulation.time - before);
    }
}

static struct map_fields fields_of(const struct running *run, const char *name)
{
    struct map_fields fields = {NULL, NULL};
    const struct population population = simulation_population(&run->simulation);
    for (int k = 0; k < run->simulation.maps; k++)
        if (!strcmp(run->simulation.map[k].name, name))
            assert_true(maps_find(&run->simulation.map[k], &population, &fields));
    assert_non_null(fields.value);
    return fields;
}

/* Bodies of 20 and 40 particles. */
static int place_of(const struct population *population, int32_t i)
{
    return (int)(population->id[i] & PARTICLE_SITE) + 64 * population->body[i];
}

static void maps_hold_the_peak_and_the_first_time(void **state)
{
    (void)state;
    struct running *run = begin_fresh(rod, &base);
    const struct population first = simulation_population(&run->simulation);
    enum { MOST = 128 };
    double top[MOST], came[MOST], now[MOST];
    int component;
    assert_success(maps_check(&run->simulation));
    maps_update(&run->simulation, 0.0);
    for (int k = 0; k <= STEPS; k++) {
        const struct population p = simulation_population(&run->simulation);
        const struct column *stress = column_find(&p, "stress.yy", &component);
        assert_true(p.count == first.count && p.count <= MOST);
        column_read_component(&p, stress, component, 0, p.count, now);
        for (int32_t i = 0; i < p.count; i++) {
            const int at = place_of(&p, i);
            const bool fast = fabs(p.velocity[i][0]) >= 100.0;
            top[at] = k ? maximum(top[at], now[i]) : now[i];
            if (!k || isnan(came[at]))
                came[at] = fast ? run->simulation.time : (double)NAN;
        }
        if (k < STEPS)
            step_with_maps(run, 1);
    }
    const struct map_fields peak = fields_of(run, "top"), arrival = fields_of(run, "came");
    int never = 0;
    const struct population last = simulation_population(&run->simulation);
    for (int32_t i = 0; i < last.count; i++) {
        const int at = place_of(&last, i);
        assert_true(peak.value[i] == top[at]);
        never += isnan(came[at]);
        assert_true(isnan(came[at]) ? isnan(arrival.value[i])
                                    : fabs(arrival.value[i] - came[at]) < 1e-300);
    }
    assert_true(never > 0 && never < first.count);
    end(run);
}

static void a_resumed_run_has_the_same_maps(void **state)
{
    (void)state;
    struct running *run = begin_fresh(rod, &base);
    maps_update(&run->simulation, 0.0);
    step_with_maps(run, STEPS / 2);
    run = resume(run, rod, &base);
    maps_update(&run->simulation, 0.0);
    step_with_maps(run, STEPS / 2);
    const uint64_t resumed = simulation_hash(&run->simulation);
    const struct map_fields arrival = fields_of(run, "came");
    assert_true(arrival.value[0] == arrival.memory[0] || isnan(arrival.value[0]));
    end(run);
    run = begin_fresh(rod, &base);
    maps_update(&run->simulation, 0.0);
    step_with_maps(run, STEPS);
    assert_true(simulation_hash(&run->simulation) == resumed);
    end(run);
}

static void maps_begin_with_those_of_the_run_in_one_dimension(void **state)
{
    (void)state;
    char path[96];
    snprintf(path, sizeof path, "%s/blast.yaml", folder);
    FILE *file = fopen(path, "w");
    assert_true(file && fputs(blast, file) >= 0 && fclose(file) == 0);
    struct running *run = begin_fresh(blast, &base);
    maps_update(&run->simulation, 0.0);
    while (run->simulation.time < 0.3e-3) {
        const double before = run->simulation.time;
        step_of(run, 0.3e-3 - before);
        maps_update(&run->simulation, run->simulation.time - before);
    }
    struct running *round = begin_fresh(whole, &base);
    maps_update(&round->simulation, 0.0);
    const struct population of = simulation_population(&run->simulation),
                            to = simulation_population(&round->simulation);
    static const char *const names[] = {"top", "came", "push"};
    int compared = 0;
    for (int k = 0; k < 3; k++) {
        const struct map_fields there = fields_of(run, names[k]), here = fields_of(round, names[k]);
        const double earlier = k == 1 ? 0.3e-3 : 0.0;
        for (int32_t i = 0; i < to.count; i++) {
            const double radius = sqrt(square(to.position[i][0]) + square(to.position[i][1]));
            if (radius > 0.3)
                continue;
            const int32_t shell = (int32_t)(radius / of.edge);
            assert_true(fabs(of.position[shell][0] - radius) <= of.edge);
            assert_true(fabs(here.value[i] + earlier - there.value[shell]) <=
                        1e-12 * fabs(there.value[shell]) + 1e-16);
            compared++;
        }
    }
    assert_true(compared > 300);
    end(run);
    end(round);
}

static void mistakes_of_maps_are_located(void **state)
{
    (void)state;
    struct running *run = begin_fresh(rod, &base);
    struct map_input *came = case_map(run->input, 1);
    came->arrival.above.dimension = (struct dimension){0, 0, 0, 0};
    struct error *error = maps_check(&run->simulation);
    assert_non_null(strstr(error_message(error, 0), "maps.came"));
    error_free(error);
    end(run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_hold_the_peak_and_the_first_time),
        cmocka_unit_test(a_resumed_run_has_the_same_maps),
        cmocka_unit_test(maps_begin_with_those_of_the_run_in_one_dimension),
        cmocka_unit_test(mistakes_of_maps_are_located),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
