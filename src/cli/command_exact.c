/* bolide exact: an exact solution by itself. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "cli/cli.h"
#include "exact/exact.h"

static struct error *read_time(const char *text, double *time)
{
    static const struct dimension seconds = {.time = 1};
    struct quantity quantity;
    *time = 0.0;
    if (!text)
        return NULL;
    TRY(error_context(expression_evaluate(text, NULL, 0, &quantity), "--time"));
    if (!dimension_equal(quantity.dimension, seconds) || !(quantity.value > 0.0))
        return error_new(ERROR_INPUT, "--time: \"%s\" is no time, such as 5us", text);
    *time = quantity.value;
    return NULL;
}

static void print_numbers(const struct exact_number *numbers, int count)
{
    for (int i = 0; i < count; i++)
        printf("%-36s %.12g%s%s\n", numbers[i].name, numbers[i].value,
               numbers[i].unit[0] ? " " : "", numbers[i].unit);
}

/* The places among the numbers, a fifth of their range wider on either side. */
static bool profile_range(const struct exact_number *numbers, int count, double *low, double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    for (int i = 0; i < count; i++)
        if (!strcmp(numbers[i].unit, "m")) {
            *low = minimum(*low, numbers[i].value);
            *high = maximum(*high, numbers[i].value);
        }
    double margin = 0.2 * (*high - *low);
    *low -= margin;
    *high += margin;
    return *low < *high;
}

static void print_profile(const struct exact_class *class, const void *solved, double time,
                          double low, double high, int64_t points)
{
    double contact = class->contact(solved, time);
    printf("x [m],density [kg/m^3],velocity [m/s],pressure [Pa],energy [J/kg],stress.xx [Pa],"
           "deviator.xx [Pa]\n");
    for (int64_t i = 0; i < points; i++) {
        double x = low + (high - low) * ((double)i + 0.5) / (double)points;
        struct exact_state s = class->sample(solved, x < contact ? SIDE_LEFT : SIDE_RIGHT, x, time);
        printf("%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", x, s.density, s.velocity, s.pressure,
               s.energy, s.stress, s.deviator);
    }
}

static struct error *print_solution(const struct choice *choice, const void *values, double time,
                                    int64_t points)
{
    const struct exact_class *class = choice->thing;
    struct exact_number numbers[EXACT_NUMBERS];
    void *solved = memory_allocate(class->size);
    if (!solved)
        return error_new(ERROR_SYSTEM, "out of memory");
    struct error *error = class->solve(values, solved);
    if (!error) {
        int count = class->numbers(solved, time, numbers);
        double low, high;
        if (!points)
            print_numbers(numbers, count);
        else if (time > 0.0 && profile_range(numbers, count, &low, &high))
            print_profile(class, solved, time, low, high, points);
        else
            error = error_new(ERROR_INPUT, "a profile wants --time");
    }
    free(solved);
    return error;
}

static struct error *solve_choice(const struct choice *choice, const struct cli_options *options)
{
    double time;
    struct document *document;
    TRY(read_time(options->time, &time));
    void *values = memory_allocate(choice->size);
    if (!values)
        return error_new(ERROR_SYSTEM, "out of memory");
    struct error *error = document_open_text("{}", choice->name, options->settings.text,
                                             options->settings.count, NULL, &document);
    if (!error) {
        error = document_read(document, choice->table, &bolide_catalogue, values);
        if (!error) {
            error = print_solution(choice, values, time, options->points);
            parameters_release(choice->table, values);
        }
        document_free(document);
    }
    free(values);
    return error;
}

static struct error *unknown_solution(const struct choice_list *list, const char *word)
{
    const char *names[64];
    int count = 0;
    for (; count < list->count && count < (int)COUNT_OF(names); count++)
        names[count] = list->choices[count].name;
    const char *nearest = nearest_name(word, names, count);
    return nearest ? error_new(ERROR_INPUT, "no exact solution \"%s\" (did you mean \"%s\"?)", word,
                               nearest)
                   : error_new(ERROR_INPUT, "no exact solution \"%s\"; `bolide exact` lists them",
                               word);
}

int command_exact(const struct cli_options *options)
{
    const struct choice_list *list = catalogue_list(&bolide_catalogue, "exact");
    if (!options->names.count) {
        for (int i = 0; i < list->count; i++)
            printf("%-28s %s\n", list->choices[i].name, list->choices[i].help);
        return EXIT_OK;
    }
    const char *name = options->names.text[0];
    const struct choice *choice = catalogue_find(&bolide_catalogue, "exact", name);
    struct error *error = choice ? solve_choice(choice, options) : unknown_solution(list, name);
    return error ? report_error(error) : EXIT_OK;
}
