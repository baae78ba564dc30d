/* The pictures of report.html, inlined: FIELD-NNNNNN.png as a player over time for each field,
 * check-FIELD.png as profiles over exact solutions, and whatever else is in pictures/. */
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"
#include "page/internal.h"
#include "picture/picture.h"

enum {
    FRAME_BYTES_MAX = 3400000,   /* of all frames together: the page stays below 5 MB */
    SHRINK_MAX = 8,              /* frames have so many times fewer pixels on a side at most */
    PICTURE_BYTES_MAX = 1000000, /* of any other picture */
    PRINTED_FRAMES = 4
};

struct picture {
    const char *name;
    int field_length; /* of a frame: what stands before its number; else 0 */
    long long number;
};

struct pictures {
    int count;
    char **names;
    struct picture *item;
    char *folder;
    int shrink; /* of frames */
};

static bool starts(const char *text, const char *start)
{
    return !strncmp(text, start, strlen(start));
}

/* "pressure-000012.png" is frame 12 of pressure. */
static struct picture picture_named(const char *name)
{
    struct picture picture = {.name = name};
    int end = (int)strlen(name) - 4, start = end;
    while (start > 0 && name[start - 1] >= '0' && name[start - 1] <= '9')
        start--;
    if (end - start < 6 || end - start > 18 || start < 2 || name[start - 1] != '-')
        return picture;
    picture.field_length = start - 1;
    picture.number = strtoll(name + start, NULL, 10);
    return picture;
}

static bool same_field(const struct picture *a, const struct picture *b)
{
    return a->field_length == b->field_length &&
           !strncmp(a->name, b->name, (size_t)a->field_length);
}

static int by_field_and_number(const void *left, const void *right)
{
    const struct picture *a = left, *b = right;
    int length = a->field_length < b->field_length ? a->field_length : b->field_length;
    int order = strncmp(a->name, b->name, (size_t)length);
    if (!order)
        order = a->field_length - b->field_length;
    if (!order)
        order = (a->number > b->number) - (a->number < b->number);
    return order ? order : strcmp(a->name, b->name);
}

static void pictures_free(struct pictures *pictures)
{
    names_free(pictures->names, pictures->count);
    free(pictures->item);
    free(pictures->folder);
}

static struct error *pictures_find(const char *folder, struct pictures *pictures)
{
    *pictures = (struct pictures){.folder = path_join(folder, "pictures")};
    struct error *error = pictures->folder ? folder_names(pictures->folder, ".png",
                                                          &pictures->names, &pictures->count)
                                           : out_of_memory_for("a report");
    if (!error) {
        pictures->item = memory_allocate((size_t)pictures->count * sizeof *pictures->item);
        error = pictures->item ? NULL : out_of_memory_for("a report");
    }
    if (error) {
        pictures_free(pictures);
        return error;
    }
    for (int i = 0; i < pictures->count; i++)
        pictures->item[i] = picture_named(pictures->names[i]);
    qsort(pictures->item, (size_t)pictures->count, sizeof *pictures->item, by_field_and_number);
    return NULL;
}

/* *BYTES is NULL where the file is too large for a page, or no picture. */
static struct error *read_picture(const struct pictures *pictures, const struct picture *picture,
                                  int shrink, char **bytes, size_t *size)
{
    *bytes = NULL;
    *size = 0;
    char *path = path_join(pictures->folder, picture->name);
    struct error *error = NULL;
    if (!path)
        error = out_of_memory_for("a report");
    else if (shrink > 1)
        error_free(picture_shrink(path, shrink, bytes, size));
    else if (file_size(path) <= FRAME_BYTES_MAX)
        error = file_read(path, bytes, size);
    free(path);
    return error;
}

static unsigned big_endian(const unsigned char *bytes)
{
    return (unsigned)bytes[0] << 24 | (unsigned)bytes[1] << 16 | (unsigned)bytes[2] << 8 | bytes[3];
}

static bool is_png(const char *bytes, size_t size)
{
    return bytes && size > 24 && !memcmp(bytes, "\x89PNG\r\n\x1a\n", 8);
}

void page_png(FILE *file, const char *bytes, size_t size)
{
    const unsigned char *data = (const unsigned char *)bytes;
    fprintf(file, "\" width=\"%u\" height=\"%u\" src=\"data:image/png;base64,",
            big_endian(data + 16), big_endian(data + 20));
    page_base64(file, data, size);
    fputs("\">", file);
}

/* When FRAME was taken, in BUFFER; false where the summary does not say. */
static bool frame_time(const struct page *page, const struct picture *frame, char *buffer)
{
    char number[32], *end;
    snprintf(number, sizeof number, "%06lld", frame->number);
    const char *text = summary_value(&page->summary, "picture", number, "time");
    double time = strtod(text, &end);
    if (end == text)
        return false;
    quantity_text(time, "s", buffer);
    return true;
}

static struct error *put_frame(const struct page *page, const struct pictures *pictures,
                               const struct picture *frame, bool printed)
{
    char *bytes, time[QUANTITY_TEXT];
    size_t size;
    TRY(read_picture(pictures, frame, pictures->shrink, &bytes, &size));
    if (!frame_time(page, frame, time))
        snprintf(time, sizeof time, "picture %lld", frame->number);
    if (is_png(bytes, size)) {
        char *field = text_copy_part(frame->name, (size_t)frame->field_length);
        fprintf(page->file, "<figure%s><img alt=\"Particles by ", printed ? " class=\"key\"" : "");
        page_text(page->file, field ? field : "");
        fputs(", ", page->file);
        page_text(page->file, time);
        page_png(page->file, bytes, size);
        fputs("<figcaption>", page->file);
        page_text(page->file, time);
        fputs("</figcaption></figure>\n", page->file);
        free(field);
    }
    free(bytes);
    return NULL;
}

