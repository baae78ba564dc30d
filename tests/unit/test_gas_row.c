/* Sweeps along rows of gas cells: Sod's tube, cut into rows whose ghosts are the cells of the
 * next ones. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "exact/gas_riemann.h"
#include "exact_solution.h"
#include "gas/lax_wendroff.h"
#include "gas/muscl_hancock.h"

static const struct exact_gas_riemann sod = {{{1.0, 0.0, 1.0, 1.4}, {0.125, 0.0, 0.1, 1.4}}, 0.5};
static const double end = 0.143, courant = 0.5;

struct tube {
    struct eos eos;
    int cells, rows; /* cells at most in a row */
    double edge;
    double *u[GAS_NUMBERS]; /* of cells -ROW_GHOSTS .. cells + ROW_GHOSTS - 1, from the first on */
};

static double *number_of(const struct tube *tube, int n, int cell)
{
    return &tube->u[n][cell + ROW_GHOSTS];
}

static struct tube open_tube(int cells, int rows)
{
    const struct eos_ideal_gas gas = {1.0, 1.4};
    struct tube tube = {eos_make_ideal_gas(&gas), cells, rows, 1.0 / cells, {NULL}};
    for (int n = 0; n < GAS_NUMBERS; n++)
        tube.u[n] = calloc((size_t)cells + 2 * ROW_GHOSTS, sizeof(double));
    for (int c = 0; c < cells; c++) {
        const struct exact_gas *side = &sod.gas[(c + 0.5) * tube.edge > sod.at];
        *number_of(&tube, GAS_DENSITY, c) = side->density;
        *number_of(&tube, GAS_ENERGY, c) = side->pressure / (side->gamma - 1.0);
    }
    return tube;
}

static void close_tube(struct tube *tube)
{
    for (int n = 0; n < GAS_NUMBERS; n++)
        free(tube->u[n]);
}

static struct gas_row row_at(const struct tube *tube, int first, int axis)
{
    struct gas_row row = {.closure = {.eos = &tube->eos}, .axis = axis};
    row.cells = tube->cells - first < tube->rows ? tube->cells - first : tube->rows;
    for (int n = 0; n < GAS_NUMBERS; n++)
        memcpy(row.u.of[n], &tube->u[n][first],
               ((size_t)row.cells + 2 * ROW_GHOSTS) * sizeof(double));
    return row;
}

static double fastest(const struct tube *tube)
{
    double speed = 0.0;
    for (int c = 0; c < tube->cells; c++) {
        const double density = *number_of(tube, GAS_DENSITY, c),
                     u = *number_of(tube, GAS_MOMENTUM, c) / density,
                     energy = *number_of(tube, GAS_ENERGY, c) / density - 0.5 * square(u);
        speed = maximum(speed, fabs(u) + sqrt(1.4 * 0.4 * energy));
    }
    return speed;
}

/* A sweep by SCHEME, or MUSCL-Hancock where it is NULL; beyond the ends of the tube are copies
 * of its last cells, or those of the other end of a RING. */
static void sweep(struct tube *tube, const struct lax_wendroff *scheme, double r, bool ring)
{
    double *next[GAS_NUMBERS];
    for (int n = 0; n < GAS_NUMBERS; n++) {
        for (int g = 1; g <= ROW_GHOSTS; g++) {
            *number_of(tube, n, -g) = *number_of(tube, n, ring ? tube->cells - g : 0);
            *number_of(tube, n, tube->cells - 1 + g) =
                *number_of(tube, n, ring ? g - 1 : tube->cells - 1);
        }
        next[n] = calloc((size_t)tube->cells + 2 * ROW_GHOSTS, sizeof(double));
    }
    for (int first = 0; first < tube->cells; first += tube->rows) {
        struct gas_row row = row_at(tube, first, 0);
        struct gas_numbers flux;
        if (scheme)
            row_lax_wendroff(&row, scheme, r, &flux);
        else
            row_muscl_hancock(&row, r, &flux);
        for (int n = 0; n < GAS_NUMBERS; n++)
            memcpy(&next[n][first + ROW_GHOSTS], &row.u.of[n][ROW_GHOSTS],
                   (size_t)row.cells * sizeof(double));
    }
    for (int n = 0; n < GAS_NUMBERS; n++) {
        free(tube->u[n]);
        tube->u[n] = next[n];
    }
}

