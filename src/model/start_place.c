/* Where particles stood at the start; see start_place.h. */
#include "model/start_place.h"

#include "model/generate.h"

void start_places(const struct population *particles, int64_t begin, int64_t end,
                  double (*place)[3])
{
    struct lattice lattice = {0};
    struct lattice_row row = {0};
    int lattice_body = -1;
    for (int64_t i = begin; i < end; i++) {
        const int body = (int)(particles->id[i] >> PARTICLE_SITE_BITS);
        const int64_t site = (int64_t)(particles->id[i] & PARTICLE_SITE);
        if (particles->id[i] & PARTICLE_CREATED) {
            for (int axis = 0; axis < 3; axis++)
                place[i - begin][axis] = particles->position[i][axis];
            continue;
        }
        if (body != lattice_body) {
            lattice = place_lattice(&particles->problem->place, body);
            lattice_body = body;
            row.sites = 0;
        }
        /* Neighbours in storage often share a row, and rings are found by walking. */
        if (site < row.first || site >= row.first + row.sites)
            row = lattice_row_of(&lattice, site);
        const struct vec3 at = lattice_place(&lattice, &row, site);
        double *out = place[i - begin];
        out[0] = at.x;
        out[1] = at.y;
        out[2] = at.z;
    }
}
