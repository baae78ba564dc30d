/* The grid of the material point method: shape functions, particles in cells, and the loops between
 * particles and nodes, judged by slow ones. */
#include "dice.h"

#include <stdlib.h>
#include <string.h>

#include "mpm/transfer.h"

enum { PARTICLES = 700 };

/* Particles in a box about the origin, stored as one block of the key that the first of them has,
 * so that most are strays. */
struct cloud {
    struct transfer transfer;
    struct bins bins;
    struct grid grid;
    struct grid_field main, back;
    struct block block[2];
    struct binned binned;
    double position[PARTICLES][3], velocity[PARTICLES][3], deviator[PARTICLES][6],
        gradient[PARTICLES][9];
    double energy[PARTICLES], mass[PARTICLES], density[PARTICLES], pressure[PARTICLES],
        viscosity[PARTICLES];
    uint64_t id[PARTICLES];
    uint16_t material[PARTICLES], body[PARTICLES];
    double half_size, gauge;
};

static struct cloud *make_cloud(int dimension, enum grid_shape shape, bool affine, uint64_t seed)
{
    struct dice dice = {seed};
    struct cloud *c = calloc(1, sizeof *c);
    const double edge = 0.37, size = dimension == 1 ? 40.0 : dimension == 2 ? 6.0 : 2.2;
    for (int i = 0; i < PARTICLES; i++) {
        for (int k = 0; k < dimension; k++)
            c->position[i][k] = dice_between(&dice, -size, size);
        for (int k = 0; k < dimension; k++)
            c->velocity[i][k] = dice_between(&dice, -3.0, 3.0);
        for (int k = 0; k < 6; k++)
            c->deviator[i][k] = dice_between(&dice, -1.0, 1.0);
        for (int k = 0; k < 9; k++)
            c->gradient[i][k] = dice_between(&dice, -1.0, 1.0);
        c->mass[i] = dice_between(&dice, 0.5, 1.5);
        c->density[i] = dice_between(&dice, 0.5, 1.5);
        c->pressure[i] = dice_between(&dice, -1.0, 1.0);
        c->viscosity[i] = dice_between(&dice, 0.0, 0.3);
        c->id[i] = dice_word(&dice);
    }
    c->half_size = 0.31;
    c->gauge = 0.2;
    const int64_t origin[3] = {0, 0, 0}, below[3] = {-1, 0, 0};
    c->block[0] = (struct block){block_key(below), 0, PARTICLES / 2};
    c->block[1] = (struct block){block_key(origin), PARTICLES / 2, PARTICLES - PARTICLES / 2};
    c->binned = (struct binned){.dimension = dimension,
                                .edge = edge,
                                .shift = shape_window_of(shape, false).centred ? 0.5 * edge : 0.0,
                                .count = PARTICLES,
                                .blocks = 2,
                                .block = c->block,
                                .position = (const double(*)[3])c->position,
                                .id = c->id,
                                .order = 1,
                                .groups = 1,
                                .low = {INT64_MIN, INT64_MIN, INT64_MIN},
                                .high = {INT64_MAX, INT64_MAX, INT64_MAX}};
    assert_success(bins_find(&c->bins, &c->binned, 2));
    assert_success(bins_fill(&c->bins, &c->binned, 2));
    grid_start(&c->grid, dimension, shape_window_of(shape, false));
    c->main.stride = NODE_STRIDE;
    c->back.stride = BACK_STRIDE;
    assert_success(grid_plan(&c->grid, &c->bins));
    assert_success(grid_field_reserve(&c->main, &c->grid));
    assert_success(grid_field_reserve(&c->back, &c->grid));
    c->transfer = (struct transfer){.dimension = dimension,
                                    .shape = shape,
                                    .window = 1 + c->grid.reach + c->grid.after,
                                    .affine = affine,
                                    .by_moments = true,
                                    .edge = edge,
                                    .bins = &c->bins,
                                    .grid = &c->grid,
                                    .main = &c->main,
                                    .back = &c->back,
                                    .flip = 0.25,
                                    .position = c->position,
                                    .velocity = c->velocity,
                                    .energy = c->energy,
                                    .mass = c->mass,
                                    .density = c->density,
                                    .pressure = c->pressure,
                                    .viscosity = c->viscosity,
                                    .deviator = (const double(*)[6])c->deviator,
                                    .material = c->material,
                                    .body = c->body,
                                    .gradient = affine ? c->gradient : NULL,
                                    .half_size = &c->half_size,
                                    .gauge = &c->gauge};
    return c;
}

static void free_cloud(struct cloud *c)
{
    bins_free(&c->bins);
    grid_free(&c->grid);
    grid_field_free(&c->main);
    grid_field_free(&c->back);
    free(c);
}

