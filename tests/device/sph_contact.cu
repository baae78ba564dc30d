/* Device code of contact SPH: what the body of its pair loop does with a particle and eight neighbours.
 * The kind is known at run time only. */
#include "sph/contact/body.h"

__global__ void add_pairs(struct pair_kind kind, double smoothing, const double *record,
                          const struct lanes *lanes, struct sums *sums)
{
    const int i = (int)blockIdx.x;
    struct pairs pairs;
    struct contacts contacts;
    find_places(kind, smoothing, record, &lanes[i], &pairs);
    find_contacts(kind, record, &lanes[i], &pairs, &contacts);
    add_contacts(kind, record, &lanes[i], &pairs, &contacts, &sums[i]);
    add_contacts(kind, record, &lanes[i], &pairs, NULL, &sums[i]);
}
