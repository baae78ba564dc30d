/* Two materials in cells of several levels: contacts that pass from one to another, be it that they
 * move or that the levels change, and what must be conserved. */
#include <stdarg.h>

#include "populations.h"
#include "running.h"

#if defined(BOLIDE_SANITIZE)
enum { STEPS = 16, RANDOM = 3, CHANGES = 0 };
#else
enum { STEPS = 80, RANDOM = 9, CHANGES = 5 };
#endif
enum { BURNT = 180 }; /* steps, within which a charge has burnt */

static const struct variant plain = {"plain", 1, 1.0, NULL, false};

/* Texts are formats: speeds along x and y, m/s, and two places, mm. */
#define LET "let: {u: %g m/s, v: %g m/s, a: %g mm, b: %g mm}\n"
#define AIR "materials:\n  air: {eos: {ideal-gas: {density: 1.2 kg/m^3, gamma: 1.4}}}\n"
#define GAS "  gas: {eos: {ideal-gas: {density: 1000 kg/m^3, gamma: 1.667}}}\n"
#define ABEL                                                                        \
    "  gas: {eos: {noble-abel: {density: 1000 kg/m^3, gamma: 1.25, covolume: 2e-4 " \
    "m^3/kg}}}\n"
#define PRODUCTS                                                                       \
    "  gas: {eos: {jwl: {density: 1630 kg/m^3, a: 371.2 GPa, b: 3.231 GPa, r1: 4.15, " \
    "r2: 0.95, omega: 0.3, energy: 6.993 GPa}}}\n"
#define AIR_AT(p) "material: air, density: 1 kg/m^3, pressure: " p
#define GAS_AT(p) "material: gas, density: 1000 kg/m^3, pressure: " p
#define START "format: 1\nresolution: 1 mm\nlevels: 3\nrun: {until: 1 s}\n" LET
#define LINE                                           \
    START "dimension: 1\nsolver: {gas: {regrid: 0}}\n" \
          "fine: {middle: {box: {from: [256 mm], to: [320 mm]}}}\n" AIR
#define LINE_BODIES(first, other)                                                       \
    "bodies:\n  first: {" first ", box: {from: [0 mm], to: [768 mm]}, velocity: [u]}\n" \
    "  other: {" other ", box: {from: [a], to: [b]}, velocity: [u], replaces: first}\n"
#define PLANE                                          \
    START "dimension: 2\nsolver: {gas: {regrid: 0}}\n" \
          "fine: {middle: {box: {from: [64 mm, 64 mm], to: [80 mm, 80 mm]}}}\n" AIR
#define PLANE_BODIES(first, other)                                                           \
    "bodies:\n  first: {" first                                                              \
    ", box: {from: [0 mm, 0 mm], to: [160 mm, 160 mm]}, velocity: [u, v]}\n  other: {" other \
    ", ball: {center: [a, b], radius: 21.3 mm}, velocity: [u, v], replaces: first}\n"

static const struct {
    const char *text;
    double pressure;
    int dimension;
} contacts[] = {
    {LINE GAS LINE_BODIES(AIR_AT("0.1 MPa"), GAS_AT("0.1 MPa")), 1e5, 1},
    {LINE GAS LINE_BODIES(GAS_AT("0.1 MPa"), AIR_AT("0.1 MPa")), 1e5, 1},
    {LINE ABEL LINE_BODIES(AIR_AT("0.1 MPa"), GAS_AT("0.1 MPa")), 1e5, 1},
    {LINE PRODUCTS LINE_BODIES(AIR_AT("1 GPa"), GAS_AT("1 GPa")), 1e9, 1},
    {PLANE GAS PLANE_BODIES(AIR_AT("0.1 MPa"), GAS_AT("0.1 MPa")), 1e5, 2},
    {PLANE PRODUCTS PLANE_BODIES(AIR_AT("1 GPa"), GAS_AT("1 GPa")), 1e9, 2},
};

static struct running *begin_with(const char *text, ...)
{
    char filled[2000];
    va_list values;
    va_start(values, text);
    vsnprintf(filled, sizeof filled, text, values);
    va_end(values);
    return begin_fresh(filled, &plain);
}

/* What there is of each material, of momentum and energy. */
enum { FIRST, SECOND, MOMENTUM_X, MOMENTUM_Y, MOMENTUM_Z, ENERGY, SUMS };

