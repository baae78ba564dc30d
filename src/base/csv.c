/* Tables of comma-separated values; see csv.h. Fields are unquoted in place. */
#include "base/csv.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "base/memory.h"

/* Unquotes the field at *AT in place, goes behind what ends it, and returns that: a comma, the end of
 * the line or of the text. */
static char take_field(char **at, const char **field)
{
    char *from = *at, *to = from;
    *field = from;
    if (*from == '"') {
        for (from++; *from && (*from != '"' || from[1] == '"'); *to++ = *from++)
            from += *from == '"';
        from += *from == '"';
    }
    while (*from && *from != ',' && *from != '\n')
        *to++ = *from++;
    char end = *from;
    *at = from + (end != '\0');
    if (end != ',' && to > *field && to[-1] == '\r')
        to--;
    *to = '\0';
    return end;
}

/* Takes the line at *AT as row CSV->rows + 1, the first one as heads. False when memory is out. */
static bool take_line(char **at, struct csv *csv, int64_t *room)
{
    bool heads = csv->columns == 0;
    int64_t start = heads ? 0 : (csv->rows + 1) * csv->columns;
    int column = 0;
    for (char end = ','; end == ','; column++) {
        const char *field;
        end = take_field(at, &field);
        if (!heads && column >= csv->columns)
            continue;
        if (!memory_reserve((void **)&csv->field, room, start + column + 1, start + column,
                            sizeof *csv->field))
            return false;
        csv->field[start + column] = field;
    }
    if (heads) {
        csv->columns = column;
        return true;
    }
    if (!memory_reserve((void **)&csv->field, room, start + csv->columns,
                        start + (column < csv->columns ? column : csv->columns),
                        sizeof *csv->field))
        return false;
    for (; column < csv->columns; column++)
        csv->field[start + column] = "";
    csv->rows++;
    return true;
}

struct error *csv_read(const char *path, struct csv *csv)
{
    *csv = (struct csv){0};
    size_t size;
    TRY(file_read(path, &csv->text, &size));
    int64_t room = 0;
    for (char *at = csv->text; at && *at;) {
        if (*at == '\n' || (*at == '\r' && at[1] == '\n')) {
            at++;
            continue;
        }
        if (!take_line(&at, csv, &room)) {
            csv_free(csv);
            return error_new(ERROR_SYSTEM, "%s: out of memory", path);
        }
    }
    return NULL;
}

void csv_free(struct csv *csv)
{
    free(csv->field);
    free(csv->text);
    *csv = (struct csv){0};
}

const char *csv_head(const struct csv *csv, int column)
{
    return column >= 0 && column < csv->columns ? csv->field[column] : "";
}

const char *csv_field(const struct csv *csv, int64_t row, int column)
{
    bool there = row >= 0 && row < csv->rows && column >= 0 && column < csv->columns;
    return there ? csv->field[(row + 1) * csv->columns + column] : "";
}

int csv_column(const struct csv *csv, const char *name)
{
    for (int i = 0; i < csv->columns; i++)
        if (!strcmp(csv->field[i], name))
            return i;
    return -1;
}

double csv_number(const struct csv *csv, int64_t row, int column)
{
    const char *text = csv_field(csv, row, column);
    char *end;
    double value = strtod(text, &end);
    return end == text || *end ? NAN : value;
}

void csv_put_text(FILE *file, const char *text)
{
    fputc('"', file);
    for (; text && *text; text++) {
        if (*text == '"')
            fputc('"', file);
        fputc(*text, file);
    }
    fputc('"', file);
}

void csv_put_number(FILE *file, double value)
{
    char text[32];
    if (isnan(value)) { /* printf shows the sign bit of one, which means nothing */
        fputs("nan", file);
        return;
    }
    value += 0.0; /* no negative zero: which of two zeros is the extreme one hangs on their order */
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            break;
    }
    fputs(text, file);
}

/* The place behind the head and the first KEEP rows; a last line without its end is no row. */
static struct error *place_behind(FILE *file, const char *path, int64_t keep, off_t *place)
{
    int64_t lines = 0;
    *place = 0;
    for (int c; lines < keep + 1 && (c = getc(file)) != EOF;) {
        ++*place;
        lines += c == '\n';
    }
    if (ferror(file))
        return error_new(ERROR_SYSTEM, "%s: %s", path, strerror(errno));
    if (lines < keep + 1)
        return error_new(ERROR_INPUT, "%s: has %lld rows where %lld were written: cannot go on",
                         path, (long long)(lines ? lines - 1 : 0), (long long)keep);
    return NULL;
}

/* Opens PATH to go on behind KEEP rows. What an interrupted run wrote behind them is cut off. */
static struct error *open_behind(const char *path, int64_t keep, FILE **file)
{
    *file = fopen(path, "r+e");
    if (!*file)
        return error_new(ERROR_SYSTEM, "%s: %s", path, strerror(errno));
    off_t place;
    struct error *error = place_behind(*file, path, keep, &place);
    if (!error && (fseeko(*file, place, SEEK_SET) || ftruncate(fileno(*file), place)))
        error = error_new(ERROR_SYSTEM, "%s: %s", path, strerror(errno));
    if (error)
        fclose(*file);
    return error;
}

struct error *csv_grow(const char *path, int64_t keep, FILE **file)
{
    if (keep > 0)
        return open_behind(path, keep, file);
    *file = fopen(path, "we");
    return *file ? NULL : error_new(ERROR_SYSTEM, "%s: %s", path, strerror(errno));
}

void csv_put_head(FILE *file, const char *name, const char *unit)
{
    fprintf(file, *unit ? "%s [%s]" : "%s%s", name, unit);
}
