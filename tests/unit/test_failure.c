/* Failure models: single points of every model beside values worked out by hand, what failed
 * material bears, and what does not go together. */
#include "dice.h"

#include "material/material.h"
#include "material/whole.h"

enum { STEPS = 4000 };

/* An elastic-plastic metal with YIELD (Pa) that fails by nothing yet. */
static struct material metal(double yield)
{
    struct material material = {.eos = {.kind = EOS_mie_grueneisen}};
    material.eos.of.mie_grueneisen = (struct eos_mie_grueneisen){
        .density = 2700.0, .sound = 5350.0, .slope = 1.35, .gamma = 2.0, .bulk_modulus = 73e9};
    material.strength.kind = STRENGTH_perfect_plastic;
    material.strength.of.perfect_plastic = (struct strength_perfect_plastic){23e9, yield};
    return material;
}

/* The state at the start. */
static struct point at_rest(const struct material *material)
{
    struct point point = {.density = material_density(material)};
    (void)material_evaluate(material, &point);
    return point;
}

/* Draws POINT in STEPS steps by volume and shape: the logarithmic strains along the axes. */
static void strain_by(const struct material *material, double x, double y, double z, double time,
                      struct point *point)
{
    const double dt = time / STEPS;
    for (int k = 0; k < STEPS; k++) {
        struct motion motion = {.dt = dt, .energy = point->energy, .length = 1e-3};
        motion.strain_rate = (struct sym3){x / time, y / time, z / time, 0.0, 0.0, 0.0};
        motion.density = point->density * exp(-dt * (x + y + z) / time);
        (void)material_step(material, point, &motion);
    }
}

static void spall_limits_the_largest_stress_and_leaves_no_tension(void **state)
{
    (void)state;
    struct material material = metal(100e9);
    material.failure.kind = FAILURE_spall;
    material.failure.of.spall = (struct failure_spall){.friction = 0.3, .strength = 600e6};
    struct point point = at_rest(&material);
    /* sigma_x = (K + 4/3 G) strain: fails at 0.0058 */
    const double modulus = 73e9 + 4.0 / 3.0 * 23e9;
    strain_by(&material, 0.98 * 600e6 / modulus, 0.0, 0.0, 1e-6, &point);
    assert_true(point.history[HISTORY_damage] == 0.0);
    assert_close(failing_largest_stress(
                     &(struct failing){.pressure = point.pressure, .deviator = point.deviator}),
                 0.98 * 600e6, 0.02);
    strain_by(&material, 0.04 * 600e6 / modulus, 0.0, 0.0, 1e-6, &point);
    assert_true(point.history[HISTORY_damage] == 1.0);
    assert_true(point.pressure == 0.0 && sym3_mises(point.deviator) == 0.0);
    assert_close(point.density, 2700.0, 1e-9); /* that of the material, not of its voids */
    assert_close(point.history[HISTORY_void_ratio], 1.02 * 600e6 / modulus, 0.01);
}

static void voids_close_before_failed_material_resists(void **state)
{
    (void)state;
    struct material material = metal(400e6);
    material.failure.kind = FAILURE_spall;
    material.failure.of.spall =
        (struct failure_spall){.friction = 0.3, .strength = 1e9, .stress = SPALL_MEAN};
    struct point point = at_rest(&material);
    strain_by(&material, 0.1, 0.0, 0.0, 1e-6, &point);
    assert_close(point.history[HISTORY_void_ratio], exp(0.1) - 1.0, 0.01);
    strain_by(&material, -0.09, 0.0, 0.0, 1e-6, &point);
    assert_true(point.pressure == 0.0 && point.history[HISTORY_void_ratio] > 0.0);
    strain_by(&material, -0.02, 0.0, 0.0, 1e-6, &point);
    assert_true(point.history[HISTORY_void_ratio] == 0.0);
    assert_close(point.pressure, 2700.0 * square(5350.0) * 0.01, 0.02);
    /* friction bounds the shear: 0.3 p, below the yield stress */
    assert_close(sym3_mises(point.deviator), 0.3 * point.pressure, 0.05);
    /* however far it is drawn apart, voids count up to half the material's volume */
    strain_by(&material, 2.0, 0.0, 0.0, 1e-6, &point);
    assert_true(point.history[HISTORY_void_ratio] == VOIDS_MOST);
    assert_close(point.density, 2700.0, 1e-3);
}

