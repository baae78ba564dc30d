/* asymmetry: how far a field is from its own mirror image. Each particle is compared with the one
 * that stood at the start where its image did:
 *   largest |f_i - s f_image(i)| / largest |f|, s = 1 for an even field, -1 for an odd one. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/measure.h"
#include "measure/near_points.h"
#include "model/start_place.h"
#include "parallel/exchange.h"

static const char *const across_names[] = {"x", "y", "z", "xy", "xyz", NULL};
static const char *const parity_names[] = {"even", "odd", NULL};
static const bool flips[][3] = {{true, false, false},
                                {false, true, false},
                                {false, false, true},
                                {true, true, false},
                                {true, true, true}};
/* An image is found when a particle stood within this part of the resolution of it. */
static const double tolerance = 1e-3;

const struct parameter measure_asymmetry_table[] = {
    PARAMETER(TEXT, struct measure_asymmetry, field, REQUIRED,
              "a field of the particles, or one component of it: velocity.x, displacement.y"),
    PARAMETER(CHOICE, struct measure_asymmetry, across, REQUIRED,
              "the axis that the image reflects; xy: both, a rotation by 180 degrees about z",
              .names = across_names),
    PARAMETER(CHOICE, struct measure_asymmetry, parity, "even",
              "whether the field is the same at the image, or changes its sign",
              .names = parity_names),
    PARAMETER(VECTOR, struct measure_asymmetry, center, OPTIONAL,
              "the centre of symmetry; default: the origin", .unit = "m"),
    PARAMETER_END,
};

/* A particle where it stood at the start, or the image of one, for which another is wanted. Both go
 * to the rank that sees to that part of space. */
struct start_place {
    double at[3], field;
    uint64_t id;
    bool is_image;
};

/* Places on their way. */
struct places {
    int64_t count, room, sends, send_room;
    struct start_place *place;
    struct send_item *send;
};

/* The places that a rank has got: so many that particles stood at, then images. */
struct received {
    struct start_place *place;
    double (*stood)[3];
    int32_t stands, count;
};

/* A search for the particle that stood nearest to an image; of those equally near the one of the
 * lowest id. */
struct mirror_search {
    const struct start_place *place, *image, *nearest;
    double distance2;
};

static void look_at(void *context, int64_t index)
{
    struct mirror_search *search = context;
    const struct start_place *place = &search->place[index];
    const double *x = place->at, *image = search->image->at;
    const double distance2 =
        square(x[0] - image[0]) + square(x[1] - image[1]) + square(x[2] - image[2]);
    if (distance2 < search->distance2 ||
        (search->nearest && distance2 == search->distance2 && place->id < search->nearest->id)) {
        search->distance2 = distance2;
        search->nearest = place;
    }
}

/* The rank that sees to the cube of edge CELL number NUMBER: neighbours may go to different
 * ranks. */
static int32_t rank_of(const struct ranks *ranks, const double number[3])
{
    uint64_t mixed = 0;
    for (int k = 0; k < 3; k++) {
        const double clean = number[k] + 0.0; /* no negative zero */
        uint64_t bits;
        memcpy(&bits, &clean, sizeof bits);
        mixed = (mixed ^ bits) * 0x9e3779b97f4a7c15u;
        mixed ^= mixed >> 29;
    }
    return (int32_t)(mixed % (uint64_t)ranks->size);
}

static bool send_to(struct places *places, int32_t rank)
{
    if (!memory_reserve((void **)&places->send, &places->send_room, places->sends + 1,
                        places->sends, sizeof *places->send))
        return false;
    places->send[places->sends++] = (struct send_item){rank, (int32_t)places->count - 1};
    return true;
}

/* Sends PLACE to every rank that sees to a part of space nearer than REACH, once. */
static bool add_place(struct places *places, const struct ranks *ranks,
                      const struct start_place *place, double cell, double reach)
{
    int32_t sent[8];
    int count = 0;
    if (!memory_reserve((void **)&places->place, &places->room, places->count + 1, places->count,
                        sizeof *places->place))
        return false;
    places->place[places->count++] = *place;
    for (int corner = 0; corner < 8; corner++) {
        double number[3];
        for (int k = 0; k < 3; k++)
            number[k] = floor((place->at[k] + (corner >> k & 1 ? reach : -reach)) / cell);
        const int32_t rank = rank_of(ranks, number);
        bool known = false;
        for (int i = 0; i < count; i++)
            known |= sent[i] == rank;
        if (!known && !send_to(places, sent[count++] = rank))
            return false;
    }
    return true;
}

static struct start_place image_of(const struct measure_asymmetry *parameters,
                                   const struct start_place *place)
{
    struct start_place image = *place;
    for (int k = 0; k < 3; k++)
        if (flips[parameters->across][k])
            image.at[k] = 2.0 * parameters->center.at[k] - place->at[k];
    image.is_image = true;
    return image;
}

