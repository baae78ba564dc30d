/* Checks from the case to verdicts; see checks.h. */
#include "run/checks.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"
#include "run/checks_internal.h"

static const struct measure_class *class_of(const struct check_input *check)
{
    return check->measure.choice->thing;
}

static bool given(const struct quantity *quantity) { return !isnan(quantity->value); }

struct error *check_same_dimension(const char *what, const char *key,
                                   const struct quantity *quantity, struct dimension wanted)
{
    if (!given(quantity) || dimension_equal(quantity->dimension, wanted))
        return NULL;
    char is[DIMENSION_TEXT], must[DIMENSION_TEXT];
    dimension_text(quantity->dimension, is);
    dimension_text(wanted, must);
    return error_new(ERROR_INPUT, "`%s` is in %s, but `%s` is in %s", key,
                     is[0] ? is : "plain numbers", what, must[0] ? must : "plain numbers");
}

/* A `within` without dimension is a fraction of `is`; where `is` is zero or not given and the
 * measure is a plain number, it is the distance itself. */
struct error *check_find_limits(const struct check_input *check, const char *what,
                                struct dimension dimension, double *wanted, double *low,
                                double *high)
{
    const struct dimension none = {0, 0, 0, 0};
    TRY(check_same_dimension(what, "is", &check->is, dimension));
    TRY(check_same_dimension(what, "at_most", &check->at_most, dimension));
    TRY(check_same_dimension(what, "at_least", &check->at_least, dimension));
    TRY(check_same_dimension(what, "recorded_value", &check->recorded, dimension));
    if (!dimension_equal(check->regression_bound.dimension, none))
        TRY(check_same_dimension(what, "regression_bound", &check->regression_bound, dimension));
    *wanted = NAN;
    *low = given(&check->at_least) ? check->at_least.value : -INFINITY;
    *high = given(&check->at_most) ? check->at_most.value : INFINITY;
    const bool bounded = given(&check->regression_bound);
    if (given(&check->is) && !given(&check->within)) {
        if (!bounded)
            return error_new(ERROR_INPUT, "`is` needs `within`");
        *wanted = check->is.value;
    }
    if (given(&check->within)) {
        double is = given(&check->is) ? check->is.value : 0.0, distance = check->within.value;
        if (dimension_equal(check->within.dimension, none) && is != 0.0)
            distance *= fabs(is);
        else
            TRY(check_same_dimension(what, "within", &check->within, dimension));
        *wanted = is;
        *low = maximum(*low, is - distance);
        *high = minimum(*high, is + distance);
    }
    return NULL;
}

/* ERROR (taken) at the place of the check in the case. */
static struct error *located(const struct measurement *m, struct error *error)
{
    if (!error)
        return NULL;
    struct error *with_place = measure_error(m, "%s", error_message(error, 0));
    error_free(error);
    return with_place;
}

static const struct one_of *against_of(const struct measurement *m)
{
    return m->check->against.choice ? &m->check->against : &m->simulation->problem->input->exact;
}

/* The solution of the problem that PREPARED is measured against, if a check before it has solved
 * it. */
static const void *solved_before(const struct checks *checks, const struct prepared_check *prepared)
{
    const void *problem = against_of(&prepared->measurement)->value;
    for (const struct prepared_check *other = checks->item; other < prepared; other++)
        if (other->solved && against_of(&other->measurement)->value == problem)
            return other->solved;
    return NULL;
}

/* Bytes of all exact solutions of a case. One takes up to 1.3 MB. */
static const size_t solved_limit = (size_t)512 << 20;

/* Whether the exact solution says what the value of M is: the check gives how far it may be off, as
 * a fraction, and not what it is. */
static bool takes_expected(const struct measurement *m)
{
    const struct check_input *check = m->check;
    const struct dimension none = {0, 0, 0, 0};
    return class_of(check)->expected && against_of(m)->choice && !check->relative &&
           !check->minus && !given(&check->is) && given(&check->within) &&
           dimension_equal(check->within.dimension, none);
}

