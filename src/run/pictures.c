/* Pictures from snapshots: every frame is looked at twice, for the window and the colours that all
 * share, and to be drawn. */
#include "run/pictures.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <omp.h>

#include "base/file.h"
#include "base/memory.h"
#include "measure/fragments.h"
#include "model/columns.h"
#include "output/shelf.h"
#include "output/snapshot.h"
#include "picture/album.h"

/* Frames that are looked at several times stay in memory up to this many bytes. */
enum { KEPT_BYTES = 1 << 26 };

/* The frames of a run, read when they are wanted. */
struct reel {
    const struct pictures_request *request;
    struct shelf shelf;
    struct album *album;
    struct frame *frame; /* of each; groups 0: not here */
    bool *missing;       /* cannot be read */
    int64_t bytes;
};

static struct error *open_reel(const struct pictures_request *request, struct reel *reel)
{
    reel->request = request;
    TRY(shelf_open(request->folder, &reel->shelf));
    reel->frame = calloc((size_t)reel->shelf.frames + 1, sizeof *reel->frame);
    reel->missing = calloc((size_t)reel->shelf.frames + 1, sizeof *reel->missing);
    return reel->frame && reel->missing ? NULL : out_of_memory_for("pictures");
}

static void close_reel(struct reel *reel)
{
    for (int i = 0; i < reel->shelf.frames && reel->frame; i++)
        frame_free(&reel->frame[i]);
    free(reel->frame);
    free(reel->missing);
    shelf_free(&reel->shelf);
    album_free(reel->album);
}

/* *FRAME is frame NUMBER until drop_frame; NULL where it cannot be read and a run leaves out what
 * somebody has damaged or replaced meanwhile. */
static struct error *take_frame(struct reel *reel, int number, struct frame **frame)
{
    struct frame *kept = &reel->frame[number];
    *frame = NULL;
    if (!kept->groups && !reel->missing[number]) {
        int fields;
        const char *const *field = album_fields(reel->album, &fields);
        struct error *error = shelf_read(&reel->shelf, number, field, fields, kept);
        reel->missing[number] = error != NULL;
        reel->bytes += frame_bytes(kept);
        if (error && !reel->request->lenient)
            return error;
        error_free(error);
    }
    if (!reel->missing[number])
        *frame = kept;
    return NULL;
}

static void drop_frame(struct reel *reel, int number)
{
    if (reel->bytes <= KEPT_BYTES)
        return;
    reel->bytes -= frame_bytes(&reel->frame[number]);
    frame_free(&reel->frame[number]);
}

/* From FIRST on, or back, the first frame that can be read; NULL: there is none. */
static struct error *seek_frame(struct reel *reel, int first, int step, int *number,
                                struct frame **frame)
{
    *frame = NULL;
    for (*number = first; *number >= 0 && *number < reel->shelf.frames; *number += step) {
        TRY(take_frame(reel, *number, frame));
        if (*frame)
            return NULL;
    }
    return NULL;
}

static struct error *begin_album(struct reel *reel, bool *begun)
{
    struct frame *first, *last;
    int from, to;
    TRY(seek_frame(reel, 0, 1, &from, &first));
    *begun = first != NULL;
    if (!first)
        return NULL;
    TRY(seek_frame(reel, reel->shelf.frames - 1, -1, &to, &last));
    struct error *error = album_begin(reel->album, first, last);
    drop_frame(reel, from);
    if (to != from)
        drop_frame(reel, to);
    return error;
}

/* Calls LOOK with the frames of this rank. */
static struct error *each_frame(struct reel *reel,
                                struct error *(*look)(struct album *, const struct frame *))
{
    const struct ranks *ranks = reel->request->ranks;
    struct error *error = NULL;
    for (int i = ranks->rank; i < reel->shelf.frames && !error; i += ranks->size) {
        struct frame *frame;
        error = take_frame(reel, i, &frame);
        if (error || !frame)
            continue;
        error = look(reel->album, frame);
        drop_frame(reel, i);
    }
    error = ranks_agree(ranks, error);
    if (!error)
        album_share(reel->album, ranks);
    return error;
}

static bool is_wanted(const struct pictures_request *request, const char *name)
{
    bool wanted = request->count == 0;
    for (int i = 0; i < request->count; i++)
        wanted |= !strcmp(request->names[i], name);
    return wanted;
}

