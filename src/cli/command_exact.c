/* bolide exact: an exact solution by itself. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "case/library.h"
#include "cli/cli.h"
#include "exact/exact.h"
#include "output/report.h"

static struct error *read_time(const char *text, double *time)
{
    static const struct dimension seconds = {.time = 1};
    struct quantity quantity;
    *time = 0.0;
    if (!text)
        return NULL;
    TRY(error_context(expression_evaluate(text, NULL, &quantity), "--time"));
    if (!dimension_equal(quantity.dimension, seconds) || !(quantity.value > 0.0))
        return error_new(ERROR_INPUT, "--time: \"%s\" is not a time, such as 5us", text);
    *time = quantity.value;
    return NULL;
}

static void print_numbers(const struct exact_number *numbers, int count)
{
    char value[64];
    for (int i = 0; i < count; i++) {
        readable_digits(numbers[i].value, numbers[i].unit, 6, value, sizeof value);
        printf("%-36s %s\n", numbers[i].name, value);
    }
}

/* The places among the numbers, a fifth of their range wider on either side; from the centre of a
 * solution that has one to a fifth beyond. */
static bool profile_range(const struct exact_class *class, const struct exact_number *numbers,
                          int count, double *low, double *high)
{
    *low = class->contact ? INFINITY : 0.0;
    *high = -INFINITY;
    for (int i = 0; i < count; i++)
        if (!strcmp(numbers[i].unit, "m")) {
            *low = minimum(*low, numbers[i].value);
            *high = maximum(*high, numbers[i].value);
        }
    double margin = 0.2 * (*high - *low);
    *low -= class->contact ? margin : 0.0;
    *high += margin;
    return *low < *high;
}

static void print_profile(const struct exact_class *class, const void *solved, double time,
                          double low, double high, int64_t points)
{
    static const char plain[] = "x [m],density [kg/m^3],velocity [m/s],pressure [Pa],energy [J/kg],"
                                "stress.xx [Pa],deviator.xx [Pa]";
    const bool alone = class->thermal || class->known == EXACT_PRESSURE;
    if (alone)
        printf(class->thermal ? "x [m],temperature [K]\n" : "x [m],pressure [Pa]\n");
    else
        printf("%s%s\n", plain, class->burns ? ",temperature [K],burnt" : "");
    for (int64_t i = 0; i < points; i++) {
        double x = low + (high - low) * ((double)i + 0.5) / (double)points;
        enum exact_side side = exact_side_at(class, solved, x, time);
        struct exact_state s = class->sample(solved, side, x, time);
        const double state[] = {s.density, s.velocity, s.pressure,    s.energy,
                                s.stress,  s.deviator, s.temperature, s.burnt};
        const int columns = alone ? 1 : class->burns ? 8 : 6;
        printf("%.9g", x);
        for (int k = 0; k < columns; k++) {
            const double value = class->thermal ? s.temperature : alone ? s.pressure : state[k];
            if (isnan(value)) /* without a sign, as in every table */
                printf(",nan");
            else
                printf(",%.9g", value);
        }
        putchar('\n');
    }
}

static struct error *print_solution(const struct choice *choice, const void *values, double time,
                                    int64_t points)
{
    const struct exact_class *class = choice->thing;
    struct exact_number numbers[EXACT_NUMBERS];
    void *solved = memory_allocate(class->size);
    if (!solved)
        return out_of_memory();
    struct error *error = class->solve(values, solved);
    if (!error) {
        int count = class->numbers(solved, time, numbers);
        double low, high;
        if (!points)
            print_numbers(numbers, count);
        else if (class->known == EXACT_NO_FIELD)
            error = error_new(ERROR_INPUT, "%s has no profile: leave --points out", choice->name);
        else if (time > 0.0 && profile_range(class, numbers, count, &low, &high))
            print_profile(class, solved, time, low, high, points);
        else
            error = error_new(ERROR_INPUT, "a profile needs --time");
    }
    free(solved);
    return error;
}

