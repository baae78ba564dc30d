/* The fast pair loop: against the naive one, against itself on other instruction sets, and what it
 * must keep. */
#include "trial.h"

#include "base/isa.h"

typedef void pair_loop_isa(const struct pair_loop *, int32_t, int32_t);
ISA_DECLARE(pair_loop_isa, pair_loop_run);

#define KIND(...)                        \
    {                                    \
        __VA_ARGS__, false, false, false \
    }
static const struct pair_kind kinds[] = {KIND(1, false, STAR_ACOUSTIC, false),
                                         KIND(1, false, STAR_MEAN, false),
                                         KIND(2, false, STAR_ACOUSTIC, false),
                                         KIND(2, false, STAR_MEAN, false),
                                         KIND(2, true, STAR_ACOUSTIC, false),
                                         KIND(2, true, STAR_MEAN, false),
                                         KIND(3, false, STAR_ACOUSTIC, false),
                                         KIND(3, false, STAR_MEAN, false),
                                         KIND(3, true, STAR_ACOUSTIC, false),
                                         KIND(3, true, STAR_MEAN, false),
                                         KIND(1, false, STAR_DUKOWICZ, true),
                                         KIND(2, false, STAR_DUKOWICZ, false),
                                         KIND(3, true, STAR_DUKOWICZ, true),
                                         KIND(1, false, STAR_EXACT_GAS, false),
                                         KIND(3, false, STAR_EXACT_GAS, true),
                                         KIND(2, true, STAR_ACOUSTIC, true),
                                         {2, false, STAR_ACOUSTIC, false, true, false, false},
                                         {2, true, STAR_MEAN, true, true, false, false},
                                         {2, false, STAR_DUKOWICZ, true, true, false, false},
                                         {2, false, STAR_EXACT_GAS, false, true, false, false},
                                         {2, true, STAR_ACOUSTIC, false, true, false, false},
                                         {2, true, STAR_ACOUSTIC, false, false, true, false},
                                         {3, true, STAR_ACOUSTIC, true, false, true, false},
                                         {2, true, STAR_ACOUSTIC, true, true, true, false},
                                         {1, false, STAR_ACOUSTIC, false, false, false, true},
                                         {2, true, STAR_ACOUSTIC, false, false, false, true},
                                         {2, true, STAR_ACOUSTIC, false, true, true, true},
                                         {3, true, STAR_ACOUSTIC, false, false, false, true},
                                         {3, true, STAR_DUKOWICZ, true, false, false, true}};

static void the_fast_loop_agrees_with_the_naive_one(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(kinds); k++)
        for (unsigned with = 0; with < 4; with++) {
            struct trial t;
            trial_create(&t, kinds[k], 80, with, 10 * k + with);
            pair_loop_run(&t.loop, 0, t.scene.particles.count);
            for (int32_t i = 0; i < t.scene.particles.count; i++)
                compare_with_naive(&t, i);
            trial_destroy(&t);
        }
}

/* Rows longer than the loop's lists. */
static void long_rows_agree_too(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(kinds); k += 4) {
        struct trial t;
        trial_create(&t, kinds[k], 1300, LAWS, 100 + k);
        for (int32_t i = 0; i < t.scene.particles.count; i++)
            scene_diameter(&t.scene)[i] *= kinds[k].dimension == 1 ? 400.0 : 12.0;
        rates_free(&t.loop.rates);
        trial_prepare(&t, kinds[k]);
        uint32_t longest = 0;
        for (int32_t i = 0; i < t.scene.particles.count; i++)
            longest = longest < t.scene.neighbours.row[i].count ? t.scene.neighbours.row[i].count
                                                                : longest;
        assert_true(longest > 1024);
        pair_loop_run(&t.loop, 0, t.scene.particles.count);
        for (int32_t i = 0; i < t.scene.particles.count; i += 50)
            compare_with_naive(&t, i);
        trial_destroy(&t);
    }
}

static void assert_same_rates(const struct pair_rates *a, const struct pair_rates *b, int32_t count)
{
    size_t n = (size_t)count * sizeof(double);
    assert_memory_equal(a->acceleration, b->acceleration, 3 * n);
    assert_memory_equal(a->power, b->power, n);
    assert_memory_equal(a->strain_rate, b->strain_rate, 6 * n);
    assert_memory_equal(a->spin, b->spin, 3 * n);
    assert_memory_equal(a->wall, b->wall, 3 * n);
    assert_memory_equal(a->hoop_pull, b->hoop_pull, n);
    assert_memory_equal(a->hoop_strain, b->hoop_strain, n);
    assert_memory_equal(a->broken, b->broken, n);
}

