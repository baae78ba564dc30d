/* Records of the particles that a rank does not own: mirror images and other ranks' particles. They
 * follow those of the owned particles; images of owned particles are made while those of other
 * ranks are on their way. */
#include <string.h>

#include "parallel/periodic.h"
#include "sph/lanes.h"
#include "sph/scheme.h"

void sph_reflect_place(const struct simulation *simulation, image_code image, double *record)
{
    const size_t bytes = (size_t)simulation->problem->dimension * sizeof *record;
    double x[3] = {0.0, 0.0, 0.0};
    memcpy(x, record, bytes);
    const struct vec3 place =
        image_position(&simulation->problem->images, image, vec3_make(x[0], x[1], x[2]));
    const double at[3] = {place.x, place.y, place.z};
    memcpy(record, at, bytes);
}

void sph_reflect_motion(const struct simulation *simulation, image_code image, double *record)
{
    const int dimension = simulation->problem->dimension;
    const struct vec3 sign = image_sign(&simulation->problem->images, image);
    const double signs[3] = {sign.x, sign.y, sign.z};
    double *velocity = record + record_velocity(dimension);
    assert(dimension <= 3);
    sph_reflect_place(simulation, image, record);
    for (int axis = 0; axis < dimension; axis++)
        velocity[axis] *= signs[axis];
}

/* Copies position and diameter of the records of ghosts BEGIN .. END - 1. */
static void copy_places(const struct sph *sph, const struct simulation *simulation,
                        const struct sph_records *records, int32_t begin, int32_t end)
{
    const size_t count = (size_t)sph->particles->count, stride = records->stride;
    const size_t bytes = (size_t)(simulation->problem->dimension + 1) * sizeof(double);
    if (!records->place)
        return;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t g = begin; g < end; g++)
        memcpy(records->place + (count + (size_t)g) * PLACE_STRIDE,
               records->first + (count + (size_t)g) * stride, bytes);
}

/* What the fields of a record are multiplied by, 1 or -1, in an image of each kind, and what is
 * added to the position then. */
struct reflections {
    double sign[IMAGE_CODES][SPH_STRIDE_MAX], shift[IMAGE_CODES][3];
};

static void find_reflections(struct sph *sph, const struct simulation *simulation,
                             const struct sph_records *records, struct reflections *reflections)
{
    assert(records->stride <= SPH_STRIDE_MAX);
    const int images[] = {1, 3, 9, IMAGE_CODES};
    for (int image = 0; image < images[simulation->problem->dimension]; image++) {
        double *sign = reflections->sign[image];
        for (size_t f = 0; f < records->stride; f++)
            sign[f] = 1.0;
        records->reflect(sph, simulation, (image_code)image, sign);
        const struct vec3 turned = image_sign(&simulation->problem->images, (image_code)image);
        const double signs[3] = {turned.x, turned.y, turned.z};
        memcpy(sign, signs, (size_t)simulation->problem->dimension * sizeof *sign);
        for (int axis = 0; axis < 3; axis++)
            reflections->shift[image][axis] = image_place(
                &simulation->problem->images, image_along((image_code)image, axis), axis, 0.0);
    }
}

/* The records of ghosts BEGIN .. END - 1, which are images. */
static void make_images(struct sph *sph, const struct simulation *simulation,
                        const struct sph_records *records, int32_t begin, int32_t end)
{
    const struct ghosts *ghosts = &sph->neighbours.ghosts;
    const size_t count = (size_t)sph->particles->count, stride = records->stride;
    const int dimension = simulation->problem->dimension;
    struct reflections reflections;
    if (begin == end)
        return;
    find_reflections(sph, simulation, records, &reflections);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t g = begin; g < end; g++) {
        const double *from = records->first + (size_t)ghosts->source[g] * stride;
        const double *sign = reflections.sign[ghosts->image[g]],
                     *shift = reflections.shift[ghosts->image[g]];
        double *record = records->first + (count + (size_t)g) * stride;
        for (size_t f = 0; f < stride; f++)
            record[f] = sign[f] * from[f];
        for (int axis = 0; axis < dimension; axis++)
            record[axis] += shift[axis];
    }
    copy_places(sph, simulation, records, begin, end);
}

/* Along periodic axes records of owned particles are where neighbour lists saw them, on the grain:
 * particles that have gone round since then appear outside, and all differences are exact. */
static void settle_owned(const struct sph *sph, const struct simulation *simulation,
                         const struct sph_records *records)
{
    const double(*origin)[3] = (const double(*)[3])sph->neighbours.origin;
    const int dimension = simulation->problem->dimension;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < sph->particles->count; i++) {
        double *record = records->first + (size_t)i * records->stride;
        for (int axis = 0; axis < dimension; axis++)
            if (images_repeat(&simulation->problem->images, axis))
                record[axis] = periodic_nearest(
                    &simulation->problem->images, axis,
                    periodic_rounded(&simulation->problem->images, axis, record[axis]),
                    origin[i][axis]);
        if (records->place)
            memcpy(records->place + (size_t)i * PLACE_STRIDE, record,
                   (size_t)dimension * sizeof *record);
    }
}

double *sph_records_start(struct sph *sph, const struct simulation *simulation,
                          const struct sph_records *records)
{
    struct ghosts *ghosts = &sph->neighbours.ghosts;
    const int32_t count = sph->particles->count;
    if (sph_has(sph, SPH_PERIODIC))
        settle_owned(sph, simulation, records);
    ghosts_start(ghosts, records->first, count, records->stride * sizeof(double));
    make_images(sph, simulation, records, ghosts->remotes, ghosts->early);
    double *empty = records->first + (size_t)(count + ghosts->count) * records->stride;
    return memset(empty, 0, records->stride * sizeof *empty);
}

void sph_records_finish(struct sph *sph, struct simulation *simulation,
                        const struct sph_records *records)
{
    struct ghosts *ghosts = &sph->neighbours.ghosts;
    ghosts_finish(ghosts);
    simulation_end_waiting(simulation);
    copy_places(sph, simulation, records, 0, ghosts->remotes);
    make_images(sph, simulation, records, ghosts->early, ghosts->count);
}
