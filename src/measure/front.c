/* front: the position where a field first crosses a value, seen from one end. The field is linear
 * between particles sorted along the axis or, in 2-D and 3-D, between the means of slabs. The value
 * is given, or half the jump. With half the jump the speed of a shock in porous material is
 * measured: U_s0 = (x_2 - x_1)/(t_2 - t_1) (3.4), and in the frame of the material ahead, which
 * moves with U_0, U_s = U_0 - U_s0 (3.5). Source: Parshikov (2013), chapter 3. */
#include <stdlib.h>

#include "base/memory.h"
#include "measure/bands.h"
#include "measure/measure.h"

const struct parameter measure_front_table[] = {
    PARAMETER(TEXT, struct measure_front, field, REQUIRED,
              "the field whose front is located: pressure, stress.xx"),
    PARAMETER(QUANTITY, struct measure_front, value, OPTIONAL, "value of the field at the front"),
    PARAMETER(FLAG, struct measure_front, half, "no",
              "instead of `value`: the level halfway between the field ahead of the front and the "
              "mean of all values past this level"),
    PARAMETER(CHOICE, struct measure_front, from, "high",
              "the end of the axis from which the search starts", .names = parameter_sides),
    PARAMETER(NUMBER, struct measure_front, slab, "0 m",
              "thickness of slabs over which particles are averaged first; 0: no averaging",
              .unit = "m", .below = INFINITY, .closed = true),
    PARAMETER(NUMBER, struct measure_front, frame, "0 m/s",
              "velocity of the frame of reference along the axis; in the frame of the material "
              "ahead, the speed of a shock is relative to it",
              .unit = "m/s"),
    PARAMETER_END,
};

struct error *front_check(const struct measure_front *front, const char *unit)
{
    struct unit parsed;
    TRY(unit_parse(unit, &parsed));
    if (isnan(front->value.value) != front->half)
        return error_new(ERROR_INPUT, "a front needs either `value` or `half: yes`");
    if (!front->half && !dimension_equal(parsed.dimension, front->value.dimension))
        return error_new(ERROR_INPUT, "`value` must be in %s, as %s is",
                         unit[0] ? unit : "plain numbers", front->field);
    return NULL;
}

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    const char *field_unit;
    TRY(measure_field_unit(measurement, &field_unit));
    *unit = "m";
    return measure_located(measurement, front_check(measurement->check->measure.value, field_unit));
}

/* Replaces the samples of all ranks by one a slab on rank 0, at the mean place with the mean
 * value. */
static struct error *average_slabs(const struct ranks *ranks, struct samples *samples,
                                   double thickness)
{
    struct bands slabs = {0, NULL};
    struct band *own = memory_allocate(((size_t)samples->count + 1) * sizeof *own);
    struct error *error = ranks_agree(ranks, own ? NULL : out_of_memory_for("a front"));
    for (int64_t i = 0; i < samples->count && !error; i++)
        own[i] = (struct band){floor(samples->at[i].at / thickness), samples->at[i].at,
                               samples->at[i].value};
    if (!error)
        error = bands_make(ranks, own, samples->count, 1.0, &slabs);
    free(own);
    samples_free(samples);
    if (!error && ranks->rank == 0)
        samples->at = memory_allocate(((size_t)slabs.count + 1) * sizeof *samples->at);
    for (int64_t k = 0; k < slabs.count && samples->at; k++)
        samples->at[samples->count++] =
            (struct sample){.at = slabs.band[k].first, .value = slabs.band[k].second};
    const bool lost = ranks->rank == 0 && !error && !samples->at;
    bands_free(&slabs);
    return error ? error : ranks_agree(ranks, lost ? out_of_memory_for("a front") : NULL);
}

/* A front that is sought: samples stand in order as they are seen from the end where the search
 * begins. */
struct front_search {
    const struct ranks *ranks;
    const struct samples *own;
    bool from_high;
};

static bool is_before(const struct front_search *search, const struct sample *a,
                      const struct sample *b)
{
    const int order = sample_order(a, b);
    return search->from_high ? order > 0 : order < 0;
}

/* Collective: of the samples that the ranks choose (NULL: none) the one that is seen first, or
 * last. *found is false where there is none. */
static struct error *first_of_all(const struct front_search *search, const struct sample *chosen,
                                  bool last, struct sample *first, bool *found)
{
    struct sample *all;
    int64_t count;
    TRY(ranks_gather(search->ranks, -1, chosen, chosen ? 1 : 0, sizeof *chosen, (void **)&all,
                     &count));
    *found = count > 0;
    for (int64_t k = 0; k < count; k++)
        if (k == 0 ||
            (last ? is_before(search, first, &all[k]) : is_before(search, &all[k], first)))
            *first = all[k];
    free(all);
    return NULL;
}

/* Which samples are looked for: all, those at the level, those on the other side of it than the
 * first, and those before one that is known. */
enum wanted { ANY, AT_LEVEL, BEYOND, BEFORE };

