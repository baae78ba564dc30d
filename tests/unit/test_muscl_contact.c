/* The points of the second-order contact method: its Riemann problem against what waves must do and
 * against a tabulated one, and the deformation of a step against rotations and strains that are
 * known. */
#include "dice.h"

#include "riemann/shock.h"
#include "sph/deform.h"

static struct side random_side(struct dice *dice)
{
    struct side side = {.impedance = pow(10.0, dice_between(dice, 4.0, 8.0)),
                        .velocity = dice_between(dice, -1e3, 1e3),
                        .stress = dice_between(dice, -1e10, 1e10),
                        .density = dice_between(dice, 1.0, 1e4),
                        .shock_slope = dice_between(dice, 0.05, 2.0)};
    return side;
}

static struct contact_weights shock_weights(struct side l, struct side r)
{
    return riemann_shock_weights(l.impedance, r.impedance, l.density * l.shock_slope,
                                 r.density * r.shock_slope, r.velocity - l.velocity,
                                 r.stress - l.stress);
}

static struct contact contact_of(struct contact_weights w, struct side l, struct side r)
{
    const double jump = r.velocity - l.velocity;
    struct contact contact;
    contact.velocity = l.velocity + contact_velocity_jump(w, jump, r.stress - l.stress);
    contact.stress = contact_stress(w, l.stress, r.stress, jump);
    return contact;
}

static struct contact shock_contact(struct side l, struct side r)
{
    return contact_of(shock_weights(l, r), l, r);
}

static void the_contact_of_equal_states_is_that_state(void **state)
{
    (void)state;
    struct dice dice = {5};
    for (int k = 0; k < 1000; k++) {
        struct side side = random_side(&dice), other = random_side(&dice);
        other.velocity = side.velocity;
        other.stress = side.stress;
        struct contact contact = shock_contact(side, other);
        assert_true(contact.velocity == side.velocity);
        assert_close(contact.stress, side.stress, 1e-15);
    }
}

static void the_contact_is_the_same_from_both_sides(void **state)
{
    (void)state;
    struct dice dice = {6};
    for (int k = 0; k < 1000; k++) {
        struct side l = random_side(&dice), r = random_side(&dice);
        struct side mirrored_l = l, mirrored_r = r;
        mirrored_l.velocity = -l.velocity;
        mirrored_r.velocity = -r.velocity;
        const struct contact_weights w = shock_weights(l, r);
        struct contact contact = contact_of(w, l, r);
        struct contact mirrored = shock_contact(mirrored_r, mirrored_l);
        double velocity = fabs(l.velocity) + fabs(r.velocity),
               stress = fabs(l.stress) + fabs(r.stress);
        assert_near(mirrored.velocity, -contact.velocity,
                    1e-13 * (velocity + w.compliance * stress));
        assert_near(mirrored.stress, contact.stress, 1e-13 * (stress + w.impedance * velocity));
    }
}

/* To first order in the jumps; and of any size where both sides expand. */
static void weak_waves_and_waves_of_expansion_are_acoustic(void **state)
{
    (void)state;
    const double weak = 1e-6;
    struct dice dice = {7};
    for (int k = 0; k < 1000; k++) {
        struct side l = random_side(&dice), r = random_side(&dice);
        const double sound = minimum(l.impedance / (l.density * l.shock_slope),
                                     r.impedance / (r.density * r.shock_slope));
        const double impedance = minimum(l.impedance, r.impedance);
        r.velocity = l.velocity + weak * sound * dice_between(&dice, -1.0, 1.0);
        r.stress = l.stress + weak * impedance * sound * dice_between(&dice, -1.0, 1.0);
        const struct contact_weights w = shock_weights(l, r),
                                     acoustic = riemann_acoustic_weights(l.impedance, r.impedance);
        assert_near(w.right, acoustic.right, 4.0 * weak);
        assert_close(w.impedance, acoustic.impedance, 4.0 * weak);
        assert_close(w.compliance, acoustic.compliance, 4.0 * weak);
        r.stress = l.stress;
        r.velocity = l.velocity + dice_between(&dice, 0.0, 1e4);
        struct contact apart = shock_contact(l, r), wanted = riemann_acoustic(l, r);
        assert_true(apart.velocity == wanted.velocity && apart.stress == wanted.stress);
    }
}

/* The first jump of acceptance test T3, between a hot gas and a cold one. */
static void the_pressure_of_a_blast_wave_is_within_two_per_cent(void **state)
{
    (void)state;
    const struct side hot = {sqrt(1.3 * 3e10), 0.0, -3e10, 1.0, 1.15};
    const struct side cold = {sqrt(1.4 * 1e5), 0.0, -1e5, 1.0, 1.2};
    assert_close(shock_contact(hot, cold).stress, -1.4205672612e10, 0.02);
}

/* Up to jumps of the lesser sound speed; what compresses both sides far more than that may yield as
 * the other grows. */
