/* The table and the plots of a sweep; see sweep.h. The loop over its runs is verify's. */
#include "study/sweep.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/csv.h"
#include "base/file.h"
#include "base/memory.h"
#include "base/visible.h"
#include "page/page.h"
#include "picture/picture.h"

const char sweep_table_name[] = "sweep.csv";

const char *sweep_unit(const struct repetitions *sweep, int index, char *buffer)
{
    const struct dimension dimension = sweep->runs[0].sweep[index].quantity.dimension;
    for (int i = 0; i < sweep->count; i++) {
        const struct quantity *other = &sweep->runs[i].sweep[index].quantity;
        if (isnan(other->value) || !dimension_equal(other->dimension, dimension))
            return NULL;
    }
    return dimension_text(dimension, buffer);
}

const struct check_results *sweep_checks(const struct repetitions *sweep)
{
    for (int i = 0; i < sweep->count; i++)
        if (sweep->runs[i].result.checks.count)
            return &sweep->runs[i].result.checks;
    return &sweep->runs[0].result.checks;
}

void sweep_put_head(FILE *file, const struct repetitions *sweep, int index)
{
    char buffer[DIMENSION_TEXT];
    const char *unit = sweep_unit(sweep, index, buffer);
    csv_put_named_head(file, sweep->runs[0].sweep[index].key, "", unit ? unit : "");
}

void sweep_put_value(FILE *file, const struct repetitions *sweep, int run, int index)
{
    char buffer[DIMENSION_TEXT];
    const struct sweep_value *value = &sweep->runs[run].sweep[index];
    if (sweep_unit(sweep, index, buffer))
        csv_put_number(file, value->quantity.value);
    else
        csv_put_text(file, value->text);
}

static void put_row(FILE *file, const struct repetitions *sweep, int index)
{
    const struct verify_case *run = &sweep->runs[index];
    const struct check_results *checks = sweep_checks(sweep);
    const char *slash = strrchr(run->name, '/');
    csv_put_text(file, slash ? slash + 1 : run->name);
    for (int k = 0; k < run->sweep_values; k++) {
        fputc(',', file);
        sweep_put_value(file, sweep, index, k);
    }
    for (int k = 0; k < checks->count; k++) {
        const struct check_result *check = verify_find_check(run, checks->item[k].name);
        fputc(',', file);
        if (check && !isnan(check->measured))
            csv_put_number(file, check->measured);
        char *verdict = check ? check_verdict_text(check) : NULL;
        fputc(',', file);
        if (verdict && (check->known_deviation || check->nothing))
            csv_put_text(file, verdict);
        else if (verdict)
            fputs(verdict, file);
        free(verdict);
    }
    fprintf(file, ",%s\n", run->error ? "not finished" : run->passed ? "passed" : "FAILED");
}

static void put_table(FILE *file, const void *content)
{
    const struct repetitions *sweep = content;
    const struct check_results *checks = sweep_checks(sweep);
    fputs("run", file);
    for (int k = 0; k < sweep->runs[0].sweep_values; k++) {
        fputc(',', file);
        sweep_put_head(file, sweep, k);
    }
    for (int k = 0; k < checks->count; k++) {
        fputc(',', file);
        csv_put_named_head(file, checks->item[k].name, "", checks->item[k].unit);
        fputc(',', file);
        csv_put_named_head(file, checks->item[k].name, " verdict", "");
    }
    fputs(",verdict\n", file);
    for (int i = 0; i < sweep->count; i++)
        put_row(file, sweep, i);
}

/* A run as a plot sees it. */
struct dot {
    double x;
    const struct check_result *check;
    int run;
    int group;   /* the first run with the same swept values but for those of the axis */
    char *label; /* these values */
};

/* By group in the order of the runs, then by place. */
static int compare_dots(const void *a, const void *b)
{
    const struct dot *one = a, *other = b;
    if (one->group != other->group)
        return one->group - other->group;
    return (one->x > other->x) - (one->x < other->x);
}