static void sum_up(const struct running *run, double all[SUMS])
{
    const struct gas *gas = &run->gas;
    struct exact_sum sum[SUMS];
    memset(sum, 0, sizeof sum);
    for (int32_t i = 0; i < gas->cells->count; i++) {
        const double volume = gas_volume_of(gas, i), second = gas->u[GAS_SECOND][i];
        const double of[SUMS] = {gas->u[GAS_DENSITY][i] - second, second,
                                 gas->u[GAS_MOMENTUM][i],         gas->u[GAS_MOMENTUM + 1][i],
                                 gas->u[GAS_MOMENTUM + 2][i],     gas->u[GAS_ENERGY][i]};
        for (int n = 0; n < SUMS && (!gas->open || gas->open[i] != 0.0); n++)
            exact_sum_add(&sum[n], volume * of[n]);
    }
    for (int n = 0; n < SUMS; n++)
        all[n] = exact_sum_value(&sum[n]);
}

static void check_contact(const struct running *run, size_t c, const double speed[2])
{
    const struct gas *gas = &run->gas;
    int mixed = 0;
    for (int32_t i = 0; i < gas->cells->count; i++) {
        const double pressure = gas->cells->pressure[i], *velocity = gas->cells->velocity[i];
        mixed += gas->u[GAS_FRACTION][i] > 0.0 && gas->u[GAS_FRACTION][i] < 1.0;
        if (!(fabs(pressure - contacts[c].pressure) <= 1e-10 * contacts[c].pressure &&
              fabs(velocity[0] - speed[0]) <= 1e-10 * hypot(speed[0], speed[1]) &&
              fabs(velocity[1] - speed[1]) <= 1e-10 * hypot(speed[0], speed[1])))
            fail_msg("contact %zu, cell %d: pressure off by %g, velocity by %g, %g", c, (int)i,
                     pressure / contacts[c].pressure - 1.0, velocity[0] - speed[0],
                     velocity[1] - speed[1]);
    }
    assert_true(mixed > 0);
}

/* Into the fine cells and out of them. */
static void contacts_pass_faces_of_levels(void **state)
{
    (void)state;
    static const double speed[2][2] = {{1e3, 700.0}, {-1e3, -300.0}};
    for (size_t c = 0; c < COUNT_OF(contacts); c++)
        for (int back = 0; back < 2; back++) {
            const bool plane = contacts[c].dimension == 2;
            const double at = plane ? (back ? 100.0 : 50.0) : back ? 325.0 : 235.0;
            const double along[2] = {speed[back][0], plane ? speed[back][1] : 0.0};
            struct running *run =
                begin_with(contacts[c].text, along[0], along[1], at, plane ? at : at + 17.3);
            for (int k = 0; k < 4; k++) {
                step(run, STEPS / 4);
                check_contact(run, c, along);
            }
            end(run);
        }
}

/* The fine cells are elsewhere every few steps, as a wave might ask for; nothing passes the faces
 * of the domain but what comes in. */
static void contacts_stay_while_levels_change(void **state)
{
    (void)state;
    for (size_t c = 0; c < COUNT_OF(contacts); c++) {
        const double speed[2] = {300.0, contacts[c].dimension == 2 ? -200.0 : 0.0};
        struct running *run = begin_with(contacts[c].text, speed[0], speed[1], 60.0, 90.0);
        struct cell_region *region = &run->gas.cells->region[0];
        run->gas.parameters.regrid = 2;
        for (int k = 0; k < STEPS / 2; k++) {
            double before[SUMS], after[SUMS];
            for (int axis = 0; axis < contacts[c].dimension; axis++) {
                region->low[axis] = 11 * ((k + 3 * axis) % 9);
                region->high[axis] = region->low[axis] + 30;
            }
            sum_up(run, before);
            assert_success(gas_regrid(&run->gas, &run->simulation));
            sum_up(run, after);
            for (int n = 0; n < SUMS; n++)
                if (!(fabs(after[n] - before[n]) <= 1e-14 * fabs(before[n])))
                    fail_msg("contact %zu, number %d: %.17g becomes %.17g", c, n, before[n],
                             after[n]);
            step(run, 1);
            check_contact(run, c, speed);
        }
        end(run);
    }
}

