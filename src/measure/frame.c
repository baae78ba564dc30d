/* Frames: their order and memory; see frame.h. */
#include "measure/frame.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "particle/radix.h"

void frame_names_free(struct frame_names *names)
{
    for (int i = 0; i < names->count; i++)
        free(names->name[i]);
    free(names->name);
}

struct error *frame_names_copy(const struct frame_names *from, struct frame_names *to)
{
    to->name = calloc((size_t)from->count + 1, sizeof *to->name);
    if (!to->name)
        return out_of_memory_for("pictures");
    for (int i = 0; i < from->count; i++) {
        to->name[i] = text_copy(from->name[i] ? from->name[i] : "?");
        to->count += to->name[i] != NULL;
    }
    return NULL;
}

static void group_free(struct frame_group *group)
{
    free(group->id);
    free(group->body);
    free(group->material);
    free(group->position);
    free(group->diameter);
    free(group->mass);
    for (int i = 0; i < group->fields; i++)
        free(group->field[i].value);
}

void frame_free(struct frame *frame)
{
    frame_names_free(&frame->bodies);
    frame_names_free(&frame->materials);
    for (int i = 0; i < frame->groups; i++)
        group_free(&frame->group[i]);
    *frame = (struct frame){0};
}

/* Puts the COUNT elements of BYTES at *ARRAY in the ORDER; false when memory is out. */
static bool permute(void **array, size_t bytes, const struct keyed *order, int64_t count)
{
    char *sorted = memory_allocate((size_t)count * bytes + 1);
    if (!sorted)
        return false;
    for (int64_t i = 0; i < count; i++)
        memcpy(sorted + (size_t)i * bytes, (char *)*array + (size_t)order[i].index * bytes, bytes);
    free(*array);
    *array = sorted;
    return true;
}

static bool is_drawn(const struct frame_group *group, int64_t i)
{
    const float *x = group->position[i];
    return isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]) && group->diameter[i] > 0.0f &&
           isfinite(group->diameter[i]) && !(group->mass[i] == 0.0f);
}

struct error *frame_order(struct frame_group *group)
{
    const size_t room = (size_t)group->count;
    struct keyed *order = memory_allocate((2 * room + 1) * sizeof *order);
    if (!order)
        return out_of_memory_for("a picture");
    int64_t count = 0;
    for (int64_t i = 0; i < group->count; i++)
        if (is_drawn(group, i))
            order[count++] = (struct keyed){group->id[i], (int32_t)i};
    radix_sort(order, order + room, count, 1);
    bool done = permute((void **)&group->id, sizeof *group->id, order, count) &&
                permute((void **)&group->body, sizeof *group->body, order, count) &&
                permute((void **)&group->material, sizeof *group->material, order, count) &&
                permute((void **)&group->position, sizeof *group->position, order, count) &&
                permute((void **)&group->diameter, sizeof *group->diameter, order, count) &&
                permute((void **)&group->mass, sizeof *group->mass, order, count);
    for (int k = 0; k < group->fields && done; k++)
        done = permute((void **)&group->field[k].value, sizeof(float), order, count);
    free(order);
    group->count = count;
    return done ? NULL : out_of_memory_for("a picture");
}

const struct frame_field *frame_field(const struct frame_group *group, const char *name)
{
    for (int i = 0; i < group->fields; i++)
        if (!strcmp(group->field[i].name, name))
            return &group->field[i];
    return NULL;
}

int64_t frame_members(const struct frame *frame)
{
    int64_t count = 0;
    for (int i = 0; i < frame->groups; i++)
        count += frame->group[i].count;
    return count;
}

int64_t frame_bytes(const struct frame *frame)
{
    const struct frame_group *group = frame->group;
    int64_t bytes = 0;
    for (int i = 0; i < frame->groups; i++, group++)
        bytes += group->count *
                 (int64_t)(sizeof *group->id + sizeof *group->body + sizeof *group->material +
                           sizeof *group->position + sizeof *group->diameter + sizeof *group->mass +
                           (size_t)group->fields * sizeof(float));
    return bytes;
}