/* The swept value on the axis: the first whose runs are no repetitions, if there is one. */
static int axis_of(const struct repetitions *repetitions)
{
    const struct verify_case *run = &repetitions->runs[0];
    const int repeated = repetitions_entry(repetitions);
    for (int k = 0; k < run->sweep_values; k++)
        if (run->sweep[k].entry != repeated)
            return k;
    return 0;
}

/* Whether the swept value K tells groups of dots apart. */
static bool is_of_group(const struct repetitions *repetitions, int k)
{
    const struct sweep_value *values = repetitions->runs[0].sweep;
    return values[k].entry != values[axis_of(repetitions)].entry &&
           values[k].entry != repetitions_entry(repetitions);
}

static int group_of(const struct repetitions *repetitions, int run)
{
    const struct verify_case *runs = repetitions->runs;
    for (int first = 0;; first++) {
        bool is_same = true;
        for (int k = 0; k < runs[run].sweep_values && is_same; k++)
            is_same = !is_of_group(repetitions, k) ||
                      strcmp(runs[first].sweep[k].text, runs[run].sweep[k].text) == 0;
        if (is_same)
            return first;
    }
}

/* "U0=500 m/s,pore=1 mm" */
static char *group_label(const struct repetitions *repetitions, int run)
{
    const struct sweep_value *values = repetitions->runs[run].sweep;
    char *text = text_copy("");
    for (int k = 0; k < repetitions->runs[run].sweep_values && text; k++) {
        if (!is_of_group(repetitions, k))
            continue;
        char *longer =
            text_format("%s%s%s=%s", text, text[0] ? "," : "", values[k].key, values[k].text);
        free(text);
        text = longer;
    }
    return text;
}

/* The runs in which the check NAME measured something; returns how many. */
static int take_dots(const struct repetitions *repetitions, const char *name, bool ordinal,
                     struct dot *dots)
{
    int taken = 0;
    const int axis = axis_of(repetitions);
    for (int i = 0; i < repetitions->count; i++) {
        const struct verify_case *run = &repetitions->runs[i];
        const struct check_result *check = verify_find_check(run, name);
        if (check && isfinite(check->measured))
            dots[taken++] = (struct dot){ordinal ? i + 1.0 : run->sweep[axis].quantity.value, check,
                                         i, group_of(repetitions, i), group_label(repetitions, i)};
    }
    qsort(dots, (size_t)taken, sizeof *dots, compare_dots);
    return taken;
}

/* Fills X and Y, of 3 COUNT + 1 places each, and the series: a point a run, and behind them the
 * limits of the check, where it has any and there is one group. Returns how many series. */
static int make_series(const struct dot *dots, int count, double *x, double *y,
                       struct series *series)
{
    int used = 0;
    bool one_group = dots[0].group == dots[count - 1].group, has_limits = false;
    for (int i = 0; i < count; i++) {
        double *low = y + count + i, *high = y + 2 * count + 1 + i;
        x[i] = x[count + i] = x[2 * count + 1 + i] = dots[i].x;
        y[i] = dots[i].check->measured;
        *low = dots[i].check->low;
        *high = dots[i].check->high;
        has_limits = has_limits || isfinite(*low) || isfinite(*high);
    }
    x[2 * count] = y[2 * count] = NAN; /* the line breaks between low and high */
    if (one_group && has_limits)
        series[used++] =
            (struct series){"limits of the check", 2 * count + 1, x + count, y + count, LINE_PLAIN};
    for (int first = 0, end; first < count; first = end) {
        for (end = first; end < count && dots[end].group == dots[first].group;)
            end++;
        series[used++] = (struct series){one_group ? "computed" : dots[first].label, end - first,
                                         x + first, y + first, LINE_NONE};
    }
    return used;
}

/* Fills X and Y, of 3 COUNT places each: at each place with several runs of a group a bar from end
 * to end of the confidence interval of their mean. */
