/* Histograms of fields; see histograms.h. Sums are exact, so that a histogram is the same for any
 * order of the members. */
#include "measure/histograms.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/csv.h"
#include "base/file.h"
#include "base/memory.h"

/* A mistake at KEY of HISTOGRAM. */
static struct error *wrong(const struct histogram *histogram, const struct simulation *simulation,
                           const char *key, const char *text)
{
    char *path = text_format("histograms.%s.%s", histogram->name, key);
    struct error *error = path ? input_error(simulation->problem->input, "output", path, "%s", text)
                               : out_of_memory_for("a histogram");
    free(path);
    return error;
}

/* An end of the bins, which KEY gives, against the UNIT of the field. */
static struct error *check_end(const struct histogram *histogram,
                               const struct simulation *simulation, const char *key,
                               const struct quantity *end, const char *unit)
{
    struct unit parsed;
    char is[DIMENSION_TEXT], text[160];
    TRY(unit_parse(unit, &parsed));
    if (!isnan(end->value) && !dimension_equal(end->dimension, parsed.dimension)) {
        dimension_text(end->dimension, is);
        snprintf(text, sizeof text, "it is in %s, and the field in %s",
                 is[0] ? is : "plain numbers", unit[0] ? unit : "plain numbers");
        return wrong(histogram, simulation, key, text);
    }
    if (histogram->input->log && end->value <= 0.0)
        return wrong(histogram, simulation, key, "with `log` it must be above zero");
    return NULL;
}

static struct error *check_range(const struct histogram *histogram,
                                 const struct simulation *simulation)
{
    const struct histogram_range *range = &histogram->input->range;
    const char *unit = histogram->field->field[0].unit;
    TRY(check_end(histogram, simulation, "range.low", &range->low, unit));
    TRY(check_end(histogram, simulation, "range.high", &range->high, unit));
    return range->high.value <= range->low.value
               ? wrong(histogram, simulation, "range", "`high` must be above `low`")
               : NULL;
}

static struct error *find_bodies(struct histogram *histogram, const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    const struct name_list *of = &histogram->input->of;
    struct error *error = NULL;
    for (int b = 0; b < input->bodies.count; b++)
        histogram->counts[b] = of->count == 0;
    for (int k = 0; k < of->count; k++) {
        const int body = case_find_body(input, of->names[k]);
        char text[120];
        snprintf(text, sizeof text, "there is no body \"%.80s\"", of->names[k]);
        if (body >= 0)
            histogram->counts[body] = true;
        else
            error = error_join(error, wrong(histogram, simulation, "of", text));
    }
    return error;
}

static struct error *prepare(struct histogram *histogram, const struct simulation *simulation,
                             const struct population *population)
{
    char *names[] = {histogram->input->field};
    const struct name_list one = {1, names};
    histogram->field = memory_allocate(sizeof *histogram->field);
    histogram->bodies = simulation->problem->input->bodies.count;
    histogram->counts = memory_allocate((size_t)histogram->bodies + 1);
    if (!histogram->field || !histogram->counts)
        return out_of_memory_for("a histogram");
    struct error *told = find_bodies(histogram, simulation);
    struct error *error =
        fields_choose(population, &one, simulation->problem->dimension, histogram->field);
    if (error) {
        told = error_join(told, wrong(histogram, simulation, "field", error_message(error, 0)));
        error_free(error);
        return told;
    }
    if (histogram->field->count > 1)
        return error_join(
            told, wrong(histogram, simulation, "field", "it has several components: name one"));
    return error_join(told, check_range(histogram, simulation));
}

struct error *histograms_prepare(const struct simulation *simulation,
                                 const struct population *population, struct histograms *histograms)
{
    const struct simulation_case *input = simulation->problem->input;
    struct error *error = NULL;
    *histograms =
        (struct histograms){0, memory_allocate(((size_t)input->output.histograms.count + 1) *
                                               sizeof *histograms->item)};
    if (!histograms->item)
        return out_of_memory_for("a histogram");
    for (int i = 0; i < input->output.histograms.count; i++) {
        struct histogram *histogram = &histograms->item[histograms->count++];
        histogram->name = input->output.histograms.names[i];
        histogram->input = case_histogram(input, i);
        error = error_join(error, prepare(histogram, simulation, population));
    }
    return error;
}