static void run_until(struct tube *tube, const struct lax_wendroff *scheme, double until, bool ring)
{
    for (double time = 0.0; time < until;) {
        double dt = courant * tube->edge / fastest(tube);
        dt = time + dt > until ? until - time : dt;
        sweep(tube, scheme, dt / tube->edge, ring);
        time = until - time <= dt ? until : time + dt;
    }
}

static struct tube run_tube(const struct lax_wendroff *scheme, int cells, int rows)
{
    struct tube tube = open_tube(cells, rows);
    run_until(&tube, scheme, end, false);
    return tube;
}

struct errors {
    double density, velocity, pressure;
};

/* L1 at the centres of cells. */
static struct errors errors_of(const struct tube *tube)
{
    struct solution solution = solve(&exact_gas_riemann_class, &sod, end);
    const double contact = solution.class->contact(solution.solved, end);
    struct errors errors = {0.0, 0.0, 0.0};
    for (int c = 0; c < tube->cells; c++) {
        const double x = (c + 0.5) * tube->edge, density = *number_of(tube, GAS_DENSITY, c),
                     u = *number_of(tube, GAS_MOMENTUM, c) / density,
                     pressure = 0.4 * (*number_of(tube, GAS_ENERGY, c) - 0.5 * density * square(u));
        const struct exact_state exact =
            solution.class->sample(solution.solved, x < contact ? SIDE_LEFT : SIDE_RIGHT, x, end);
        errors.density += tube->edge * fabs(density - exact.density);
        errors.velocity += tube->edge * fabs(u - exact.velocity);
        errors.pressure += tube->edge * fabs(pressure - exact.pressure);
    }
    release(&solution);
    return errors;
}

static const struct lax_wendroff standard = {LAX_WENDROFF_RICHTMYER, VISCOSITY_OF_FACES, 0.25,
                                             false};

/* Figures of the prototype that the scheme was restored with. */
static void lax_wendroff_has_the_errors_of_its_prototype(void **state)
{
    (void)state;
    static const struct {
        int cells;
        const char *density, *velocity, *pressure;
    } table[] = {{100, "9.306", "16.43", "7.897"},  {200, "5.400", "8.468", "4.069"},
                 {400, "2.904", "4.337", "2.062"},  {500, "2.385", "3.515", "1.662"},
                 {800, "1.610", "2.280", "1.048"},  {1000, "1.354", "1.716", "0.854"},
                 {1600, "0.890", "1.055", "0.520"}, {2000, "0.737", "0.850", "0.411"}};
    for (size_t k = 0; k < COUNT_OF(table); k++) {
        struct tube tube = run_tube(&standard, table[k].cells, ROW_CELLS);
        const struct errors errors = errors_of(&tube);
        assert_printed("density", errors.density, 1e-3, table[k].density);
        assert_printed("velocity", errors.velocity, 1e-3, table[k].velocity);
        assert_printed("pressure", errors.pressure, 1e-3, table[k].pressure);
        close_tube(&tube);
    }
}

static double total(const struct tube *tube, int n)
{
    double sum = 0.0;
    for (int c = 0; c < tube->cells; c++)
        sum += tube->edge * *number_of(tube, n, c);
    return sum;
}

static void mass_and_energy_stay(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct tube tube = run_tube(k ? &standard : NULL, 1000, ROW_CELLS);
        assert_near(total(&tube, GAS_DENSITY), 0.5625, 0.5625, 1e-12);
        assert_near(total(&tube, GAS_ENERGY), 1.375, 1.375, 1e-12);
        close_tube(&tube);
    }
}

