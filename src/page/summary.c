/* What report.html takes from summary.csv and checks.csv: the verdict, what was computed, speed. */
#include <stdlib.h>
#include <string.h>

#include "page/internal.h"

/* The columns of summary.csv. */
enum summary_column { ABOUT, NAME, QUANTITY, VALUE, UNIT };

static bool is(const struct csv *summary, int64_t row, enum summary_column column, const char *text)
{
    return !text || !strcmp(csv_field(summary, row, (int)column), text);
}

/* The row of these words, from the row FROM on; -1 if there is none. NULL fits anything. */
static int64_t find_row(const struct csv *summary, int64_t from, const char *about,
                        const char *name, const char *quantity)
{
    for (int64_t row = from; row < summary->rows; row++)
        if (is(summary, row, ABOUT, about) && is(summary, row, NAME, name) &&
            is(summary, row, QUANTITY, quantity))
            return row;
    return -1;
}

const char *summary_value(const struct csv *summary, const char *about, const char *name,
                          const char *quantity)
{
    return csv_field(summary, find_row(summary, 0, about, name, quantity), VALUE);
}

static void put_row_value(const struct page *page, int64_t row)
{
    const char *text = csv_field(&page->summary, row, VALUE);
    double value = csv_number(&page->summary, row, VALUE);
    if (isnan(value) || is(&page->summary, row, UNIT, "text"))
        page_text(page->file, text);
    else
        page_quantity(page->file, value, csv_field(&page->summary, row, UNIT));
}

void summary_put(const struct page *page, const char *about, const char *name, const char *quantity)
{
    put_row_value(page, find_row(&page->summary, 0, about, name, quantity));
}

/* Writes a number as the cell of a table that becomes a list on a telephone. */
static void put_cell(const struct page *page, const char *about, const char *name,
                     const char *quantity, const char *label)
{
    fprintf(page->file, "<td class=\"num\" data-label=\"%s\">", label);
    summary_put(page, about, name, quantity);
    fputs("</td>", page->file);
}

/* The columns of checks.csv. */
struct check {
    const char *name, *measure, *unit, *verdict, *source, *known_deviation, *nothing;
    double measured, wanted, low, high;
    bool regression_bound;
};

static struct check read_check(const struct csv *csv, int64_t row)
{
    return (struct check){
        .name = csv_field(csv, row, csv_column(csv, "check")),
        .measure = csv_field(csv, row, csv_column(csv, "measure")),
        .unit = csv_field(csv, row, csv_column(csv, "unit")),
        .verdict = csv_field(csv, row, csv_column(csv, "verdict")),
        .source = csv_field(csv, row, csv_column(csv, "source")),
        .known_deviation = csv_field(csv, row, csv_column(csv, "known_deviation")),
        .nothing = csv_field(csv, row, csv_column(csv, "nothing")),
        .regression_bound =
            !strcmp(csv_field(csv, row, csv_column(csv, "regression_bound")), "yes"),
        .measured = csv_number(csv, row, csv_column(csv, "measured")),
        .wanted = csv_number(csv, row, csv_column(csv, "wanted")),
        .low = csv_number(csv, row, csv_column(csv, "low")),
        .high = csv_number(csv, row, csv_column(csv, "high")),
    };
}

static bool has_passed(const struct check *check) { return !strcmp(check->verdict, "passed"); }

static bool known_deviation(const struct check *check)
{
    return !strcmp(check->verdict, "known deviation");
}

static bool measured_only(const struct check *check)
{
    return !strcmp(check->verdict, "measured only");
}

static bool has_failed(const struct check *check)
{
    return !has_passed(check) && !known_deviation(check) && !measured_only(check);
}

/* True where the limits lie evenly about the wanted value. */
static bool is_symmetric(const struct check *check)
{
    double above = check->high - check->wanted, below = check->wanted - check->low;
    return isfinite(above) && fabs(above - below) <= 1e-6 * fabs(above);
}