static struct series make_bars(const struct repetitions *repetitions, const struct dot *dots,
                               int count, double *x, double *y)
{
    int used = 0;
    for (int i = 0; i < count; i++) {
        if (i > 0 && dots[i].group == dots[i - 1].group && dots[i].x == dots[i - 1].x)
            continue;
        const struct statistic statistic =
            repetitions_of_check(repetitions, dots[i].run, dots[i].check->name);
        if (statistic.count < 2)
            continue;
        for (int end = -1; end <= 1; end++) {
            x[used] = dots[i].x;
            y[used++] = statistic.mean + end * statistic.confidence;
        }
    }
    return (struct series){"mean and its 95 % confidence", used, x, y, LINE_BARS};
}

/* Draws what COUNT runs measured into PATH. */
static struct error *draw(const char *path, const char *x_name, const char *x_unit,
                          const struct repetitions *repetitions, const struct dot *dots, int count)
{
    size_t places = 6 * (size_t)count + 1;
    const bool has_bars = repetitions_entry(repetitions) >= 0;
    struct series *series = memory_allocate(((size_t)count + 2) * sizeof *series);
    double *x = memory_allocate(places * sizeof *x), *y = memory_allocate(places * sizeof *y);
    const char *name = dots[0].check->name;
    char *title = text_format("%s over %s", name, x_name);
    struct error *error = series && x && y && title ? NULL : out_of_memory();
    if (!error) {
        const int dots_end = 3 * count + 1;
        int used = make_series(dots, count, x, y, series);
        if (has_bars)
            series[used++] = make_bars(repetitions, dots, count, x + dots_end, y + dots_end);
        struct plot plot = {.title = title,
                            .x_name = x_name,
                            .x_unit = x_unit,
                            .y_name = name,
                            .y_unit = dots[0].check->unit,
                            .count = used,
                            .series = series};
        error = picture_plot(path, &plot);
    }
    free(title);
    free(y);
    free(x);
    free(series);
    return error;
}

/* The picture of the check NAME, where two runs measured something. Without a quantity on the first
 * axis the runs are counted. */
static struct error *draw_check(const char *folder, const struct repetitions *repetitions,
                                const char *name, struct dot *dots)
{
    char unit[DIMENSION_TEXT];
    const int axis = axis_of(repetitions);
    const char *x_unit = sweep_unit(repetitions, axis, unit);
    char *file = text_format("%s.png", name);
    if (file)
        text_make_file_name(file);
    char *path = file ? path_join(folder, file) : NULL;
    struct error *error = path ? NULL : out_of_memory();
    int taken = take_dots(repetitions, name, !x_unit, dots);
    if (!error && taken > 1)
        error = draw(path, x_unit ? repetitions->runs[0].sweep[axis].key : "run",
                     x_unit ? x_unit : "", repetitions, dots, taken);
    for (int i = 0; i < taken; i++)
        free(dots[i].label);
    free(path);
    free(file);
    return error;
}

static struct error *draw_checks(const char *folder, const struct repetitions *repetitions)
{
    const struct check_results *checks = sweep_checks(repetitions);
    struct dot *dots = memory_allocate((size_t)repetitions->count * sizeof *dots);
    struct error *error = dots ? folder_make(folder) : out_of_memory();
    for (int k = 0; k < checks->count && !error; k++)
        error = draw_check(folder, repetitions, checks->item[k].name, dots);
    free(dots);
    return error;
}

static struct error *write_fits(const char *folder, const struct check_results *fits)
{
    char *path = path_join(folder, "checks.csv");
    struct error *error = path ? check_results_write(fits, path) : out_of_memory();
    free(path);
    return error;
}

struct error *sweep_write(const char *folder, const struct repetitions *sweep,
                          const struct check_results *fits)
{
    if (sweep->count == 0)
        return NULL;
    TRY(folder_make(folder));
    TRY(file_write(folder, sweep_table_name, put_table, sweep));
    if (sweep->key)
        TRY(repetitions_write(sweep, folder));
    if (fits->count > 0)
        TRY(write_fits(folder, fits));
    char *pictures = path_join(folder, "pictures");
    struct error *error = pictures ? draw_checks(pictures, sweep) : out_of_memory();
    free(pictures);
    return error ? error : page_write(folder);
}