/* A blast of products or of a gas in a closed box, with an obstacle, into TEXT. */
static void draw(struct dice *dice, int number, char *text, size_t room)
{
    static const char *const gases[] = {GAS, ABEL, PRODUCTS};
    const int dimension = 1 + number % 3;
    const double side = dimension == 1   ? 2048.0
                        : dimension == 2 ? 256.0
                                         : 96.0,
                 radius = side * dice_between(dice, 0.05, 0.12);
    char places[3][2][64], ball[64];
    int used = 0;
    for (int k = 0; k < 3; k++)
        for (int high = 0; high < 2; high++)
            snprintf(places[k][high], sizeof places[k][high],
                     dimension == 1   ? "[%g mm]"
                     : dimension == 2 ? "[%g mm, %g mm]"
                                      : "[%g mm, %g mm, %g mm]",
                     side * (k == 2 ? high ? 0.7 : 0.6 : high), side * (k == 2 ? 0.4 : 1.0) * high,
                     side * high);
    snprintf(ball, sizeof ball,
             dimension == 1   ? "[%g mm]"
             : dimension == 2 ? "[%g mm, %g mm]"
                              : "[%g mm, %g mm, %g mm]",
             side * dice_between(dice, 0.2, 0.45), side * dice_between(dice, 0.2, 0.7),
             side * dice_between(dice, 0.2, 0.7));
    used +=
        snprintf(text, room,
                 "format: 1\ndimension: %d\nresolution: 1 mm\nlevels: %d\nrun: {until: 1 s}\n"
                 "solver: {gas: {regrid: %d}}\n" AIR "%s"
                 "bodies:\n  air: {material: air, pressure: 0.1 MPa, box: {from: %s, to: %s}}\n"
                 "  hot: {material: gas, density: %g kg/m^3, pressure: %g Pa, replaces: air,\n"
                 "    ball: {center: %s, radius: %g mm}}\nboundaries:\n",
                 dimension, 2 + dice_below(dice, 3), 1 + dice_below(dice, 4), gases[number / 3 % 3],
                 places[0][0], places[0][1], pow(10.0, dice_between(dice, 0.0, 3.1)),
                 pow(10.0, dice_between(dice, 4.0, 6.5)), ball, radius);
    for (int face = 0; face < 2 * dimension; face++)
        used += snprintf(text + used, room - (size_t)used,
                         "  f%d: {kind: reflecting, axis: %c, at: %g mm, side: %s}\n", face,
                         "xyz"[face / 2], face % 2 ? side : 0.0, face % 2 ? "high" : "low");
    if (dice_below(dice, 2))
        snprintf(text + used, room - (size_t)used,
                 "  block: {kind: rigid-body, part: {box: {from: %s, to: %s}}}\n", places[2][0],
                 places[2][1]);
}

static void two_materials_are_conserved(void **state)
{
    (void)state;
    struct dice dice = {72};
    int changes = 0;
    for (int k = 0; k < RANDOM; k++) {
        char text[3000];
        double before[SUMS], after[SUMS];
        draw(&dice, k, text, sizeof text);
        struct running *run = begin_fresh(text, &plain);
        const struct simulation *s = &run->simulation;
        const uint64_t order = run->gas.cells->order;
        sum_up(run, before);
        step(run, STEPS / (k % 3 == 2 ? 8 : 3));
        changes += run->gas.cells->order > order;
        sum_up(run, after);
        const struct totals booked = ledger_totals(&s->ledger, &run->ranks, LEDGER_CAUSES);
        /* with one level, too, sweeps give next to nothing of a material to the other */
        const double traces = k % 3 == 2 || k >= 6 ? 1e-8 : 1e-12;
        assert_close(after[FIRST] + after[SECOND], before[FIRST] + before[SECOND], 1e-12);
        const double size = sqrt(2.0 * fabs(before[ENERGY]) * (before[FIRST] + before[SECOND]));
        for (int n = 0; n < SUMS; n++) {
            const bool push = n >= MOMENTUM_X && n < ENERGY;
            const double gain = push ? booked.entry[LEDGER_MOMENTUM_X + n - MOMENTUM_X] : 0.0;
            const double whole = push ? size : fabs(before[n]),
                         least = n <= SECOND ? traces : 1e-12;
            if (!(fabs(after[n] - gain - before[n]) <= least * whole))
                fail_msg("case %d, number %d: %.17g becomes %.17g, less %g\n%s", k, n, before[n],
                         after[n], gain, text);
        }
        end(run);
    }
    assert_true(changes >= CHANGES); /* the few steps under sanitizers need not change any */
}

