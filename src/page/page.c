/* report.html as a whole; see page.h. */
#include "page/page.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "base/memory.h"
#include "page/assets.h"
#include "page/internal.h"

/* A folder may hold files of any size; what is larger than this does not fit on a page. */
enum { TABLE_BYTES_MAX = 1 << 28, TEXT_BYTES_MAX = 1 << 22 };

struct error *page_read_table(const char *folder, const char *name, struct csv *csv)
{
    *csv = (struct csv){0};
    char *path = path_join(folder, name);
    struct error *error = !path                               ? out_of_memory_for("a report")
                          : file_size(path) > TABLE_BYTES_MAX ? NULL
                                                              : csv_read(path, csv);
    free(path);
    return error;
}

void page_head(const struct page *page, const char *title)
{
    fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
          "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src "
          "data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
          "<meta name=\"color-scheme\" content=\"light dark\">\n<title>",
          page->file);
    page_text(page->file, title);
    fprintf(page->file, "</title>\n<style>\n%s%s</style>\n</head>\n<body>\n", asset_dygraphs_style,
            page_style);
}

/* "demo · 2-D · sph · 4928 particles · until 2 ns" */
static void put_header(const struct page *page, const char *title)
{
    static const char *const words[][3] = {
        {"name", "", ""},        {"dimension", "", "-D"},
        {"method", "", ""},      {"particles", "", " particles"},
        {"cells", "", " cells"}, {"until", "until ", ""},
    };
    fputs("<header><h1>", page->file);
    page_text(page->file, title);
    fputs("</h1>\n<p class=\"lead\">", page->file);
    bool begun = false;
    for (size_t i = 0; i < COUNT_OF(words); i++) {
        if (!*summary_value(&page->summary, "run", NULL, words[i][0]))
            continue;
        fprintf(page->file, "%s%s", begun ? " · " : "", words[i][1]);
        summary_put(page, "run", NULL, words[i][0]);
        fputs(words[i][2], page->file);
        begun = true;
    }
    fputs("</p></header>\n<main>\n", page->file);
}

/* A text file of the folder, folded away; nothing where there is none. */
static struct error *put_file(const struct page *page, const char *name, const char *words)
{
    char *path = path_join(page->folder, name), *text = NULL;
    size_t size;
    const bool shown = path && file_size(path) <= TEXT_BYTES_MAX;
    struct error *error = !path   ? out_of_memory_for("a report")
                          : shown ? file_read(path, &text, &size)
                                  : NULL;
    if (path && !shown)
        fprintf(page->file, "<p class=\"note\">%s is too large to be shown here.</p>\n", name);
    if (!error && text && *text) {
        fprintf(page->file, "<details><summary>%s</summary><pre>", words);
        page_text(page->file, text);
        fputs("</pre></details>\n", page->file);
    }
    free(text);
    free(path);
    return error;
}

void page_foot(const struct page *page, bool plots)
{
    fputs("</main>\n<footer><p>Made by Bolide.</p></footer>\n", page->file);
    if (plots)
        fprintf(page->file, "<script>\n%s</script>\n<script>\n%s</script>\n", asset_dygraphs,
                asset_plots);
    fprintf(page->file, "<script>\n%s</script>\n</body>\n</html>\n", page_script);
}

/* The viewer of the run (view.html), which a button opens, within the page up to a size. */
static struct error *put_viewer(const struct page *page)
{
    enum { WITHIN_MOST = 5000000 };
    char *path = path_join(page->folder, "view.html"), *text = NULL;
    size_t size;
    const int64_t bytes = path ? file_size(path) : 0;
    struct error *error = !path                               ? out_of_memory_for("a report")
                          : bytes > 0 && bytes <= WITHIN_MOST ? file_read(path, &text, &size)
                                                              : NULL;
    const char *begin = text ? strstr(text, view_begin) : NULL;
    const char *end = begin ? strstr(begin, view_end) : NULL;
    if (end || bytes > WITHIN_MOST)
        fputs("<section id=\"particles\"><h2>Particles from any side</h2>\n", page->file);
    if (end) {
        fputs("<p class=\"controls\"><button id=\"open-viewer\" type=\"button\">Open the "
              "viewer</button></p>\n<template id=\"viewer-page\">",
              page->file);
        fwrite(begin, 1, (size_t)(end - begin), page->file);
        fputs("</template></section>\n", page->file);
    } else if (bytes > WITHIN_MOST) {
        fputs("<p><a href=\"view.html\">Open the viewer</a> (view.html).</p></section>\n",
              page->file);
    }
    free(text);
    free(path);
    return error;
}

