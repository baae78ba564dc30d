/* Velocities corrected to the contact point (`rotation: corrected`): a body that turns as a whole
 * feels nothing of it. */
#include "populations.h"
#include "running.h"

#define HEAD(dimension)                                                          \
    "format: 1\n"                                                                \
    "dimension: " dimension "\n"                                                 \
    "resolution: 1 mm\n"                                                         \
    "solver: {sph: {method: {contact: {rotation: corrected}}}}\n"                \
    "materials:\n"                                                               \
    "  metal:\n"                                                                 \
    "    eos: {barotropic: {density: 2700 kg/m^3, bulk_modulus: 73 GPa}}\n"      \
    "    strength: {perfect-plastic: {shear_modulus: 23 GPa, yield: 100 GPa}}\n" \
    "run: {until: 1 s}\n"                                                        \
    "bodies:\n"

static const char disc[] =
    HEAD("2") "  disc: {material: metal, ball: {center: [0 mm, 0 mm], radius: 12 mm}}\n";
static const char cube[] = HEAD(
    "3") "  cube: {material: metal, box: {from: [-4 mm, -4 mm, -4 mm], to: [4 mm, 4 mm, 4 mm]}}\n";

static const struct variant corrected = {"corrected", 1, 1.0, NULL, false};
static const struct variant faithful = {"faithful", 1, 1.0,
                                        "solver.sph.method.contact.rotation=faithful", false};

/* Turns all particles about OMEGA through the origin; SPIN: the spins say so. */
static void turn(struct running *run, struct vec3 omega, bool spin)
{
    const struct particles *p = particles_of(&run->simulation);
    double(*spins)[3] = particles_field(p, "spin");
    for (int32_t i = 0; i < p->count; i++) {
        const double *x = p->position[i];
        struct vec3 u = vec3_cross(omega, vec3_make(x[0], x[1], x[2]));
        memcpy(p->velocity[i], &u, sizeof u);
        if (spin)
            memcpy(spins[i], &omega, sizeof omega);
    }
}

static double largest_acceleration(const struct running *run)
{
    const struct particles *p = particles_of(&run->simulation);
    const double(*a)[3] = particles_field(p, "acceleration");
    double largest = 0.0;
    for (int32_t i = 0; i < p->count; i++)
        largest = maximum(largest, sqrt(square(a[i][0]) + square(a[i][1]) + square(a[i][2])));
    return largest;
}

static void judge_rates(const char *text, struct vec3 omega)
{
    struct running *run = begin_fresh(text, &corrected);
    const struct particles *p = particles_of(&run->simulation);
    const double size = sqrt(vec3_dot(omega, omega));
    turn(run, omega, true);
    assert_success(run->solver->prepare(&run->sph, &run->simulation, &run->limit));
    const double(*rate)[6] = particles_field(p, "strain_rate");
    const double(*spin)[3] = particles_field(p, "spin");
    const double *power = particles_field(p, "power");
    /* An acceleration of C_t Omega is what the couples of the faithful method bring. */
    assert_true(largest_acceleration(run) < 1e-9 * 2918.0 * size);
    double middle[3] = {0.0};
    for (int32_t i = 0; i < p->count; i++) {
        const double *x = p->position[i];
        assert_near(power[i], 0.0, 1e-9 * 2918.0 * size);
        if (square(x[0]) + square(x[1]) + square(x[2]) > square(2e-3))
            continue; /* those of the surface miss neighbours */
        for (int k = 0; k < 6; k++)
            assert_near(rate[i][k], 0.0, 1e-12 * size);
        memcpy(middle, spin[i], sizeof middle);
    }
    /* The kernel's sum over a lattice is one to a few per cent, for every component alike. */
    double ratio = sqrt(square(middle[0]) + square(middle[1]) + square(middle[2])) / size;
    assert_near(ratio, 1.0, 0.05);
    assert_near(middle[0], ratio * omega.x, 1e-12 * size);
    assert_near(middle[1], ratio * omega.y, 1e-12 * size);
    assert_near(middle[2], ratio * omega.z, 1e-12 * size);
    end(run);
}

static void a_disc_that_turns_as_a_whole_has_its_spin_and_no_shear(void **state)
{
    (void)state;
    judge_rates(disc, vec3_make(0.0, 0.0, 3e3));
}

static void so_has_a_cube_in_space(void **state)
{
    (void)state;
    judge_rates(cube, vec3_make(2e3, -1e3, 3e3));
}

static void without_the_correction_couples_brake_it(void **state)
{
    (void)state;
    struct running *run = begin_fresh(disc, &faithful);
    turn(run, vec3_make(0.0, 0.0, 3e3), true);
    assert_success(run->solver->prepare(&run->sph, &run->simulation, &run->limit));
    assert_true(largest_acceleration(run) > 0.1 * 2918.0 * 3e3);
    end(run);
}

static double angular_momentum_left(const char *text, const struct variant *variant)
{
    struct running *run = begin_fresh(text, variant);
    const struct particles *p = particles_of(&run->simulation);
    turn(run, vec3_make(0.0, 0.0, 3e3), false);
    struct totals start = population_totals(population_of_particles(p), &run->ranks, -1);
    step(run, 60);
    struct totals now = population_totals(population_of_particles(p), &run->ranks, -1);
    assert_near(now.entry[LEDGER_ENERGY], start.entry[LEDGER_ENERGY],
                1e-13 * start.entry[LEDGER_ENERGY]);
    assert_near(now.entry[LEDGER_MOMENTUM_X], 0.0, 1e-13 * now.momentum_scale);
    double left = now.entry[LEDGER_ANGULAR_Z] / start.entry[LEDGER_ANGULAR_Z];
    end(run);
    return left;
}

static void it_keeps_its_angular_momentum_much_longer(void **state)
{
    (void)state;
    const char *const texts[] = {disc, cube};
    const double of_loss[] = {0.1, 0.4}; /* a cube of eight particles is mostly surface */
    for (int k = 0; k < 2; k++) {
        double with = angular_momentum_left(texts[k], &corrected);
        double without = angular_momentum_left(texts[k], &faithful);
        print_message("left of angular momentum: %.4f, faithful %.4f\n", with, without);
        assert_true(1.0 - with < of_loss[k] * (1.0 - without));
    }
}

static void it_is_refused_where_it_means_nothing(void **state)
{
    (void)state;
    static const struct {
        const char *setting, *words;
    } wrong[] = {{"solver.sph.method.contact.riemann=dukowicz", "rotation: corrected"},
                 {"materials.metal.strength=none", "needs a material with strength"}};
    for (size_t k = 0; k < COUNT_OF(wrong); k++) {
        const struct variant variant = {"", 1, 1.0, wrong[k].setting, false};
        struct running *run = open_case(disc, &variant);
        struct error *error =
            run->solver->create(&run->sph, &run->simulation, run->input->solver.value);
        assert_non_null(error);
        assert_int_equal(error_kind(error), ERROR_INPUT);
        assert_non_null(strstr(error_message(error, 0), wrong[k].words));
        error_free(error);
        end(run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_disc_that_turns_as_a_whole_has_its_spin_and_no_shear),
        cmocka_unit_test(so_has_a_cube_in_space),
        cmocka_unit_test(without_the_correction_couples_brake_it),
        cmocka_unit_test(it_keeps_its_angular_momentum_much_longer),
        cmocka_unit_test(it_is_refused_where_it_means_nothing),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
