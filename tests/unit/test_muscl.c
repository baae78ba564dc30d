/* The second-order contact method: what its gradients must give exactly, and what its sums must
 * keep. */
#include "material/material.h"
#include "populations.h"
#include "second_order.h"

#define LINE "{from: [-8 mm], to: [8 mm]}"
#define PLANE "{from: [-6 mm, -5 mm], to: [6 mm, 5 mm]}"
#define SPACE "{from: [-4 mm, -3 mm, -3 mm], to: [4 mm, 3 mm, 3 mm]}"

/* Free bodies; what a record keeps of stress differs between them. */
static const struct {
    const char *name, *text;
    int dimension, stresses;
    double shift; /* off the sites, m; corners in space stand less */
} bodies[] = {{"solid line", BODY("1", METAL, "metal", LINE), 1, 1, 2e-4},
              {"liquid line", BODY("1", LIQUID, "liquid", LINE), 1, 1, 2e-4},
              {"solid plane", BODY("2", METAL, "metal", PLANE), 2, 3, 2e-4},
              {"liquid plane", BODY("2", LIQUID, "liquid", PLANE), 2, 1, 2e-4},
              {"solid space", BODY("3", METAL, "metal", SPACE), 3, 6, 5e-5},
              {"liquid space", BODY("3", LIQUID, "liquid", SPACE), 3, 1, 5e-5}};

/* One particle thick: its neighbours know nothing of the direction across it. */
static const char layer[] =
    BODY("3", METAL, "metal", "{from: [-4 mm, -4 mm, 0 mm], to: [4 mm, 4 mm, 1 mm]}");

/* Moves particles off their sites by up to SHIFT metres, and takes up to a tenth from their mass or
 * adds it. */
static void distort(struct running *run, double shift, struct dice *dice)
{
    struct particles *p = particles_of(&run->simulation);
    for (int32_t i = 0; i < p->count; i++) {
        p->mass[i] *= dice_between(dice, 0.9, 1.1);
        for (int axis = 0; axis < p->dimension; axis++)
            p->position[i][axis] += dice_between(dice, -shift, shift);
    }
    sph_evaluate(&run->sph, &run->simulation);
}

/* U = A x in the dimensions of the run. */
static void set_velocity(struct running *run, const double a[3][3])
{
    struct particles *p = particles_of(&run->simulation);
    for (int32_t i = 0; i < p->count; i++)
        for (int row = 0; row < p->dimension; row++) {
            p->velocity[i][row] = 0.0;
            for (int column = 0; column < p->dimension; column++)
                p->velocity[i][row] += a[row][column] * p->position[i][column];
        }
}

/* A random gradient of velocity; TURNING: with a spin. */
static void random_gradient(struct dice *dice, bool turning, double a[3][3])
{
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++)
            a[row][column] =
                !turning && column < row ? a[column][row] : dice_between(dice, -1e4, 1e4);
}

/* The invariants of A, by which volumes follow places. Contacts are ahead of nothing. */
static void assert_volume_rates(const struct running *run, const double a[3][3])
{
    const struct particles *p = particles_of(&run->simulation);
    const double(*volume)[VOLUME_NUMBERS] = particles_field(p, "volume_rate");
    const bool space = p->dimension > 2;
    const double minors[3] = {a[0][0] * a[1][1] - a[0][1] * a[1][0],
                              a[0][0] * a[2][2] - a[0][2] * a[2][0],
                              a[1][1] * a[2][2] - a[1][2] * a[2][1]};
    const double first = a[0][0] + a[1][1] + (space ? a[2][2] : 0.0);
    const double second = minors[0] + (space ? minors[1] + minors[2] : 0.0);
    const double third = space ? a[0][0] * minors[2] -
                                     a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
                                     a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0])
                               : 0.0;
    for (int32_t i = 0; i < p->count; i++) {
        assert_true(volume[i][VOLUME_SHARE] > 0.0);
        assert_near(volume[i][VOLUME_FIRST], first, 3e-6);
        assert_near(volume[i][VOLUME_SECOND], second, 3e-2);
        assert_near(volume[i][VOLUME_THIRD], third, 3e2);
        assert_near(volume[i][VOLUME_EXCHANGE], 0.0, 3e-6);
    }
}