/* Whether the exact solution has the field that M is of. */
static struct error *check_field(const struct measurement *m, const struct one_of *against)
{
    const struct exact_class *exact = against->choice->thing;
    const struct measure_field *parameters = m->check->measure.value;
    const struct exact_state some = {0};
    if (isnan(exact_field(&some, parameters->field)))
        return measure_error(m,
                             "exact solutions have density, velocity.x, speed, pressure, energy, "
                             "stress.xx, deviator.xx, temperature and burnt, not \"%s\"",
                             parameters->field);
    if (exact->known == EXACT_NO_FIELD)
        return measure_error(m, "%s has no fields: it has the front and the peak there",
                             against->choice->name);
    if (exact->known == EXACT_PRESSURE && strcmp(parameters->field, "pressure") != 0)
        return measure_error(m, "%s has pressure only", against->choice->name);
    if (!exact->burns && !strcmp(parameters->field, "burnt"))
        return measure_error(m, "%s has no `burnt`", against->choice->name);
    if (!exact->burns && exact->thermal != !strcmp(parameters->field, "temperature"))
        return measure_error(m, "%s %s", against->choice->name,
                             exact->thermal ? "has temperature only" : "has no temperature");
    if (class_of(m->check)->needs_contact && !exact->star)
        return measure_error(m, "`%s` needs an exact solution with a star state; %s has none",
                             m->check->measure.choice->name, against->choice->name);
    return NULL;
}

static struct error *solve_exact(struct checks *checks, struct prepared_check *prepared)
{
    struct measurement *m = &prepared->measurement;
    const struct one_of *against = against_of(m);
    const bool needed = class_of(m->check)->needs_exact;
    if (!needed && !takes_expected(m))
        return NULL;
    if (!against->choice)
        return measure_error(m, "`%s` needs an exact solution: `exact` of the case, or `against`",
                             m->check->measure.choice->name);
    if (needed)
        TRY(check_field(m, against));
    m->exact = against->choice->thing;
    m->solved = solved_before(checks, prepared);
    if (m->solved)
        return NULL;
    if (checks->solved_bytes + m->exact->size > solved_limit)
        return measure_error(m,
                             "the exact solutions of the checks take more than %zu MB: give "
                             "`exact` to the case, once, in place of `against`",
                             solved_limit >> 20);
    checks->solved_bytes += m->exact->size;
    prepared->solved = memory_allocate(m->exact->size);
    if (!prepared->solved)
        return out_of_memory_for("an exact solution");
    m->solved = prepared->solved;
    return located(m, m->exact->solve(against->value, prepared->solved));
}

static struct error *prepare_check(struct checks *checks, struct prepared_check *prepared)
{
    const struct measurement *m = &prepared->measurement;
    const struct measure_class *class = class_of(m->check);
    struct unit field_unit;
    const char *own_unit;
    prepared->raw_unit = NULL;
    TRY(class->unit(m, &own_unit));
    if (!own_unit)
        return NULL;
    prepared->raw_unit = own_unit;
    if (m->check->between.count != 0 && m->check->between.count != 2)
        return measure_error(m, "`between` needs two positions");
    if (class->of_bodies && m->check->between.count)
        return measure_error(m, "`between` has no meaning for `%s`",
                             m->check->measure.choice->name);
    if (class->needs_exact) {
        const char *text;
        TRY(measure_field_unit(m, &text));
        TRY(unit_parse(text, &field_unit));
        TRY(located(m, check_same_dimension(m->check->measure.choice->name, "scale",
                                            &m->check->scale, field_unit.dimension)));
    } else if (given(&m->check->scale))
        return measure_error(m, "`scale` has no meaning for `%s`", m->check->measure.choice->name);
    return solve_exact(checks, prepared);
}

int check_mean_with(const struct prepared_check *prepared, int k)
{
    const struct measurement *m = &prepared->measurement;
    return named_map_find(&m->simulation->problem->input->checks, m->check->mean_with.names[k]);
}

/* Whether the check PREPARED has the unit of OTHER, which KEY names; that of one with a mistake
 * that was reported is not known. */
static struct error *match_unit(const struct prepared_check *prepared,
                                const struct prepared_check *other, const char *key)
{
    struct unit unit, unlike;
    if (!other->raw_unit)
        return NULL;
    TRY(unit_parse(prepared->raw_unit, &unit));
    TRY(unit_parse(other->raw_unit, &unlike));
    if (!dimension_equal(unit.dimension, unlike.dimension))
        return measure_error(&prepared->measurement,
                             "`%s`: the check \"%s\" is in %s, and this one in %s", key,
                             other->measurement.name, other->raw_unit, prepared->raw_unit);
    return NULL;
}

