/* Snapshots in a folder; see shelf.h. */
#include "output/shelf.h"

#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"
#include "output/snapshot_read.h"

static bool is_frame(const char *name)
{
    const size_t digits = strspn(name, "0123456789");
    return digits >= 6 && !strcmp(name + digits, ".vtkhdf");
}

static int by_number(const void *a, const void *b)
{
    const char *x = *(char *const *)a, *y = *(char *const *)b;
    const long long m = strtoll(x, NULL, 10), n = strtoll(y, NULL, 10);
    return m != n                       ? (m > n) - (m < n)
           : is_frame(x) != is_frame(y) ? (is_frame(x) ? -1 : 1)
                                        : strcmp(x, y);
}

void shelf_free(struct shelf *shelf)
{
    names_free(shelf->names, shelf->count);
    free(shelf->begin);
    free(shelf->folder);
}

struct error *shelf_open(const char *folder, struct shelf *shelf)
{
    *shelf = (struct shelf){.folder = path_join(folder, "snapshots")};
    TRY(shelf->folder ? folder_names(shelf->folder, ".vtkhdf", &shelf->names, &shelf->count)
                      : out_of_memory_for("pictures"));
    shelf->begin = memory_allocate(((size_t)shelf->count + 2) * sizeof *shelf->begin);
    if (!shelf->begin)
        return out_of_memory_for("pictures");
    int kept = 0;
    for (int i = 0; i < shelf->count; i++) { /* failed.vtkhdf is no frame */
        char *name = shelf->names[i];
        if (name[0] >= '0' && name[0] <= '9')
            shelf->names[kept++] = name;
        else
            free(name);
    }
    shelf->count = kept;
    if (kept > 1)
        qsort(shelf->names, (size_t)kept, sizeof *shelf->names, by_number);
    for (int i = 0; i < kept; i++)
        if (is_frame(shelf->names[i]))
            shelf->begin[shelf->frames++] = i;
    shelf->begin[shelf->frames] = kept;
    return NULL;
}

long long shelf_number(const struct shelf *shelf, int frame)
{
    return strtoll(shelf->names[shelf->begin[frame]], NULL, 10);
}

struct error *shelf_read(const struct shelf *shelf, int number, const char *const *fields,
                         int count, struct frame *frame)
{
    struct error *error = NULL;
    *frame = (struct frame){0};
    for (int i = shelf->begin[number]; i < shelf->begin[number + 1] && !error; i++) {
        char *path = path_join(shelf->folder, shelf->names[i]);
        error = path ? snapshot_read(path, fields, count, frame) : out_of_memory_for("pictures");
        free(path);
    }
    if (error)
        frame_free(frame);
    return error;
}

struct error *shelf_find_time(const struct shelf *shelf, double time, int *number)
{
    double least = INFINITY;
    for (int i = 0; i < shelf->frames; i++) {
        struct frame frame = {0};
        char *path = path_join(shelf->folder, shelf->names[shelf->begin[i]]);
        struct error *error =
            path ? snapshot_read(path, NULL, 0, &frame) : out_of_memory_for("pictures");
        free(path);
        if (!error && fabs(frame.time - time) < least) {
            least = fabs(frame.time - time);
            *number = i;
        }
        frame_free(&frame);
        if (error)
            return error;
    }
    return NULL;
}