/* All that the second pass says of velocity, A. */
static void assert_velocity_gradient(const struct running *run, const double a[3][3])
{
    const struct particles *p = particles_of(&run->simulation);
    const double(*rate)[6] = particles_field(p, "strain_rate");
    const double(*spin)[3] = particles_field(p, "spin");
    const double *gradient = particles_field(p, "velocity_gradient"), tolerance = 1e-10 * 1e4;
    const int dimension = p->dimension;
    for (int32_t i = 0; i < p->count; i++)
        for (int row = 0; row < dimension; row++)
            for (int column = 0; column < dimension; column++) {
                int other = 3 - row - column, slot = row == column ? row : (other + 1) % 3 + 3;
                double sign = (row + 1) % 3 == column ? -1.0 : 1.0; /* U^x_y = e_xy - spin_z */
                double sum = rate[i][slot] + (row == column ? 0.0 : sign * spin[i][other]);
                assert_near(sum, a[row][column], tolerance);
                assert_near(gradient[(i * dimension + row) * dimension + column], a[row][column],
                            tolerance);
            }
    const struct muscl_fields fields = muscl_fields_of(&run->sph, &run->simulation);
    const double divergence =
        a[0][0] + (dimension > 1 ? a[1][1] : 0.0) + (dimension > 2 ? a[2][2] : 0.0);
    for (int32_t i = 0; i < p->count; i++)
        assert_near(muscl_divergence(&run->simulation, &fields, i), divergence, 3.0 * tolerance);
    if (dimension > 1)
        assert_volume_rates(run, a);
}

static void linear_velocities_have_their_gradient_inside_and_at_free_surfaces(void **state)
{
    (void)state;
    struct dice dice = {1};
    for (size_t k = 0; k < COUNT_OF(bodies); k++) {
        struct running *run = begin_fresh(bodies[k].text, &plain);
        double a[3][3];
        distort(run, bodies[k].shift, &dice);
        random_gradient(&dice, true, a);
        set_velocity(run, a);
        prepare(run);
        assert_velocity_gradient(run, a);
        end(run);
    }
}

/* A random deviator and pressure and their slopes along the axes, in the order of the store. */
struct linear_stress {
    double at[6], slope[3][6];
};

static struct linear_stress random_stress(struct dice *dice)
{
    struct linear_stress stress;
    for (int row = -1; row < 3; row++) {
        double *of = row < 0 ? stress.at : stress.slope[row], size = row < 0 ? 1e8 : 1e10;
        for (int c = 0; c < 6; c++)
            of[c] = dice_between(dice, -size, size);
    }
    return stress;
}

/* The solid's deviator takes the stress less its mean. */
static void set_stress(struct running *run, const struct linear_stress *stress, bool solid)
{
    struct particles *p = particles_of(&run->simulation);
    for (int32_t i = 0; i < p->count; i++) {
        double s[6];
        for (int c = 0; c < 6; c++) {
            s[c] = stress->at[c];
            for (int axis = 0; axis < p->dimension; axis++)
                s[c] += stress->slope[axis][c] * p->position[i][axis];
        }
        double mean = solid ? (s[0] + s[1] + s[2]) / 3.0 : s[0];
        p->pressure[i] = -mean;
        for (int c = 0; c < 6; c++)
            p->deviator[i][c] = solid ? s[c] - (c < 3 ? mean : 0.0) : 0.0;
    }
}