/* One step of sums over particles, at all nodes. */
static void sum_cloud(struct cloud *c)
{
    for (int32_t b = 0; b < c->bins.count; b++)
        transfer_scatter(&c->transfer, b);
    for (int32_t n = 0; n < c->grid.blocks; n++)
        grid_reduce(&c->grid, &c->main, n);
}

static void node_place(const struct cloud *c, int32_t n, int k, int64_t at[3])
{
    int place[3];
    grid_corner(&c->grid, n, at);
    bin_cell_place(c->grid.dimension, k, place);
    for (int axis = 0; axis < 3; axis++)
        at[axis] += place[axis];
}

/* The shape function of particle I at a node and its slopes, found from nothing but their
 * places. */
static double slow_weight(const struct cloud *c, int i, const int64_t at[3], double slope[3])
{
    double value[3] = {1.0, 1.0, 1.0}, along[3] = {0.0, 0.0, 0.0};
    for (int axis = 0; axis < c->grid.dimension; axis++) {
        const double r = c->position[i][axis] / c->binned.edge - (double)at[axis];
        value[axis] = shape_value(c->transfer.shape, r, c->half_size);
        along[axis] = shape_slope(c->transfer.shape, r, c->half_size) / c->binned.edge;
    }
    slope[0] = along[0] * value[1] * value[2];
    slope[1] = value[0] * along[1] * value[2];
    slope[2] = value[0] * value[1] * along[2];
    return value[0] * value[1] * value[2];
}

static void shape_functions_add_up_to_one_and_their_slopes_to_nothing(void **state)
{
    (void)state;
    struct dice dice = {5};
    for (int shape = SHAPE_LINEAR; shape <= SHAPE_CUBIC; shape++)
        for (int trial = 0; trial < 2000; trial++) {
            const double x = dice_between(&dice, 0.0, 1.0), half = dice_between(&dice, 0.05, 0.5);
            double sum = 0.0, slopes = 0.0, moment = 0.0, step = 1e-6;
            for (int node = -2; node <= 3; node++) {
                const double r = x - node, s = shape_slope(shape, r, half);
                sum += shape_value(shape, r, half);
                slopes += s;
                moment += s * node;
                if (fabs(x - 0.5) < 0.49 && shape != SHAPE_GIMP)
                    assert_near(
                        s,
                        (shape_value(shape, r + step, half) - shape_value(shape, r - step, half)) /
                            (2.0 * step),
                        2e-6);
            }
            assert_near(sum, 1.0, 1e-14);
            assert_near(slopes, 0.0, 1e-13);
            assert_near(moment, 1.0, 1e-13);
        }
}

static void particles_lie_in_their_cells_in_the_order_of_ids(void **state)
{
    (void)state;
    for (int dimension = 1; dimension <= 3; dimension++) {
        struct cloud *c = make_cloud(dimension, SHAPE_LINEAR, false, 11);
        bool seen[PARTICLES] = {false};
        int32_t count = 0;
        for (int32_t b = 0; b < c->bins.count; b++) {
            const struct bin *bin = &c->bins.bin[b];
            assert_int_equal(bin->first, count);
            assert_true(b == 0 || bin->key > bin[-1].key);
            for (int cell = 0; cell < BLOCK_CELLS; cell++)
                for (int32_t k = bin->cell[cell]; k < bin->cell[cell + 1]; k++, count++) {
                    const int32_t i = c->bins.list[bin->first + k];
                    int64_t block[3];
                    int place[3];
                    block_coordinates(bin->key, block);
                    bin_cell_place(dimension, cell, place);
                    for (int axis = 0; axis < dimension; axis++)
                        assert_int_equal((int64_t)floor((c->position[i][axis] + c->binned.shift) /
                                                        c->binned.edge),
                                         block[axis] * block_cells(dimension) + place[axis]);
                    assert_false(seen[i]);
                    seen[i] = true;
                    if (k > bin->cell[cell])
                        assert_true(c->id[i] > c->id[c->bins.list[bin->first + k - 1]]);
                }
        }
        assert_int_equal(count, PARTICLES);
        free_cloud(c);
    }
}