/* The unit of the result and its limits, when all checks know what they measure. */
static struct error *prepare_limits(const struct checks *checks, struct prepared_check *prepared)
{
    const struct measurement *m = &prepared->measurement;
    const int by = m->check->relative ? m->check->relative_check : -1;
    const char *divided_by = by < 0 ? prepared->raw_unit : checks->item[by].raw_unit;
    struct unit unit, other;
    if (!prepared->raw_unit || !divided_by) /* a mistake that was reported */
        return NULL;
    TRY(unit_parse(prepared->raw_unit, &unit));
    snprintf(prepared->unit, sizeof prepared->unit, "%s", prepared->raw_unit);
    if (m->check->minus_check >= 0)
        TRY(match_unit(prepared, &checks->item[m->check->minus_check], "minus"));
    for (int k = 0; k < m->check->mean_with.count; k++)
        TRY(match_unit(prepared, &checks->item[check_mean_with(prepared, k)], "mean_with"));
    if (m->check->relative) {
        TRY(unit_parse(divided_by, &other));
        unit.dimension = dimension_quotient(unit.dimension, other.dimension);
        dimension_text(unit.dimension, prepared->unit);
    }
    struct check_input check = *m->check;
    if (takes_expected(m)) {
        check.is = (struct quantity){class_of(m->check)->expected(m), unit.dimension};
        if (!isfinite(check.is.value))
            return measure_error(m, "%s does not give this value here: give `is`",
                                 against_of(m)->choice->name);
    }
    return located(m, check_find_limits(&check, m->check->measure.choice->name, unit.dimension,
                                        &prepared->wanted, &prepared->low, &prepared->high));
}

struct error *checks_prepare(const struct simulation *simulation,
                             const struct population *population, const struct probes *probes,
                             struct checks **result)
{
    const struct simulation_case *input = simulation->problem->input;
    struct checks *checks = memory_allocate(sizeof *checks);
    struct prepared_check *items =
        memory_allocate(((size_t)input->checks.count + 1) * sizeof *items);
    if (!checks || !items) {
        free(checks);
        free(items);
        return out_of_memory_for("checks");
    }
    *checks = (struct checks){input->checks.count, items, 0};
    struct error *error = NULL;
    for (int i = 0; i < checks->count; i++) {
        items[i].measurement = (struct measurement){
            .simulation = simulation,
            .population = simulation_seen(simulation, case_check(input, i)->of, population),
            .probes = probes,
            .check = case_check(input, i),
            .name = input->checks.names[i],
            .unplaced = error_is_full(error),
            .at_start = NAN};
        error = error_join(error, simulation_check_of(simulation, "checks", input->checks.names[i],
                                                      case_check(input, i)->of));
        error = error_join(error, prepare_check(checks, &items[i]));
    }
    for (int i = 0; i < checks->count; i++) {
        items[i].measurement.unplaced = error_is_full(error);
        error = error_join(error, prepare_limits(checks, &items[i]));
    }
    if (error) {
        checks_free(checks);
        checks = NULL;
    }
    *result = checks;
    return error;
}

void checks_free(struct checks *checks)
{
    for (int i = 0; checks && i < checks->count; i++)
        free(checks->item[i].solved);
    free(checks ? checks->item : NULL);
    free(checks);
}

static struct measurement measurement_at(const struct prepared_check *prepared,
                                         const struct check_moment *moment,
                                         const struct check_memory *memory)
{
    struct measurement measurement = prepared->measurement;
    measurement.simulation = moment->simulation;
    measurement.population =
        simulation_seen(moment->simulation, measurement.check->of, moment->population);
    measurement.start = moment->start;
    measurement.at_start = memory->start;
    return measurement;
}

static bool relative_to_start(const struct check_input *check)
{
    return check->relative && check->relative_check < 0;
}

struct error *checks_start(const struct checks *checks, const struct check_moment *moment)
{
    const struct ranks *ranks = moment->simulation->ranks;
    for (int i = 0; i < checks->count; i++) {
        struct check_memory *memory = &moment->memory[i];
        *memory = (struct check_memory){NAN, NAN, NAN, NOTHING_SAID};
        struct measurement m = measurement_at(&checks->item[i], moment, memory);
        const struct measure_class *class = class_of(m.check);
        if (relative_to_start(m.check))
            TRY(ranks_agree(ranks, class->measure(&m, &memory->start)));
        else if (class->start)
            TRY(ranks_agree(ranks, class->start(&m, &memory->start)));
    }
    return NULL;
}

static struct error *measure_now(const struct prepared_check *prepared,
                                 const struct check_moment *moment, struct check_memory *memory)
{
    struct measurement m = measurement_at(prepared, moment, memory);
    enum nothing why = NOTHING_SAID;
    m.why = &why;
    memory->time = moment->simulation->time;
    struct error *error = class_of(m.check)->measure(&m, &memory->measured);
    memory->why = why;
    return ranks_agree(m.simulation->ranks, error);
}

struct error *checks_watch(const struct checks *checks, const struct check_moment *moment)
{
    for (int i = 0; i < checks->count; i++)
        if (moment->simulation->time >= checks->item[i].measurement.check->at &&
            isnan(moment->memory[i].time))
            TRY(measure_now(&checks->item[i], moment, &moment->memory[i]));
    return NULL;
}