static void all_instruction_sets_give_the_same_bits(void **state)
{
    (void)state;
    pair_loop_isa *const set[] = {ISA_LIST(pair_loop_run)};
    const int sets = isa_count();
    print_message("%d instruction sets\n", sets);
    for (size_t k = 0; k < COUNT_OF(kinds); k++)
        for (unsigned with = 0; with < 4; with++) {
            struct trial t;
            trial_create(&t, kinds[k], 200, with, 200 + 10 * k + with);
            int32_t count = t.scene.particles.count;
            struct pair_rates first = t.loop.rates;
            set[0](&t.loop, 0, count);
            for (int s = 1; s < sets; s++) {
                t.loop.rates = rates_new(count);
                set[s](&t.loop, 0, count);
                assert_same_rates(&t.loop.rates, &first, count);
                rates_free(&t.loop.rates);
            }
            t.loop.rates = first;
            trial_destroy(&t);
        }
}

/* The rates of particle ID of the other trial. */
static void assert_same_by_id(const struct trial *a, const struct trial *b)
{
    const struct particles *p = &a->scene.particles, *q = &b->scene.particles;
    for (int32_t i = 0; i < p->count; i++) {
        int32_t j = 0;
        while (q->id[j] != p->id[i])
            j++;
        const struct pair_rates *r = &a->loop.rates, *s = &b->loop.rates;
        assert_memory_equal(r->acceleration[i], s->acceleration[j], sizeof r->acceleration[i]);
        assert_memory_equal(&r->power[i], &s->power[j], sizeof r->power[i]);
        assert_memory_equal(r->strain_rate[i], s->strain_rate[j], sizeof r->strain_rate[i]);
        assert_memory_equal(r->spin[i], s->spin[j], sizeof r->spin[i]);
        assert_memory_equal(r->wall[i], s->wall[j], sizeof r->wall[i]);
    }
}

static void storage_and_skin_do_not_change_a_bit(void **state)
{
    (void)state;
    static const struct {
        double cell, skin;
    } other[] = {{0.7, 0.15}, {11.0, 0.15}, {3.0, 0.02}, {3.0, 0.6}, {1.3, 0.9}};
    for (size_t k = 4; k < COUNT_OF(kinds); k += 4) {
        struct trial t;
        trial_create(&t, kinds[k], 200, WALLS | LAWS, 300 + k);
        pair_loop_run(&t.loop, 0, t.scene.particles.count);
        for (size_t m = 0; m < COUNT_OF(other); m++) {
            struct trial o;
            trial_create(&o, kinds[k], 200, WALLS | LAWS, 300 + k);
            o.scene.particles.cell = other[m].cell;
            o.scene.neighbours.skin = other[m].skin;
            rates_free(&o.loop.rates);
            trial_prepare(&o, kinds[k]);
            pair_loop_run(&o.loop, 0, o.scene.particles.count);
            assert_same_by_id(&t, &o);
            trial_destroy(&o);
        }
        trial_destroy(&t);
    }
}

static void momentum_and_total_energy_are_conserved(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(kinds); k++)
        for (unsigned with = 0; with < 4; with += LAWS) {
            struct trial t;
            trial_create(&t, kinds[k], 300, with, 400 + 10 * k + with);
            const struct particles *p = &t.scene.particles;
            pair_loop_run(&t.loop, 0, p->count);
            double force[3] = {0.0}, force_size = 0.0, power = 0.0, power_size = 0.0;
            for (int32_t i = 0; i < p->count; i++) {
                power += p->mass[i] * t.loop.rates.power[i];
                power_size += fabs(p->mass[i] * t.loop.rates.power[i]);
                for (int a = 0; a < 3; a++) {
                    double f = p->mass[i] * t.loop.rates.acceleration[i][a];
                    force[a] += f;
                    force_size += fabs(f);
                    power += f * p->velocity[i][a];
                    power_size += fabs(f * p->velocity[i][a]);
                }
            }
            for (int a = 0; a < 3; a++)
                assert_near(force[a], 0.0, 1e-14 * force_size);
            assert_near(power, 0.0, 1e-14 * power_size);
            trial_destroy(&t);
        }
}