void histograms_free(struct histograms *histograms)
{
    for (int i = 0; i < histograms->count; i++) {
        free(histograms->item[i].field);
        free(histograms->item[i].counts);
    }
    free(histograms->item);
    *histograms = (struct histograms){0, NULL};
}

/* Values and weights of the members that count; one that is not finite, or with `log` not above
 * zero, is in no bin. */
struct values {
    int64_t count;
    double *value, *weight;
    double ends[2];        /* where the bins begin and end, */
    double low, high;      /* and in the scale of the bins */
    struct exact_sum *sum; /* of each bin, of what is below the first, and of all */
};

static bool has_place(const struct histogram *histogram, double value)
{
    return isfinite(value) && (!histogram->input->log || value > 0.0);
}

static double scaled(const struct histogram *histogram, double value)
{
    return histogram->input->log ? log(value) : value;
}

static void take_values(const struct histogram *histogram, const struct population *p,
                        struct values *values)
{
    const struct chosen_field *field = &histogram->field->field[0];
    const int weight = histogram->input->weight;
    column_read_component(p, &p->column[field->column], field->component, 0, p->count,
                          values->value);
    for (int32_t i = 0; i < p->count; i++) {
        if (!population_has(p, i) || p->body[i] >= histogram->bodies ||
            !histogram->counts[p->body[i]])
            continue;
        values->value[values->count] = values->value[i];
        values->weight[values->count++] = weight == WEIGHT_MASS     ? p->mass[i]
                                          : weight == WEIGHT_VOLUME ? p->mass[i] / p->density[i]
                                                                    : 1.0;
    }
}

/* Collective. */
static void find_range(const struct histogram *histogram, const struct ranks *ranks,
                       struct values *values)
{
    const struct histogram_range *given = &histogram->input->range;
    double low = INFINITY, high = -INFINITY;
    for (int64_t i = 0; i < values->count; i++)
        if (has_place(histogram, values->value[i])) {
            low = minimum(low, values->value[i]);
            high = maximum(high, values->value[i]);
        }
    low = ranks_minimum(ranks, low);
    high = ranks_maximum(ranks, high);
    low = isnan(given->low.value) ? low : given->low.value;
    high = isnan(given->high.value) ? high : given->high.value;
    values->ends[0] = low;
    values->ends[1] = high;
    values->low = scaled(histogram, low);
    values->high = scaled(histogram, high);
}

/* Collective. What is on the upper end belongs to the last bin. */
static void sum_up(const struct histogram *histogram, const struct ranks *ranks,
                   struct values *values)
{
    const int64_t bins = histogram->input->bins;
    const double width = (values->high - values->low) / (double)bins;
    for (int64_t i = 0; i < values->count; i++) {
        exact_sum_add(&values->sum[bins + 1], values->weight[i]);
        if (!has_place(histogram, values->value[i]))
            continue;
        const double at = scaled(histogram, values->value[i]);
        const double bin = width > 0.0 ? minimum(floor((at - values->low) / width),
                                                 (double)bins - (at <= values->high))
                                       : 0.0;
        if (at < values->low)
            exact_sum_add(&values->sum[bins], values->weight[i]);
        else if (bin < (double)bins)
            exact_sum_add(&values->sum[(int64_t)bin], values->weight[i]);
    }
    ranks_sum_exact(ranks, values->sum, (int)bins + 2);
}

static double end_of_bin(const struct histogram *histogram, const struct values *values,
                         int64_t bin)
{
    if (bin == 0 || bin == histogram->input->bins)
        return values->ends[bin > 0];
    const double fraction = (double)bin / (double)histogram->input->bins;
    const double at = values->low + fraction * (values->high - values->low);
    return histogram->input->log ? exp(at) : at;
}