/* What was changed when the run was resumed; nothing where nothing was. */
static void put_changes(const struct page *page)
{
    const struct csv *table = &page->changes;
    if (!table->rows)
        return;
    fputs("<section id=\"changes\"><h2>Changed when it was resumed</h2>\n<table><tr><th>step</th>"
          "<th>time</th><th>key</th><th>before</th><th>after</th></tr>\n",
          page->file);
    for (int64_t row = 0; row < table->rows; row++) {
        fputs("<tr><td>", page->file);
        page_text(page->file, csv_field(table, row, csv_column(table, "step")));
        fputs("</td><td>", page->file);
        page_quantity(page->file, csv_number(table, row, csv_column(table, "time [s]")), "s");
        static const char *const columns[] = {"key", "before", "after"};
        for (size_t k = 0; k < COUNT_OF(columns); k++) {
            fputs("</td><td>", page->file);
            page_text(page->file, csv_field(table, row, csv_column(table, columns[k])));
        }
        fputs("</td></tr>\n", page->file);
    }
    fputs("</table></section>\n", page->file);
}

static struct error *put_page(const struct page *page)
{
    if (page->calibration)
        return page_calibration(page);
    const char *title = summary_value(&page->summary, "run", NULL, "title");
    if (!*title)
        title = summary_value(&page->summary, "run", NULL, "name");
    if (!*title)
        title = "Results of a run";
    page_head(page, title);
    put_header(page, title);
    if (page->sweep.rows) {
        page_sweep(page);
        TRY(page_pictures(page));
        page_foot(page, false);
        return NULL;
    }
    page_verdict(page);
    put_changes(page);
    TRY(page_pictures(page));
    TRY(put_viewer(page));
    TRY(page_profiles(page));
    TRY(page_histograms(page));
    TRY(page_history(page));
    page_about(page);
    page_speed(page);
    fputs("<section id=\"files\"><h2>The case and the log</h2>\n", page->file);
    TRY(put_file(page, "case.yaml", "The case as run, with all defaults (case.yaml)"));
    TRY(put_file(page, "run.log", "What the run said (run.log)"));
    fputs("</section>\n", page->file);
    page_foot(page, true);
    return NULL;
}

/* Writes the page to PATH; half a page is never there. */
static struct error *put_file_of_page(struct page *page, const char *path)
{
    TRY(file_begin(path, &page->file));
    struct error *error = put_page(page);
    if (!error)
        return file_end(path, page->file);
    fclose(page->file);
    char *beside = file_beside(path);
    if (beside)
        unlink(beside);
    free(beside);
    return error;
}

static struct error *look_for_run(const char *folder)
{
    char *path = path_join(folder, "run.log");
    if (!path)
        return out_of_memory_for("a report");
    bool there = access(path, R_OK) == 0;
    free(path);
    return there ? NULL
                 : error_new(ERROR_INPUT, "%s: contains no results of a run (there is no run.log)",
                             folder);
}

static struct error *read_run(const char *folder, struct page *page)
{
    TRY(look_for_run(folder));
    TRY(page_read_table(folder, "summary.csv", &page->summary));
    TRY(page_read_table(folder, "checks.csv", &page->checks));
    TRY(page_read_table(folder, "changes.csv", &page->changes));
    return page_read_table(folder, "history.csv", &page->history);
}

/* The words of the sweep's page are those of its first run. */
static struct error *read_first_run(const char *folder, struct page *page)
{
    TRY(page_read_table(folder, "checks.csv", &page->checks)); /* its fits */
    TRY(page_read_table(folder, "statistics.csv", &page->statistics));
    char *first = path_join(folder, csv_field(&page->sweep, 0, 0));
    struct error *error = first ? page_read_table(first, "summary.csv", &page->summary)
                                : out_of_memory_for("a report");
    free(first);
    return error;
}

struct error *page_write(const char *folder)
{
    struct page page = {.folder = folder};
    char *keys = path_join(folder, "calibrate-keys.csv");
    page.calibration = keys && access(keys, R_OK) == 0;
    free(keys);
    struct error *error = page_read_table(folder, "sweep.csv", &page.sweep);
    if (!error && !page.calibration)
        error = page.sweep.rows ? read_first_run(folder, &page) : read_run(folder, &page);
    char *path = path_join(folder, "report.html");
    if (!error)
        error = path ? put_file_of_page(&page, path) : out_of_memory_for("a report");
    free(path);
    csv_free(&page.sweep);
    csv_free(&page.statistics);
    csv_free(&page.summary);
    csv_free(&page.checks);
    csv_free(&page.changes);
    csv_free(&page.history);
    return error;
}
