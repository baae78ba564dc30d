/* Transmitting boundaries in the second-order scheme. Frozen particles stay in place while the
 * material beside them moves with the outgoing waves, so the areas of pairs across would no longer
 * add up to zero, and an initial pressure would act like a spring that reflects long waves as a
 * wall does. Frozen particles therefore have no volume in the records: the material ends beside
 * them as at a free surface, and that surface gets the traction of its contact with material at
 * rest, from the impedances (Lysmer and Kuhlemeyer, J. Eng. Mech. Div. ASCE 95 (1969) 859). */
#include <string.h>

#include "base/memory.h"
#include "riemann/acoustic.h"
#include "sph/kernel.h"
#include "sph/muscl/muscl.h"
#include "sph/muscl/rates.h"

/* The body of what ENTRY names. */
static uint16_t body_of(const struct neighbours *n, const struct particles *p, uint32_t entry)
{
    int32_t j = (int32_t)(entry & ENTRY_INDEX);
    if (j >= n->count)
        j = n->ghosts.source[j - n->count];
    return j < n->count ? p->body[j] : n->ghosts.remote[j - n->count].body;
}

struct error *frozen_find(struct sph *sph, const struct simulation *simulation)
{
    const struct particles *p = sph->particles;
    const struct neighbours *n = &sph->neighbours;
    struct muscl_state *state = sph->state;
    state->ends = 0;
    if (!any_body(simulation, body_is_frozen))
        return NULL;
    for (int32_t i = 0; i < p->count; i++) {
        const uint32_t *entry = neighbours_row(n, i);
        const int count = (int)n->row[i].count;
        int q = body_is_frozen(simulation, p->body[i]) ? count : 0;
        while (q < count && !body_is_frozen(simulation, body_of(n, p, entry[q])))
            q++;
        if (q == count)
            continue;
        if (!memory_reserve((void **)&state->end, &state->end_capacity, state->ends + 1,
                            state->ends, sizeof *state->end))
            return error_new(ERROR_SYSTEM, "out of memory for %d particles beside frozen ones",
                             state->ends + 1);
        state->end[state->ends++].index = i;
    }
    return NULL;
}

/* Closes the gate of the particles that were found: the surface there does work that no credit of
 * theirs limits (record.c). */
void frozen_close(const struct sph *sph, struct muscl_kind kind)
{
    const struct muscl_state *state = sph->state;
    for (int32_t k = 0; k < state->ends; k++)
        sph->record[(size_t)state->end[k].index * (size_t)muscl_stride(kind) +
                    (size_t)muscl_elasticity(kind)] = 0.0;
}

/* What the row of a particle says of the surface. */
struct surface {
    struct vec3 outwards; /* a unit vector; zero where nothing frozen is in support */
    struct vec3 velocity; /* of what is frozen there, and its stress and impedances */
    struct sym3 stress;
    double along, across;
    /* The area per unit of volume that pairs of material leave open; the part 1 - Q of linear
     * fields that these pairs do not represent, with Q = -sum f w a x; the moments for forces, see
     * below. */
    struct vec3 open, offset;
    double missing[3][3];
    struct sym3 moment;
};

/* A neighbour, with w = V W', frozen or not, and f = 2 D_i/(D_i + D_j). */
struct look {
    const double *own, *other;
    struct vec3 x, e;
    double weight, near;
    bool frozen;
};

/* False where the entry is out of support. */
static bool look_at(const struct sph *sph, const struct simulation *simulation,
                    struct muscl_kind kind, uint32_t entry, struct look *look)
{
    const int dimension = kind.dimension, d = record_diameter(dimension);
    look->other = sph->record + (size_t)(entry & ENTRY_INDEX) * (size_t)muscl_stride(kind);
    look->x =
        vec3_sub(vector_from(dimension, look->other, 1), vector_from(dimension, look->own, 1));
    const int compression = muscl_compression(kind);
    const double r = sqrt(vec3_dot(look->x, look->x)), both = look->own[d] + look->other[d];
    if ((entry >> ENTRY_PART_SHIFT & PART_LAW) &&
        !muscl_meet(look->own[compression], look->other[compression]))
        return false;
    if (!(r > 0.0 && r < sph->parameters.smoothing * both))
        return false;
    look->e = vec3_scale(1.0 / r, look->x);
    look->near = 2.0 * look->own[d] / both;
    look->frozen = body_is_frozen(simulation, body_of(&sph->neighbours, sph->particles, entry));
    const double volume =
        look->frozen ? pow(look->other[d], dimension) : look->other[record_volume(dimension)];
    look->weight = volume * kernel_slope(r, 2.0 / (sph->parameters.smoothing * both), dimension);
    return true;
}

