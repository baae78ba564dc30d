/* The tables and the plot of a convergence study; see study.h. */
#include "page/study.h"

#include <stdlib.h>
#include <string.h>

#include "base/csv.h"
#include "base/file.h"
#include "base/memory.h"
#include "page/internal.h"
#include "picture/picture.h"

static void put_runs(FILE *file, const void *content)
{
    const struct study *study = content;
    fputs("run,resolution [m],particles,seconds [s]", file);
    for (int k = 0; k < study->quantities; k++) {
        const struct study_quantity *quantity = &study->quantity[k];
        if (quantity->kind != STUDY_NORM) {
            fputc(',', file);
            csv_put_named_head(file, quantity->name, "", quantity->unit);
        }
        fputc(',', file);
        csv_put_named_head(file, quantity->name, " error", quantity->unit);
        fputc(',', file);
        csv_put_named_head(file, quantity->name, " order", "");
    }
    fputc('\n', file);
    for (int i = 0; i < study->runs; i++) {
        const struct study_run *run = &study->run[i];
        csv_put_text(file, run->name);
        csv_add_finite(file, run->resolution);
        fprintf(file, ",%lld", (long long)run->particles);
        csv_add_finite(file, run->seconds);
        for (int k = 0; k < study->quantities; k++) {
            const struct study_quantity *quantity = &study->quantity[k];
            if (quantity->kind != STUDY_NORM)
                csv_add_finite(file, quantity->measured[i]);
            csv_add_finite(file, quantity->error[i]);
            csv_add_finite(file, quantity->order[i]);
        }
        fputc('\n', file);
    }
}

static void put_orders(FILE *file, const void *content)
{
    const struct study *study = content;
    static const char *const kinds[] = {"norm", "exact value", "extrapolated value"};
    fputs("quantity,unit,error from,exact,order,approach,extrapolated,grid convergence index,"
          "at least,at most,verdict,source\n",
          file);
    for (int k = 0; k < study->quantities; k++) {
        const struct study_quantity *quantity = &study->quantity[k];
        const struct extrapolation *extrapolation = &quantity->extrapolation;
        csv_put_text(file, quantity->name);
        fprintf(file, ",%s,%s", quantity->unit, kinds[quantity->kind]);
        csv_add_finite(file, quantity->exact);
        csv_add_finite(file, quantity->fitted);
        fprintf(file, ",%s",
                quantity->kind == STUDY_NORM ? "" : approach_name(extrapolation->approach));
        csv_add_finite(file, extrapolation->limit);
        csv_add_finite(file, extrapolation->index);
        csv_add_finite(file, quantity->low);
        csv_add_finite(file, quantity->high);
        fputc(',', file);
        if (quantity->verdict_text)
            csv_put_text(file, quantity->verdict_text);
        fputc(',', file);
        if (quantity->source)
            csv_put_text(file, quantity->source);
        fputc('\n', file);
    }
}

double study_scale(const struct study *study, const struct study_quantity *quantity)
{
    double scale = quantity->kind == STUDY_NORM       ? 1.0
                   : quantity->kind == STUDY_DISTANCE ? fabs(quantity->exact)
                                                      : fabs(quantity->extrapolation.limit);
    for (int i = 0; i < study->runs && !(scale > 0.0); i++)
        scale = quantity->error[i];
    return scale;
}

/* The relative errors of each quantity as a line; returns the smallest. X has a place a run, Y one
 * a run and quantity. */
static double fill_errors(const struct study *study, double *x, double *y, struct series *series)
{
    double lowest = INFINITY;
    for (int i = 0; i < study->runs; i++)
        x[i] = study->run[i].resolution;
    for (int k = 0; k < study->quantities; k++) {
        const struct study_quantity *quantity = &study->quantity[k];
        double scale = study_scale(study, quantity);
        for (int i = 0; i < study->runs; i++) {
            y[i] = quantity->error[i] / scale;
            if (y[i] > 0.0)
                lowest = minimum(lowest, y[i]);
        }
        series[k] = (struct series){quantity->name, study->runs, x, y, LINE_MARKED};
        y += study->runs;
    }
    return lowest;
}

/* Slopes of first and second order from half of LOWEST at the finest run on. X and Y have four
 * places. */
static void fill_slopes(const struct study *study, double lowest, double *x, double *y,
                        struct series *series)
{
    const double coarse = study->run[0].resolution, fine = study->run[study->runs - 1].resolution;
    for (int i = 0; i < 4; i++) {
        const int order = 1 + i / 2;
        x[i] = i % 2 ? coarse : fine;
        y[i] = 0.5 * lowest * pow(x[i] / fine, order);
    }
    series[0] = (struct series){"orders 1 and 2", 2, x, y, LINE_FAINT};
    series[1] = (struct series){NULL, 2, x + 2, y + 2, LINE_FAINT};
}

static struct error *draw(const char *path, const struct study *study)
{
    const size_t runs = (size_t)study->runs, points = runs * (size_t)study->quantities;
    double *x = memory_allocate((runs + 4) * sizeof *x);
    double *y = memory_allocate((points + 4) * sizeof *y);
    struct series *series = memory_allocate((size_t)(study->quantities + 2) * sizeof *series);
    struct error *error = x && y && series ? NULL : out_of_memory_for("a convergence study");
    if (!error) {
        double lowest = fill_errors(study, x, y, series);
        fill_slopes(study, lowest, x + runs, y + points, series + study->quantities);
        struct plot plot = {.title = study->title,
                            .x_name = "resolution",
                            .x_unit = "m",
                            .y_name = "relative error",
                            .y_unit = "",
                            .count = study->quantities + 2,
                            .series = series,
                            .log_x = true,
                            .log_y = true};
        error = picture_plot(path, &plot);
    }
    free(series);
    free(y);
    free(x);
    return error;
}

struct error *study_write(const char *folder, const struct study *study)
{
    TRY(folder_make(folder));
    TRY(file_write(folder, "convergence.csv", put_runs, study));
    TRY(file_write(folder, "convergence-orders.csv", put_orders, study));
    char *path = path_join(folder, "convergence.png");
    struct error *error = path ? draw(path, study) : out_of_memory_for("a convergence study");
    free(path);
    return error ? error : page_study(folder, study);
}

void study_free(struct study *study)
{
    for (int i = 0; i < study->runs && study->run; i++)
        free(study->run[i].name);
    for (int k = 0; k < study->quantities && study->quantity; k++) {
        struct study_quantity *quantity = &study->quantity[k];
        free(quantity->name);
        free(quantity->measured);
        free(quantity->error);
        free(quantity->order);
        free(quantity->source);
        free(quantity->verdict_text);
    }
    free(study->run);
    free(study->quantity);
    free(study->title);
    free(study->vary);
    *study = (struct study){0};
}
