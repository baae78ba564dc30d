/* What the measures of broken bodies share; see broken.h. */
#include "measure/broken.h"

struct error *broken_check(const struct measurement *measurement)
{
    if (connected_has_diameters(measurement->population))
        return NULL;
    return measure_error(measurement,
                         "only particles form fragments, not the cells of this solver");
}

struct error *broken_check_axis(const struct measurement *measurement, int along)
{
    const int dimension = measurement->simulation->problem->dimension;
    if (along < dimension)
        return NULL;
    return measure_error(measurement, "`along`: the case has %d dimension%s", dimension,
                         dimension == 1 ? "" : "s");
}

struct error *broken_find(const struct measurement *measurement, double link,
                          struct fragments *fragments)
{
    return fragments_find(measurement->simulation->ranks, measurement->population,
                          measure_body(measurement), link, fragments);
}