/* The means of what is frozen by w, whose sum is SUM. */
static void add_frozen(struct muscl_kind kind, const struct look *look, struct surface *s,
                       double *sum)
{
    const int dimension = kind.dimension, z = muscl_impedance(kind);
    const double *other = look->other, w = look->weight;
    const struct vec3 velocity = vector_from(dimension, other + record_velocity(dimension), 1);
    const struct sym3 stress =
        stress_from(muscl_stresses(kind) > 1 ? dimension : 1, other + record_stress(dimension), 1);
    *sum += w;
    s->velocity = vec3_add(s->velocity, vec3_scale(w, velocity));
    s->stress = sym3_add(s->stress, sym3_scale(w, stress));
    s->along += w * other[z];
    s->across += w * (dimension > 1 ? maximum(other[z + 1], 0.0) : 0.0);
}

static void add_matter(struct muscl_kind kind, const struct look *look, struct surface *s)
{
    const int dimension = kind.dimension, l = muscl_correction(kind);
    const struct sym3 both = sym3_add(stress_from(dimension, look->own + l, 1),
                                      stress_from(dimension, look->other + l, 1));
    const struct vec3 a = traction_of(dimension, sym3_scale(0.5, both), look->e);
    const double as[3] = {a.x, a.y, a.z}, xs[3] = {look->x.x, look->x.y, look->x.z};
    double weight = look->weight;
    assert(dimension <= 3);
    for (int b = 0; b < dimension; b++)
        for (int c = 0; c < dimension; c++)
            s->missing[b][c] += weight * look->near * as[b] * xs[c];
    if (kind.depth)
        weight *= 0.5 * fabs(look->own[muscl_depth(kind)] + look->other[muscl_depth(kind)]) /
                  look->own[muscl_depth(kind)];
    s->open = vec3_add(s->open, vec3_scale(2.0 * weight, a));
}

/* The moments for forces are computed as if the material continued symmetrically outside the
 * surface: a neighbour well inside counts twice and one well outside not at all, so that the motion
 * of the material past the frozen particles does not matter. On a complete lattice the moments are
 * those of the lattice. */
static void add_moments(const struct look *look, struct surface *s)
{
    const struct vec3 e = look->e, c = vec3_scale(-look->weight * look->near, look->x);
    const double across = vec3_dot(e, s->outwards), t = minimum(1.0, 2.5 * fabs(across));
    const double well = square(t) * (3.0 - 2.0 * t);
    const struct sym3 m = {c.x * e.x, c.y * e.y, c.z * e.z, c.x * e.y, c.y * e.z, c.z * e.x};
    s->offset = vec3_add(s->offset, vec3_scale(1.0 - well, c));
    s->moment = sym3_add(s->moment, sym3_scale(across < 0.0 ? 1.0 + well : 1.0 - well, m));
}

