/* convergence.html: what a reviewer wants of a convergence study, on one page. */
#include <stdlib.h>

#include "base/file.h"
#include "base/memory.h"
#include "page/internal.h"
#include "page/study.h"

static void put_header(FILE *file, const struct study *study)
{
    fputs("<header><h1>", file);
    page_text(file, study->title);
    fputs("</h1>\n<p class=\"lead\">Convergence over ", file);
    page_text(file, study->vary);
    fprintf(file, " · %d runs of %lld to %lld particles</p></header>\n<main>\n", study->runs,
            (long long)study->run[0].particles, (long long)study->run[study->runs - 1].particles);
}

static void put_verdict(FILE *file, const struct study *study)
{
    int count[STUDY_FAILED + 1] = {0};
    for (int k = 0; k < study->quantities; k++)
        count[study->quantity[k].verdict]++;
    int judged = study->quantities - count[STUDY_NOT_JUDGED];
    if (!judged)
        return;
    fprintf(file,
            "<section id=\"verdict\"><h2>Verdict</h2>\n<p class=\"verdict %s\"><strong>%s: %d of "
            "%d orders.</strong>",
            count[STUDY_FAILED]            ? "bad"
            : count[STUDY_KNOWN_DEVIATION] ? "warn"
                                           : "good",
            count[STUDY_FAILED] ? "Failed" : "Passed",
            count[count[STUDY_FAILED] ? STUDY_FAILED : STUDY_PASSED], judged);
    if (count[STUDY_KNOWN_DEVIATION])
        fprintf(file, " %d known deviation%s.", count[STUDY_KNOWN_DEVIATION],
                count[STUDY_KNOWN_DEVIATION] == 1 ? "" : "s");
    fputs("</p></section>\n", file);
}

/* The SIZE bytes of a PNG. */
static void put_plot(FILE *file, const char *bytes, size_t size)
{
    fputs("<section id=\"errors\" class=\"pictures\"><h2>Errors</h2>\n<figure><img "
          "alt=\"Relative errors over the resolution, both axes logarithmic, with slopes of "
          "first and second order; the numbers are in the table below",
          file);
    page_png(file, bytes, size);
    fputs("</figure>\n", file);
}

/* The label of a run's column: its resolution. */
static void put_label(FILE *file, const struct study *study, int run)
{
    page_quantity(file, study->run[run].resolution, "m");
}

static void put_heads(FILE *file, const struct study *study)
{
    fputs("<table class=\"cards\"><caption>Errors by resolution, and the order from the run "
          "before</caption>\n<thead><tr><th scope=\"col\">error of</th>",
          file);
    for (int i = 0; i < study->runs; i++) {
        fputs("<th scope=\"col\" class=\"num\"><a href=\"convergence/", file);
        page_text(file, study->run[i].name);
        fputs("/report.html\">", file);
        put_label(file, study, i);
        fputs("</a></th>", file);
    }
    fputs("<th scope=\"col\" class=\"num\">order</th><th scope=\"col\" "
          "class=\"num\">wanted</th></tr></thead>\n<tbody>\n",
          file);
}

static void begin_cell(FILE *file, const struct study *study, int run)
{
    fputs("<td class=\"num\" data-label=\"", file);
    put_label(file, study, run);
    fputs("\">", file);
}

static void put_effort(FILE *file, const struct study *study)
{
    fputs("<tr><th scope=\"row\">particles</th>", file);
    for (int i = 0; i < study->runs; i++) {
        begin_cell(file, study, i);
        fprintf(file, "%lld</td>", (long long)study->run[i].particles);
    }
    fputs("<td></td><td></td></tr>\n<tr><th scope=\"row\">time of computing</th>", file);
    for (int i = 0; i < study->runs; i++) {
        begin_cell(file, study, i);
        if (study->run[i].finished)
            page_quantity(file, study->run[i].seconds, "s");
        else
            fputs("not finished", file);
        fputs("</td>", file);
    }
    fputs("<td></td><td></td></tr>\n", file);
}

static void put_wanted(FILE *file, const struct study_quantity *quantity)
{
    static const char *const classes[] = {"", "good", "warn", "bad"};
    static const char *const marks[] = {"", "✓", "△", "✗"};
    fprintf(file, "<td class=\"num %s\" data-label=\"wanted\">", classes[quantity->verdict]);
    if (quantity->verdict != STUDY_NOT_JUDGED) {
        fprintf(file, "<span class=\"mark\">%s </span>", marks[quantity->verdict]);
        if (isfinite(quantity->low))
            fprintf(file, "at least %.4g ", quantity->low);
        if (isfinite(quantity->high))
            fprintf(file, "at most %.4g", quantity->high);
    }
    fputs("</td></tr>\n", file);
}

static void put_quantity(FILE *file, const struct study *study,
                         const struct study_quantity *quantity)
{
    fputs("<tr><th scope=\"row\">", file);
    page_text(file, quantity->name);
    if (quantity->kind == STUDY_ESTIMATE)
        fputs(" <span class=\"unit\">estimated</span>", file);
    fputs("</th>", file);
    for (int i = 0; i < study->runs; i++) {
        begin_cell(file, study, i);
        if (isfinite(quantity->error[i]))
            page_quantity(file, quantity->error[i], quantity->unit);
        if (isfinite(quantity->order[i]))
            fprintf(file, " <span class=\"unit\">(%.2f)</span>", quantity->order[i]);
        fputs("</td>", file);
    }
    fputs("<td class=\"num\" data-label=\"order\">", file);
    if (isfinite(quantity->fitted))
        fprintf(file, "%.2f", quantity->fitted);
    fputs("</td>", file);
    put_wanted(file, quantity);
}

