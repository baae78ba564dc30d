/* Elements of a surface follow the particles: area vectors go with the cofactor of the deformation
 * gradient F (Nanson), a = cof(F) A, and F is the least-squares fit to the particles around. See
 * surface.h. */
#include "model/surface.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "base/field.h"

/* Particles that are so many times as far apart as at the start no longer belong together. */
static const double TORN = 3.0;

/* The weight of F = 1 beside the neighbours: for directions in which there are none. */
static const double TO_UNITY = 1e-7;

void surface_free(struct body_surface *surface)
{
    free(surface->element);
    free(surface->now);
    free(surface->id);
    free(surface->start);
    free(surface->place);
    free(surface->member);
    free(surface->first);
    free(surface->near);
    *surface = (struct body_surface){0};
}

static int by_id(const void *key, const void *item)
{
    const uint64_t a = *(const uint64_t *)key, b = *(const uint64_t *)item;
    return (a > b) - (a < b);
}

/* Whether each site that this rank has is still the member that it was. */
static bool is_located(const struct body_surface *surface, const struct population *p)
{
    bool same = true;
    for (int32_t k = 0; k < surface->sites; k++) {
        const int32_t i = surface->member[k];
        same &= i < 0 || (i < p->count && p->id[i] == surface->id[k]);
    }
    return same;
}

static void locate(struct body_surface *surface, const struct population *p,
                   const struct ranks *ranks)
{
    const bool never = surface->sites > 0 && isnan(surface->place[0].x);
    if (ranks_maximum(ranks, never || !is_located(surface, p)) == 0.0)
        return;
    for (int32_t k = 0; k < surface->sites; k++)
        surface->member[k] = -1;
#pragma omp parallel for schedule(static) num_threads(p->threads)
    for (int32_t i = 0; i < p->count; i++) {
        if (p->body[i] != surface->body)
            continue;
        const uint64_t *found =
            bsearch(&p->id[i], surface->id, (size_t)surface->sites, sizeof *surface->id, by_id);
        if (found)
            surface->member[found - surface->id] = i;
    }
}

/* By columns. */
struct matrix {
    struct vec3 x, y, z;
};

static void add_product(struct matrix *m, struct vec3 a, struct vec3 b)
{
    m->x = vec3_add(m->x, vec3_scale(b.x, a));
    m->y = vec3_add(m->y, vec3_scale(b.y, a));
    m->z = vec3_add(m->z, vec3_scale(b.z, a));
}

static struct vec3 times(const struct matrix *m, struct vec3 v)
{
    return vec3_add(vec3_add(vec3_scale(v.x, m->x), vec3_scale(v.y, m->y)), vec3_scale(v.z, m->z));
}

static struct vec3 unit_cross(struct vec3 a, struct vec3 b)
{
    const struct vec3 c = vec3_cross(a, b);
    const double size = sqrt(vec3_dot(c, c));
    return vec3_scale(size > 0.0 ? 1.0 / size : 0.0, c);
}

static struct matrix cofactor(const struct matrix *m)
{
    return (struct matrix){vec3_cross(m->y, m->z), vec3_cross(m->z, m->x), vec3_cross(m->x, m->y)};
}

/* F of a site: the minimum of sum |x - F X|^2 over the sites around it, F = B M^-1 with
 * B = sum x X^T, M = sum X X^T. */
static struct matrix deformation_of(const struct body_surface *surface, int32_t site)
{
    const struct matrix unity = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    struct matrix b = {0}, m = {0};
    const double scale = 1.0 / square(surface->spacing);
    for (int32_t k = surface->first[site]; k < surface->first[site + 1]; k++) {
        const int32_t other = surface->near[k];
        const struct vec3 start = vec3_sub(surface->start[other], surface->start[site]),
                          now = vec3_sub(surface->place[other], surface->place[site]);
        if (!(vec3_dot(now, now) <= square(TORN) * vec3_dot(start, start)))
            continue;
        add_product(&b, vec3_scale(scale, now), start);
        add_product(&m, vec3_scale(scale, start), start);
    }
    for (int axis = 0; axis < 3; axis++) {
        const double weight = axis < surface->dimension ? TO_UNITY : 1.0;
        const struct vec3 e = axis == 0 ? unity.x : axis == 1 ? unity.y : unity.z;
        add_product(&b, vec3_scale(weight, e), e);
        add_product(&m, vec3_scale(weight, e), e);
    }
    const struct matrix inverse = cofactor(&m); /* times the determinant; m is symmetric */
    const double determinant = vec3_dot(m.x, inverse.x);
    struct matrix f = {vec3_scale(1.0 / determinant, times(&b, inverse.x)),
                       vec3_scale(1.0 / determinant, times(&b, inverse.y)),
                       vec3_scale(1.0 / determinant, times(&b, inverse.z))};
    /* across a sheet of one particle there is no neighbour: it turns with the sheet */
    if (m.x.x < 2.0 * TO_UNITY)
        f.x = unit_cross(f.y, f.z);
    else if (m.y.y < 2.0 * TO_UNITY)
        f.y = unit_cross(f.z, f.x);
    else if (m.z.z < 2.0 * TO_UNITY)
        f.z = unit_cross(f.x, f.y);
    return f;
}

static struct surface_state state_now(const struct body_surface *surface,
                                      const struct surface_element *element, const struct matrix *f,
                                      const struct matrix *cofactors)
{
    const int32_t site = element->site;
    const struct vec3 offset = vec3_sub(element->start.place, surface->start[site]);
    struct surface_state now = {.place = vec3_add(surface->place[site], times(f, offset)),
                                .area = times(cofactors, element->start.area),
                                .normal = times(cofactors, element->start.normal)};
    const double size = sqrt(vec3_dot(now.normal, now.normal));
    now.normal = size > 0.0 ? vec3_scale(1.0 / size, now.normal) : element->start.normal;
    if (surface->round)
        now.area = vec3_scale(maximum(now.place.x, 0.0), now.area);
    return now;
}

void surface_follow(struct body_surface *surface, const struct population *p,
                    const struct ranks *ranks)
{
    locate(surface, p, ranks);
    const struct vec3 gone = {-(double)INFINITY, -(double)INFINITY, -(double)INFINITY};
    for (int32_t k = 0; k < surface->sites; k++)
        surface->place[k] =
            surface->member[k] < 0 ? gone : vector_at(p->position[surface->member[k]]);
    if (ranks->size > 1)
        ranks_maximum_of(ranks, &surface->place[0].x, 3 * surface->sites);
#pragma omp parallel num_threads(p->threads)
    {
        struct matrix f = {0}, cofactors = {0};
        int32_t last = -1;
#pragma omp for schedule(static)
        for (int32_t e = 0; e < surface->elements; e++) {
            const struct surface_element *element = &surface->element[e];
            if (surface->place[element->site].x == gone.x) {
                surface->now[e] = (struct surface_state){.normal = element->start.normal};
                continue;
            }
            if (element->site != last) {
                f = deformation_of(surface, element->site);
                cofactors = cofactor(&f);
                last = element->site;
            }
            surface->now[e] = state_now(surface, element, &f, &cofactors);
        }
    }
}