static void put_rows(FILE *file, const struct histogram *histogram,
                     const struct simulation *simulation, const struct values *values)
{
    const int weight = histogram->input->weight;
    const int64_t bins = histogram->input->bins;
    const int dimension = simulation->problem->dimension;
    static const char *const volumes[] = {"m", "m^2", "m^3"};
    const char *unit = weight == WEIGHT_MASS
                           ? ledger_unit(LEDGER_MASS, dimension, simulation->problem->geometry)
                       : weight == WEIGHT_VOLUME ? volumes[dimension - 1]
                                                 : "";
    char name[96];
    snprintf(name, sizeof name, "%.80s.low", histogram->field->field[0].name);
    csv_put_head(file, name, histogram->field->field[0].unit);
    snprintf(name, sizeof name, "%.80s.high", histogram->field->field[0].name);
    putc(',', file);
    csv_put_head(file, name, histogram->field->field[0].unit);
    putc(',', file);
    csv_put_head(file, weight_names[weight], unit);
    fputs(",fraction,cumulative\n", file);
    const double all = exact_sum_value(&values->sum[bins + 1]);
    double below = exact_sum_value(&values->sum[bins]);
    for (int64_t bin = 0; bin < bins && all > 0.0 && values->low <= values->high; bin++) {
        const double in = exact_sum_value(&values->sum[bin]);
        below += in;
        const double numbers[] = {end_of_bin(histogram, values, bin),
                                  end_of_bin(histogram, values, bin + 1), in, in / all,
                                  below / all};
        for (size_t k = 0; k < COUNT_OF(numbers); k++) {
            if (k)
                putc(',', file);
            csv_put_number(file, numbers[k]);
        }
        putc('\n', file);
    }
}

static struct error *write_one(const struct histogram *histogram,
                               const struct simulation *simulation,
                               const struct population *population, const char *path)
{
    const struct ranks *ranks = simulation->ranks;
    const size_t room = (size_t)population->count + 1;
    const size_t sums = (size_t)histogram->input->bins + 2;
    struct values values = {.value = memory_allocate(room * sizeof *values.value),
                            .weight = memory_allocate(room * sizeof *values.weight),
                            .sum = memory_allocate(sums * sizeof *values.sum)};
    const bool ready = values.value && values.weight && values.sum;
    struct error *error = ranks_agree(ranks, ready ? NULL : out_of_memory_for("a histogram"));
    FILE *file;
    if (!error) {
        take_values(histogram, population, &values);
        find_range(histogram, ranks, &values);
        sum_up(histogram, ranks, &values);
        if (ranks->rank == 0)
            error = file_begin(path, &file);
        if (!error && ranks->rank == 0) {
            put_rows(file, histogram, simulation, &values);
            error = file_end(path, file);
        }
    }
    free(values.value);
    free(values.weight);
    free(values.sum);
    return error;
}

struct error *histograms_write(const struct histograms *histograms,
                               const struct simulation *simulation,
                               const struct population *population, const char *folder,
                               int64_t number)
{
    if (histograms->count == 0)
        return NULL;
    char *own = path_join(folder, "histograms");
    struct error *error = !own                           ? out_of_memory_for("a histogram")
                          : simulation->ranks->rank == 0 ? folder_make(own)
                                                         : NULL;
    error = ranks_agree(simulation->ranks, error);
    for (int i = 0; i < histograms->count && !error; i++) {
        const struct histogram *histogram = &histograms->item[i];
        char *path = text_format("%s/%s-%06lld.csv", own, histogram->name, (long long)number);
        error = ranks_agree(simulation->ranks,
                            path ? file_check_folder(path) : out_of_memory_for("a histogram"));
        if (!error)
            error =
                ranks_agree(simulation->ranks, write_one(histogram, simulation, population, path));
        free(path);
    }
    free(own);
    return error;
}