static void put_errors(FILE *file, const struct study *study)
{
    put_heads(file, study);
    put_effort(file, study);
    for (int k = 0; k < study->quantities; k++)
        put_quantity(file, study, &study->quantity[k]);
    fputs("</tbody></table>\n", file);
    for (int k = 0; k < study->quantities; k++) {
        const struct study_quantity *quantity = &study->quantity[k];
        if (quantity->verdict == STUDY_NOT_JUDGED ||
            (quantity->verdict == STUDY_PASSED && !quantity->source))
            continue;
        fputs("<p class=\"note\">Order of ", file);
        page_text(file, quantity->name);
        fputs(": ", file);
        page_text(file, quantity->verdict_text);
        if (quantity->source) {
            fputs(". Source of the limit: ", file);
            page_text(file, quantity->source);
        }
        fputs("</p>\n", file);
    }
    fputs("</section>\n", file);
}

static void put_number_cell(FILE *file, const char *label, double value, const char *unit)
{
    fprintf(file, "<td class=\"num\" data-label=\"%s\">", label);
    if (isfinite(value))
        page_quantity(file, value, unit);
    fputs("</td>", file);
}

static void put_extrapolation(FILE *file, const struct study *study,
                              const struct study_quantity *quantity)
{
    const struct extrapolation *extrapolation = &quantity->extrapolation;
    const double finest = quantity->measured[study->runs - 1];
    fputs("<tr><th scope=\"row\">", file);
    page_text(file, quantity->name);
    fputs("</th>", file);
    for (int i = 0; i < study->runs; i++) {
        begin_cell(file, study, i);
        page_quantity(file, quantity->measured[i], quantity->unit);
        fputs("</td>", file);
    }
    put_number_cell(file, "extrapolated", extrapolation->limit, quantity->unit);
    put_number_cell(file, "order", extrapolation->order, "");
    put_number_cell(file, "index", extrapolation->index, quantity->unit);
    put_number_cell(file, "index, %", 100.0 * extrapolation->index / fabs(finest), "");
    fprintf(file, "<td data-label=\"approach\">%s</td></tr>\n",
            approach_name(extrapolation->approach));
}

static void put_extrapolations(FILE *file, const struct study *study)
{
    int values = 0;
    for (int k = 0; k < study->quantities; k++)
        values += study->quantity[k].kind != STUDY_NORM;
    if (!values)
        return;
    fputs(
        "<section id=\"values\"><h2>Values</h2>\n<table class=\"cards\"><caption>Values, and what "
        "the three finest runs tend to</caption>\n<thead><tr><th scope=\"col\">value</th>",
        file);
    for (int i = 0; i < study->runs; i++) {
        fputs("<th scope=\"col\" class=\"num\">", file);
        put_label(file, study, i);
        fputs("</th>", file);
    }
    fputs("<th scope=\"col\" class=\"num\">extrapolated</th><th scope=\"col\" "
          "class=\"num\">order</th><th scope=\"col\" class=\"num\">index</th><th scope=\"col\" "
          "class=\"num\">index, %</th><th scope=\"col\">approach</th></tr></thead>\n<tbody>\n",
          file);
    for (int k = 0; k < study->quantities; k++)
        if (study->quantity[k].kind != STUDY_NORM)
            put_extrapolation(file, study, &study->quantity[k]);
    fputs("</tbody></table>\n</section>\n", file);
}

static void put_words(FILE *file)
{
    fputs("<section id=\"how\"><h2>How these numbers are made</h2>\n<p>The error of a norm is the "
          "norm itself; that of a value with an exact one is its distance from it. The order "
          "between two runs of resolutions h₁ &gt; h₂ is ln(e₁/e₂)/ln(h₁/h₂); over all runs it is "
          "the slope of the line of least squares through ln e over ln h.</p>\n<p>Values are "
          "extrapolated from the three finest runs by f(h) = f₀ + C hᵖ (Richardson). The index is "
          "the grid convergence index of Roache, 1.25 |f₀ − f| of the finest run, and in per cent "
          "of f. An estimated error is the distance from f₀, and its order p of three runs each. "
          "Where changes go back and forth (oscillating) or grow (diverging) nothing is "
          "extrapolated. In the plot errors are divided by the exact or extrapolated value, or "
          "where that is zero by the error of the first run.</p></section>\n",
          file);
}

struct error *page_study(const char *folder, const struct study *study)
{
    struct page page = {.folder = folder};
    char *picture = path_join(folder, "convergence.png"), *bytes = NULL;
    char *path = path_join(folder, "convergence.html");
    size_t size;
    struct error *error =
        path && picture ? file_read(picture, &bytes, &size) : out_of_memory_for("a report");
    if (!error)
        error = file_begin(path, &page.file);
    if (!error) {
        page_head(&page, study->title);
        put_header(page.file, study);
        put_verdict(page.file, study);
        put_plot(page.file, bytes, size);
        put_errors(page.file, study);
        put_extrapolations(page.file, study);
        put_words(page.file);
        page_foot(&page, false);
        error = file_end(path, page.file);
    }
    free(bytes);
    free(path);
    free(picture);
    return error;
}