static void put_allowed(FILE *file, const struct check *check)
{
    if (is_symmetric(check)) {
        page_quantity(file, check->wanted, check->unit);
        fputs(" ± ", file);
        page_quantity(file, check->high - check->wanted, check->unit);
    } else if (isfinite(check->low) && isfinite(check->high)) {
        page_quantity(file, check->low, check->unit);
        fputs(" to ", file);
        page_quantity(file, check->high, check->unit);
    } else if (isfinite(check->high)) {
        fputs("at most ", file);
        page_quantity(file, check->high, check->unit);
    } else if (isfinite(check->low)) {
        fputs("at least ", file);
        page_quantity(file, check->low, check->unit);
    }
}

static void put_check(FILE *file, const struct check *check)
{
    bool passed = has_passed(check), lacking = known_deviation(check);
    fprintf(file, "<tr class=\"%s\"><th scope=\"row\">",
            passed                 ? "good"
            : lacking              ? "warn"
            : measured_only(check) ? "neutral"
                                   : "bad");
    page_text(file, check->name);
    fputs(" <span class=\"unit\">", file);
    page_text(file, check->measure);
    fprintf(file, "</span></th><td data-label=\"verdict\"><span class=\"mark\">%s</span></td>",
            passed && check->regression_bound       ? "✓ regression bound"
            : passed                                ? "✓ passed"
            : lacking                               ? "△ known deviation"
            : measured_only(check)                  ? "measured only"
            : !strcmp(check->verdict, "passes now") ? "✗ passes now: remove known_deviation"
                                                    : "✗ failed");
    fputs("<td class=\"num\" data-label=\"measured\">", file);
    if (isnan(check->measured))
        fputs("nothing", file);
    else
        page_quantity(file, check->measured, check->unit);
    fputs("</td><td class=\"num\" data-label=\"allowed\">", file);
    put_allowed(file, check);
    fputs("</td><td data-label=\"source\">", file);
    page_text(file, check->source);
    if (lacking) {
        fprintf(file, "%sknown deviation: ", check->source[0] ? "<br>" : "");
        page_text(file, check->known_deviation);
    }
    if (check->nothing[0]) {
        fputs(check->source[0] ? "<br>" : "", file);
        page_text(file, check->nothing);
    }
    fputs("</td></tr>\n", file);
}

void page_checks(const struct page *page, const char *caption)
{
    fprintf(page->file, "<table class=\"cards\"><caption>%s</caption>\n", caption);
    fputs("<thead><tr><th scope=\"col\">check</th>"
          "<th scope=\"col\">verdict</th><th scope=\"col\" class=\"num\">measured</th><th "
          "scope=\"col\" class=\"num\">allowed</th><th scope=\"col\">source</th></tr></thead>\n"
          "<tbody>\n",
          page->file);
    for (int64_t row = 0; row < page->checks.rows; row++) {
        struct check check = read_check(&page->checks, row);
        put_check(page->file, &check);
    }
    fputs("</tbody></table>\n", page->file);
}

/* " star stress left, energy": the checks that are AMONG them. */
static void put_names(const struct page *page, bool (*among)(const struct check *))
{
    for (int64_t row = 0, told = 0; row < page->checks.rows; row++) {
        struct check check = read_check(&page->checks, row);
        if (!among(&check))
            continue;
        fputs(told++ ? ", " : " ", page->file);
        page_text(page->file, check.name);
    }
}

/* One of the run's warnings; the verdict is never told without them. */
static void put_warning(const struct page *page, int64_t row)
{
    const char *name = csv_field(&page->summary, row, NAME);
    const char *expected = summary_value(&page->summary, "warning", name, "expected");
    fprintf(page->file, "<p class=\"said warn\"><span class=\"mark\">△ %s:</span> ",
            *expected ? "expected warning" : "warning");
    page_text(page->file, csv_field(&page->summary, row, VALUE));
    if (*expected) {
        fputs("; expected: ", page->file);
        page_text(page->file, expected);
    }
    fputs("</p>\n", page->file);
}

static int64_t count_warnings(const struct page *page)
{
    int64_t count = 0;
    for (int64_t row = -1; (row = find_row(&page->summary, row + 1, "warning", NULL, "text")) >= 0;)
        count++;
    return count;
}

