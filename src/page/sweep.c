/* The report of a sweep: its table, each run with a link to its own report. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "page/internal.h"

/* The head of a column in parts: `pressure [Pa]`. */
struct head {
    char name[160], unit[48];
};

static struct head head_of(const struct csv *table, int column)
{
    struct head head = {"", ""};
    const char *text = csv_head(table, column), *bracket = strrchr(text, '[');
    snprintf(head.name, sizeof head.name, "%s", text);
    if (bracket > text + 1 && text[strlen(text) - 1] == ']') {
        snprintf(head.unit, sizeof head.unit, "%.*s", (int)strcspn(bracket + 1, "]"), bracket + 1);
        if ((size_t)(bracket - text) <= sizeof head.name)
            head.name[bracket - text - 1] = '\0';
    }
    return head;
}

/* Whether COLUMN judges the check of the column before it. */
static bool is_verdict(const struct csv *table, int column)
{
    static const char ending[] = " verdict";
    const char *text = csv_head(table, column);
    const size_t length = strlen(text), size = strlen(ending);
    return length > size && !strcmp(text + length - size, ending);
}

static bool begins(const char *text, const char *with)
{
    return !strncmp(text, with, strlen(with));
}

static void put_cell(const struct page *page, int64_t row, int column)
{
    const struct csv *table = &page->sweep;
    const struct head head = head_of(table, column);
    const double value = csv_number(table, row, column);
    const bool judged = is_verdict(table, column + 1);
    const char *verdict = judged ? csv_field(table, row, column + 1) : "";
    const bool failed = begins(verdict, "FAILED"), lacking = begins(verdict, "known deviation");
    fprintf(page->file, "<td class=\"num%s\" data-label=\"",
            failed    ? " bad"
            : lacking ? " warn"
                      : "");
    page_text(page->file, head.name);
    fputs("\">", page->file);
    if (failed || lacking)
        fprintf(page->file, "<span class=\"mark\">%s </span>", failed ? "✗" : "△");
    if (isnan(value))
        page_text(page->file, csv_field(table, row, column));
    else
        page_quantity(page->file, value, head.unit);
    fputs("</td>", page->file);
}

/* Whether the run in ROW came to this VERDICT. */
static bool came_to(const struct csv *table, int64_t row, const char *verdict)
{
    return !strcmp(csv_field(table, row, table->columns - 1), verdict);
}

static int64_t count_of(const struct csv *table, const char *verdict)
{
    int64_t count = 0;
    for (int64_t row = 0; row < table->rows; row++)
        count += came_to(table, row, verdict);
    return count;
}

static void put_row(const struct page *page, int64_t row)
{
    const struct csv *table = &page->sweep;
    const bool passed = came_to(table, row, "passed");
    fputs("<tr><th scope=\"row\"><a href=\"", page->file);
    page_text(page->file, csv_field(table, row, 0));
    fputs("/report.html\">", page->file);
    page_text(page->file, csv_field(table, row, 0));
    fputs("</a></th>", page->file);
    for (int column = 1; column < table->columns - 1; column++)
        if (!is_verdict(table, column))
            put_cell(page, row, column);
    fprintf(page->file, "<td class=\"%s\" data-label=\"verdict\"><span class=\"mark\">%s ",
            passed ? "good" : "bad", passed ? "✓" : "✗");
    page_text(page->file, csv_field(table, row, table->columns - 1));
    fputs("</span></td></tr>\n", page->file);
}

static void put_table(const struct page *page)
{
    const struct csv *table = &page->sweep;
    fputs("<table class=\"cards\"><caption>Runs</caption>\n<thead><tr><th scope=\"col\">run</th>",
          page->file);
    for (int column = 1; column < table->columns - 1; column++) {
        if (is_verdict(table, column))
            continue;
        fputs("<th scope=\"col\" class=\"num\">", page->file);
        page_text(page->file, head_of(table, column).name);
        fputs("</th>", page->file);
    }
    fputs("<th scope=\"col\">verdict</th></tr></thead>\n<tbody>\n", page->file);
    for (int64_t row = 0; row < table->rows; row++)
        put_row(page, row);
    fputs("</tbody></table>\n", page->file);
}