static void nodes_have_what_a_slow_sum_over_all_particles_gives(void **state)
{
    (void)state;
    for (int kind = 0; kind < 3 * 4 * 2; kind++) {
        const int dimension = 1 + kind % 3;
        const enum grid_shape shape = (enum grid_shape)(kind / 3 % 4);
        struct cloud *c = make_cloud(dimension, shape, kind / 12 > 0, 21 + (uint64_t)kind);
        sum_cloud(c);
        double mass = 0.0, momentum = 0.0, force = 0.0, all = 0.0, push = 0.0;
        for (int32_t n = 0; n < c->grid.blocks; n++)
            for (int k = 0; k < BLOCK_CELLS; k++) {
                const double *node = grid_node(&c->main, n, k);
                mass += node[NODE_MASS];
                momentum += node[NODE_MOMENTUM];
                force += node[NODE_FORCE];
                if (k % 7 != n % 7) /* a part of them is enough */
                    continue;
                int64_t at[3];
                double slow[NODE_STRIDE] = {0}, slope[3];
                node_place(c, n, k, at);
                for (int i = 0; i < PARTICLES; i++) {
                    const double w = slow_weight(c, i, at, slope);
                    const double *s = c->deviator[i],
                                 p = c->pressure[i] + c->viscosity[i] - c->gauge,
                                 volume = c->mass[i] / c->density[i];
                    const double stress[3][3] = {
                        {s[0] - p, s[3], s[5]}, {s[3], s[1] - p, s[4]}, {s[5], s[4], s[2] - p}};
                    slow[NODE_MASS] += w * c->mass[i];
                    for (int a = 0; a < dimension; a++) {
                        double u = c->velocity[i][a];
                        for (int b = 0; b < dimension && c->transfer.affine; b++)
                            u += c->gradient[i][3 * a + b] *
                                 ((double)at[b] * c->binned.edge - c->position[i][b]);
                        slow[NODE_MOMENTUM + a] += w * c->mass[i] * u;
                        for (int b = 0; b < dimension; b++)
                            slow[NODE_FORCE + a] -= volume * stress[a][b] * slope[b];
                    }
                }
                for (int f = 0; f < NODE_STRIDE; f++)
                    assert_near(node[f], slow[f], 1e-12 * PARTICLES);
            }
        for (int i = 0; i < PARTICLES; i++) {
            all += c->mass[i];
            push += c->mass[i] * c->velocity[i][0];
        }
        assert_near(mass, all, 1e-12 * all);
        assert_near(momentum, push, 1e-12 * all);
        assert_near(force, 0.0, 1e-11 * all);
        free_cloud(c);
    }
}

/* Linear fields at all nodes: velocity a + B x, acceleration twice that. */
static const double start[3] = {0.3, -0.2, 0.5},
                    slopes[3][3] = {{0.2, -0.4, 0.1}, {0.5, 0.3, -0.6}, {-0.1, 0.7, 0.2}};

static double linear_at(const struct cloud *c, const double x[3], int k)
{
    double value = start[k];
    for (int j = 0; j < c->grid.dimension; j++)
        value += slopes[k][j] * x[j];
    return value;
}

static void set_linear(struct cloud *c)
{
    for (int32_t n = 0; n < c->grid.blocks; n++)
        for (int k = 0; k < BLOCK_CELLS; k++) {
            int64_t at[3];
            node_place(c, n, k, at);
            const double x[3] = {(double)at[0] * c->binned.edge, (double)at[1] * c->binned.edge,
                                 (double)at[2] * c->binned.edge};
            for (int a = 0; a < c->grid.dimension; a++) {
                grid_node(&c->main, n, k)[NODE_VELOCITY + a] = linear_at(c, x, a);
                grid_node(&c->main, n, k)[NODE_ACCELERATION + a] = 2.0 * linear_at(c, x, a);
            }
        }
}

static void particles_take_a_linear_field_from_nodes_as_it_is(void **state)
{
    (void)state;
    static double rate[RATES][PARTICLES + 7], old[PARTICLES][3], before[PARTICLES][3];
    for (int kind = 0; kind < 3 * 4; kind++) {
        const int dimension = 1 + kind % 3;
        const double dt = 0.01;
        struct cloud *c = make_cloud(dimension, (enum grid_shape)(kind / 3), true, 3);
        sum_cloud(c);
        set_linear(c);
        memcpy(old, c->velocity, sizeof old);
        memcpy(before, c->position, sizeof before);
        for (int32_t b = 0; b < c->bins.count; b++) {
            grid_spread(&c->grid, &c->main, b);
            transfer_velocity(&c->transfer, b, (struct transfer_step){dt, false}, true);
            const struct nodal velocity = {grid_patch(&c->grid, &c->main, b) + NODE_VELOCITY,
                                           NODE_STRIDE};
            transfer_gradient(&c->transfer, b, (struct transfer_step){dt, true}, velocity,
                              (struct rates){&rate[0][c->bins.bin[b].first], PARTICLES + 7});
        }
        for (int32_t n = 0; n < c->grid.blocks; n++)
            grid_reduce(&c->grid, &c->back, n);
        double total[3] = {0.0}, nodes[3] = {0.0};
        for (int32_t k = 0; k < PARTICLES; k++) {
            const int32_t i = c->bins.list[k];
            for (int a = 0; a < dimension; a++) {
                const double field = linear_at(c, before[i], a);
                assert_near(c->velocity[i][a], 0.25 * (old[i][a] + dt * 2.0 * field) + 0.75 * field,
                            1e-13);
                assert_near(c->position[i][a], before[i][a] + dt * field, 1e-13);
                for (int b = 0; b < dimension; b++)
                    assert_near(c->gradient[i][3 * a + b], slopes[a][b], 1e-11);
                total[a] += c->mass[i] * c->velocity[i][a];
            }
            assert_near(rate[0][k], slopes[0][0], 1e-12);
            if (dimension < 2)
                continue;
            assert_near(rate[3][k], 0.5 * (slopes[0][1] + slopes[1][0]), 1e-12);
            assert_near(rate[RATE_SPIN + 2][k], 0.5 * (slopes[1][0] - slopes[0][1]), 1e-12);
        }
        for (int32_t n = 0; n < c->grid.blocks; n++)
            for (int k = 0; k < BLOCK_CELLS; k++)
                for (int a = 0; a < dimension; a++)
                    nodes[a] += grid_node(&c->back, n, k)[a];
        for (int a = 0; a < dimension; a++)
            assert_near(nodes[a], total[a], 1e-10);
        free_cloud(c);
    }
}