static void assert_stress_gradient(const struct running *run, const struct linear_stress *stress,
                                   int stresses)
{
    const struct particles *p = particles_of(&run->simulation);
    const double *slope = particles_field(p, "stress_gradient");
    for (int32_t i = 0; i < p->count; i++)
        for (int axis = 0; axis < p->dimension; axis++)
            for (int c = 0; c < stresses; c++)
                assert_near(slope[(i * p->dimension + axis) * stresses + c],
                            stress->slope[axis][p->dimension == 2 && c == 2 ? 3 : c], 1e-10 * 1e10);
}

/* Slopes are those of the end of the step: without spin all stress changes alike. */
static void linear_stresses_have_their_gradient_inside_and_at_free_surfaces(void **state)
{
    (void)state;
    struct dice dice = {2};
    for (size_t k = 0; k < COUNT_OF(bodies); k++) {
        struct running *run = begin_fresh(bodies[k].text, &plain);
        const struct linear_stress stress = random_stress(&dice);
        double a[3][3];
        distort(run, bodies[k].shift, &dice);
        random_gradient(&dice, false, a);
        set_velocity(run, a);
        set_stress(run, &stress, strstr(bodies[k].name, "solid") != NULL);
        prepare(run);
        assert_stress_gradient(run, &stress, bodies[k].stresses);
        end(run);
    }
}

/* Whether no surface is nearer to particle I of a body of extent ACROSS about the origin than its
 * support, 2.4 mm. */
static bool is_inside(const struct particles *p, int32_t i, const double across[3])
{
    bool inside = true;
    for (int axis = 0; axis < p->dimension; axis++)
        inside = inside && fabs(p->position[i][axis]) < across[axis] - 2e-3;
    return inside;
}