/* Frames are so much smaller, and the part of them that is returned is shown, that their bytes stay
 * within the bound. A picture of a quarter of the pixels takes a third of the bytes. */
static double fit_frames(struct pictures *pictures)
{
    double all = 1.0, least;
    for (int i = 0; i < pictures->count; i++) {
        char *path = path_join(pictures->folder, pictures->item[i].name);
        all += path && pictures->item[i].field_length ? (double)file_size(path) : 0.0;
        free(path);
    }
    pictures->shrink = 0;
    do
        least = all / pow(++pictures->shrink, 1.5);
    while (least > FRAME_BYTES_MAX && pictures->shrink < SHRINK_MAX);
    return minimum(1.0, FRAME_BYTES_MAX / least);
}

/* The INDEX-th of SHOWN evenly chosen ones of COUNT, the last one always among them. */
static int evenly(int index, int shown, int count)
{
    return shown > 1 ? (int)((int64_t)index * (count - 1) / (shown - 1)) : count - 1;
}

static struct error *put_player(const struct page *page, const struct pictures *pictures,
                                const struct picture *frames, int count, double part)
{
    int shown = (int)minimum(count, maximum(2.0, part * count));
    char *field = text_copy_part(frames->name, (size_t)frames->field_length);
    if (!field)
        return out_of_memory_for("a report");
    fputs("<div class=\"player\" data-name=\"", page->file);
    page_text(page->file, field);
    fputs("\"><h3>", page->file);
    page_text(page->file, field);
    fputs("</h3>\n<div class=\"frames\">\n", page->file);
    struct error *error = NULL;
    for (int i = 0; i < shown && !error; i++) {
        bool printed = false;
        for (int k = 0; k < PRINTED_FRAMES; k++)
            printed |= evenly(k, PRINTED_FRAMES, shown) == i;
        error = put_frame(page, pictures, &frames[evenly(i, shown, count)], printed);
    }
    fputs("</div>\n", page->file);
    if (!error && shown < count)
        fprintf(page->file,
                "<p class=\"note\">%d of %d pictures, evenly chosen; all are in pictures/.</p>\n",
                shown, count);
    fputs("</div>\n", page->file);
    free(field);
    return error;
}

/* The first picture behind those of the field of picture I. */
static int behind_field(const struct pictures *pictures, int i)
{
    int next = i + 1;
    while (next < pictures->count && same_field(&pictures->item[i], &pictures->item[next]))
        next++;
    return next;
}

static struct error *put_players(const struct page *page, struct pictures *pictures)
{
    bool any = false;
    for (int i = 0; i < pictures->count; i++)
        any |= pictures->item[i].field_length > 0;
    if (!any)
        return NULL;
    double part = fit_frames(pictures);
    fputs("<section id=\"fields\"><h2>Fields over time</h2>\n", page->file);
    for (int i = 0, next; i < pictures->count; i = next) {
        next = behind_field(pictures, i);
        if (pictures->item[i].field_length)
            TRY(put_player(page, pictures, &pictures->item[i], next - i, part));
    }
    fputs("</section>\n", page->file);
    return NULL;
}

static struct error *put_single(const struct page *page, const struct pictures *pictures,
                                const struct picture *picture)
{
    static const char check[] = "check-";
    char *bytes, *name;
    size_t size;
    bool profile = starts(picture->name, check);
    const char *start = picture->name + (profile ? strlen(check) : 0);
    TRY(read_picture(pictures, picture, 1, &bytes, &size));
    name = text_copy_part(start, strlen(start) - 4);
    if (name && is_png(bytes, size) && size <= PICTURE_BYTES_MAX) {
        fputs("<figure><img alt=\"", page->file);
        page_text(page->file, name);
        fputs(profile ? ": the run over the exact solution" : "", page->file);
        page_png(page->file, bytes, size);
        fputs("<figcaption>", page->file);
        page_text(page->file, name);
        fputs("</figcaption></figure>\n", page->file);
    }
    struct error *error = name ? NULL : out_of_memory_for("a report");
    free(name);
    free(bytes);
    return error;
}

/* The pictures that are no frames: those of checks, or the others. */
static struct error *put_singles(const struct page *page, const struct pictures *pictures,
                                 bool checks, const char *id, const char *title)
{
    bool begun = false;
    struct error *error = NULL;
    for (int i = 0; i < pictures->count && !error; i++) {
        const struct picture *picture = &pictures->item[i];
        if (picture->field_length || starts(picture->name, "check-") != checks)
            continue;
        if (!begun)
            fprintf(page->file, "<section id=\"%s\"><h2>%s</h2>\n<div class=\"pictures\">\n", id,
                    title);
        begun = true;
        error = put_single(page, pictures, picture);
    }
    if (begun)
        fputs("</div></section>\n", page->file);
    return error;
}

struct error *page_pictures(const struct page *page)
{
    struct pictures pictures;
    TRY(pictures_find(page->folder, &pictures));
    struct error *error = put_players(page, &pictures);
    if (!error)
        error = put_singles(page, &pictures, true, "profiles", "Profiles and exact solutions");
    if (!error)
        error = put_singles(page, &pictures, false, "pictures",
                            page->sweep.rows ? "What the checks measured" : "Other pictures");
    pictures_free(&pictures);
    return error;
}