/* An error may grow, a distance from what is wanted too, and another value may change, by the
 * fraction or the quantity. While the record is being made, what is measured stands for what was
 * recorded. */
static void bound_change(const struct check_input *check, bool is_error,
                         struct check_result *result)
{
    const struct dimension none = {0, 0, 0, 0};
    const struct quantity *bound = &check->regression_bound;
    const double from = given(&check->recorded) ? check->recorded.value : result->measured;
    const bool fraction = dimension_equal(bound->dimension, none);
    const double wanted = given(&check->is) ? check->is.value : 0.0, error = fabs(from - wanted);
    const double change = fraction ? bound->value * error : bound->value;
    const double middle = given(&check->is) || is_error ? wanted : from;
    const double reach = given(&check->is) || is_error ? error + change : change;
    if (!is_error || given(&check->is))
        result->low = maximum(result->low, middle - reach);
    result->high = minimum(result->high, middle + reach);
}

void check_judge(const struct check_input *check, bool is_error, struct check_result *result)
{
    if (given(&check->regression_bound))
        bound_change(check, is_error, result);
    const bool finite = isfinite(result->measured);
    const bool within =
        finite && result->measured >= result->low && result->measured <= result->high;
    /* What measured nothing is not excused. */
    const bool expected = check->known_deviation && check->known_deviation_if > 0.0 && finite;
    result->source = text_copy(check->source);
    result->verdict = !check_has_limit(check) ? CHECK_MEASURED_ONLY
                      : within                ? (expected ? CHECK_PASSES_NOW : CHECK_PASSED)
                                              : (expected ? CHECK_KNOWN_DEVIATION : CHECK_FAILED);
    result->known_deviation =
        result->verdict == CHECK_KNOWN_DEVIATION ? text_copy(check->known_deviation) : NULL;
    result->regression_bound = given(&check->regression_bound);
    result->changes = check->regression_bound;
}

/* MEMORY holds what all checks measured. */
static struct error *judge(const struct prepared_check *prepared, const struct check_memory *memory,
                           int index, struct check_result *result)
{
    const struct check_input *check = prepared->measurement.check;
    result->name = text_copy(prepared->measurement.name);
    result->measure = check->measure.choice->name;
    snprintf(result->unit, sizeof result->unit, "%s", prepared->unit);
    result->wanted = prepared->wanted;
    result->low = prepared->low;
    result->high = prepared->high;
    result->time = memory[index].time;
    result->measured = memory[index].measured;
    if (check->minus)
        result->measured -= memory[check->minus_check].measured;
    for (int k = 0; k < check->mean_with.count; k++)
        result->measured += memory[check_mean_with(prepared, k)].measured;
    result->measured /= 1.0 + check->mean_with.count;
    if (relative_to_start(check))
        result->measured /= memory[index].start;
    else if (check->relative)
        result->measured /= memory[check->relative_check].measured;
    check_judge(check, class_of(check)->needs_exact, result);
    if (!isfinite(result->measured))
        result->nothing = check_reason(prepared, memory, index);
    if ((class_of(check)->needs_exact || takes_expected(&prepared->measurement)) && !result->source)
        result->source =
            text_format("exact solution %s", against_of(&prepared->measurement)->choice->name);
    return result->name ? NULL : out_of_memory_for("checks");
}

void check_results_count(struct check_results *results)
{
    const struct check_result *result = &results->item[results->count++];
    results->failed += check_failed(result);
    results->known_deviations += result->verdict == CHECK_KNOWN_DEVIATION;
    results->measured_only += result->verdict == CHECK_MEASURED_ONLY;
    results->regression_bounds += result->verdict == CHECK_PASSED && result->regression_bound;
}

const char *checks_unit(const struct checks *checks, int index) { return checks->item[index].unit; }

struct error *checks_evaluate(const struct checks *checks, const struct check_moment *moment,
                              struct check_results *results)
{
    *results = (struct check_results){0};
    results->item = memory_allocate(((size_t)checks->count + 1) * sizeof *results->item);
    if (!results->item)
        return out_of_memory_for("checks");
    for (int i = 0; i < checks->count; i++)
        if (isnan(checks->item[i].measurement.check->at))
            TRY(measure_now(&checks->item[i], moment, &moment->memory[i]));
    for (int i = 0; i < checks->count; i++) {
        TRY(judge(&checks->item[i], moment->memory, i, &results->item[i]));
        check_results_count(results);
    }
    return NULL;
}

void check_results_free(struct check_results *results)
{
    for (int i = 0; i < results->count; i++) {
        free(results->item[i].name);
        free(results->item[i].source);
        free(results->item[i].known_deviation);
        free(results->item[i].nothing);
    }
    free(results->item);
    *results = (struct check_results){0};
}