/* Whether COLUMN of the statistics is a mean, which its deviation and confidence follow. */
static bool is_mean(const struct csv *table, int column)
{
    static const char ending[] = " mean";
    const struct head head = head_of(table, column);
    const size_t length = strlen(head.name), size = strlen(ending);
    return column + 2 < table->columns && length > size &&
           !strcmp(head.name + length - size, ending);
}

static void put_statistic(const struct page *page, int64_t row, int column, bool is_with_confidence)
{
    const struct csv *table = &page->statistics;
    const struct head head = head_of(table, column);
    const double value = csv_number(table, row, column);
    fputs("<td class=\"num\" data-label=\"", page->file);
    page_text(page->file, head.name);
    fputs("\">", page->file);
    if (isnan(value))
        page_text(page->file, csv_field(table, row, column));
    else
        page_quantity(page->file, value, head.unit);
    const double confidence = is_with_confidence ? csv_number(table, row, column + 2) : NAN;
    if (!isnan(confidence)) {
        fputs(" ± ", page->file);
        page_quantity(page->file, confidence, head.unit);
    }
    fputs("</td>", page->file);
}

/* Means of the runs that are repetitions, with half the width of their confidence interval. */
static void put_statistics(const struct page *page)
{
    const struct csv *table = &page->statistics;
    if (table->rows == 0)
        return;
    fputs("<table class=\"cards\"><caption>Means of repetitions ± half the width of the 95 % "
          "confidence interval</caption>\n<thead><tr>",
          page->file);
    for (int column = 0; column < table->columns; column += is_mean(table, column) ? 3 : 1) {
        fputs("<th scope=\"col\" class=\"num\">", page->file);
        page_text(page->file, head_of(table, column).name);
        fputs("</th>", page->file);
    }
    fputs("</tr></thead>\n<tbody>\n", page->file);
    for (int64_t row = 0; row < table->rows; row++) {
        fputs("<tr>", page->file);
        for (int column = 0; column < table->columns; column += is_mean(table, column) ? 3 : 1)
            put_statistic(page, row, column, is_mean(table, column));
        fputs("</tr>\n", page->file);
    }
    fputs("</tbody></table>\n", page->file);
}

/* The reasons of known deviations: those of the first run that has them. */
static void put_reasons(const struct page *page)
{
    const struct csv *table = &page->sweep;
    for (int column = 1; column < table->columns - 1; column++)
        for (int64_t row = 0; row < table->rows && is_verdict(table, column); row++) {
            const char *verdict = csv_field(table, row, column);
            if (!begins(verdict, "known deviation"))
                continue;
            fputs("<p class=\"warn\"><span class=\"mark\">△ </span>", page->file);
            page_text(page->file, head_of(table, column - 1).name);
            fputc(' ', page->file);
            page_text(page->file, verdict);
            fputs("</p>\n", page->file);
            break;
        }
}

/* Fits through the runs that failed. */
static int64_t failed_fits(const struct page *page)
{
    int64_t failed = 0;
    for (int64_t row = 0; row < page->checks.rows; row++) {
        const char *verdict = csv_field(&page->checks, row, csv_column(&page->checks, "verdict"));
        failed += !strcmp(verdict, "failed") || !strcmp(verdict, "passes now");
    }
    return failed;
}

static void put_count(const struct page *page, const char *verdict, int64_t count)
{
    fprintf(page->file, "<strong>%s: %lld of %lld runs.</strong> ", verdict, (long long)count,
            (long long)page->sweep.rows);
}

void page_sweep(const struct page *page)
{
    const struct csv *table = &page->sweep;
    const int64_t passed = count_of(table, "passed"), open = count_of(table, "not finished"),
                  failed = table->rows - passed - open;
    fprintf(page->file, "<section id=\"sweep\"><h2>Verdict</h2>\n<p class=\"verdict %s\">",
            passed == table->rows && !failed_fits(page) ? "good" : "bad");
    if (failed)
        put_count(page, "Failed", failed);
    if (open)
        put_count(page, "Not finished", open);
    if (passed == table->rows)
        put_count(page, "Passed", passed);
    if (failed_fits(page))
        fprintf(page->file, "<strong>Failed: %lld of %lld fits.</strong>",
                (long long)failed_fits(page), (long long)page->checks.rows);
    fputs("</p>\n", page->file);
    put_statistics(page);
    put_table(page);
    put_reasons(page);
    if (page->checks.rows)
        page_checks(page, "Fits through the runs");
    fputs("</section>\n", page->file);
}