/* Voids grow from the strength on, and the tension falls in proportion to them. What is pressed
 * together before it fails keeps its damage. */
static void tension_falls_while_voids_grow(void **state)
{
    (void)state;
    struct material material = metal(100e6);
    material.failure.kind = FAILURE_spall;
    material.failure.of.spall = (struct failure_spall){
        .friction = 0.3, .strength = 1e9, .growth = 0.15, .stress = SPALL_MEAN};
    struct point point = at_rest(&material);
    const double onset = 1e9 / (2700.0 * square(5350.0));
    strain_by(&material, 0.95 * onset, 0.0, 0.0, 1e-6, &point);
    assert_true(point.history[HISTORY_damage] == 0.0 && point.history[HISTORY_void_ratio] == 0.0);
    assert_close(point.pressure, -0.95 * 1e9, 0.06);
    strain_by(&material, 0.07, 0.0, 0.0, 1e-6, &point);
    const double damage = point.history[HISTORY_damage];
    assert_true(damage > 0.4 && damage < 0.6);
    assert_close(point.history[HISTORY_void_ratio], 0.15 * damage, 1e-12);
    assert_close(point.pressure, -1e9 * (1.0 - damage), 0.01);
    struct point closed = point;
    strain_by(&material, -0.09, 0.0, 0.0, 1e-6, &closed);
    assert_true(closed.history[HISTORY_void_ratio] == 0.0 && closed.pressure > 0.0);
    assert_true(closed.history[HISTORY_damage] == damage);
    strain_by(&material, 0.1, 0.0, 0.0, 1e-6, &point);
    assert_true(point.history[HISTORY_damage] == 1.0 && point.pressure == 0.0);
}

static void voids_do_the_work_of_half_the_strength(void **state)
{
    (void)state;
    struct material material = metal(1.0);
    material.failure.kind = FAILURE_spall;
    material.failure.of.spall =
        (struct failure_spall){.strength = 1e9, .growth = 0.15, .stress = SPALL_MEAN};
    struct point point = at_rest(&material);
    double work = 0.0, volume = 1.0;
    const double dt = 1e-10, rate = 1e6;
    for (int k = 0; k < 2000; k++) {
        struct motion motion = {.dt = dt, .energy = 0.0, .length = 1e-3};
        const double before = point.pressure, next = volume * exp(rate * dt);
        motion.strain_rate = (struct sym3){rate, 0.0, 0.0, 0.0, 0.0, 0.0};
        motion.density = point.density * exp(-rate * dt);
        (void)material_step(&material, &point, &motion);
        work -= 0.5 * (before + point.pressure) * (next - volume);
        volume = next;
    }
    assert_true(point.history[HISTORY_damage] == 1.0);
    assert_close(work, 0.5 * 1e9 * 0.15, 0.02);
}

static void growth_of_voids_needs_a_mean_tension(void **state)
{
    (void)state;
    const char *key;
    struct failure failure = {.kind = FAILURE_spall};
    failure.of.spall = (struct failure_spall){.strength = 1e9, .growth = 0.15};
    assert_non_null(failure_wrong(&failure, &key));
    assert_string_equal(key, "growth");
    failure.of.spall.stress = SPALL_MEAN;
    assert_null(failure_wrong(&failure, &key));
    failure.of.spall.onset = SPALL_STANDING;
    assert_non_null(failure_wrong(&failure, &key));
}

/* Constants of OFHC copper (Johnson and Cook, 1985). */
static const struct failure_johnson_cook copper = {.d1 = 0.54,
                                                   .d2 = 4.89,
                                                   .d3 = -3.03,
                                                   .d4 = 0.014,
                                                   .d5 = 1.12,
                                                   .rate = 1.0,
                                                   .least_strain = 1e-3,
                                                   .spall = NAN};

