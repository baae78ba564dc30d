/* Tables of comma-separated values; see csv.h. Fields are unquoted in place. */
#include "base/csv.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file.h"
#include "base/memory.h"

/* Unquotes the field at *AT in place, goes behind what ends it, and returns that: a comma, the end
 * of the line or of the text. */
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

char *csv_heads(const struct csv *csv, int first)
{
    enum { SHOWN = 24 };
    char *text = text_copy("");
    for (int i = first; i < csv->columns && i <= first + SHOWN && text; i++) {
        char *longer = text_format("%s%s%s", text, i > first ? ", " : "",
                                   i < first + SHOWN ? csv_head(csv, i) : "...");
        free(text);
        text = longer;
    }
    return text;
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

/* FNV-1a: it needs to see accidents, not enemies. */
static uint64_t hash_more(uint64_t hash, const unsigned char *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ bytes[i]) * 0x100000001b3u;
    return hash;
}

/* Extends MARK to the first BYTES of FILE. */
static struct error *extend_to(FILE *file, const char *path, int64_t bytes, struct csv_mark *mark)
{
    unsigned char piece[1 << 14];
    if (!mark->bytes)
        mark->hash = 0xcbf29ce484222325u;
    while (mark->bytes < bytes) {
        int64_t wanted = bytes - mark->bytes;
        size_t size = wanted < (int64_t)sizeof piece ? (size_t)wanted : sizeof piece;
        ssize_t got = pread(fileno(file), piece, size, mark->bytes);
        if (got < 0)
            return file_error(path, errno);
        if (got == 0)
            return NULL;
        mark->hash = hash_more(mark->hash, piece, (size_t)got);
        mark->bytes += got;
    }
    return NULL;
}

struct error *csv_extend(FILE *file, const char *path, struct csv_mark *mark)
{
    struct stat status;
    errno = 0;
    if (fflush(file) || ferror(file) || fstat(fileno(file), &status))
        return file_error(path, errno);
    return extend_to(file, path, status.st_size, mark);
}

struct error *csv_visit_mark(struct csv_mark *mark, const char *name, struct visitor *visitor)
{
    char part[80];
    snprintf(part, sizeof part, "%s_bytes", name);
    TRY(visitor->visit(visitor, part, NUMBER_INT64, &mark->bytes, 1, 1));
    if (mark->bytes < 0)
        return error_new(ERROR_SYSTEM, "%s is %lld: it is negative", part, (long long)mark->bytes);
    snprintf(part, sizeof part, "%s_hash", name);
    return visitor->visit(visitor, part, NUMBER_UINT64, &mark->hash, 1, 1);
}

/* The place after the head and the first KEEP rows; a last line without its end is no row. */
static struct error *place_after(FILE *file, const char *path, int64_t keep, off_t *place)
{
    int64_t lines = 0;
    *place = 0;
    for (int c; lines < keep + 1 && (c = getc(file)) != EOF;) {
        ++*place;
        lines += c == '\n';
    }
    if (ferror(file))
        return file_error(path, errno);
    if (lines < keep + 1)
        return error_new(ERROR_INPUT,
                         "%s: has %lld rows, but %lld were written: the run cannot continue", path,
                         (long long)(lines ? lines - 1 : 0), (long long)keep);
    return NULL;
}

/* Compares the first PLACE bytes, KEEP rows, with those that MARK was made of. */
static struct error *compare_mark(FILE *file, const char *path, int64_t keep, off_t place,
                                  const struct csv_mark *mark)
{
    struct csv_mark found = {0};
    TRY(extend_to(file, path, place, &found));
    if (found.bytes == mark->bytes && found.hash == mark->hash)
        return NULL;
    return error_new(ERROR_INPUT,
                     "%s: its first %lld rows are not those that the run wrote: the file has been "
                     "changed since the checkpoint; restore it, or start again with --overwrite",
                     path, (long long)keep);
}

/* Opens PATH to go on after KEEP rows. What an interrupted run wrote after them is cut off. */
static struct error *open_after(const char *path, int64_t keep, const struct csv_mark *mark,
                                FILE **file)
{
    TRY(file_open(path, "r+", file));
    off_t place;
    struct error *error = place_after(*file, path, keep, &place);
    if (!error && mark)
        error = compare_mark(*file, path, keep, place, mark);
    if (!error && (fseeko(*file, place, SEEK_SET) || ftruncate(fileno(*file), place)))
        error = file_error(path, errno);
    if (error) {
        fclose(*file);
        *file = NULL;
    }
    return error;
}

struct error *csv_grow(const char *path, int64_t keep, const struct csv_mark *mark, FILE **file)
{
    if (keep > 0)
        return open_after(path, keep, mark, file);
    return file_open(path, "w+", file);
}

void csv_put_head(FILE *file, const char *name, const char *unit)
{
    fprintf(file, *unit ? "%s [%s]" : "%s%s", name, unit);
}

void csv_put_named_head(FILE *file, const char *name, const char *what, const char *unit)
{
    char *head = text_format(*unit ? "%s%s [%s]" : "%s%s%s", name, what, unit);
    csv_put_text(file, head);
    free(head);
}

void csv_add_finite(FILE *file, double value)
{
    fputc(',', file);
    if (isfinite(value))
        csv_put_number(file, value);
}