/* It burns at once, and its products in the air. */
static const char charge[] =
    "format: 1\ndimension: 2\nresolution: 2 mm\nlevels: 4\nsolver: {gas: {cells_to_front: 20}}\n"
    "materials:\n"
    "  air: {eos: {ideal-gas: {density: 1.2 kg/m^3, gamma: 1.4}}}\n"
    "  tnt:\n"
    "    eos: {jwl: {density: 1630 kg/m^3, a: 371.2 GPa, b: 3.231 GPa, r1: 4.15, r2: 0.95, omega: "
    "0.3, energy: 6.993 GPa}}\n"
    "    burn: {programmed: {speed: 6930 m/s}}\n"
    "    afterburn: {energy: 3 MJ/kg, rate: 1e5 1/s}\n"
    "bodies:\n"
    "  air: {material: air, box: {from: [0 m, 0 m], to: [0.896 m, 0.64 m]}, pressure: 0.1 MPa}\n"
    "  hot: {material: tnt, ball: {center: [0 m, 0 m], radius: 50 mm}, replaces: air}\n"
    "boundaries:\n"
    "  left: {kind: reflecting, axis: x, at: 0 m, side: low}\n"
    "  low: {kind: reflecting, axis: y, at: 0 m, side: low}\n"
    "  block: {kind: rigid-body, part: {box: {from: [0.3 m, 0 m], to: [0.34 m, 0.1 m]}}}\n"
    "detonations: {end: {at: [0 m, 0 m]}}\nrun: {until: 1 s}\n";

static void a_charge_is_fine_until_it_has_burnt(void **state)
{
    (void)state;
    struct running *run = begin_fresh(charge, &plain);
    const struct gas *gas = &run->gas;
    double before[SUMS], after[SUMS];
    sum_up(run, before);
    for (int k = 0; k < BURNT && gas->unburnt; k++) {
        for (int32_t i = 0; i < gas->cells->count; i++)
            if (gas->u[gas->layout.burnt][i] < 1.0)
                assert_true(gas->cells->size[i] == gas->cells->edge);
        step(run, 1);
    }
    assert_false(gas->unburnt);
    step(run, STEPS);
    sum_up(run, after);
    const struct totals booked = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_CAUSES);
    assert_int_equal(gas->cells->regions, 1); /* that of the rigid body */
    assert_close(after[FIRST] + after[SECOND] - booked.entry[LEDGER_MASS],
                 before[FIRST] + before[SECOND], 1e-12);
    assert_close(after[ENERGY] - booked.entry[LEDGER_ENERGY], before[ENERGY], 1e-12);
    end(run);
}

static void threads_and_resumes_change_no_bit(void **state)
{
    (void)state;
    static const struct variant variants[] = {{"2 threads", 2, 1.0, NULL, false},
                                              {"3, 2 and 1 threads by turns", -3, 1.0, NULL, false},
                                              {"resumed", 2, 1.0, NULL, true}};
    struct dice dice = {5};
    for (int k = 0; k < 4; k++) {
        char text[3000];
        draw(&dice, k + 5, text, sizeof text);
        const char *of = k == 3 ? charge : text;
        const uint64_t hash = hash_after(of, &plain, &plain, STEPS / 6);
        for (size_t v = 0; v < COUNT_OF(variants); v++)
            if (hash_after(of, &plain, &variants[v], STEPS / 6) != hash)
                fail_msg("%s: other bits of\n%s", variants[v].name, of);
    }
}

static const char shells[] =
    "format: 1\ndimension: 1\ngeometry: spherical\nresolution: 2 mm\nsolver: gas\n" AIR PRODUCTS
    "bodies:\n"
    "  air: {material: air, pressure: 0.1 MPa, density: 1.2 kg/m^3, box: {from: [0 m], to: [0.5 "
    "m]}}"
    "\n"
    "  hot: {material: gas, pressure: 1 GPa, density: 900 kg/m^3, box: {from: [0 m], to: [40 mm]}, "
    "replaces: air}\n"
    "run: {until: 30 us}\n";
static const char octant[] =
    "format: 1\ndimension: 3\nresolution: 10 mm\nlevels: 3\nsolver: gas\n" AIR PRODUCTS "bodies:\n"
    "  air: {material: air, pressure: 0.1 MPa, density: 1.2 kg/m^3, box: {from: [0 m, 0 m, 0 m], "
    "to: [0.32 m, 0.32 m, 0.32 m]}}\n"
    "start: {from: shells.yaml, material: gas}\n"
    "boundaries:\n"
    "  x: {kind: reflecting, axis: x, at: 0 m, side: low}\n"
    "  y: {kind: reflecting, axis: y, at: 0 m, side: low}\n"
    "  z: {kind: reflecting, axis: z, at: 0 m, side: low}\n"
    "run: {until: 1 s}\n";

