/* A corner of two mirror walls stands for the whole: particle by particle, a quarter between walls
 * moves as the same quarter of the whole body without them. So does one half of a body of
 * revolution. */
#include "model/particles/fill.h"
#include "populations.h"
#include "running.h"

enum { STEPS = 60 };

/* A pressed block of metal with a hot liquid core flies apart; %s: what differs between whole and
 * part. */
static const char block[] =
    "format: 1\n"
    "dimension: 2\n"
    "resolution: 1 mm\n"
    "solver: {sph: {method: contact, smoothing: 1.2}}\n"
    "materials:\n"
    "  metal:\n"
    "    eos: {mie-grueneisen: {density: 2700 kg/m^3, sound: 5350 m/s, slope: 1.35, gamma: 2.17, "
    "bulk_modulus: 73 GPa}}\n"
    "    strength: {perfect-plastic: {shear_modulus: 23 GPa, yield: 0.4 GPa}}\n"
    "  liquid: {eos: {barotropic: {density: 1500 kg/m^3, bulk_modulus: 20 GPa}}}\n"
    "run: {until: 1 s}\n";

static const char plane_whole[] =
    "bodies:\n"
    "  block: {material: metal, pressure: 1 GPa, box: {from: [-11 mm, -8 mm], to: [11 mm, 8 mm]}}\n"
    "  core: {material: liquid, pressure: 4 GPa, replaces: block,\n"
    "    intersection: [{ball: {center: [0 mm, 0 mm], radius: 4 mm}},\n"
    "                   {box: {from: [-11 mm, -8 mm], to: [11 mm, 8 mm]}}]}\n";

static const char plane_quarter[] =
    "bodies:\n"
    "  block: {material: metal, pressure: 1 GPa, box: {from: [0 mm, 0 mm], to: [11 mm, 8 mm]}}\n"
    "  core: {material: liquid, pressure: 4 GPa, replaces: block,\n"
    "    intersection: [{ball: {center: [0 mm, 0 mm], radius: 4 mm}},\n"
    "                   {box: {from: [0 mm, 0 mm], to: [11 mm, 8 mm]}}]}\n"
    "walls:\n"
    "  left: {mirror: x, at: 0 mm, side: low}\n"
    "  below: {mirror: y, at: 0 mm, side: low}\n";

static const char round_half[] =
    "geometry: axisymmetric\n"
    "bodies:\n"
    "  block: {material: metal, pressure: 1 GPa, box: {from: [0 mm, -8 mm], to: [11 mm, 8 mm]}}\n"
    "  core: {material: liquid, pressure: 4 GPa, replaces: block,\n"
    "    intersection: [{ball: {center: [0 mm, 0 mm], radius: 4 mm}},\n"
    "                   {box: {from: [0 mm, -8 mm], to: [11 mm, 8 mm]}}]}\n";

static const char round_quarter[] =
    "geometry: axisymmetric\n"
    "bodies:\n"
    "  block: {material: metal, pressure: 1 GPa, box: {from: [0 mm, 0 mm], to: [11 mm, 8 mm]}}\n"
    "  core: {material: liquid, pressure: 4 GPa, replaces: block,\n"
    "    intersection: [{ball: {center: [0 mm, 0 mm], radius: 4 mm}},\n"
    "                   {box: {from: [0 mm, 0 mm], to: [11 mm, 8 mm]}}]}\n"
    "walls:\n"
    "  below: {mirror: y, at: 0 mm, side: low}\n";

static struct running *begin_block(const char *bodies)
{
    static const struct variant plain = {.threads = 1, .cell = 1.0};
    char text[4096];
    assert_true(snprintf(text, sizeof text, "%s%s", block, bodies) < (int)sizeof text);
    struct running *run = begin(text, &plain);
    assert_success(generate_particles(&run->simulation, particles_of(&run->simulation)));
    assert_success(run->solver->start(&run->sph, &run->simulation));
    return run;
}

/* One step of both, the smaller of what they allow; the limits themselves must agree. */
static void step_both(struct running *whole, struct running *part)
{
    struct running *runs[] = {whole, part};
    for (int k = 0; k < 2; k++)
        assert_success(
            runs[k]->solver->prepare(&runs[k]->sph, &runs[k]->simulation, &runs[k]->limit));
    double dt = minimum(whole->limit.dt, part->limit.dt);
    assert_true(fabs(whole->limit.dt - part->limit.dt) <= 1e-10 * dt);
    for (int k = 0; k < 2; k++) {
        assert_success(runs[k]->solver->advance(&runs[k]->sph, &runs[k]->simulation, dt));
        runs[k]->simulation.time += dt;
        runs[k]->simulation.step++;
    }
}

static int32_t with_id(const struct particles *particles, uint64_t id)
{
    for (int32_t i = 0; i < particles->count; i++)
        if (particles->id[i] == id)
            return i;
    fail_msg("no particle %llx", (unsigned long long)id);
    return -1;
}

/* For every particle of PART the id of the one of WHOLE that stands at the same place. */
static uint64_t *partners(const struct particles *whole, const struct particles *part)
{
    uint64_t *id = calloc((size_t)part->count, 2 * sizeof *id);
    for (int32_t i = 0; i < part->count; i++) {
        const double *a = part->position[i];
        id[2 * i] = part->id[i];
        for (int32_t j = 0; j < whole->count; j++) {
            const double *b = whole->position[j];
            if (hypot(a[0] - b[0], a[1] - b[1]) < 1e-9)
                id[2 * i + 1] = whole->id[j];
        }
        assert_true(id[2 * i + 1] != 0 || i == 0);
    }
    return id;
}

static void assert_stands_for(const char *whole_text, const char *part_text, int share)
{
    struct running *whole = begin_block(whole_text), *part = begin_block(part_text);
    const struct particles *w = particles_of(&whole->simulation),
                           *p = particles_of(&part->simulation);
    assert_int_equal(w->count, share * p->count);
    uint64_t *id = partners(w, p);
    for (int k = 0; k < STEPS; k++)
        step_both(whole, part);
    double moved = 0.0;
    for (int32_t k = 0; k < p->count; k++) {
        int32_t i = with_id(p, id[2 * k]), j = with_id(w, id[2 * k + 1]);
        for (int axis = 0; axis < 2; axis++) {
            assert_true(fabs(p->position[i][axis] - w->position[j][axis]) < 1e-13);
            assert_true(fabs(p->velocity[i][axis] - w->velocity[j][axis]) < 1e-7);
            moved = maximum(moved, fabs(p->velocity[i][axis]));
        }
        assert_true(fabs(p->density[i] - w->density[j]) < 1e-9 * w->density[j]);
        assert_true(fabs(p->energy[i] - w->energy[j]) < 1e-9 * 1e6);
        for (int c = 0; c < 6; c++)
            assert_true(fabs(p->deviator[i][c] - w->deviator[j][c]) < 1e-9 * 4e8);
    }
    assert_true(moved > 30.0);
    free(id);
    end(whole);
    end(part);
}

static void a_quarter_between_two_walls_moves_as_a_quarter_of_the_whole(void **state)
{
    (void)state;
    assert_stands_for(plane_whole, plane_quarter, 4);
}

static void a_round_body_on_a_wall_moves_as_half_of_the_whole(void **state)
{
    (void)state;
    assert_stands_for(round_half, round_quarter, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_quarter_between_two_walls_moves_as_a_quarter_of_the_whole),
        cmocka_unit_test(a_round_body_on_a_wall_moves_as_half_of_the_whole),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