static struct error *draw_frame(struct reel *reel, int number, int64_t *count)
{
    const struct pictures_request *request = reel->request;
    struct frame *frame;
    TRY(take_frame(reel, number, &frame));
    if (!frame)
        return NULL;
    struct error *error = NULL;
    for (int i = 0; i < album_count(reel->album) && !error; i++) {
        const char *name = album_name(reel->album, i);
        if (!is_wanted(request, name))
            continue;
        char *path =
            text_format("%s%s/%s-%06lld.png", request->into ? request->into : request->folder,
                        request->into ? "" : "/pictures", name, shelf_number(&reel->shelf, number));
        error = path ? album_draw(reel->album, i, frame, path) : out_of_memory_for("pictures");
        if (!error && request->drawn)
            request->drawn(request->context, path);
        *count += !error;
        free(path);
    }
    drop_frame(reel, number);
    return error;
}

static struct error *draw_frames(struct reel *reel, int64_t *count)
{
    const struct pictures_request *request = reel->request;
    const struct ranks *ranks = request->ranks;
    struct error *error = NULL;
    int first = 0, end = reel->shelf.frames;
    if (request->last_alone)
        first = end - 1;
    if (!isnan(request->at)) {
        TRY(ranks_agree(ranks, shelf_find_time(&reel->shelf, request->at, &first)));
        end = first + 1;
    }
    for (int i = first + ranks->rank; i < end && !error; i += ranks->size)
        error = draw_frame(reel, i, count);
    return ranks_agree(ranks, error);
}

struct error *pictures_draw(const struct pictures_request *request, int64_t *count)
{
    const struct ranks *ranks = request->ranks;
    struct reel reel = {0};
    const int threads = request->threads > 0 ? request->threads : omp_get_max_threads();
    struct error *error = album_create(request->input, threads, &reel.album);
    *count = 0;
    if (!error)
        album_set_size(reel.album, request->size);
    error = error_join(error, open_reel(request, &reel));
    error = ranks_agree(ranks, error);
    bool begun = false;
    if (!error && album_count(reel.album))
        error = ranks_agree(ranks, begin_album(&reel, &begun));
    if (!error && begun) {
        error = each_frame(&reel, album_add);
        if (!error && album_measures(reel.album))
            error = each_frame(&reel, album_measure);
        if (!error)
            error = draw_frames(&reel, count);
        *count = ranks_sum(ranks, *count);
    }
    close_reel(&reel);
    return error;
}

static struct error *check_field(const struct population *shown, const char *field, bool fragments)
{
    static const char *const others[] = {"material", "body", "schlieren"};
    const struct column *column;
    int component;
    if (!fragments && !strcmp(field, fragments_column))
        return error_new(ERROR_INPUT, "\"%s\" needs `fragments: yes` beside it", fragments_column);
    for (size_t i = 0; i < COUNT_OF(others); i++)
        if (!strcmp(field, others[i]))
            return NULL;
    TRY(column_choose(shown, field, others, COUNT_OF(others), &column, &component));
    return snapshot_has(shown, column->name)
               ? NULL
               : error_new(ERROR_INPUT, "\"%s\": a gas has no stress but its pressure", field);
}

static struct error *check_bodies(const struct simulation_case *input,
                                  const struct name_list *bodies)
{
    struct error *error = NULL;
    for (int i = 0; i < bodies->count; i++)
        if (named_map_find(&input->bodies, bodies->names[i]) < 0)
            error = error_join(
                error, error_new(ERROR_INPUT, "there is no body \"%.60s\"", bodies->names[i]));
    return error;
}

struct error *pictures_check(const struct simulation *simulation, const struct population *shown,
                             bool fragments)
{
    const struct simulation_case *input = simulation->problem->input;
    const struct named_map *pictures = &input->output.pictures;
    const struct picture_input *items = pictures->items;
    struct error *all = NULL;
    for (int i = 0; i < pictures->count; i++) {
        const struct name_list panels = album_panels(input, i);
        struct error *mistake = error_join(check_bodies(input, &items[i].bodies),
                                           check_bodies(input, &items[i].without));
        for (int k = 0; k < panels.count; k++) {
            mistake = error_join(mistake, check_field(shown, panels.names[k], fragments));
            if (!strcmp(panels.names[k], "schlieren"))
                mistake = error_join(mistake, check_field(shown, items[i].schlieren.field, true));
        }
        if (!mistake)
            continue;
        char key[128];
        snprintf(key, sizeof key, "pictures.%.100s", pictures->names[i]);
        all = error_join(all, input_error(input, "output", key, "%s", error_message(mistake, 0)));
        error_free(mistake);
    }
    return all;
}

struct error *pictures_drop_snapshots(const char *folder)
{
    struct shelf shelf;
    struct error *error = shelf_open(folder, &shelf);
    for (int i = 0; i < shelf.count && !error; i++) {
        char *path = path_join(shelf.folder, shelf.names[i]);
        if (path)
            unlink(path);
        free(path);
    }
    shelf_free(&shelf);
    return error;
}