/* A mirror is a slip wall at rest: it pushes along its normal and does no work. */
static void walls_do_no_work_and_push_along_their_normal(void **state)
{
    (void)state;
    for (size_t k = 4; k < COUNT_OF(kinds); k += 4) {
        struct trial t;
        trial_create(&t, kinds[k], 300, WALLS, 500 + k);
        t.scene.mirrors.high[0] = t.scene.mirrors.high[1] = t.scene.mirrors.high[2] = NAN;
        t.scene.mirrors.low[1] = t.scene.mirrors.low[2] = NAN;
        rates_free(&t.loop.rates);
        trial_prepare(&t, kinds[k]);
        const struct particles *p = &t.scene.particles;
        pair_loop_run(&t.loop, 0, p->count);
        double along = 0.0, across[2] = {0.0}, power = 0.0, force_size = 0.0, power_size = 0.0;
        for (int32_t i = 0; i < p->count; i++) {
            const double *a = t.loop.rates.acceleration[i], *u = p->velocity[i];
            double rate = a[0] * u[0] + a[1] * u[1] + a[2] * u[2] + t.loop.rates.power[i];
            power += p->mass[i] * rate;
            power_size += p->mass[i] * (fabs(a[0] * u[0]) + fabs(t.loop.rates.power[i]));
            along += p->mass[i] * (a[0] - t.loop.rates.wall[i][0]);
            across[0] += p->mass[i] * a[1];
            across[1] += p->mass[i] * a[2];
            force_size += p->mass[i] * (fabs(a[0]) + fabs(a[1]) + fabs(a[2]));
        }
        assert_near(power, 0.0, 1e-13 * power_size);
        assert_near(along, 0.0, 1e-13 * force_size);
        assert_near(across[0], 0.0, 1e-13 * force_size);
        assert_near(across[1], 0.0, 1e-13 * force_size);
        trial_destroy(&t);
    }
}

/* Section 0.3 of the acceptance tests, item 1. */
static void on_a_line_with_h_equal_to_d_the_loop_is_godunovs_scheme(void **state)
{
    (void)state;
    enum { COUNT = 40 };
    const double d = 0x1p-10;
    const struct pair_kind kind = KIND(1, false, STAR_ACOUSTIC, false);
    struct dice dice = {600};
    struct trial t = {.record = NULL};
    scene_create(&t.scene, 1, COUNT, 3.0 * d, 0.15);
    t.scene.reach.smoothing = 1.0;
    struct particles *p = &t.scene.particles;
    for (int32_t i = 0; i < COUNT; i++) {
        p->position[i][0] = i * d;
        scene_diameter(&t.scene)[i] = d;
    }
    random_state(&t.scene, kind, &dice);
    for (int32_t i = 0; i < COUNT; i++)
        p->mass[i] = p->density[i] * d;
    trial_prepare(&t, kind);
    pair_loop_run(&t.loop, 0, COUNT);
    for (int32_t i = 1; i < COUNT - 1; i++) {
        double u_star[2], s_star[2], size = 0.0, speed = 0.0;
        for (int side = 0; side < 2; side++) {
            int32_t l = i - 1 + side, r = i + side;
            while (p->position[l][0] != (i - 1 + side) * d)
                l = (l + 1) % COUNT;
            while (p->position[r][0] != (i + side) * d)
                r = (r + 1) % COUNT;
            double zl = p->energy[l], zr = p->energy[r], ul = p->velocity[l][0];
            double ur = p->velocity[r][0], sl = p->deviator[l][0], sr = p->deviator[r][0];
            u_star[side] = (zl * ul + zr * ur + sr - sl) / (zl + zr);
            s_star[side] = (zl * sr + zr * sl + zl * zr * (ur - ul)) / (zl + zr);
            size += fabs(sl) + fabs(sr) + fabs(zl * zr * (ur - ul)) / (zl + zr);
            speed += fabs(ul) + fabs(ur) + (fabs(sr) + fabs(sl)) / (zl + zr);
        }
        int32_t own = 0;
        while (p->position[own][0] != i * d)
            own++;
        double mass = p->mass[own], u = p->velocity[own][0];
        assert_near(t.loop.rates.acceleration[own][0], (s_star[1] - s_star[0]) / mass,
                    1e-14 * size / mass);
        assert_near(t.loop.rates.strain_rate[own][0], (u_star[1] - u_star[0]) / d,
                    1e-14 * speed / d);
        assert_near(t.loop.rates.power[own],
                    (s_star[1] * (u_star[1] - u) - s_star[0] * (u_star[0] - u)) / mass,
                    1e-14 * size * speed / mass);
    }
    trial_destroy(&t);
}

/* Two particles, one at the origin, one at X; the caller says of which bodies. */
static void two_particles(struct trial *t, struct pair_kind kind, const double x[3])
{
    struct dice dice = {700};
    *t = (struct trial){.record = NULL};
    scene_create(&t->scene, kind.dimension, 2, 3.0, 0.15);
    for (int axis = 0; axis < kind.dimension; axis++)
        t->scene.particles.position[1][axis] = x[axis];
    for (int32_t i = 0; i < 2; i++)
        scene_diameter(&t->scene)[i] = 1.0;
    t->scene.groups = (struct contact_groups){scene_group_of_body, scene_law, SCENE_BODIES, NULL};
    t->scene.particles.id[0] = 1; /* both solid, where the kind has shear */
    t->scene.particles.id[1] = 2;
    random_state(&t->scene, kind, &dice);
}