static void johnson_cook_failure_strains(void **state)
{
    (void)state;
    const double rows[][4] = {/* triaxiality, rate, T*, eps_f */
                              {0.0, 1.0, 0.0, 5.43},
                              {1.0 / 3.0, 1.0, 0.0, 0.54 + 4.89 * 0.36421897957152333},
                              {1.0 / 3.0, 1e-3, 0.0, 0.54 + 4.89 * 0.36421897957152333},
                              {0.0, 1e4, 0.5, 5.43 * (1.0 + 0.014 * 9.210340371976184) * 1.56},
                              {1.5, 1.0, 0.0, 0.59193264}, /* 0.54 + 4.89 exp(-4.545) */
                              {9.0, 1.0, 0.0, 0.59193264}};
    for (size_t k = 0; k < COUNT_OF(rows); k++)
        assert_close(johnson_cook_failure_strain(&copper, rows[k][0], rows[k][1], rows[k][2]),
                     rows[k][3], 1e-6);
    /* the set of aluminium 6061-T6 falls below zero */
    struct failure_johnson_cook aluminium = copper;
    aluminium.d1 = -0.77;
    aluminium.d2 = 1.45;
    aluminium.d3 = -0.47;
    assert_true(johnson_cook_failure_strain(&aluminium, 1.5, 1.0, 0.0) == 1e-3);
}

/* In pure shear at constant volume the mean stress is zero and every plastic strain counts
 * alike. */
static void johnson_cook_damage_adds_up(void **state)
{
    (void)state;
    struct material material = metal(200e6);
    material.failure.kind = FAILURE_johnson_cook;
    material.failure.of.johnson_cook = copper;
    struct point point = at_rest(&material);
    strain_by(&material, 1.0, -1.0, 0.0, 1.0, &point); /* rate 2/sqrt(3) 1/s */
    const double strain = point.history[HISTORY_plastic_strain];
    const double rate = 2.0 / sqrt(3.0);
    assert_close(strain, rate, 0.01);
    assert_close(point.history[HISTORY_damage], strain / (5.43 * (1.0 + 0.014 * log(rate))), 1e-3);
    /* the spall stress of a set acts at once */
    material.failure.of.johnson_cook.spall = 1e9;
    point = at_rest(&material);
    strain_by(&material, 0.004, 0.004, 0.004, 1e-6, &point);
    assert_true(point.history[HISTORY_damage] == 0.0);
    strain_by(&material, 0.002, 0.002, 0.002, 1e-6, &point);
    assert_true(point.history[HISTORY_damage] == 1.0);
}

/* Damage that a strain of 0.1 adds to a point of 4 mm with a band of BAND; TENSION: its mean stress
 * over the Mises stress. */
static double damage_of(double band, double tension)
{
    struct failure_johnson_cook failure = copper;
    failure.band = band;
    struct failing point = {.deviator = {200e6, -100e6, -100e6, 0.0, 0.0, 0.0},
                            .pressure = -tension * 300e6,
                            .flow = 0.1,
                            .rate = 1.0,
                            .relative = 1.0,
                            .length = 4e-3};
    return failure_johnson_cook(&failure, &point, 0.0);
}

static void damage_in_shear_bands_knows_the_size_of_particles(void **state)
{
    (void)state;
    const double none = (double)NAN, shear[] = {-1.0, 0.0};
    for (size_t k = 0; k < COUNT_OF(shear); k++) {
        assert_close(damage_of(1e-3, shear[k]), 4.0 * damage_of(none, shear[k]), 1e-12);
        assert_close(damage_of(4e-3, shear[k]), damage_of(none, shear[k]), 1e-12);
        assert_close(damage_of(9e-3, shear[k]), damage_of(none, shear[k]), 1e-12);
    }
    assert_close(damage_of(1e-3, 1.0 / 6.0), 2.5 * damage_of(none, 1.0 / 6.0), 1e-12);
    assert_close(damage_of(1e-3, 1.0 / 3.0), damage_of(none, 1.0 / 3.0), 1e-12);
    assert_close(damage_of(1e-3, 2.0), damage_of(none, 2.0), 1e-12);
}

/* Damage D from the plastic strain p_d on takes the fraction beta D of the yield stress, fails the
 * point at D_c, and slows hardening: with p_d = 0 the strain that hardens is p (1 - beta D/2). */
