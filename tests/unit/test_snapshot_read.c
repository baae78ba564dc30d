/* Snapshots read back: cells of a gas in each dimension, blocked ones left out, and particles. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "build_simulation.h"
#include "grid/cell_blocks.h"
#include "output/snapshot.h"
#include "output/snapshot_read.h"
#include "scratch_folder.h"

enum { CELLS_MAX = 64 };
static const double edge = 0.01;

/* Two blocks, the second one cell wide, of which one cell is blocked. */
struct gas {
    struct cell_block block[2];
    uint64_t id[CELLS_MAX];
    uint16_t zero[CELLS_MAX];
    double mass[CELLS_MAX], centre[CELLS_MAX][3];
    struct population population;
};

static void compute_mass(const struct population *p, int64_t begin, int64_t end, double *out)
{
    memcpy(out, p->mass + begin, (size_t)(end - begin) * sizeof *out);
}

static void compute_velocity(const struct population *p, int64_t begin, int64_t end, double *out)
{
    for (int64_t i = begin; i < end; i++)
        for (int k = 0; k < 3; k++)
            *out++ = 10.0 * (double)p->id[i] + k;
}

static const struct column columns[] = {
    {"mass", "kg", NULL, 1, -1, compute_mass},
    {"velocity", "m/s", NULL, 3, -1, compute_velocity},
};

static void fill(struct gas *gas, int dimension, int blocked)
{
    static const int64_t corner[2][3] = {{-1, 3, 0}, {1, 3, 0}};
    static const int count[2][3] = {{2, 3, 2}, {1, 3, 2}};
    int32_t cell = 0;
    *gas = (struct gas){0};
    for (int b = 0; b < 2; b++) {
        gas->block[b].first = cell;
        for (int axis = 0; axis < 3; axis++) {
            gas->block[b].corner[axis] = axis < dimension ? corner[b][axis] : 0;
            gas->block[b].count[axis] = axis < dimension ? count[b][axis] : 1;
        }
        const int *n = gas->block[b].count;
        for (int i = 0; i < n[0] * n[1] * n[2]; i++, cell++) {
            const int at[3] = {i % n[0], i / n[0] % n[1], i / n[0] / n[1]};
            for (int axis = 0; axis < dimension; axis++)
                gas->centre[cell][axis] =
                    edge * ((double)gas->block[b].corner[axis] + at[axis] + 0.5);
            gas->id[cell] = (uint64_t)(100 - cell);
            gas->mass[cell] = cell == blocked ? 0.0 : 1.0 + cell;
        }
    }
    gas->population = (struct population){.name = "gas",
                                          .kind = POPULATION_OF_CELLS,
                                          .dimension = dimension,
                                          .threads = 1,
                                          .count = cell,
                                          .id = gas->id,
                                          .material = gas->zero,
                                          .body = gas->zero,
                                          .mass = gas->mass,
                                          .position = gas->centre,
                                          .edge = edge,
                                          .blocks = 2,
                                          .block = gas->block,
                                          .columns = COUNT_OF(columns),
                                          .column = columns};
}

static void cells_have_their_centres_and_blocked_ones_are_left_out(void **state)
{
    (void)state;
    static const char *const fields[] = {"velocity.y", "stress.xx"};
    static const int blocked = 1;
    char path[96];
    snprintf(path, sizeof path, "%s/000000.vtkhdf", folder);
    struct simulation *simulation = build_simulation(0);
    for (int dimension = 1; dimension <= 3; dimension++) {
        struct gas gas;
        struct frame frame = {0};
        fill(&gas, dimension, blocked);
        assert_null(snapshot_write(path, simulation, &gas.population, NULL));
        assert_null(snapshot_read(path, fields, COUNT_OF(fields), &frame));
        const struct frame_group *group = &frame.group[0];
        assert_int_equal(frame.groups, 1);
        assert_int_equal(group->cell_dimension, dimension);
        assert_int_equal(group->count, gas.population.count - 1);
        assert_int_equal(group->fields, 1);
        for (int64_t i = 0; i < group->count; i++) { /* ids rise, where they fell in the store */
            const int cell = 100 - (int)group->id[i];
            assert_int_not_equal(cell, blocked);
            assert_true(i == 0 || group->id[i] > group->id[i - 1]);
            assert_true(group->mass[i] == (float)gas.mass[cell]);
            assert_true(fabs(group->diameter[i] - edge) < 1e-8);
            assert_true(group->field[0].value[i] == 10.0f * (float)group->id[i] + 1.0f);
            for (int axis = 0; axis < 3; axis++)
                assert_true(fabs(group->position[i][axis] - gas.centre[cell][axis]) < 1e-8);
        }
        frame_free(&frame);
    }
    drop_simulation(simulation);
}

static void particles_come_back_in_the_order_of_their_ids(void **state)
{
    (void)state;
    static const char *const fields[] = {"density", "velocity.x"};
    char path[96];
    snprintf(path, sizeof path, "%s/000000.vtkhdf", folder);
    struct simulation *simulation = build_simulation(6);
    struct population population = simulation_population(simulation);
    struct column with[COLUMNS_MAX];
    struct frame frame = {0};
    memcpy(with, population.column, (size_t)population.columns * sizeof *with);
    with[population.columns++] = (struct column){"diameter", "m", NULL, 1, -1, compute_mass};
    population.column = with;
    assert_null(snapshot_write(path, simulation, &population, NULL));
    assert_null(snapshot_read(path, fields, COUNT_OF(fields), &frame));
    const struct frame_group *group = &frame.group[0];
    assert_int_equal(group->cell_dimension, 0);
    assert_int_equal(group->count, 6);
    assert_true(frame.time == 1.5e-6);
    for (int64_t i = 0; i < group->count; i++) {
        const int particle = (int)(i < 3 ? 2 * i : 2 * i - 5);
        assert_true(group->id[i] == particles_of(simulation)->id[particle]);
        assert_true(group->field[0].value[i] == 1000.0f + (float)particle);
        assert_true(group->field[1].value[i] == 3.0f);
    }
    frame_free(&frame);
    drop_simulation(simulation);
}

static void particles_without_diameters_get_those_of_their_volumes(void **state)
{
    (void)state;
    static const char *const fields[] = {"density"};
    char path[96];
    snprintf(path, sizeof path, "%s/000000.vtkhdf", folder);
    struct simulation *simulation = build_simulation(6);
    const struct population population = simulation_population(simulation);
    struct frame frame = {0};
    int dimension = 1;
    for (int i = 0; i < 6; i++)
        for (int axis = dimension; axis < 3; axis++)
            if (population.position[i][axis] != population.position[0][axis])
                dimension = axis + 1;
    assert_null(snapshot_write(path, simulation, &population, NULL));
    assert_null(snapshot_read(path, fields, COUNT_OF(fields), &frame));
    const struct frame_group *group = &frame.group[0];
    for (int64_t i = 0; i < group->count; i++) {
        const double volume = (double)group->mass[i] / (double)group->field[0].value[i];
        const double wanted = pow(volume, 1.0 / dimension);
        assert_true(fabs((double)group->diameter[i] / wanted - 1.0) < 1e-5);
    }
    frame_free(&frame);
    drop_simulation(simulation);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(cells_have_their_centres_and_blocked_ones_are_left_out),
        IN_FOLDER(particles_come_back_in_the_order_of_their_ids),
        IN_FOLDER(particles_without_diameters_get_those_of_their_volumes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