static void the_contact_pressure_grows_with_what_drives_it(void **state)
{
    (void)state;
    struct dice dice = {8};
    for (int k = 0; k < 1000; k++) {
        struct side l = random_side(&dice);
        const struct side r = random_side(&dice);
        const double sound = minimum(l.impedance / l.density, r.impedance / r.density);
        const double stress = sound * minimum(l.impedance, r.impedance);
        l.velocity = r.velocity + sound * dice_between(&dice, -1.0, 1.0);
        l.stress = r.stress + stress * dice_between(&dice, -1.0, 1.0);
        struct side faster = l, harder = l;
        faster.velocity = r.velocity - sound;
        harder.stress = r.stress + stress;
        struct contact slow = shock_contact(faster, r), soft = shock_contact(harder, r);
        for (int more = 0; more < 20; more++) {
            faster.velocity += 0.1 * sound;
            harder.stress -= 0.1 * stress;
            struct contact fast = shock_contact(faster, r), hard = shock_contact(harder, r);
            assert_true(fast.stress < slow.stress && fast.velocity > slow.velocity);
            assert_true(hard.stress < soft.stress && hard.velocity > soft.velocity);
            slow = fast;
            soft = hard;
        }
    }
}

/* Places that turn by ANGLE about a unit vector in a step. */
static void a_rotation_keeps_density_and_has_no_strain(void **state)
{
    (void)state;
    struct dice dice = {9};
    const double dt = 1e-8;
    for (int k = 0; k < 100; k++) {
        const double angle = pow(10.0, dice_between(&dice, -3.0, -1.0));
        struct vec3 n = vec3_make(dice_between(&dice, -1.0, 1.0), dice_between(&dice, -1.0, 1.0),
                                  dice_between(&dice, -1.0, 1.0));
        n = vec3_scale(1.0 / sqrt(vec3_dot(n, n)), n);
        const double c = (1.0 - cos(angle)) / dt, s = sin(angle) / dt;
        struct sym3 strain = {c * (n.x * n.x - 1.0), c * (n.y * n.y - 1.0), c * (n.z * n.z - 1.0),
                              c * n.x * n.y,         c * n.y * n.z,         c * n.z * n.x};
        struct vec3 spin = vec3_scale(s, n);
        assert_near(sph_deform(dt, &strain, &spin), 1.0, 1e-14);
        struct vec3 missed = vec3_sub(vec3_scale(dt, spin), vec3_scale(angle, n));
        assert_near(dt * sqrt(sym3_square(strain)), 0.0, pow(angle, 4.0) + 1e-15);
        assert_near(sqrt(vec3_dot(missed, missed)), 0.0, pow(angle, 3.0));
    }
}

/* Of a rotation that is taken as its rate, the stretch is left: det F = 1 + angle^2. */
static void a_plain_spin_stretches_to_second_order(void **state)
{
    (void)state;
    struct sym3 strain = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    struct vec3 spin = {0.0, 0.0, 1e6};
    const double angle = 1e-2, dt = angle / spin.z;
    assert_close(sph_deform(dt, &strain, &spin), 1.0 + square(angle), 1e-15);
    assert_close(dt * strain.xx, 0.5 * square(angle), 1e-12);
    assert_close(dt * strain.yy, 0.5 * square(angle), 1e-12);
    assert_true(strain.zz == 0.0 && strain.xy == 0.0 && spin.z == 1e6);
}

static void uniaxial_strain_changes_volume_by_itself(void **state)
{
    (void)state;
    struct dice dice = {10};
    for (int k = 0; k < 300; k++) {
        const double rate = dice_between(&dice, -1e6, 1e6), dt = 1e-7, x = dt * rate;
        double of[3] = {0.0, 0.0, 0.0};
        of[k % 3] = rate;
        struct sym3 strain = {of[0], of[1], of[2], 0.0, 0.0, 0.0};
        struct vec3 spin = {0.0, 0.0, 0.0};
        assert_true(sph_deform(dt, &strain, &spin) == 1.0 + x);
        /* ln (1 + x) to second order */
        assert_near(dt * sym3_trace(strain), x - 0.5 * square(x), 1e-15);
        assert_true(spin.x == 0.0 && spin.y == 0.0 && spin.z == 0.0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_contact_of_equal_states_is_that_state),
        cmocka_unit_test(the_contact_is_the_same_from_both_sides),
        cmocka_unit_test(weak_waves_and_waves_of_expansion_are_acoustic),
        cmocka_unit_test(the_pressure_of_a_blast_wave_is_within_two_per_cent),
        cmocka_unit_test(the_contact_pressure_grows_with_what_drives_it),
        cmocka_unit_test(a_rotation_keeps_density_and_has_no_strain),
        cmocka_unit_test(a_plain_spin_stretches_to_second_order),
        cmocka_unit_test(uniaxial_strain_changes_volume_by_itself),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
