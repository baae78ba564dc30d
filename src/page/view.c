/* The data of the viewer: positions with 16 bits in a box about the window, fields with 8 bits over
 * their range, each frame as its difference to the one before, positions as that to free flight
 * where this is less, in planes of bytes, deflated, as base64. viewer.js reads and draws them. A
 * particle that a frame does not have is at 65535 on each axis. */
#include "page/view.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

#include "base/file.h"
#include "base/memory.h"
#include "output/shelf.h"
#include "page/assets.h"
#include "page/internal.h"
#include "picture/album.h"

enum { CODES = 65534, ABSENT = 65535, FIELDS_SHOWN = 8 };
/* The box is so much larger than the window on every side; strays outside are absent. */
static const double ROOM = 0.5;

const char view_begin[] = "<main id=\"viewer\">", view_end[] = "</body>";

struct viewer {
    const struct view_request *request;
    struct shelf shelf;
    struct album *album;
    struct album_space space;
    int names;
    const char *name[FIELDS_SHOWN + 1]; /* body, then fields */
    int fields;                         /* that there are */
    const char *field[FIELDS_SHOWN];
    struct album_range range[FIELDS_SHOWN];
    double low[3], span[3];
    int frames, stride;
    int *frame; /* numbers on the shelf */
    double *time;
    int64_t count; /* of particles in any frame, every STRIDE-th */
    uint64_t *id;
    unsigned char *still;               /* body, radius */
    unsigned char *now, *last, *before; /* the planes of a frame, and of those before */
    double largest;                     /* radius, m */
};

/* What is shown of a frame: particles, or the cells of a gas. */
static const struct frame_group *shown_of(const struct frame *frame)
{
    for (int g = 0; g < frame->groups; g++)
        if (!frame->group[g].cell_dimension)
            return &frame->group[g];
    return &frame->group[0];
}

static struct error *read_frame(const struct viewer *v, int index, struct frame *frame)
{
    int count;
    const char *const *fields = album_fields(v->album, &count);
    return shelf_read(&v->shelf, v->frame[index], fields, count, frame);
}

static void choose_frames(struct viewer *v, int most)
{
    v->frames = v->shelf.frames < most ? v->shelf.frames : most;
    for (int i = 0; i < v->frames; i++)
        v->frame[i] = v->frames > 1 ? (int)((int64_t)i * (v->shelf.frames - 1) / (v->frames - 1))
                                    : v->shelf.frames - 1;
}

static struct error *study_run(struct viewer *v)
{
    const struct ranks alone = ranks_alone();
    struct error *error = NULL;
    struct frame frame, last;
    TRY(read_frame(v, 0, &frame));
    error = read_frame(v, v->frames - 1, &last);
    if (!error) {
        error = album_begin(v->album, &frame, &last);
        frame_free(&last);
    }
    frame_free(&frame);
    for (int i = 0; i < v->frames && !error; i++) {
        TRY(read_frame(v, i, &frame));
        error = album_add(v->album, &frame);
        frame_free(&frame);
    }
    album_share(v->album, &alone);
    album_space(v->album, &v->space);
    for (int axis = 0; axis < 3; axis++) {
        const struct album_range *window = &v->space.computed[axis];
        const double more = ROOM * (window->high - window->low);
        v->low[axis] = window->low - more;
        v->span[axis] = window->high - window->low + 2.0 * more;
    }
    return error;
}