static void put_warnings(const struct page *page)
{
    for (int64_t row = -1; (row = find_row(&page->summary, row + 1, "warning", NULL, "text")) >= 0;)
        put_warning(page, row);
}

static void put_judged(const struct page *page)
{
    const int64_t warnings = count_warnings(page);
    int64_t failed = 0, lacking = 0, bounds = 0, unlimited = 0, count = page->checks.rows;
    for (int64_t row = 0; row < page->checks.rows; row++) {
        struct check check = read_check(&page->checks, row);
        failed += has_failed(&check);
        lacking += known_deviation(&check);
        unlimited += measured_only(&check);
        bounds += has_passed(&check) && check.regression_bound;
    }
    count -= unlimited;
    if (failed) {
        fprintf(page->file,
                "<p class=\"verdict bad\"><strong>Failed: %lld of %lld checks.</strong>",
                (long long)failed, (long long)count);
        put_names(page, has_failed);
    } else if (lacking || (warnings && count))
        fprintf(page->file,
                "<p class=\"verdict warn\"><strong>Passed: %lld of %lld checks.</strong>",
                (long long)(count - lacking), (long long)count);
    else if (count)
        fprintf(page->file, "<p class=\"verdict good\"><strong>Passed: %s%lld check%s.</strong>",
                count == 1 ? "" : "all ", (long long)count, count == 1 ? "" : "s");
    if (lacking) {
        fprintf(page->file, " <strong>%lld known deviation%s:</strong>", (long long)lacking,
                lacking == 1 ? "" : "s");
        put_names(page, known_deviation);
    }
    if (bounds)
        fprintf(page->file, " %lld of those that passed %s.", (long long)bounds,
                bounds == 1 ? "is a regression bound" : "are regression bounds");
    if (!count)
        fprintf(page->file,
                "<p class=\"verdict%s\"><strong>Finished.</strong> The case has no checks%s.",
                warnings ? " warn" : "", unlimited ? " with a limit" : "");
    if (unlimited)
        fprintf(page->file, " %lld value%s measured only.", (long long)unlimited,
                unlimited == 1 ? " was" : "s were");
    if (warnings)
        fprintf(page->file, " <strong>%lld warning%s, below.</strong>", (long long)warnings,
                warnings == 1 ? "" : "s");
    fputs("</p>\n", page->file);
}

/* "at step 400, t = 1.2 ns of 2 ns" */
static void put_moment(const struct page *page)
{
    fputs(" at step ", page->file);
    page_text(page->file, summary_value(&page->summary, "run", NULL, "steps"));
    fputs(", t = ", page->file);
    summary_put(page, "run", NULL, "time");
    fputs(" of ", page->file);
    summary_put(page, "run", NULL, "until");
}

static void put_errors(const struct page *page)
{
    for (int64_t row = -1; (row = find_row(&page->summary, row + 1, "run", NULL, "error")) >= 0;) {
        fputs("<p class=\"said\">", page->file);
        page_text(page->file, csv_field(&page->summary, row, VALUE));
        fputs("</p>\n", page->file);
    }
}

void page_verdict(const struct page *page)
{
    const char *status = summary_value(&page->summary, "run", NULL, "status");
    fputs("<section id=\"verdict\"><h2>Verdict</h2>\n", page->file);
    if (!strcmp(status, "finished"))
        put_judged(page);
    else if (!strcmp(status, "failed")) {
        fputs("<div class=\"verdict bad\"><p><strong>The run failed", page->file);
        put_moment(page);
        fputs(".</strong></p>\n", page->file);
        put_errors(page);
        fputs("</div>\n", page->file);
    } else if (!strcmp(status, "stopped")) {
        fputs("<p class=\"verdict warn\"><strong>Stopped early", page->file);
        put_moment(page);
        fputs(".</strong> Continue it with <code>bolide run … --resume</code>; the checks are "
              "judged at its end.</p>\n",
              page->file);
    } else if (!strcmp(status, "running"))
        fputs("<p class=\"verdict warn\"><strong>Not at its end:</strong> the run is still going "
              "on, or it was killed. What it has written so far is below.</p>\n",
              page->file);
    else
        fputs(
            "<p class=\"verdict warn\"><strong>Unknown:</strong> the folder has no summary of the "
            "run.</p>\n",
            page->file);
    put_warnings(page);
    if (page->checks.rows)
        page_checks(page, "Checks");
    fputs("</section>\n", page->file);
}

