/* In 1-D: a field over x, as dots, with the axes of the whole run. */
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "picture/album_internal.h"
#include "picture/picture.h"

struct error *line_draw(const struct album *album, const struct picture *picture,
                        const struct frame *frame, const char *path)
{
    const struct panel *panel = &picture->panel[0];
    const struct simulation_case *input = album->input;
    struct scene scene;
    struct scatter scatter;
    int64_t outside;
    char time[UNIT_TEXT], note[UNIT_TEXT + 8], name[LABEL_TEXT];
    struct error *error = scene_take(album, picture, panel, frame, &scene, &outside);
    if (!scatter_allocate(&scatter, scene.count) && !error)
        error = out_of_memory_for("a picture");
    for (int64_t i = 0; i < scene.count && !error; i++) {
        scatter.x[i] = scene.item[i].place[0];
        scatter.y[i] = scene.item[i].value;
    }
    if (!error) {
        const struct ranks alone = ranks_alone();
        error = scatter_gather(&alone, &scatter);
    }
    multiple_text(frame->time, "s", time, sizeof time);
    snprintf(note, sizeof note, "t = %s", time);
    field_text(panel->field, name, sizeof name);
    const struct range categories = {-0.5, album->bodies.count + album->materials.count};
    const struct range all =
        panel->category ? categories
                        : range_padded(range_drawable(panel->extremes, false), 0.05, false);
    const struct series series = {.count = scatter.count, .x = scatter.x, .y = scatter.y};
    const struct plot plot = {.title = input->title ? input->title : input->name,
                              .x_name = "x",
                              .x_unit = "m",
                              .y_name = name,
                              .y_unit = panel->unit,
                              .count = 1,
                              .series = &series,
                              .note = note,
                              .own_folder = true,
                              .frame = true,
                              .x_low = picture->view.window[0].low,
                              .x_high = picture->view.window[0].high,
                              .y_low = all.low,
                              .y_high = all.high};
    if (!error)
        error = picture_plot(path, &plot);
    scatter_free(&scatter);
    free(scene.item);
    return error;
}