static struct error *find_places(const struct measurement *measurement, const double (*start)[3],
                                 const double *field, double reach, struct places *places)
{
    const struct ranks *ranks = measurement->simulation->ranks;
    const struct population *p = measurement->population;
    const double cell = measurement->simulation->problem->input->resolution;
    const int body = measure_body(measurement);
    bool done = true;
    for (int32_t i = 0; i < p->count && done; i++) {
        const struct start_place place = {
            {start[i][0], start[i][1], start[i][2]}, field[i], p->id[i], false};
        const struct start_place image = image_of(measurement->check->measure.value, &place);
        done = add_place(places, ranks, &place, cell, 2.0 * reach) &&
               (!(body < 0 || p->body[i] == body) || add_place(places, ranks, &image, cell, 0.0));
    }
    return done ? NULL : out_of_memory_for("a check");
}

/* Brings the places where particles stood before the images. */
static struct error *sort_places(struct received *received)
{
    received->stood = memory_allocate(((size_t)received->count + 1) * sizeof *received->stood);
    if (!received->stood)
        return out_of_memory_for("a check");
    for (int32_t i = 0; i < received->count; i++) {
        const struct start_place place = received->place[i];
        if (place.is_image)
            continue;
        received->place[i] = received->place[received->stands];
        received->place[received->stands] = place;
        memcpy(received->stood[received->stands++], place.at, sizeof place.at);
    }
    return NULL;
}

/* Of the images here: whether one has no particle, the largest difference, the largest field. */
enum { LOST, OFF, LARGEST, FOUND };

static struct error *compare(const struct received *received, double sign, double reach,
                             double found[FOUND])
{
    struct near_points near;
    TRY(near_points_make((const double(*)[3])received->stood, received->stands, reach, &near));
    for (int32_t i = received->stands; i < received->count; i++) {
        const struct start_place *image = &received->place[i];
        struct mirror_search search = {received->place, image, NULL, square(reach)};
        near_points_about(&near, image->at, look_at, &search);
        const double difference =
            search.nearest ? fabs(image->field - sign * search.nearest->field) : NAN;
        found[LOST] = isnan(difference) ? 1.0 : found[LOST];
        found[OFF] = maximum(found[OFF], difference);
        found[LARGEST] = maximum(found[LARGEST], fabs(image->field));
    }
    near_points_free(&near);
    return NULL;
}

static struct error *compare_on_ranks(const struct measurement *measurement,
                                      const double (*start)[3], const double *field, double *value)
{
    const struct measure_asymmetry *parameters = measurement->check->measure.value;
    const struct ranks *ranks = measurement->simulation->ranks;
    const double reach = tolerance * measurement->simulation->problem->input->resolution;
    struct places places = {0};
    struct received received = {0};
    double found[FOUND] = {0.0, 0.0, 0.0};
    struct error *error =
        ranks_agree(ranks, find_places(measurement, start, field, reach, &places));
    if (!error)
        error = exchange_once(ranks, places.send, (int32_t)places.sends, places.place,
                              sizeof *places.place, (void **)&received.place, &received.count);
    free(places.place);
    free(places.send);
    if (!error)
        error = sort_places(&received);
    if (!error)
        error = compare(&received, parameters->parity ? -1.0 : 1.0, reach, found);
    error = ranks_agree_on(ranks, error, found, FOUND);
    free(received.place);
    free(received.stood);
    *value = found[LOST] > 0.0   ? measure_nothing(measurement, NOTHING_NO_IMAGE)
             : found[OFF] == 0.0 ? 0.0
                                 : found[OFF] / found[LARGEST];
    return error;
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_asymmetry *parameters = measurement->check->measure.value;
    const struct simulation *simulation = measurement->simulation;
    const int32_t count = measurement->population->count;
    const struct column *column;
    int component;
    TRY(column_choose(measurement->population, parameters->field, NULL, 0, &column, &component));
    double(*start)[3] = memory_allocate(((size_t)count + 1) * sizeof *start);
    double *field = memory_allocate(((size_t)count + 1) * sizeof *field);
    struct error *error = NULL;
    if (!start || !field)
        error = out_of_memory_for("a check of %d particles", (int)count);
    error = ranks_agree(simulation->ranks, error);
    if (!error) {
        start_places(measurement->population, 0, count, start);
        column_read_component(measurement->population, column, component, 0, count, field);
        error = compare_on_ranks(measurement, (const double(*)[3])start, field, value);
    }
    free(start);
    free(field);
    return error;
}

const struct measure_class measure_asymmetry = {
    .of_field = true, .unit = measure_no_unit, .measure = measure, .of_bodies = true};
