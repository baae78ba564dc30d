/* Device code of the physics of a point: every equation of state, strength, failure and burn model,
 * and every contact solver. The kinds are known at run time only, so that all of them are compiled.
 * physics_headers.h, which scripts/check-device writes, includes all headers of their modules. */
#include "physics_headers.h"

#include "material/batch.h"

__global__ void step_points(const struct material *material, const struct motion *motion,
                            struct point *point, struct response *response)
{
    const int i = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    response[i] = material_step(material, &point[i], &motion[i]);
    response[i] = material_step_by_work(material, &point[i], &motion[i]);
}

__global__ void step_batches(const struct material *material, struct batch *batch)
{
    if (batch_takes(material))
        batch_step(material, &batch[blockIdx.x], ENERGY_BY_WORK);
}

__global__ void solve_contacts(const struct side *left, const struct side *right,
                               struct contact *contact)
{
    const int i = (int)threadIdx.x;
    contact[4 * i] = riemann_acoustic(left[i], right[i]);
    contact[4 * i + 1] = riemann_dukowicz(left[i], right[i]);
    contact[4 * i + 2] = riemann_exact_gas(left[i], right[i]);
}

__global__ void solve_elastic_contacts(const struct elastic_side *left,
                                       const struct elastic_side *right, struct contact *contact,
                                       struct elastic_contact *elastic)
{
    const int i = (int)threadIdx.x;
    contact[i] = riemann_hllc(left[i], right[i]);
    elastic[i] = riemann_hllc_elastic(left[i], right[i]);
}

__global__ void weigh_shocks(const double *jump, struct contact_weights *weights)
{
    weights[threadIdx.x] = riemann_shock_weights(jump[0], jump[1], jump[2], jump[3], jump[4], jump[5]);
}

__global__ void find_slopes(const struct material *material, double *slope)
{
    slope[threadIdx.x] = riemann_shock_slope(&material[threadIdx.x]);
}

__global__ void use_formulas(double *x)
{
    x[0] = exponential_minus_one(x[0]) + cube_root(x[1]) + cosine_of_third(x[2]);
    x[1] = power(x[1], x[2]) + logarithm(x[3]);
}