static int by_id(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* The ids of all frames, each once, every STRIDE-th. */
static struct error *collect_ids(struct viewer *v)
{
    int64_t room = 0, count = 0;
    free(v->id);
    v->id = NULL;
    for (int i = 0; i < v->frames; i++) {
        struct frame frame;
        TRY(read_frame(v, i, &frame));
        const struct frame_group *group = shown_of(&frame);
        const bool done =
            memory_reserve((void **)&v->id, &room, count + group->count + 1, count, sizeof *v->id);
        if (done && group->count)
            memcpy(v->id + count, group->id, (size_t)group->count * sizeof *v->id);
        count += done ? group->count : 0;
        v->time[i] = frame.time;
        frame_free(&frame);
        if (!done)
            return out_of_memory_for("the viewer");
        qsort(v->id, (size_t)count, sizeof *v->id, by_id);
        int64_t kept = 0;
        for (int64_t k = 0; k < count; k++)
            if (kept == 0 || v->id[k] != v->id[kept - 1])
                v->id[kept++] = v->id[k];
        count = kept;
    }
    v->count = 0;
    for (int64_t k = 0; k < count; k += v->stride)
        v->id[v->count++] = v->id[k];
    return NULL;
}

static unsigned char code_of(double value, double low, double high)
{
    const double part = high > low ? (value - low) / (high - low) : 0.5;
    return isfinite(part) ? (unsigned char)(255.0 * minimum(maximum(part, 0.0), 1.0) + 0.5) : 0;
}

static void put_place(struct viewer *v, const float *place, int64_t k)
{
    unsigned code[3] = {ABSENT, ABSENT, ABSENT};
    bool inside = place != NULL;
    for (int axis = 0; axis < 3 && inside; axis++) {
        const double part = (place[axis] - v->low[axis]) / v->span[axis];
        inside = part >= 0.0 && part <= 1.0;
        code[axis] = (unsigned)(part * CODES + 0.5);
    }
    for (int axis = 0; axis < 3; axis++) {
        const unsigned put = inside ? code[axis] : ABSENT;
        v->now[axis * v->count + k] = put & 255;
        v->now[(3 + axis) * v->count + k] = (unsigned char)(put >> 8);
    }
}

/* The planes of FRAME. */
static void encode(struct viewer *v, const struct frame *frame)
{
    const struct frame_group *group = shown_of(frame);
    const double factor = cbrt(v->stride);
    int64_t i = 0;
    for (int64_t k = 0; k < v->count; k++) {
        while (i < group->count && group->id[i] < v->id[k])
            i++;
        if (i == group->count || group->id[i] != v->id[k]) {
            put_place(v, NULL, k);
            continue;
        }
        put_place(v, group->position[i], k);
        v->still[k] = group->body[i] < 255 ? (unsigned char)group->body[i] : 255;
        const unsigned char radius = code_of(0.62 * factor * group->diameter[i], 0.0, v->largest);
        if (!v->still[v->count + k])
            v->still[v->count + k] = radius ? radius : 1;
        for (int f = 0; f < v->fields; f++) {
            const struct frame_field *field = frame_field(group, v->field[f]);
            v->now[(6 + f) * v->count + k] =
                field ? code_of(field->value[i], v->range[f].low, v->range[f].high) : 0;
        }
    }
}

static struct error *put_blob(FILE *file, const char *id, int order, const unsigned char *bytes,
                              size_t size)
{
    uLongf packed = compressBound((uLong)size);
    unsigned char *room = memory_allocate(packed + 1);
    if (!room || compress2(room, &packed, bytes, (uLong)size, 6) != Z_OK) {
        free(room);
        return out_of_memory_for("the viewer");
    }
    fprintf(file, "<script type=\"text/plain\" id=\"%s\" data-order=\"%d\">", id, order);
    page_base64(file, room, packed);
    fputs("</script>\n", file);
    free(room);
    return NULL;
}

/* The whole number of position K in PLANES. */
static int place_code(const struct viewer *v, const unsigned char *planes, int64_t k)
{
    return planes[k] | planes[3 * v->count + k] << 8;
}

/* What position K is expected to be: 0, that of the frame before, or where free flight takes it. */
static int place_expected(const struct viewer *v, int64_t k, int order)
{
    return order == 0   ? 0
           : order == 1 ? place_code(v, v->last, k)
                        : 2 * place_code(v, v->last, k) - place_code(v, v->before, k);
}

static int place_difference(const struct viewer *v, int64_t k, int order)
{
    return (place_code(v, v->now, k) - place_expected(v, k, order)) & 0xffff;
}

/* Which of the two expectations is nearer to the frame NUMBER. */
static int choose_order(const struct viewer *v, int number)
{
    int64_t sum[3] = {0};
    for (int64_t k = 0; k < 3 * v->count && number > 1; k++)
        for (int order = 1; order <= 2; order++) {
            const int off = place_difference(v, k, order),
                      least = off < 0x8000 ? off : 0x10000 - off;
            sum[order] += least < 256 ? least : 256;
        }
    return number > 1 && sum[2] < sum[1] ? 2 : number > 0;
}

/* The frames, each as its difference to what those before let expect, then what does not change. */
static struct error *put_frames(struct viewer *v, FILE *file)
{
    const size_t places = (size_t)(6 * v->count), bytes = places + (size_t)(v->fields * v->count);
    unsigned char *difference = memory_allocate(bytes + 1);
    struct error *error = difference ? NULL : out_of_memory_for("the viewer");
    memset(v->last, 0, bytes);
    for (int i = 0; i < v->frames && !error; i++) {
        struct frame frame;
        char id[16];
        error = read_frame(v, i, &frame);
        if (error)
            break;
        encode(v, &frame);
        frame_free(&frame);
        const int order = choose_order(v, i);
        for (int64_t k = 0; k < 3 * v->count; k++) {
            const int off = place_difference(v, k, order);
            difference[k] = off & 255;
            difference[3 * v->count + k] = (unsigned char)(off >> 8);
        }
        for (size_t k = places; k < bytes; k++)
            difference[k] = (unsigned char)(v->now[k] - v->last[k]);
        snprintf(id, sizeof id, "f%d", i);
        error = put_blob(file, id, order, difference, bytes);
        memcpy(v->before, v->last, places);
        memcpy(v->last, v->now, bytes);
    }
    free(difference);
    return error ? error : put_blob(file, "still", 0, v->still, (size_t)(2 * v->count));
}

static void put_vector(FILE *file, const char *name, double x, double y, double z)
{
    fprintf(file, "\"%s\":[%.9g,%.9g,%.9g],", name, x, y, z);
}

static void put_meta(const struct viewer *v, FILE *file)
{
    const struct album_space *space = &v->space;
    char text[QUANTITY_TEXT];
    double reach = 0.0;
    fprintf(file, "<script type=\"application/json\" id=\"meta\">{\"count\":%lld,\"flat\":%s,",
            (long long)v->count, space->dimension < 3 ? "true" : "false");
    put_vector(file, "lo", v->low[0], v->low[1], v->low[2]);
    put_vector(file, "span", v->span[0] * ABSENT / CODES, v->span[1] * ABSENT / CODES,
               v->span[2] * ABSENT / CODES);
    put_vector(file, "at", space->mirror_at[0], space->mirror_at[1], space->mirror_at[2]);
    double up[3] = {0.0};
    up[space->up] = space->up_sign;
    put_vector(file, "up", up[0], up[1], up[2]);
    fputs("\"mirror\":[", file);
    for (int axis = 0, put = 0; axis < 3; axis++) {
        reach = maximum(reach,
                        maximum(fabs(space->computed[axis].low), fabs(space->computed[axis].high)));
        if (space->mirrored[axis])
            fprintf(file, "%s%d", put++ ? "," : "", axis);
    }
    const struct multiple unit = multiple_find(reach, "m");
    fprintf(file, "],\"cut\":\"%s\",\"unit\":\"%s\",\"mm\":%.9g,\"rmax\":%.9g,\"window\":{",
            space->cut, unit.name, 1.0 / unit.scale, v->largest);
    put_vector(file, "lo", space->computed[0].low, space->computed[1].low, space->computed[2].low);
    fprintf(file, "\"hi\":[%.9g,%.9g,%.9g]},\"times\":[", space->computed[0].high,
            space->computed[1].high, space->computed[2].high);
    for (int i = 0; i < v->frames; i++)
        fprintf(file, "%s\"%s\"", i ? "," : "", quantity_text(v->time[i], "s", text));
    fputs("],\"fields\":[", file);
    for (int f = 0; f < v->fields; f++) {
        const struct album_range *range = &v->range[f];
        const struct multiple multiple =
            multiple_find(maximum(fabs(range->low), fabs(range->high)), range->unit);
        fprintf(file,
                "%s{\"name\":\"%s\",\"low\":%.9g,\"high\":%.9g,\"scale\":%.9g,\"unit\":\"%s\"}",
                f ? "," : "", v->field[f], range->low, range->high, multiple.scale, multiple.name);
    }
    fputs("],\"bodies\":[", file);
    for (int b = 0; b < space->bodies->count && b < 32; b++) {
        fputs(b ? "," : "", file);
        page_json_text(file, space->bodies->name[b]);
    }
    fprintf(file, "],\"stride\":%d,\"left\":%d}</script>\n", v->stride,
            v->shelf.frames - v->frames);
}

static struct error *put_page(struct viewer *v, FILE *file)
{
    const struct simulation_case *input = v->request->input;
    const struct page page = {.folder = v->request->folder, .file = file};
    page_head(&page, input->title ? input->title : input->name);
    fputs("<h1>", file);
    page_text(file, input->title ? input->title : input->name);
    fprintf(file, "</h1>\n%s\n%s", view_begin, asset_viewer_controls);
    put_meta(v, file);
    TRY(put_frames(v, file));
    fprintf(file, "</main><script>\n%s</script>\n%s\n</html>\n", asset_viewer, view_end);
    return NULL;
}

/* One try; *BYTES is what it took. */
static struct error *put_file(struct viewer *v, int64_t *bytes)
{
    const char *path = v->request->path;
    FILE *file;
    TRY(collect_ids(v));
    const size_t planes = (size_t)((6 + v->fields) * v->count) + 1;
    free(v->still);
    free(v->now);
    free(v->last);
    free(v->before);
    v->before = memory_allocate(planes);
    v->still = memory_allocate((size_t)(2 * v->count) + 1);
    v->now = memory_allocate(planes);
    v->last = memory_allocate(planes);
    if (!v->still || !v->now || !v->last || !v->before)
        return out_of_memory_for("the viewer");
    TRY(file_begin(path, &file));
    struct error *error = put_page(v, file);
    if (!error)
        error = file_end(path, file);
    else
        fclose(file);
    *bytes = file_size(path);
    return error;
}

/* Fewer frames, then fewer particles, until the page is within its limit. */
static struct error *fit(struct viewer *v, struct view_result *result)
{
    enum { FRAMES_LEAST = 10, TRIES = 6 };
    const int64_t limit = v->request->limit ? v->request->limit : VIEW_BYTES;
    struct error *error = put_file(v, &result->bytes);
    for (int i = 0; i < TRIES && !error && result->bytes > limit; i++) {
        const double over = 1.05 * (double)result->bytes / (double)limit;
        const int fewer = (int)maximum(FRAMES_LEAST, floor(v->frames / over));
        if (fewer < v->frames)
            choose_frames(v, fewer);
        else
            v->stride = (int)ceil(maximum(v->stride * over, v->stride + 1.0));
        v->largest *= cbrt((double)v->stride) / cbrt((double)result->stride);
        result->stride = v->stride;
        error = put_file(v, &result->bytes);
    }
    result->frames = v->frames;
    result->of_frames = v->shelf.frames;
    result->particles = v->count;
    return error;
}

static void add_name(struct viewer *v, const char *name)
{
    for (int i = 0; i < v->names; i++)
        if (!strcmp(v->name[i], name))
            return;
    if (v->names <= FIELDS_SHOWN)
        v->name[v->names++] = name;
}

static void choose_fields(struct viewer *v)
{
    const struct view_request *request = v->request;
    add_name(v, "body");
    for (int i = 0; i < request->field_count; i++)
        add_name(v, request->fields[i]);
    if (request->field_count)
        return;
    for (int i = 0; album_name_of(request->input, i); i++) {
        const struct name_list panels = album_panels(request->input, i);
        for (int k = 0; k < panels.count; k++)
            if (!album_is_category(panels.names[k]) && strcmp(panels.names[k], "schlieren") != 0)
                add_name(v, panels.names[k]);
    }
    add_name(v, "speed");
    add_name(v, "pressure");
}

static struct error *find_fields(struct viewer *v)
{
    for (int i = 1; i < v->names; i++) {
        if (album_range(v->album, i, &v->range[v->fields]))
            v->field[v->fields++] = v->name[i];
        else if (v->request->field_count)
            return error_new(ERROR_INPUT, "no snapshot has the field \"%.60s\"", v->name[i]);
    }
    return NULL;
}

static struct error *prepare(struct viewer *v)
{
    TRY(shelf_open(v->request->folder, &v->shelf));
    if (!v->shelf.frames)
        return error_new(ERROR_INPUT, "%s: there are no snapshots to show", v->request->folder);
    v->frame = memory_allocate((size_t)v->shelf.frames * sizeof *v->frame);
    v->time = memory_allocate((size_t)v->shelf.frames * sizeof *v->time);
    if (!v->frame || !v->time)
        return out_of_memory_for("the viewer");
    choose_fields(v);
    TRY(album_create_plain(v->request->input, v->name, v->names, &v->album));
    choose_frames(v, v->request->frames ? v->request->frames : VIEW_FRAMES);
    TRY(study_run(v));
    TRY(find_fields(v));
    v->largest = 0.62 * v->space.diameter;
    return NULL;
}

struct error *view_write(const struct view_request *request, struct view_result *result)
{
    struct viewer v = {.request = request, .stride = 1};
    *result = (struct view_result){.stride = 1};
    struct error *error = prepare(&v);
    if (!error)
        error = fit(&v, result);
    result->stride = v.stride;
    album_free(v.album);
    shelf_free(&v.shelf);
    free(v.frame);
    free(v.time);
    free(v.id);
    free(v.still);
    free(v.now);
    free(v.last);
    free(v.before);
    return error;
}