/* Writes ` --set "left.density=... kg/m^3"` for every value of TABLE that has no default. */
static void write_wanted(FILE *out, const char *prefix, const struct parameter *table)
{
    for (const struct parameter *p = table; p && !PARAMETER_IS_END(p); p++) {
        char path[256];
        if (p->standard)
            continue;
        snprintf(path, sizeof path, "%s%s", prefix, p->key);
        if (p->kind == PARAMETER_TABLE) {
            snprintf(path, sizeof path, "%s%s.", prefix, p->key);
            long before = ftell(out);
            write_wanted(out, path, p->table);
            if (ftell(out) == before) /* each by itself is optional: the first stands for all */
                fprintf(out, " --set \"%s%s=...\"", path, p->table->key);
        } else
            fprintf(out, " --set \"%s=...%s%s\"", path, p->unit && p->unit[0] ? " " : "",
                    p->unit ? p->unit : "");
    }
}

static struct error *wants_values(const struct choice *choice)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return out_of_memory();
    write_wanted(out, "", choice->table);
    struct error *error =
        fclose(out) ? out_of_memory()
                    : error_new(ERROR_INPUT, "%s needs its values:%s", choice->name, text);
    error = error_join(error, error_new(ERROR_INPUT,
                                        "`bolide help %s` explains them; `bolide exact CASE` takes "
                                        "those of a case",
                                        choice->name));
    free(text);
    return error;
}

/* Gives VALUES the material of the library that they name at INDEX, if any. */
static struct error *take_material(const struct exact_class *class, void *values, int index)
{
    const char *key, *const name = class->material_name(values, index, &key);
    if (!name)
        return NULL;
    char *folder = share_folder("materials");
    const char *const folders[] = {folder};
    char *path = folder ? library_file(folders, 1, name) : NULL;
    struct material_input input;
    struct error *error = NULL;
    if (path) {
        error = library_read(path, &bolide_catalogue, &input);
        if (!error) {
            class->take_material(values, index, input.material);
            library_release(&input);
        }
    } else {
        char *text = library_unknown(folders, folder != NULL, name);
        error = error_new(ERROR_INPUT, "%s: %s", key, text ? text : "out of memory");
        free(text);
    }
    free(path);
    free(folder);
    return error;
}

static struct error *solve_choice(const struct choice *choice, const struct cli_options *options)
{
    double time;
    struct document *document;
    TRY(read_time(options->time, &time));
    void *values = memory_allocate(choice->size);
    if (!values)
        return out_of_memory();
    struct error *error = document_open_text("{}", choice->name, options->settings.text,
                                             options->settings.count, NULL, &document);
    if (!error) {
        error = document_read(document, choice->table, &bolide_catalogue, values);
        if (!error) {
            const struct exact_class *class = choice->thing;
            for (int k = 0; class->material_name && k < EXACT_MATERIALS && !error; k++)
                error = take_material(class, values, k);
            if (!error)
                error = print_solution(choice, values, time, options->points);
            parameters_release(choice->table, values);
        } else if (!options->settings.count) {
            error_free(error);
            error = wants_values(choice);
        }
        document_free(document);
    }
    free(values);
    return error;
}

/* The exact solution of the case GIVEN, at the end of its run if no time is given. */
static struct error *solve_case(const char *given, const struct cli_options *options)
{
    double time;
    char *path;
    struct simulation_case *input;
    TRY(read_time(options->time, &time));
    TRY(case_locate(given, &path));
    struct error *error = read_case(path, options, &input);
    free(path);
    if (error)
        return error;
    error = input->exact.choice
                ? print_solution(input->exact.choice, input->exact.value,
                                 options->time ? time : input->run.until, options->points)
                : input_error(input, "exact", NULL,
                              "the case has no exact solution; add one, such as "
                              "`exact: {impedance-match: {...}}`; `bolide help exact` lists them");
    case_free(input);
    return error;
}

/* A word that is a path, or what is there, is a case. */
static bool names_case(const char *word)
{
    size_t length = strlen(word);
    return strchr(word, '/') || (length > 5 && !strcmp(word + length - 5, ".yaml")) ||
           access(word, F_OK) == 0;
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
    struct error *error = choice             ? solve_choice(choice, options)
                          : names_case(name) ? solve_case(name, options)
                                             : unknown_solution(list, name);
    return error ? report_error(error) : EXIT_OK;
}