static void put_method(const struct page *page)
{
    const struct csv *summary = &page->summary;
    fputs("<h3>Method: ", page->file);
    summary_put(page, "run", NULL, "method");
    fputs("</h3>\n<dl class=\"parameters\">\n", page->file);
    for (int64_t row = -1; (row = find_row(summary, row + 1, "method", NULL, NULL)) >= 0;) {
        fputs("<div><dt>", page->file);
        page_text(page->file, csv_field(summary, row, QUANTITY));
        fputs("</dt><dd>", page->file);
        put_row_value(page, row);
        fputs("</dd></div>\n", page->file);
    }
    fputs("</dl>\n", page->file);
}

static void put_bodies(const struct page *page)
{
    const char *members =
        *summary_value(&page->summary, "run", NULL, "cells") ? "cells" : "particles";
    const struct {
        const char *quantity, *label;
    } columns[] = {{members, members},
                   {"mass", "mass"},
                   {"resolution", "resolution"},
                   {"density", "density"},
                   {"sound_long", "sound speed"},
                   {"sound_shear", "shear wave speed"}};
    const struct csv *summary = &page->summary;
    fputs("<table class=\"cards\"><caption>Bodies; density and sound speeds as at the "
          "start</caption>\n<thead><tr><th "
          "scope=\"col\">body</th><th scope=\"col\">material</th>",
          page->file);
    for (size_t i = 0; i < COUNT_OF(columns); i++)
        fprintf(page->file, "<th scope=\"col\" class=\"num\">%s</th>", columns[i].label);
    fputs("</tr></thead>\n<tbody>\n", page->file);
    for (int64_t row = -1; (row = find_row(summary, row + 1, "body", NULL, "material")) >= 0;) {
        const char *name = csv_field(summary, row, NAME);
        fputs("<tr><th scope=\"row\">", page->file);
        page_text(page->file, name);
        fputs("</th><td data-label=\"material\">", page->file);
        put_row_value(page, row);
        fputs("</td>", page->file);
        for (size_t i = 0; i < COUNT_OF(columns); i++)
            put_cell(page, "body", name, columns[i].quantity, columns[i].label);
        fputs("</tr>\n", page->file);
    }
    fputs("</tbody></table>\n", page->file);
}

/* What each load has delivered beside the integral of its pressure over the surface. */
static void put_loads(const struct page *page)
{
    const struct csv *summary = &page->summary;
    if (find_row(summary, 0, "load", NULL, "apart") < 0)
        return;
    fputs(
        "<table class=\"cards\"><caption>Loads: impulse delivered, and expected from the pressure "
        "on the surface</caption>\n<tbody>\n",
        page->file);
    for (int64_t row = -1; (row = find_row(summary, row + 1, "load", NULL, NULL)) >= 0;) {
        fputs("<tr><th scope=\"row\">", page->file);
        page_text(page->file, csv_field(summary, row, NAME));
        fputs("</th><td data-label=\"quantity\">", page->file);
        page_text(page->file, csv_field(summary, row, QUANTITY));
        fputs("</td><td class=\"num\" data-label=\"value\">", page->file);
        put_row_value(page, row);
        fputs("</td></tr>\n", page->file);
    }
    fputs("</tbody></table>\n", page->file);
}

/* The rows of material NAME below "MODEL.": "density 2.7 g/cm³, yield 400 MPa". */
static void put_model(const struct page *page, const char *name, const char *model)
{
    size_t length = strlen(model);
    bool begun = false;
    for (int64_t row = -1;
         (row = find_row(&page->summary, row + 1, "material", name, NULL)) >= 0;) {
        const char *quantity = csv_field(&page->summary, row, QUANTITY);
        if (strncmp(quantity, model, length) != 0 || quantity[length] != '.')
            continue;
        fputs(begun ? ", " : "", page->file);
        page_text(page->file, quantity + length + 1);
        fputc(' ', page->file);
        put_row_value(page, row);
        begun = true;
    }
}