static bool is_wanted(const struct front_search *search, enum wanted wanted,
                      const struct sample *sample, double level, const struct sample *known)
{
    switch (wanted) {
    case ANY:
        return true;
    case AT_LEVEL:
        return sample->value == level;
    case BEYOND:
        return (sample->value < level) != (known->value < level);
    case BEFORE:
        return is_before(search, sample, known);
    }
    return false;
}

/* Collective: the first of the WANTED samples of all ranks; of those before another the last. */
static struct error *find(const struct front_search *search, enum wanted wanted, double level,
                          const struct sample *known, struct sample *sample, bool *found)
{
    const bool last = wanted == BEFORE;
    const struct sample *best = NULL;
    for (int64_t i = 0; i < search->own->count; i++) {
        const struct sample *here = &search->own->at[i];
        if (is_wanted(search, wanted, here, level, known) &&
            (!best || (last ? is_before(search, best, here) : is_before(search, here, best))))
            best = here;
    }
    return first_of_all(search, best, last, sample, found);
}

/* Where the line through the samples crosses LEVEL first. */
static struct error *crossing(const struct front_search *search, const struct sample *first,
                              double level, double *place)
{
    struct sample at_level, beyond, before;
    bool reached, crossed, found;
    TRY(find(search, AT_LEVEL, level, NULL, &at_level, &reached));
    TRY(find(search, BEYOND, level, first, &beyond, &crossed));
    if (reached && (!crossed || is_before(search, &at_level, &beyond))) {
        *place = at_level.at;
        return NULL;
    }
    *place = NAN;
    if (!crossed)
        return NULL;
    TRY(find(search, BEFORE, level, &beyond, &before, &found));
    if (!found)
        return NULL;
    const double distance = before.value - level, other = beyond.value - level;
    *place = before.at + (beyond.at - before.at) * (distance / (distance - other));
    return NULL;
}

/* Collective: the mean distance from AHEAD of the values that lie half of JUMP or more beyond it;
 * of all, where JUMP is zero. */
static double mean_beyond(const struct front_search *search, double ahead, double jump)
{
    struct exact_sum sum = {0};
    int64_t count = 0;
    for (int64_t i = 0; i < search->own->count; i++) {
        const double distance = search->own->at[i].value - ahead, beyond = distance - 0.5 * jump;
        if (jump > 0.0 ? beyond < 0.0 : jump < 0.0 && beyond > 0.0)
            continue;
        exact_sum_add(&sum, distance);
        count++;
    }
    ranks_sum_exact(search->ranks, &sum, 1);
    return exact_sum_value(&sum) / (double)ranks_sum(search->ranks, count);
}

/* Half the jump: halfway between the field AHEAD, that of the first sample seen, and the mean of
 * all that is beyond this level. The level rises from half the mean of all to the first that is so:
 * a few high peaks do not hold it up, nor does what is at rest behind the wave draw it down. */
static double half_jump(const struct front_search *search, double ahead)
{
    double jump = mean_beyond(search, ahead, 0.0);
    for (double before = 0.0; fabs(jump) > fabs(before);) {
        before = jump;
        jump = mean_beyond(search, ahead, jump);
    }
    return jump == 0.0 ? NAN : ahead + 0.5 * jump;
}

struct error *front_place(const struct ranks *ranks, struct samples *own,
                          const struct measure_front *front, double time, double *place,
                          double *level)
{
    const struct front_search search = {ranks, own, front->from == FRONT_FROM_HIGH};
    struct sample first;
    bool found;
    if (front->slab > 0.0)
        TRY(average_slabs(ranks, own, front->slab));
    *place = NAN;
    *level = front->value.value;
    TRY(find(&search, ANY, NAN, NULL, &first, &found));
    if (found && front->half)
        *level = half_jump(&search, first.value);
    if (found && !isnan(*level))
        TRY(crossing(&search, &first, *level, place));
    *place -= front->frame * time;
    return NULL;
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    double level;
    struct samples samples;
    const struct simulation *simulation = measurement->simulation;
    TRY(samples_take(measurement, &samples));
    int64_t lost = 0;
    for (int64_t i = 0; i < samples.count; i++)
        lost += isinf(samples.at[i].value);
    lost = ranks_sum(simulation->ranks, lost);
    struct error *error =
        front_place(simulation->ranks, &samples, measurement->check->measure.value,
                    simulation->time, value, &level);
    if (!error && isnan(*value))
        measure_nothing(measurement, NOTHING_NOT_REACHED);
    if (!error && lost)
        *value = measure_nothing(measurement, NOTHING_NOT_FINITE);
    samples_free(&samples);
    return error;
}

/* The distance of the front from the centre of the exact solution when the check is made. */
static double expected(const struct measurement *measurement)
{
    const struct exact_class *exact = measurement->exact;
    const double at = measurement->check->at;
    return exact->front
               ? exact->front(measurement->solved,
                              isnan(at) ? measurement->simulation->problem->input->run.until : at)
               : NAN;
}

const struct measure_class measure_front = {
    .of_field = true, .unit = unit, .measure = measure, .expected = expected};