static void damage_weakens_where_it_is_coupled(void **state)
{
    (void)state;
    struct material material = metal(0.0);
    const struct strength_johnson_cook steel = {
        .shear_modulus = 80e9, .a = 350e6, .b = 275e6, .n = 0.4, .rate = 1.0, .m = NAN};
    material.strength = (struct strength){STRENGTH_johnson_cook, {.johnson_cook = steel}};
    material.failure.kind = FAILURE_johnson_cook;
    material.failure.of.johnson_cook = (struct failure_johnson_cook){.d1 = 0.5,
                                                                     .rate = 1.0,
                                                                     .least_strain = 0.01,
                                                                     .spall = NAN,
                                                                     .band = NAN,
                                                                     .coupling = 0.8,
                                                                     .critical = 0.5};
    material_complete(&material);
    struct point point = at_rest(&material);
    strain_by(&material, 0.25, -0.125, -0.125, 1e-3, &point);
    const double p = point.history[HISTORY_plastic_strain], d = p / 0.5;
    assert_close(point.history[HISTORY_damage], d, 1e-9);
    const double wanted = (1.0 - 0.4 * d) * (350e6 + 275e6 * pow(p * (1.0 - 0.2 * d), 0.4));
    assert_close(sym3_mises(point.deviator), wanted, 1e-3);
    assert_close(strength_yield(&material.strength, &point), wanted, 1e-3);
    material.failure.of.johnson_cook.onset = 0.1;
    point = at_rest(&material);
    strain_by(&material, 0.25, -0.125, -0.125, 1e-3, &point);
    const double q = point.history[HISTORY_plastic_strain];
    assert_close(point.history[HISTORY_damage], (q - 0.1) / 0.4, 1e-3);
    strain_by(&material, 0.3, -0.15, -0.15, 1e-3, &point);
    assert_true(point.history[HISTORY_damage] == 1.0 && sym3_mises(point.deviator) == 0.0);
    assert_null(material_failure_wrong(&material));
    material.strength.kind = STRENGTH_perfect_plastic;
    assert_non_null(material_failure_wrong(&material));
}

static void cockcroft_and_latham_add_work(void **state)
{
    (void)state;
    struct material material = metal(300e6);
    material.failure.kind = FAILURE_cockcroft_latham;
    material.failure.of.cockcroft_latham =
        (struct failure_cockcroft_latham){.work = 500e6, .spall = NAN};
    struct point point = at_rest(&material);
    /* elongation at constant volume: sigma_1 = 2/3 Y */
    strain_by(&material, 1.0, -0.5, -0.5, 1e-3, &point);
    const double strain = point.history[HISTORY_plastic_strain];
    assert_close(point.history[HISTORY_damage], 200e6 * strain / 500e6, 0.01);
    strain_by(&material, 2.0, -1.0, -1.0, 1e-3, &point);
    assert_true(point.history[HISTORY_damage] == 1.0 && sym3_mises(point.deviator) == 0.0);
    /* compression does none */
    point = at_rest(&material);
    strain_by(&material, -0.3, -0.3, -0.4, 1e-3, &point);
    assert_true(point.history[HISTORY_plastic_strain] > 0.0);
    assert_true(point.history[HISTORY_damage] == 0.0);
}

static void grady_takes_the_weaker_of_cracks_and_holes(void **state)
{
    (void)state;
    const struct failing point = {
        .density = 2700.0, .sound = 5200.0, .yield = 300e6, .stretching = 1e5};
    struct failure_grady failure = {.toughness_squared = NAN, .strain = 0.15};
    /* sqrt(2 . 2700 . 5200^2 . 3e8 . 0.15) */
    assert_close(grady_strength(&failure, &point), 2.5634e9, 1e-4);
    failure.toughness_squared = 9e14; /* 30 MPa m^1/2 */
    /* (3 . 2700 . 5200 . 9e14 . 1e5)^(1/3) */
    assert_close(grady_strength(&failure, &point), 1.5593e9, 1e-4);
    failure.strain = 0.0;
    assert_close(grady_strength(&failure, &point), 1.5593e9, 1e-4);
    const char *key;
    failure.toughness_squared = NAN;
    assert_non_null(failure_wrong(&(struct failure){FAILURE_grady, {.grady = failure}}, &key));
    assert_string_equal(key, "strain");
}

static void fluids_and_models_that_fail_by_themselves_take_none(void **state)
{
    (void)state;
    struct material material = metal(300e6);
    assert_null(material_failure_wrong(&material));
    material.failure.kind = FAILURE_spall;
    assert_null(material_failure_wrong(&material));
    material.strength.kind = STRENGTH_hjc;
    assert_non_null(material_failure_wrong(&material));
    material.strength.kind = STRENGTH_NONE;
    assert_non_null(material_failure_wrong(&material));
    material.failure.kind = FAILURE_cavitation;
    assert_null(material_failure_wrong(&material));
    material.strength.kind = STRENGTH_perfect_plastic;
    assert_non_null(material_failure_wrong(&material));
}

