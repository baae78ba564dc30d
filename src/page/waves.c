/* Pressure waves at gauges, as the check `blast` reads them: a table of what the probes recorded,
 * and of the exact solution where they recorded it too. */
#include "measure/blast_record.h"
#include "page/internal.h"

static void put_cell(FILE *file, const char *label, double value, const char *unit)
{
    fprintf(file, "<td class=\"num\" data-label=\"%s\">", label);
    if (isnan(value))
        fputs("–", file);
    else
        page_quantity(file, value, unit);
    fputs("</td>", file);
}

static void put_wave(FILE *file, const char *name, const char *what, const struct blast_wave *wave)
{
    fputs("<tr><th scope=\"row\">", file);
    page_text(file, name);
    fprintf(file, "</th><td data-label=\"from\">%s</td>", what);
    put_cell(file, "peak overpressure", wave->overpressure, "Pa");
    put_cell(file, "arrival", wave->arrival, "s");
    put_cell(file, "positive duration", wave->duration, "s");
    put_cell(file, "impulse", wave->impulse, "Pa*s");
    fputs("</tr>\n", file);
}

bool page_is_wave(const double *pressure, int64_t count)
{
    double peak = 0.0;
    for (int64_t i = 0; i < count; i++)
        peak = maximum(peak, pressure[i]);
    return count > 1 && pressure[0] > 0.0 && peak > 1.01 * pressure[0];
}

void page_waves_head(FILE *file)
{
    fputs("<table class=\"cards\"><caption>Pressure waves at gauges</caption>\n<thead><tr>"
          "<th scope=\"col\">gauge</th><th scope=\"col\">from</th>"
          "<th scope=\"col\" class=\"num\">peak overpressure</th>"
          "<th scope=\"col\" class=\"num\">arrival</th>"
          "<th scope=\"col\" class=\"num\">positive duration</th>"
          "<th scope=\"col\" class=\"num\">impulse</th></tr></thead>\n<tbody>\n",
          file);
}

void page_wave(FILE *file, const char *name, const struct page_wave *wave)
{
    const struct blast_wave run = blast_record(wave->time, wave->pressure, wave->count, NAN);
    put_wave(file, name, "run", &run);
    if (wave->exact) {
        const struct blast_wave exact = blast_record(wave->time, wave->exact, wave->count, NAN);
        put_wave(file, name, "exact", &exact);
    }
}

void page_waves_foot(FILE *file)
{
    fputs("</tbody></table>\n<p class=\"note\">Over the first pressure recorded. Arrival: half the "
          "peak. –: the record ends before the overpressure is zero again. Exact: the solution at "
          "the recorded times.</p>\n",
          file);
}