static void the_force_expected_inside_a_lattice_is_the_divergence_of_stress(void **state)
{
    (void)state;
    static const int slot[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    static const double half[3][3] = {{8e-3}, {6e-3, 5e-3}, {4e-3, 3e-3, 3e-3}};
    struct dice dice = {12};
    for (size_t k = 0; k < COUNT_OF(bodies); k++) {
        struct running *run = begin_fresh(bodies[k].text, &plain);
        const struct particles *p = particles_of(&run->simulation);
        const bool tensor = bodies[k].stresses > 1;
        const struct linear_stress stress = random_stress(&dice);
        double a[3][3];
        random_gradient(&dice, false, a);
        set_velocity(run, a);
        set_stress(run, &stress, strstr(bodies[k].name, "solid") != NULL);
        prepare(run);
        assert_stress_gradient(run, &stress, bodies[k].stresses);
        muscl_pack(&run->sph, &run->simulation);
        const size_t stride = (size_t)muscl_stride(muscl_kind_of(&run->sph));
        const double *half_ahead = run->sph.record + record_velocity(p->dimension);
        int32_t inside = 0;
        for (int32_t i = 0; i < p->count; i++) {
            if (!is_inside(p, i, half[p->dimension - 1]))
                continue;
            inside++;
            for (int axis = 0; axis < p->dimension; axis++) {
                double force = 0.0;
                for (int along = 0; along < p->dimension; along++)
                    if (tensor || along == axis)
                        force += stress.slope[along][tensor ? slot[axis][along] : 0];
                double gain = half_ahead[(size_t)i * stride + (size_t)axis] - p->velocity[i][axis];
                assert_near(gain / run->sph.ahead * p->density[i], force, 1e-9 * 1e10);
            }
        }
        assert_true(inside >= 12);
        end(run);
    }
}

/* With h = D the moment of an end is half, and the empty other half completes it. */
static void a_line_of_like_particles_has_a_correction_of_one_up_to_its_ends(void **state)
{
    (void)state;
    const struct variant narrow = {"", 1, 1.0, "solver.sph.smoothing=1", false};
    struct running *run = begin_fresh(bodies[0].text, &narrow);
    prepare(run);
    const double *correction = particles_field(particles_of(&run->simulation), "correction");
    for (int32_t i = 0; i < particles_of(&run->simulation)->count; i++)
        assert_near(correction[i], 1.0, 1e-13);
    end(run);
}

static void a_single_layer_in_space_is_not_corrected(void **state)
{
    (void)state;
    static const double one[6] = {1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
    struct running *run = begin_fresh(layer, &plain);
    const struct particles *p = particles_of(&run->simulation);
    struct dice dice = {11};
    for (int32_t i = 0; i < p->count; i++)
        for (int axis = 0; axis < 3; axis++)
            p->velocity[i][axis] = dice_between(&dice, -100.0, 100.0);
    prepare(run);
    const double(*correction)[6] = particles_field(p, "correction");
    const double(*acceleration)[3] = particles_field(p, "acceleration");
    for (int32_t i = 0; i < p->count; i++) {
        assert_memory_equal(correction[i], one, sizeof one);
        assert_true(isfinite(acceleration[i][0]) && acceleration[i][2] != 0.0);
    }
    end(run);
}

static void a_free_body_that_turns_as_a_whole_is_not_braked(void **state)
{
    (void)state;
    const double omega = 3e4, sound = 5350.0;
    const double turn[3][3] = {
        {0.0, -omega, 0.5 * omega}, {omega, 0.0, -omega}, {-0.5 * omega, omega, 0.0}};
    struct dice dice = {3};
    for (size_t k = 0; k < COUNT_OF(bodies); k++) {
        if (bodies[k].dimension == 1)
            continue;
        struct running *run = begin_fresh(bodies[k].text, &plain);
        const struct particles *p = particles_of(&run->simulation);
        distort(run, bodies[k].shift, &dice);
        for (int32_t i = 0; i < p->count; i++)
            p->pressure[i] = 0.0; /* to the last digit */
        set_velocity(run, turn);
        prepare(run);
        const double(*acceleration)[3] = particles_field(p, "acceleration");
        const double *power = particles_field(p, "power");
        /* couples between particles, not corrected, bring accelerations of C_t omega */
        for (int32_t i = 0; i < p->count; i++) {
            for (int axis = 0; axis < 3; axis++)
                assert_near(acceleration[i][axis], 0.0, 1e-11 * sound * omega);
            assert_near(power[i], 0.0, 1e-11 * sound * omega * 0.01 * omega);
        }
        end(run);
    }
}

/* Two bodies that slip on each other and part without tension; beside them one that adheres. */
#define CLOUD(dimension, first, second, third)       \
    HEAD(dimension)                                  \
    "materials:\n" METAL LIQUID "bodies:\n"          \
    "  first: {material: metal, box: " first "}\n"   \
    "  second: {material: metal, box: " second "}\n" \
    "  third: {material: liquid, box: " third "}\n"  \
    "contacts:\n  faces: {between: [first, second], shear: slip, tension: none}\n"
static const char *const clouds[] = {
    CLOUD("1", "{from: [0 mm], to: [40 mm]}", "{from: [40 mm], to: [80 mm]}",
          "{from: [80 mm], to: [99 mm]}"),
    CLOUD("2", "{from: [0 mm, 0 mm], to: [12 mm, 6 mm]}",
          "{from: [0 mm, 6 mm], to: [12 mm, 11 mm]}", "{from: [0 mm, 11 mm], to: [12 mm, 15 mm]}"),
    CLOUD("3", "{from: [0 mm, 0 mm, 0 mm], to: [6 mm, 6 mm, 3 mm]}",
          "{from: [0 mm, 0 mm, 3 mm], to: [6 mm, 6 mm, 6 mm]}",
          "{from: [6 mm, 0 mm, 0 mm], to: [9 mm, 6 mm, 6 mm]}")};

static void randomise(struct running *run, struct dice *dice)
{
    struct particles *p = particles_of(&run->simulation);
    for (int32_t i = 0; i < p->count; i++)
        p->density[i] *= dice_between(dice, 0.95, 1.05);
    distort(run, 0.6e-3, dice);
    for (int32_t i = 0; i < p->count; i++) {
        bool solid = p->material[i] == p->material[0];
        for (int axis = 0; axis < p->dimension; axis++)
            p->velocity[i][axis] = dice_between(dice, -500.0, 500.0);
        double s[6];
        for (int c = 0; c < 6; c++)
            s[c] = solid ? dice_between(dice, -1e9, 1e9) : 0.0;
        s[2] = -s[0] - s[1];
        memcpy(p->deviator[i], s, sizeof s);
    }
}

static void a_random_cloud_keeps_momentum_and_energy(void **state)
{
    (void)state;
    struct dice dice = {4};
    for (size_t k = 0; k < COUNT_OF(clouds); k++) {
        struct running *run = begin_fresh(clouds[k], &plain);
        const struct particles *p = particles_of(&run->simulation);
        randomise(run, &dice);
        prepare(run);
        const double(*acceleration)[3] = particles_field(p, "acceleration");
        const double *power = particles_field(p, "power");
        double force[3] = {0.0}, size = 0.0, work = 0.0, work_size = 0.0;
        for (int32_t i = 0; i < p->count; i++) {
            work += p->mass[i] * power[i];
            work_size += fabs(p->mass[i] * power[i]);
            for (int axis = 0; axis < 3; axis++) {
                double f = p->mass[i] * acceleration[i][axis];
                force[axis] += f;
                size += fabs(f);
                work += f * p->velocity[i][axis];
                work_size += fabs(f * p->velocity[i][axis]);
            }
        }
        assert_true(size > 0.0 && work_size > 0.0);
        for (int axis = 0; axis < 3; axis++)
            assert_near(force[axis], 0.0, 1e-13 * size);
        assert_near(work, 0.0, 1e-13 * work_size);
        end(run);
    }
}

/* A block with a liquid core: the whole, and the part that stands between walls. */
#define BLOCK(geometry, from, walls)                                                  \
    HEAD("2")                                                                         \
    geometry "materials:\n" METAL LIQUID "bodies:\n"                                  \
             "  block: {material: metal, box: {from: " from ", to: [11 mm, 8 mm]}}\n" \
             "  core: {material: liquid, replaces: block, intersection:\n"            \
             "    [{ball: {center: [0 mm, 0 mm], radius: 4 mm}},\n"                   \
             "     {box: {from: " from ", to: [11 mm, 8 mm]}}]}\n" walls
#define LEFT "  left: {mirror: x, at: 0 mm, side: low}\n"
#define BELOW "  below: {mirror: y, at: 0 mm, side: low}\n"
static const char plane_whole[] = BLOCK("", "[-11 mm, -8 mm]", "");
static const char plane_quarter[] = BLOCK("", "[0 mm, 0 mm]", "walls:\n" LEFT BELOW);
static const char round_whole[] = BLOCK("geometry: axisymmetric\n", "[0 mm, -8 mm]", "");
static const char round_half[] =
    BLOCK("geometry: axisymmetric\n", "[0 mm, 0 mm]", "walls:\n" BELOW);

/* A state in motion that both mirrors leave as it is. */
static void set_symmetric_state(struct running *run)
{
    struct particles *p = particles_of(&run->simulation);
    for (int32_t i = 0; i < p->count; i++) {
        const double x = p->position[i][0] / 1e-2, y = p->position[i][1] / 1e-2;
        bool solid =
            run->simulation.problem->material[p->material[i]].strength.kind != STRENGTH_NONE;
        p->position[i][0] *= 1.0 + 0.05 * y * y;
        p->position[i][1] *= 1.0 - 0.04 * x * x;
        p->velocity[i][0] = 200.0 * x * (1.0 - 0.5 * y * y) * cos(3.0 * x);
        p->velocity[i][1] = -150.0 * y * (1.0 + x * x);
        p->density[i] *= 1.0 + 0.03 * cos(2.0 * x) * cos(4.0 * y);
        const double s[6] = {3e8 * cos(x), 2e8 * y * y, 0.0, 4e8 * x * y, 0.0, 0.0};
        for (int c = 0; c < 6; c++)
            p->deviator[i][c] = !solid ? 0.0 : c == 2 ? -s[0] - s[1] : s[c];
    }
    sph_evaluate(&run->sph, &run->simulation);
}

/* NAME has alike components in both, wherever PART has a particle. */
static void assert_same_field(const struct running *whole, const struct running *part,
                              const char *name, int components)
{
    const struct particles *w = particles_of(&whole->simulation),
                           *p = particles_of(&part->simulation);
    const double *of_whole = particles_field(w, name), *of_part = particles_field(p, name);
    double size = 0.0;
    for (int32_t k = 0; k < p->count * components; k++)
        size = maximum(size, fabs(of_part[k]));
    assert_true(size > 0.0);
    for (int32_t i = 0; i < p->count; i++) {
        int32_t j = 0;
        while (j < w->count && hypot(w->position[j][0] - p->position[i][0],
                                     w->position[j][1] - p->position[i][1]) > 1e-9)
            j++;
        assert_true(j < w->count);
        for (int c = 0; c < components; c++)
            assert_near(of_whole[j * components + c], of_part[i * components + c], 1e-10 * size);
    }
}

static void assert_stands_for(const char *whole_text, const char *part_text, int share)
{
    struct running *whole = begin_fresh(whole_text, &plain), *part = begin_fresh(part_text, &plain);
    assert_int_equal(particles_of(&whole->simulation)->count,
                     share * particles_of(&part->simulation)->count);
    set_symmetric_state(whole);
    set_symmetric_state(part);
    for (int k = 0; k < 3; k++) {
        prepare(whole);
        prepare(part);
        assert_close(whole->limit.dt, part->limit.dt, 1e-10);
        assert_same_field(whole, part, "acceleration", 3);
        assert_same_field(whole, part, "power", 1);
        assert_same_field(whole, part, "strain_rate", 6);
        assert_same_field(whole, part, "spin", 3);
        assert_same_field(whole, part, "expected_force", 3);
        assert_same_field(whole, part, "correction", 3);
        assert_same_field(whole, part, "velocity_gradient", 4);
        assert_same_field(whole, part, "stress_gradient", 6);
        const double dt = minimum(whole->limit.dt, part->limit.dt);
        assert_success(whole->solver->advance(&whole->sph, &whole->simulation, dt));
        assert_success(part->solver->advance(&part->sph, &part->simulation, dt));
        whole->simulation.step++;
        part->simulation.step++;
    }
    end(whole);
    end(part);
}

static void a_quarter_between_two_walls_has_the_rates_of_the_whole(void **state)
{
    (void)state;
    assert_stands_for(plane_whole, plane_quarter, 4);
}

static void a_round_body_on_a_wall_has_the_rates_of_the_whole(void **state)
{
    (void)state;
    assert_stands_for(round_whole, round_half, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_velocities_have_their_gradient_inside_and_at_free_surfaces),
        cmocka_unit_test(linear_stresses_have_their_gradient_inside_and_at_free_surfaces),
        cmocka_unit_test(the_force_expected_inside_a_lattice_is_the_divergence_of_stress),
        cmocka_unit_test(a_line_of_like_particles_has_a_correction_of_one_up_to_its_ends),
        cmocka_unit_test(a_single_layer_in_space_is_not_corrected),
        cmocka_unit_test(a_free_body_that_turns_as_a_whole_is_not_braked),
        cmocka_unit_test(a_random_cloud_keeps_momentum_and_energy),
        cmocka_unit_test(a_quarter_between_two_walls_has_the_rates_of_the_whole),
        cmocka_unit_test(a_round_body_on_a_wall_has_the_rates_of_the_whole),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
