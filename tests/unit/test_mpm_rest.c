/* The material point method with a gas at rest: what a uniform pressure does to nodes. */
#include "populations.h"
#include "running.h"

/* Between walls, with particles of 1 mm; the low side of x is a wall or the axis. */
#define AT_REST(GEOMETRY, CELL, HIGH, LOW_WALL)                                                   \
    "format: 1\ntitle: A gas at rest\ndimension: 2\n" GEOMETRY "resolution: 1 mm\n"               \
    "solver: {mpm: {cell: " CELL "}}\n"                                                           \
    "materials: {gas: {eos: {ideal-gas: {density: 1500 kg/m^3, gamma: 3}}}}\n"                    \
    "bodies:\n"                                                                                   \
    "  gas: {material: gas, box: {from: [0 mm, 0 mm], to: [24 mm, " HIGH "]}, pressure: 1 GPa}\n" \
    "walls:\n" LOW_WALL "  x1: {mirror: x, at: 24 mm, side: high}\n"                              \
    "  y0: {mirror: y, at: 0 mm, side: low}\n"                                                    \
    "  y1: {mirror: y, at: " HIGH ", side: high}\n"                                               \
    "run: {until: 1 s}\n"
#define WALL "  x0: {mirror: x, at: 0 mm, side: low}\n"
#define AXIS "geometry: axisymmetric\n"

/* The largest component of velocity after ten steps, m/s. */
static double stirred(const char *text, const char *setting)
{
    const struct variant variant = {"", 1, 1.0, setting, false};
    struct running *run = begin_fresh(text, &variant);
    step(run, 10);
    const struct particles *p = particles_of(&run->simulation);
    double most = 0.0;
    for (int32_t i = 0; i < p->count; i++)
        for (int a = 0; a < 2; a++)
            most = maximum(most, fabs(p->velocity[i][a]));
    end(run);
    return most;
}

static void check_rest(const char *text)
{
    static const char *const settings[] = {"solver.mpm.shape=linear", "solver.mpm.shape=gimp",
                                           "solver.mpm.shape=quadratic", "solver.mpm.shape=cubic",
                                           "solver.mpm.quadrature=particles"};
    for (size_t k = 0; k < COUNT_OF(settings); k++) {
        const double most = stirred(text, settings[k]);
        if (!(most <= 1e-8))
            fail_msg("%s: %g m/s", settings[k], most);
    }
}

static void a_gas_stays_at_rest_between_walls(void **state)
{
    (void)state;
    check_rest(AT_REST("", "2 mm", "20 mm", WALL));
}

static void a_gas_stays_at_rest_about_the_axis(void **state)
{
    (void)state;
    check_rest(AT_REST(AXIS, "2 mm", "20 mm", ""));
}

/* 2.4 particles a cell and axis, so that none lies as its neighbours do. */
static void faces_keep_it_at_rest_wherever_particles_lie(void **state)
{
    (void)state;
    static const char *const texts[] = {AT_REST("", "2.4 mm", "24 mm", WALL),
                                        AT_REST(AXIS, "2.4 mm", "24 mm", "")};
    for (size_t t = 0; t < COUNT_OF(texts); t++) {
        assert_true(stirred(texts[t], "solver.mpm.shape=quadratic") < 1e-6);
        assert_true(stirred(texts[t], "solver.mpm.shape=cubic") < 1e-6);
        assert_true(stirred(texts[t], "solver.mpm.quadrature=particles") > 1.0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_gas_stays_at_rest_between_walls),
        cmocka_unit_test(a_gas_stays_at_rest_about_the_axis),
        cmocka_unit_test(faces_keep_it_at_rest_wherever_particles_lie),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