/* Angular momentum about z of all particles, and of what their gradients give to nodes on either
 * side of them. */
static double spin_of_particles(const struct cloud *c)
{
    double spin = 0.0;
    for (int i = 0; i < PARTICLES; i++) {
        const double *x = c->position[i], *u = c->velocity[i], *g = c->gradient[i];
        double second[2] = {0.0, 0.0}; /* moment of the shape function */
        for (int axis = 0; axis < 2; axis++)
            for (int node = -2; node <= 3; node++) {
                const double at = floor(x[axis] / c->binned.edge) + node,
                             r = x[axis] / c->binned.edge - at;
                second[axis] +=
                    shape_value(c->transfer.shape, r, c->half_size) * square(r * c->binned.edge);
            }
        spin += c->mass[i] * (x[0] * u[1] - x[1] * u[0]);
        if (c->transfer.affine)
            spin += c->mass[i] * (second[0] * g[3] - second[1] * g[1]);
    }
    return spin;
}

/* The same of all nodes; with TAKE they then have velocities. */
static double spin_of_nodes(const struct cloud *c, bool take)
{
    double spin = 0.0;
    for (int32_t n = 0; n < c->grid.blocks; n++)
        for (int k = 0; k < BLOCK_CELLS; k++) {
            double *node = grid_node(&c->main, n, k);
            int64_t at[3];
            node_place(c, n, k, at);
            spin += c->binned.edge *
                    ((double)at[0] * node[NODE_MOMENTUM + 1] - (double)at[1] * node[NODE_MOMENTUM]);
            for (int a = 0; a < 3 && take; a++) {
                node[NODE_VELOCITY + a] =
                    node[NODE_MASS] > 0.0 ? node[NODE_MOMENTUM + a] / node[NODE_MASS] : 0.0;
                node[NODE_ACCELERATION + a] = 0.0;
            }
        }
    return spin;
}

/* Jiang et al., ACM Trans. Graph. 34 (2015) 51: there and back. Without gradients what comes back
 * is less. */
static void nodes_have_the_angular_momentum_of_particles_and_moments_bring_it_back(void **state)
{
    (void)state;
    for (int kind = 0; kind < 2 * 3 * 2; kind++) {
        const bool affine = kind % 2 == 0;
        struct cloud *c = make_cloud(2 + kind / 2 % 2, (enum grid_shape)(SHAPE_GIMP + kind / 4),
                                     affine, 71 + (uint64_t)kind);
        const double scale = PARTICLES * 30.0;
        c->transfer.flip = 0.0;
        sum_cloud(c);
        const double before = spin_of_particles(c);
        assert_near(spin_of_nodes(c, true), before, 1e-13 * scale);
        for (int32_t b = 0; b < c->bins.count; b++) {
            grid_spread(&c->grid, &c->main, b);
            transfer_velocity(&c->transfer, b, (struct transfer_step){0.01, false}, false);
        }
        const double lost = spin_of_particles(c) - before;
        assert_true(affine ? fabs(lost) < 1e-12 * scale : fabs(lost) > 1e-6 * scale);
        free_cloud(c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shape_functions_add_up_to_one_and_their_slopes_to_nothing),
        cmocka_unit_test(particles_lie_in_their_cells_in_the_order_of_ids),
        cmocka_unit_test(nodes_have_the_angular_momentum_of_particles_and_moments_bring_it_back),
        cmocka_unit_test(nodes_have_what_a_slow_sum_over_all_particles_gives),
        cmocka_unit_test(particles_take_a_linear_field_from_nodes_as_it_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