/* One row for each model of each material. */
static void put_materials(const struct page *page)
{
    const struct csv *summary = &page->summary;
    fputs("<table class=\"cards\"><caption>Materials</caption>\n<thead><tr><th "
          "scope=\"col\">material</th><th scope=\"col\">model</th><th scope=\"col\">kind</th><th "
          "scope=\"col\">parameters</th></tr></thead>\n<tbody>\n",
          page->file);
    for (int64_t row = -1; (row = find_row(summary, row + 1, "material", NULL, NULL)) >= 0;) {
        const char *name = csv_field(summary, row, NAME);
        const char *model = csv_field(summary, row, QUANTITY);
        if (strchr(model, '.'))
            continue;
        fputs("<tr><th scope=\"row\">", page->file);
        page_text(page->file, name);
        fputs("</th><td data-label=\"model\">", page->file);
        page_text(page->file, model);
        fputs("</td><td data-label=\"kind\">", page->file);
        put_row_value(page, row);
        fputs("</td><td data-label=\"parameters\">", page->file);
        put_model(page, name, model);
        fputs("</td></tr>\n", page->file);
    }
    fputs("</tbody></table>\n", page->file);
}

void page_about(const struct page *page)
{
    if (!page->summary.rows)
        return;
    fputs("<section id=\"about\"><h2>What was computed</h2>\n", page->file);
    put_bodies(page);
    put_loads(page);
    put_materials(page);
    put_method(page);
    fputs("</section>\n", page->file);
}

static void put_entry(const struct page *page, const char *quantity, const char *label)
{
    if (!*summary_value(&page->summary, "run", NULL, quantity))
        return;
    fprintf(page->file, "<div><dt>%s</dt><dd>", label);
    summary_put(page, "run", NULL, quantity);
    fputs("</dd></div>\n", page->file);
}

/* Where the time went, with bars. */
static void put_phases(const struct page *page)
{
    const struct csv *summary = &page->summary;
    double all = strtod(summary_value(summary, "run", NULL, "seconds"), NULL);
    if (find_row(summary, 0, "phase", NULL, "seconds") < 0)
        return;
    fputs("<table class=\"phases\"><caption>Where the time went</caption>\n<thead><tr><th "
          "scope=\"col\">phase</th><th scope=\"col\" class=\"num\">time</th><th scope=\"col\" "
          "colspan=\"2\">share</th></tr></thead>\n<tbody>\n",
          page->file);
    for (int64_t row = -1; (row = find_row(summary, row + 1, "phase", NULL, "seconds")) >= 0;) {
        double share = 100.0 * csv_number(summary, row, VALUE) / all;
        fputs("<tr><th scope=\"row\">", page->file);
        page_text(page->file, csv_field(summary, row, NAME));
        fputs("</th><td class=\"num\">", page->file);
        put_row_value(page, row);
        if (share >= 0.0 && share <= 100.0)
            fprintf(page->file,
                    "</td><td class=\"num\">%.1f %%</td><td class=\"bar\"><span "
                    "style=\"width:%.1f%%\"></span>",
                    share, share);
        else
            fputs("</td><td></td><td>", page->file);
        fputs("</td></tr>\n", page->file);
    }
    fputs("</tbody></table>\n", page->file);
}

void page_speed(const struct page *page)
{
    if (!page->summary.rows)
        return;
    fputs("<section id=\"speed\"><h2>Speed</h2>\n<dl class=\"parameters\">\n", page->file);
    put_entry(page, "steps", "steps");
    put_entry(page, "seconds", "wall clock");
    put_entry(page, "updates_per_second", "particle updates a second");
    put_entry(page, "threads", "threads");
    put_entry(page, "ended", "ended");
    put_entry(page, "hash", "hash of the last state");
    fputs("</dl>\n", page->file);
    put_phases(page);
    fputs("</section>\n", page->file);
}