static void the_shock_is_where_it_should_be_and_does_not_ring(void **state)
{
    (void)state;
    struct tube tube = run_tube(&standard, 1000, ROW_CELLS);
    double largest = 0.0, shock = 0.0;
    for (int c = 0; c < tube.cells; c++) {
        const double x = (c + 0.5) * tube.edge, density = *number_of(&tube, GAS_DENSITY, c),
                     momentum = *number_of(&tube, GAS_MOMENTUM, c),
                     pressure = 0.4 * (*number_of(&tube, GAS_ENERGY, c) -
                                       0.5 * square(momentum) / density);
        if (x > 0.52 && x < 0.74)
            largest = maximum(largest, pressure);
        if (pressure > 0.2)
            shock = x;
    }
    assert_true(largest <= 0.305);
    assert_near(shock, 0.7506, 1.0, 2.0 * tube.edge);
    close_tube(&tube);
}

/* Neither what is printed for the scheme nor for its viscosity can be meant: the one
 * stops converging, the other loses mass. */
static void the_printed_forms_fail(void **state)
{
    (void)state;
    const struct lax_wendroff printed = {LAX_WENDROFF_PRINTED, VISCOSITY_OF_FACES, 0.25, false},
                              cells = {LAX_WENDROFF_RICHTMYER, VISCOSITY_OF_CELLS, 0.25, false};
    struct tube coarse = run_tube(&printed, 1600, ROW_CELLS),
                fine = run_tube(&printed, 2000, ROW_CELLS),
                lossy = run_tube(&cells, 1000, ROW_CELLS);
    const double error = errors_of(&fine).pressure, before = errors_of(&coarse).pressure;
    assert_printed("error of pressure", error, 1e-4, "9");
    assert_printed("order", log(before / error) / log(1.25), 1.0, "0.34");
    const double lost = total(&lossy, GAS_DENSITY) / 0.5625 - 1.0;
    assert_printed("mass", lost, 1e-3, "-1.1");
    close_tube(&coarse);
    close_tube(&fine);
    close_tube(&lossy);
}

static void rows_of_any_length_give_the_same_bits(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct tube tube = run_tube(k ? &standard : NULL, 300, ROW_CELLS);
        for (int rows = 1; rows < ROW_CELLS; rows += 7) {
            struct tube other = run_tube(k ? &standard : NULL, 300, rows);
            for (int n = 0; n < GAS_NUMBERS; n++)
                assert_memory_equal(number_of(&tube, n, 0), number_of(&other, n, 0),
                                    300 * sizeof(double));
            close_tube(&other);
        }
        close_tube(&tube);
    }
}

/* Of two rows side by side, each knows of the face between them what flows through it. */
static void neighbours_agree_on_what_flows_between_them(void **state)
{
    (void)state;
    struct tube tube = run_tube(&standard, 100, ROW_CELLS);
    for (int g = 0; g < ROW_GHOSTS; g++)
        for (int n = 0; n < GAS_NUMBERS; n++)
            *number_of(&tube, n, -1 - g) = *number_of(&tube, n, 0),
                                      *number_of(&tube, n, tube.cells + g) =
                                          *number_of(&tube, n, tube.cells - 1);
    tube.rows = 50;
    struct gas_row low = row_at(&tube, 0, 0), high = row_at(&tube, 50, 0);
    struct gas_numbers leaves, enters;
    row_lax_wendroff(&low, &standard, 0.3, &leaves);
    row_lax_wendroff(&high, &standard, 0.3, &enters);
    for (int n = 0; n < GAS_NUMBERS; n++)
        assert_true(leaves.of[n][50 + ROW_GHOSTS] == enters.of[n][ROW_GHOSTS]);
    close_tube(&tube);
}