/* As much of both materials and energy as cells of one level. */
static void a_start_comes_into_cells_that_are_fine(void **state)
{
    (void)state;
    static const struct variant variants[2] = {{"levels", 1, 1.0, NULL, false},
                                               {"one level", 1, 1.0, "levels=1", false}};
    char path[96];
    double sum[2][SUMS];
    snprintf(path, sizeof path, "%s/shells.yaml", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(shells, file) >= 0);
    assert_int_equal(fclose(file), 0);
    for (int k = 0; k < 2; k++) {
        struct running *run = begin_fresh(octant, &variants[k]);
        const struct cell_blocks *cells = run->gas.cells;
        for (int32_t i = 0; i < cells->count && k == 0; i++)
            if (cells->pressure[i] > 1.1e5)
                assert_true(cells->size[i] == cells->edge);
        assert_true(k == 1 || cells->count < 32 * 32 * 32);
        sum_up(run, sum[k]);
        step(run, 3);
        end(run);
    }
    for (int n = 0; n < SUMS; n++)
        if (n <= SECOND || n == ENERGY)
            assert_close(sum[0][n], sum[1][n], 1e-12);
}

/* A box of hot gas and an obstacle in a domain that repeats itself. */
#define TORUS                                                                                    \
    "format: 1\ndimension: 2\nresolution: 0.0009765625 m\nlevels: 3\nrun: {until: 1 s}\n"        \
    "let: {h: 0.0009765625 m, a: %d*h, b: %d*h, c: %d*h, d: %d*h}\nsolver: {gas: {regrid: "      \
    "2}}\n" AIR GAS                                                                              \
    "bodies:\n  air: {material: air, pressure: 0.1 MPa, density: 1 kg/m^3, box: {from: [0 m, 0 " \
    "m], to: [256*h, 256*h]}}\n  hot: {material: gas, pressure: 2 MPa, density: 4 kg/m^3, "      \
    "replaces: air, box: {from: [a, 100*h], to: [b, 140*h]}}\n"                                  \
    "boundaries:\n  x: {kind: periodic, axis: x}\n  y: {kind: periodic, axis: y}\n"              \
    "  block: {kind: rigid-body, part: {box: {from: [c, 150*h], to: [d, 170*h]}}}\n"

/* Blocks of the widest cells are 64 of the finest wide. */
static void a_blast_in_a_torus_is_the_same_anywhere(void **state)
{
    (void)state;
    enum { SHIFT = 64, WIDTH = 256 };
    struct running *run[2];
    for (int k = 0; k < 2; k++) {
        char text[2000];
        snprintf(text, sizeof text, TORUS, 110 + k * SHIFT, 140 + k * SHIFT, 160 + k * SHIFT,
                 180 + k * SHIFT);
        run[k] = begin_fresh(text, &plain);
        step(run[k], 2 * STEPS);
    }
    const struct cell_blocks *cells = run[0]->gas.cells, *others = run[1]->gas.cells;
    int passed = 0;
    assert_int_equal(cells->count, others->count);
    for (int32_t b = 0; b < cells->blocks; b++) {
        const struct cell_block *block = &cells->block[b];
        int64_t at[3] = {block->corner[0] + SHIFT / (1 << block->level), block->corner[1], 0};
        at[0] %= WIDTH / (1 << block->level);
        const struct cell_block *other = cell_block_at(others, block->level, at);
        assert_non_null(other);
        for (int c = 0; c < block->count[0] * block->count[1]; c++) {
            const double pressure = cells->pressure[block->first + c];
            passed += at[0] < SHIFT / (1 << block->level) && fabs(pressure / 1e5 - 1.0) > 0.01;
            assert_true(pressure == others->pressure[other->first + c]);
        }
    }
    assert_true(passed > 0 || CHANGES == 0); /* in the second run the blast is beyond a face */
    end(run[0]);
    end(run[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contacts_pass_faces_of_levels),
        cmocka_unit_test(contacts_stay_while_levels_change),
        cmocka_unit_test(two_materials_are_conserved),
        cmocka_unit_test(a_charge_is_fine_until_it_has_burnt),
        cmocka_unit_test(threads_and_resumes_change_no_bit),
        cmocka_unit_test(a_start_comes_into_cells_that_are_fine),
        cmocka_unit_test(a_blast_in_a_torus_is_the_same_anywhere),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