/* Bubbles open at the tension that is given, take what the liquid expands, and bear no pressure
 * until they are closed again. */
static void a_liquid_cavitates_and_bubbles_close(void **state)
{
    (void)state;
    struct material material = metal(0.0);
    material.strength.kind = STRENGTH_NONE;
    material.failure.kind = FAILURE_cavitation;
    material.failure.of.cavitation.tension = 50e6;
    struct point point = at_rest(&material);
    const double bulk = 73e9, held = 50e6 / bulk;
    strain_by(&material, 0.98 * held, 0.0, 0.0, 1e-6, &point);
    assert_true(point.history[HISTORY_damage] == 0.0);
    assert_close(point.pressure, -0.98 * 50e6, 0.01);
    strain_by(&material, 2e-3, 0.0, 0.0, 1e-6, &point);
    assert_true(point.history[HISTORY_damage] == 1.0 && point.pressure == 0.0);
    assert_close(point.history[HISTORY_void_ratio], 2e-3 + 0.98 * held, 0.01);
    strain_by(&material, -2e-3, 0.0, 0.0, 1e-6, &point);
    assert_true(point.pressure == 0.0);
    assert_close(point.history[HISTORY_void_ratio], 0.98 * held, 0.01);
    strain_by(&material, -1e-3 - 0.98 * held, 0.0, 0.0, 1e-6, &point);
    assert_close(point.pressure, 1e-3 * 2700.0 * square(5350.0), 0.02);
}

/* The overload of a point in TENSION, in strengths, after a step of one hundredth of a transit,
 * where the tension falls by CHANGE along a diameter, and by RATE in a transit as it stretches. */
static double overload_after(double tension, double change, double rate)
{
    const struct failure_spall spall = {.strength = 1.0, .stress = SPALL_MEAN};
    const struct failing point = {.density = 1.0,
                                  .pressure = -tension,
                                  .deviator = {2.0, -1.0, -1.0},
                                  .stretching = rate,
                                  .relative = 1.0};
    const struct motion motion = {
        .dt = 0.01, .length = 1.0, .acceleration = vec3_make(change, 0.0, 0.0)};
    return spall_overload(&spall, &point, &motion, 1.0, 0.5);
}

static void spall_waits_for_the_edge_of_the_tension_to_stand(void **state)
{
    (void)state;
    assert_true(overload_after(0.99, 0.1, 0.0) == 0.0); /* begins again */
    assert_close(overload_after(1.01, 0.02, 0.02), 0.5 + 0.01 / 5.0, 1e-12);
    assert_true(overload_after(1.5, 0.02, 0.02) == 0.5); /* a wave passes */
    assert_close(overload_after(1.5, 0.02, 0.2), 0.5 + 0.01 / 20.0, 1e-12);
    assert_close(overload_after(1.5, 0.0, 0.0), 0.5 + 0.01 / 20.0, 1e-12);
}

/* Random steps of failed material: what it bears, and that no state is impossible. */
static void failed_material_bears_no_tension_whatever_happens(void **state)
{
    (void)state;
    struct material material = metal(300e6);
    material.failure.kind = FAILURE_spall;
    material.failure.of.spall = (struct failure_spall){.friction = 0.5, .strength = 1e9};
    struct dice dice = {7};
    struct point point = at_rest(&material);
    point.history[HISTORY_damage] = 1.0;
    for (int k = 0; k < 200000; k++) {
        struct motion motion = {.dt = 1e-9, .length = 1e-3};
        motion.strain_rate =
            (struct sym3){dice_between(&dice, -3e6, 3e6), dice_between(&dice, -3e6, 3e6),
                          dice_between(&dice, -3e6, 3e6), dice_between(&dice, -3e6, 3e6),
                          dice_between(&dice, -3e6, 3e6), dice_between(&dice, -3e6, 3e6)};
        motion.density = point.density / (1.0 + motion.dt * sym3_trace(motion.strain_rate));
        motion.energy = dice_between(&dice, 0.0, 1e6);
        const struct response r = material_step(&material, &point, &motion);
        assert_true(point.pressure >= 0.0 && r.sound_long > 0.0 && !(r.status & POINT_NO_SOUND));
        assert_true(sym3_mises(point.deviator) <= 0.5 * point.pressure * (1.0 + 1e-12));
        assert_true(point.history[HISTORY_void_ratio] >= 0.0 &&
                    point.history[HISTORY_void_ratio] <= VOIDS_MOST);
        if (point.history[HISTORY_void_ratio] > 0.0)
            assert_true(point.pressure < 1e-3 * 73e9);
    }
}