/* The momentum along the row is that of its axis; what lies across is carried along. */
static void all_axes_are_alike(void **state)
{
    (void)state;
    struct tube tube = run_tube(&standard, ROW_CELLS, ROW_CELLS);
    struct gas_row x = row_at(&tube, 0, 0);
    FOR_ROW (k, -ROW_GHOSTS, x.cells + ROW_GHOSTS - 1) {
        x.u.of[GAS_DENSITY][k] = maximum(x.u.of[GAS_DENSITY][k], 0.1);
        x.u.of[GAS_ENERGY][k] = maximum(x.u.of[GAS_ENERGY][k], 1.0);
        x.u.of[GAS_MOMENTUM + 1][k] = 0.1 * x.u.of[GAS_DENSITY][k];
    }
    struct gas_row z = x;
    z.axis = 2;
    memcpy(z.u.of[GAS_MOMENTUM + 2], x.u.of[GAS_MOMENTUM], sizeof x.u.of[0]);
    memcpy(z.u.of[GAS_MOMENTUM], x.u.of[GAS_MOMENTUM + 1], sizeof x.u.of[0]);
    memcpy(z.u.of[GAS_MOMENTUM + 1], x.u.of[GAS_MOMENTUM + 2], sizeof x.u.of[0]);
    struct gas_numbers along_x, along_z;
    row_lax_wendroff(&x, &standard, 0.2, &along_x);
    row_lax_wendroff(&z, &standard, 0.2, &along_z);
    close_tube(&tube);
    FOR_ROW (k, 0, x.cells - 1) {
        assert_near(x.u.of[GAS_MOMENTUM][k], z.u.of[GAS_MOMENTUM + 2][k], 1.0, 1e-14);
        assert_near(x.u.of[GAS_MOMENTUM + 1][k], 0.1 * x.u.of[GAS_DENSITY][k], 1.0, 1e-14);
        assert_near(z.u.of[GAS_MOMENTUM][k], 0.1 * z.u.of[GAS_DENSITY][k], 1.0, 1e-14);
        assert_near(x.u.of[GAS_ENERGY][k], z.u.of[GAS_ENERGY][k], 1.0, 1e-14);
    }
}

/* Regression bounds: what was measured, 0.49 to 0.63 of the errors of Lax-Wendroff, and a
 * twentieth. */
static void muscl_hancock_has_half_of_the_errors_of_lax_wendroff(void **state)
{
    (void)state;
    for (int cells = 100; cells <= 1600; cells *= 2) {
        struct tube one = run_tube(NULL, cells, ROW_CELLS),
                    other = run_tube(&standard, cells, ROW_CELLS);
        const struct errors a = errors_of(&one), b = errors_of(&other);
        if (!(a.density < 0.53 * b.density && a.velocity < 0.66 * b.velocity &&
              a.pressure < 0.5 * b.pressure))
            fail_msg("%d cells: %g, %g, %g of the errors", cells, a.density / b.density,
                     a.velocity / b.velocity, a.pressure / b.pressure);
        close_tube(&one);
        close_tube(&other);
    }
}

/* A sound wave so small that it does not steepen comes round a ring. */
static void a_sound_wave_converges_with_order_two(void **state)
{
    (void)state;
    const double small = 1e-7, sound = sqrt(1.4), turn = 2.0 * acos(-1.0);
    double last = 0.0;
    for (int cells = 32; cells <= 256; cells *= 2) {
        struct tube tube = open_tube(cells, ROW_CELLS);
        double error = 0.0;
        for (int c = 0; c < cells; c++) {
            const double rise = small * sin(turn * (c + 0.5) * tube.edge), u = sound * rise,
                         pressure = 1.0 + 1.4 * rise;
            *number_of(&tube, GAS_DENSITY, c) = 1.0 + rise;
            *number_of(&tube, GAS_MOMENTUM, c) = (1.0 + rise) * u;
            *number_of(&tube, GAS_ENERGY, c) = pressure / 0.4 + 0.5 * (1.0 + rise) * square(u);
        }
        run_until(&tube, NULL, 1.0 / sound, true);
        for (int c = 0; c < cells; c++)
            error += tube.edge / small *
                     fabs(*number_of(&tube, GAS_DENSITY, c) - 1.0 -
                          small * sin(turn * (c + 0.5) * tube.edge));
        if (cells > 32 && !(log2(last / error) > 1.9))
            fail_msg("%d cells: error %g, order %g", cells, error, log2(last / error));
        last = error;
        close_tube(&tube);
    }
}