static void slip_gives_no_tangential_force(void **state)
{
    (void)state;
    struct dice dice = {701};
    for (size_t k = 4; k < COUNT_OF(kinds); k++) {
        if (!kinds[k].shear)
            continue;
        struct trial t;
        const double axis_x[3] = {1.0, 0.0, 0.0};
        two_particles(&t, kinds[k], axis_x);
        t.scene.particles.body[0] = 0;
        t.scene.particles.body[1] = 2;
        trial_prepare(&t, kinds[k]);
        pair_loop_run(&t.loop, 0, 2);
        for (int32_t i = 0; i < 2; i++) {
            assert_true(t.loop.rates.acceleration[i][0] != 0.0);
            assert_true(t.loop.rates.acceleration[i][1] == 0.0);
            assert_true(t.loop.rates.acceleration[i][2] == 0.0);
        }
        trial_destroy(&t);
        for (int trial = 0; trial < 50; trial++) {
            double x[3] = {dice_between(&dice, -0.7, 0.7), dice_between(&dice, -0.7, 0.7),
                           kinds[k].dimension > 2 ? dice_between(&dice, -0.7, 0.7) : 0.0};
            two_particles(&t, kinds[k], x);
            t.scene.particles.body[0] = 0;
            t.scene.particles.body[1] = 2;
            trial_prepare(&t, kinds[k]);
            pair_loop_run(&t.loop, 0, 2);
            const double *a = t.loop.rates.acceleration[0];
            struct vec3 across =
                vec3_cross(vec3_make(a[0], a[1], a[2]), vec3_make(x[0], x[1], x[2]));
            double size = sqrt(square(a[0]) + square(a[1]) + square(a[2]));
            assert_near(sqrt(vec3_dot(across, across)), 0.0, 1e-15 * size);
            trial_destroy(&t);
        }
    }
}

/* Law 3: slip and no tension, between bodies 1 and 2. */
static void a_contact_that_opens_carries_nothing(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(kinds); k++) {
        if (kinds[k].star == STAR_EXACT_GAS)
            continue; /* a gas is never in tension */
        struct trial t;
        const double x[3] = {0.6, 0.5, 0.0};
        double speed[2] = {-400.0, 400.0};
        for (int closing = 0; closing < 2; closing++) {
            two_particles(&t, kinds[k], x);
            struct particles *p = &t.scene.particles;
            for (int32_t i = 0; i < 2; i++) {
                p->body[i] = (uint16_t)(1 + i);
                for (int s = 0; s < 6; s++)
                    p->deviator[i][s] = s < 3 ? (closing ? -1e9 : 1e9) : 0.0;
                p->velocity[i][0] = closing ? -speed[i] : speed[i];
            }
            trial_prepare(&t, kinds[k]);
            pair_loop_run(&t.loop, 0, 2);
            for (int32_t i = 0; i < 2; i++) {
                const double *a = t.loop.rates.acceleration[i];
                bool pushed = a[0] != 0.0 || a[1] != 0.0 || a[2] != 0.0;
                assert_true(pushed == closing);
                if (!closing)
                    assert_true(t.loop.rates.power[i] == 0.0);
            }
            trial_destroy(&t);
        }
    }
}

static void a_particle_alone_feels_nothing(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(kinds); k++) {
        struct trial t;
        const double x[3] = {7.0, 0.0, 0.0};
        two_particles(&t, kinds[k], x);
        trial_prepare(&t, kinds[k]);
        free(t.loop.rates.wall); /* which nobody asks for where there are no walls */
        t.loop.rates.wall = NULL;
        pair_loop_run(&t.loop, 0, 2);
        for (int32_t i = 0; i < 2; i++) {
            assert_true(t.loop.rates.acceleration[i][0] == 0.0);
            assert_true(t.loop.rates.power[i] == 0.0);
            assert_true(t.loop.rates.strain_rate[i][0] == 0.0);
        }
        trial_destroy(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_fast_loop_agrees_with_the_naive_one),
        cmocka_unit_test(long_rows_agree_too),
        cmocka_unit_test(all_instruction_sets_give_the_same_bits),
        cmocka_unit_test(storage_and_skin_do_not_change_a_bit),
        cmocka_unit_test(momentum_and_total_energy_are_conserved),
        cmocka_unit_test(walls_do_no_work_and_push_along_their_normal),
        cmocka_unit_test(on_a_line_with_h_equal_to_d_the_loop_is_godunovs_scheme),
        cmocka_unit_test(slip_gives_no_tangential_force),
        cmocka_unit_test(a_contact_that_opens_carries_nothing),
        cmocka_unit_test(a_particle_alone_feels_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