/* Of many particles the share exp(-V/V_0 s^m) bears more than s, and a particle bears the same in
 * every run. */
static void strength_scatters_as_weibull_says(void **state)
{
    (void)state;
    enum { MANY = 200000 };
    struct failure failure = {.kind = FAILURE_spall};
    assert_false(failure_scatters(&failure));
    failure.of.common.weibull_modulus = 8.0;
    failure.of.common.weibull_volume = 3e-9;
    assert_true(failure_scatters(&failure));
    static const double volumes[] = {3e-9, 1e-12}, bears[] = {0.6, 0.9, 1.0, 1.2};
    for (size_t v = 0; v < COUNT_OF(volumes); v++)
        for (size_t b = 0; b < COUNT_OF(bears); b++)
            for (int seed = 1; seed <= 2; seed++) {
                failure.of.common.seed = seed;
                const double specimens = volumes[v] / 3e-9;
                const double least = bears[b] * pow(specimens, -1.0 / 8.0);
                const double share = exp(-pow(bears[b], 8.0));
                int stronger = 0;
                for (uint64_t id = 0; id < MANY; id++)
                    stronger += failure_relative_strength(&failure, id, volumes[v]) > least;
                /* four standard deviations */
                assert_near(stronger, MANY * share, 4.0 * sqrt(MANY * share * (1.0 - share)));
            }
    failure.of.common.weibull_volume = NAN;
    const double first = failure_relative_strength(&failure, 7, 1e-9);
    assert_true(first == failure_relative_strength(&failure, 7, 1e-3));
    assert_true(first != failure_relative_strength(&failure, 8, 1e-9));
}

/* Twice the strength, twice the tension. */
static void a_stronger_point_fails_later(void **state)
{
    (void)state;
    struct material material = metal(100e9);
    material.failure.kind = FAILURE_spall;
    material.failure.of.spall = (struct failure_spall){.friction = 0.3, .strength = 600e6};
    const double strain = 600e6 / (73e9 + 4.0 / 3.0 * 23e9);
    for (double relative = 0.5; relative < 2.1; relative += 0.5) {
        struct point point = at_rest(&material);
        point.history[HISTORY_strength_scatter] = relative - 1.0;
        strain_by(&material, 0.97 * relative * strain, 0.0, 0.0, 1e-6, &point);
        assert_true(point.history[HISTORY_damage] == 0.0);
        strain_by(&material, 0.06 * relative * strain, 0.0, 0.0, 1e-6, &point);
        assert_true(point.history[HISTORY_damage] == 1.0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spall_limits_the_largest_stress_and_leaves_no_tension),
        cmocka_unit_test(voids_close_before_failed_material_resists),
        cmocka_unit_test(tension_falls_while_voids_grow),
        cmocka_unit_test(voids_do_the_work_of_half_the_strength),
        cmocka_unit_test(growth_of_voids_needs_a_mean_tension),
        cmocka_unit_test(johnson_cook_failure_strains),
        cmocka_unit_test(johnson_cook_damage_adds_up),
        cmocka_unit_test(damage_in_shear_bands_knows_the_size_of_particles),
        cmocka_unit_test(damage_weakens_where_it_is_coupled),
        cmocka_unit_test(cockcroft_and_latham_add_work),
        cmocka_unit_test(grady_takes_the_weaker_of_cracks_and_holes),
        cmocka_unit_test(fluids_and_models_that_fail_by_themselves_take_none),
        cmocka_unit_test(a_liquid_cavitates_and_bubbles_close),
        cmocka_unit_test(spall_waits_for_the_edge_of_the_tension_to_stand),
        cmocka_unit_test(failed_material_bears_no_tension_whatever_happens),
        cmocka_unit_test(strength_scatters_as_weibull_says),
        cmocka_unit_test(a_stronger_point_fails_later),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