static struct surface surface_of(const struct sph *sph, const struct simulation *simulation,
                                 struct muscl_kind kind, int32_t i)
{
    struct surface s = {.missing = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    struct look look = {.own = sph->record + (size_t)i * (size_t)muscl_stride(kind)};
    struct vec3 frozen = {0.0, 0.0, 0.0};
    double sum = 0.0;
    int count;
    const uint32_t *entry = neighbours_walk(&sph->neighbours, i, &count);
    for (int q = 0; q < count; q++) {
        if (!look_at(sph, simulation, kind, entry[q], &look))
            continue;
        if (look.frozen) {
            add_frozen(kind, &look, &s, &sum);
            frozen = vec3_add(frozen, vec3_scale(-look.weight, look.e));
        } else {
            add_matter(kind, &look, &s);
        }
    }
    if (!(sum < 0.0))
        return s;
    s.outwards = vec3_scale(1.0 / maximum(sqrt(vec3_dot(frozen, frozen)), 1e-100), frozen);
    s.velocity = vec3_scale(1.0 / sum, s.velocity);
    s.stress = sym3_scale(1.0 / sum, s.stress);
    s.along /= sum;
    s.across /= sum;
    for (int q = 0; q < count; q++)
        if (look_at(sph, simulation, kind, entry[q], &look))
            add_moments(&look, &s);
    return s;
}

/* Velocity and stress of a particle, and their slopes, in the order of a record. */
struct near_state {
    double value[9], slope[9][3];
};

/* On the normal N: the stress of a fluid is one number. */
static struct vec3 traction(struct muscl_kind kind, struct sym3 stress, struct vec3 n)
{
    return muscl_stresses(kind) == 1 ? vec3_scale(stress.xx, n)
                                     : traction_of(kind.dimension, stress, n);
}

/* At the surface of the material: its velocity, its own traction, and that of the contact. */
struct meeting {
    struct vec3 velocity, own, contact;
};

static struct meeting meeting_of(struct muscl_kind kind, const struct near_state *near,
                                 const struct surface *s, const double *own, struct vec3 distance)
{
    const int dimension = kind.dimension, stresses = muscl_stresses(kind);
    const int z = muscl_impedance(kind);
    const struct vec3 n = s->outwards;
    double value[9];
    for (int f = 0; f < dimension + stresses; f++) {
        const double *g = near->slope[f];
        value[f] = near->value[f] + vec3_dot(vec3_make(g[0], g[1], g[2]), distance);
    }
    struct meeting m;
    m.velocity = vector_from(dimension, value, 1);
    m.own = traction(kind, stress_from(stresses > 1 ? dimension : 1, value + dimension, 1), n);
    const struct vec3 rest = traction(kind, s->stress, n);
    const struct vec3 jump = vec3_sub(s->velocity, m.velocity);
    const struct contact_weights along = riemann_acoustic_weights(own[z], s->along);
    const struct contact_weights across =
        riemann_acoustic_weights(dimension > 1 ? maximum(own[z + 1], 0.0) : 0.0, s->across);
    const double mine = vec3_dot(m.own, n), other = vec3_dot(rest, n), closing = vec3_dot(jump, n);
    m.contact = vec3_scale(contact_stress(along, mine, other, closing), n);
    const struct vec3 mine_a = vec3_sub(m.own, vec3_scale(mine, n));
    const struct vec3 other_a = vec3_sub(rest, vec3_scale(other, n));
    const struct vec3 jump_a = vec3_sub(jump, vec3_scale(closing, n));
    m.contact = vec3_add(m.contact, vec3_scale(across.left, other_a));
    m.contact = vec3_add(m.contact, vec3_scale(across.right, mine_a));
    m.contact = vec3_add(m.contact, vec3_scale(across.impedance, jump_a));
    return m;
}

/* The state of the record, and that after the step with the slopes that were found for it. */
static struct near_state state_ahead(struct muscl_kind kind, const double *own)
{
    const int dimension = kind.dimension, values = muscl_values(kind);
    struct near_state near = {{0.0}, {{0.0}}};
    for (int f = 0; f < values; f++) {
        near.value[f] = f < dimension ? own[record_velocity(dimension) + f]
                                      : own[record_stress(dimension) + f - dimension];
        for (int a = 0; a < dimension; a++)
            near.slope[f][a] = own[muscl_slope(kind, f) + a * muscl_slope_step(kind, f)];
    }
    return near;
}

static struct near_state state_after(struct muscl_kind kind, const double *own,
                                     const struct muscl_fields *fields, int32_t i)
{
    const int dimension = kind.dimension, stresses = muscl_stresses(kind);
    const double *g = fields->own.velocity_gradient + (size_t)i * (size_t)(dimension * dimension);
    const double *h = fields->own.stress_gradient + (size_t)i * (size_t)(dimension * stresses);
    struct near_state near = {{0.0}, {{0.0}}};
    for (int f = 0; f < dimension + stresses; f++) {
        near.value[f] = own[muscl_next(kind, f)];
        for (int a = 0; a < dimension; a++)
            near.slope[f][a] =
                f < dimension ? g[f * dimension + a] : h[a * stresses + f - dimension];
    }
    return near;
}

static struct vec3 divergence_of_stress(struct muscl_kind kind, const struct near_state *near)
{
    const int dimension = kind.dimension, stresses = muscl_stresses(kind);
    const double(*s)[3] = near->slope + dimension;
    if (stresses == 1)
        return vec3_make(s[0][0], s[0][1], s[0][2]);
    return dimension == 2 ? vec3_make(s[0][0] + s[2][1], s[2][0] + s[1][1], 0.0)
                          : vec3_make(s[0][0] + s[3][1] + s[5][2], s[3][0] + s[1][1] + s[4][2],
                                      s[5][0] + s[4][1] + s[2][2]);
}

/* What the surface adds to the sums of particle I: force, power, and the force to be expected. */
static void push(struct sph *sph, const struct simulation *simulation,
                 const struct muscl_fields *fields, struct muscl_kind kind, struct end *end)
{
    const struct particles *p = sph->particles;
    const int dimension = kind.dimension;
    const int32_t i = end->index;
    const double *own = sph->record + (size_t)i * (size_t)muscl_stride(kind);
    assert(dimension >= 1 && dimension <= 3);
    struct surface s = surface_of(sph, simulation, kind, i);
    const struct vec3 n = s.outwards;
    memset(end->force, 0, sizeof end->force);
    end->power = 0.0;
    if (!(vec3_dot(n, n) > 0.0))
        return;
    put_tensor(dimension, fields->own.correction + (size_t)i * (size_t)tensor_components(dimension),
               1, correction_of(dimension, moment_of_forces(s.moment, s.offset)));
    if (fields->sph.rates.hoop_pull)
        s.open.x += fields->sph.rates.hoop_pull[i] / sph_ring(p, i).depth;
    const double area = vec3_dot(s.open, n), ns[3] = {n.x, n.y, n.z};
    struct vec3 force = traction(kind, s.stress, s.open);
    double power = 0.0;
    if (area > 0.0) {
        double missing[3] = {0.0};
        for (int b = 0; b < dimension; b++)
            for (int c = 0; c < dimension; c++)
                missing[c] += ns[b] * s.missing[b][c];
        const struct vec3 lever = vec3_make(missing[0], missing[1], missing[2]);
        const struct vec3 distance = vec3_scale(1.0 / area, lever);
        const struct near_state ahead = state_ahead(kind, own);
        const struct meeting now = meeting_of(kind, &ahead, &s, own, distance);
        const struct vec3 rest = traction(kind, s.stress, n);
        force = vec3_add(force, vec3_scale(area, vec3_sub(now.contact, rest)));
        const struct vec3 velocity = vector_from(dimension, ahead.value, 1);
        power = area * vec3_dot(now.contact, vec3_sub(now.velocity, velocity));
        const struct near_state after = state_after(kind, own, fields, i);
        const struct meeting next = meeting_of(kind, &after, &s, own, distance);
        const struct vec3 expected = vec3_add(divergence_of_stress(kind, &after),
                                              vec3_scale(area, vec3_sub(next.contact, next.own)));
        fields->own.force[i][0] = expected.x;
        fields->own.force[i][1] = expected.y;
        fields->own.force[i][2] = expected.z;
    }
    const double forces[3] = {force.x, force.y, force.z}, volume = p->mass[i] / p->density[i];
    double work = power / p->density[i];
    for (int a = 0; a < dimension; a++) {
        const double pushes = forces[a] / p->density[i];
        fields->sph.rates.acceleration[i][a] += pushes;
        work += pushes * (own[record_velocity(dimension) + a] - p->velocity[i][a]);
        end->force[a] = volume * forces[a];
        end->power += end->force[a] * p->velocity[i][a];
    }
    fields->sph.rates.power[i] += work;
    end->power += p->mass[i] * work;
}

void frozen_push(struct sph *sph, const struct simulation *simulation,
                 const struct muscl_fields *fields)
{
    const struct particles *p = sph->particles;
    const struct muscl_kind kind = muscl_kind_of(sph);
    struct muscl_state *state = sph->state;
    if (!any_body(simulation, body_is_frozen))
        return;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t k = 0; k < state->ends; k++)
        push(sph, simulation, fields, kind, &state->end[k]);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++) {
        if (!body_is_frozen(simulation, p->body[i]))
            continue;
        memset(fields->sph.rates.acceleration[i], 0, sizeof *fields->sph.rates.acceleration);
        fields->sph.rates.power[i] = 0.0;
        if (fields->sph.rates.wall)
            memset(fields->sph.rates.wall[i], 0, sizeof *fields->sph.rates.wall);
    }
}

void frozen_book(const struct sph *sph, struct simulation *simulation, double dt)
{
    const struct muscl_state *state = sph->state;
    for (int32_t k = 0; k < state->ends; k++) {
        const double *force = state->end[k].force,
                     *x = sph->particles->position[state->end[k].index];
        ledger_book(&simulation->ledger, LEDGER_PISTONS, 0.0,
                    vec3_scale(dt, vec3_make(force[0], force[1], force[2])),
                    vec3_make(x[0], x[1], x[2]), dt * state->end[k].power);
    }
}
