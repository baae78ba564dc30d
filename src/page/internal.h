/* The parts of report.html; private to this folder. Each writes its section to page->file, whose
 * errors show when it is closed. */
#ifndef BOLIDE_PAGE_INTERNAL_H
#define BOLIDE_PAGE_INTERNAL_H

#include <stdio.h>

#include "base/csv.h"
#include "picture/scale.h"

struct page {
    const char *folder;
    FILE *file;
    struct csv summary, checks, history, changes;
    struct csv sweep;      /* of a sweep: its table; SUMMARY is that of its first run */
    struct csv statistics; /* of a sweep with repetitions */
    bool calibration;      /* it is that of a calibration */
};

/* page.c */

/* What a page begins and ends with. Its policy forbids the page whatever it does not hold
 * itself. */
/* Reads the table NAME of FOLDER; one that is missing, or too large for a page, has no columns. */
struct error *page_read_table(const char *folder, const char *name, struct csv *csv);

void page_head(const struct page *page, const char *title);
/* PLOTS: the page has some. */
void page_foot(const struct page *page, bool plots);

/* text.c */

/* TEXT with everything escaped that HTML could take for its own, in an attribute too. What is not
 * UTF-8 and what no document may hold become replacement characters. */
void page_text(FILE *file, const char *text);

enum { QUANTITY_TEXT = 160 };
/* VALUE of UNIT (SI) as a person reads it, to five digits: "-2.0005e9", "Pa" gives "−2.0005 GPa",
 * "2.66e-19", "" gives "2.66 × 10⁻¹⁹". Returns BUFFER of QUANTITY_TEXT bytes. */
const char *quantity_text(double value, const char *unit, char *buffer);
void page_quantity(FILE *file, double value, const char *unit);

/* TEXT as a JSON string for a script. */
void page_json_text(FILE *file, const char *text);

/* SIZE bytes as base64. */
void page_base64(FILE *file, const unsigned char *bytes, size_t size);

/* summary.c */

/* The value that the summary has under these words, "" if there is none. NAME may be NULL: any. */
const char *summary_value(const struct csv *summary, const char *about, const char *name,
                          const char *quantity);
/* Writes the same, a number with its unit. */
void summary_put(const struct page *page, const char *about, const char *name,
                 const char *quantity);

void page_verdict(const struct page *page);
/* The table of the checks, under CAPTION. */
void page_checks(const struct page *page, const char *caption);
void page_about(const struct page *page);
void page_speed(const struct page *page);

/* sweep.c */
void page_sweep(const struct page *page);

/* calibration.c: the whole page of a calibration, whose tables are in the folder. */
struct error *page_calibration(const struct page *page);

/* history.c */
struct error *page_history(const struct page *page);

/* waves.c */
struct page_wave {
    int64_t count;
    const double *time, *pressure, *exact; /* exact: NULL: none */
};

/* Whether PRESSURE is of gas that a wave passes. */
bool page_is_wave(const double *pressure, int64_t count);
/* A table, whose lines are between its head and its foot. */
void page_waves_head(FILE *file);
void page_wave(FILE *file, const char *name, const struct page_wave *wave);
void page_waves_foot(FILE *file);

/* profiles.c */

/* Plots what CSV has, whose file is called TITLE but for its number. */
typedef struct error *page_table(const struct page *page, const struct csv *csv, const char *title);
/* The last tables of the folder NAME of the results, by PLOT, between HEAD and FOOT; nothing where
 * there is none. */
struct error *page_last_tables(const struct page *page, const char *name, const char *head,
                               const char *foot, page_table *plot);
struct error *page_profiles(const struct page *page);

/* histograms.c */
struct error *page_histograms(const struct page *page);

/* pictures.c */
struct error *page_pictures(const struct page *page);

/* The end of an <img> whose alt text the caller has begun: its size, so that nothing jumps when it
 * appears, and the SIZE bytes of a PNG. */
void page_png(FILE *file, const char *bytes, size_t size);

/* view.c: what of view.html is the viewer begins and ends with these. */
extern const char view_begin[], view_end[];

/* study_page.c */
struct study;

/* Writes FOLDER/convergence.html, with the picture convergence.png that lies there. */
struct error *page_study(const char *folder, const struct study *study);

/* plot.c: a line plot, which a script of the page draws. */

enum { PLOT_SERIES = 12 };
struct page_series {
    char label[160];
    const double *value;      /* SI */
    bool dashed, dots;        /* dots: points without a line */
    bool optional;            /* left out where it is but a billionth of the largest series */
    const double *low, *high; /* edges of a band about it; NULL: none */
};

struct page_plot {
    const char *title, *x_name, *x_unit, *unit;
    int64_t count; /* points of each series */
    const double *x;
    int series_count;
    struct page_series series[PLOT_SERIES];
};

/* Draws PLOT; nothing where it has less than two points or no series is left. */
void page_plot(FILE *file, const struct page_plot *plot);

/* style.c */
extern const char page_style[], page_script[];

#endif