/* Pressure and velocity stay the same on both sides of a contact that moves through the cells,
 * where a mixture by volume of both states has their pressure too. */
static void a_contact_that_moves_keeps_its_pressure(void **state)
{
    (void)state;
    static const struct eos_stiffened_gas water = EOS_stiffened_gas_SAMPLE;
    const struct eos_ideal_gas air = {1.0, 1.4};
    const struct eos eos[] = {eos_make_ideal_gas(&air), eos_make_stiffened_gas(&water)};
    const double none[POINT_HISTORY] = {0.0}, speed = 300.0, pressure = 2e8;
    for (size_t kind = 0; kind < COUNT_OF(eos); kind++) {
        struct gas_row row = {.closure = {.eos = &eos[kind]}, .cells = ROW_CELLS, .axis = 1};
        struct gas_numbers flux;
        for (int step = 0; step < 10; step++) {
            FOR_ROW (k, -ROW_GHOSTS, row.cells + ROW_GHOSTS - 1) {
                if (step && k >= ROW_GHOSTS && k < ROW_GHOSTS + row.cells)
                    continue;
                const double density = k < ROW_GHOSTS + 20 ? 900.0 : 300.0;
                const struct eos_value at = eos_evaluate(row.closure.eos, density, 1e6, none);
                const double energy = 1e6 + (pressure - at.pressure) / at.dp_de;
                row.u.of[GAS_DENSITY][k] = density;
                row.u.of[GAS_MOMENTUM + 1][k] = density * speed;
                row.u.of[GAS_MOMENTUM][k] = density * 10.0;
                row.u.of[GAS_ENERGY][k] = density * (energy + 0.5 * (square(speed) + square(10.0)));
            }
            row_muscl_hancock(&row, 1e-4, &flux);
        }
        struct row_states states = {0};
        double fall[ROW_ROOM];
        row_states(&row, &(struct gas_content){.kind = NULL}, &states, fall);
        FOR_ROW (k, 0, row.cells - 1) {
            assert_near(states.of.of[PRIMITIVE_PRESSURE][k], pressure, pressure, 1e-9);
            assert_near(states.of.of[PRIMITIVE_VELOCITY + 1][k], speed, speed, 1e-10);
            assert_near(states.of.of[PRIMITIVE_VELOCITY][k], 10.0, 10.0, 1e-12);
        }
        assert_true(row.u.of[GAS_DENSITY][ROW_GHOSTS + 20] > 400.0); /* it has moved on */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lax_wendroff_has_the_errors_of_its_prototype),
        cmocka_unit_test(mass_and_energy_stay),
        cmocka_unit_test(the_shock_is_where_it_should_be_and_does_not_ring),
        cmocka_unit_test(the_printed_forms_fail),
        cmocka_unit_test(rows_of_any_length_give_the_same_bits),
        cmocka_unit_test(neighbours_agree_on_what_flows_between_them),
        cmocka_unit_test(all_axes_are_alike),
        cmocka_unit_test(muscl_hancock_has_half_of_the_errors_of_lax_wendroff),
        cmocka_unit_test(a_sound_wave_converges_with_order_two),
        cmocka_unit_test(a_contact_that_moves_keeps_its_pressure)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
