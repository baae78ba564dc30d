/* Albums: the pictures of a case, and the ranges of their colours; see album.h. */
#include "picture/album.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "picture/album_internal.h"
#include "picture/picture.h"

static const char *const categories[] = {"body", "material", "fragment"};

bool album_is_category(const char *field)
{
    for (size_t i = 0; i < COUNT_OF(categories); i++)
        if (!strcmp(field, categories[i]))
            return true;
    return false;
}

/* Whether the case has no particles: solver gas. */
static bool is_of_gas(const struct simulation_case *input)
{
    return input->solver.choice && !strcmp(input->solver.choice->name, "gas");
}

static const char *standard_name(const struct simulation_case *input)
{
    return is_of_gas(input) ? "pressure" : "body";
}

/* A case that says nothing of pictures; `pictures: []` says that there are none. */
static bool wants_standard(const struct simulation_case *input)
{
    return !input->output.pictures.names && input->dimension > 1;
}

const char *album_name_of(const struct simulation_case *input, int picture)
{
    if (wants_standard(input))
        return picture == 0 ? standard_name(input) : NULL;
    return picture < input->output.pictures.count ? input->output.pictures.names[picture] : NULL;
}

struct name_list album_panels(const struct simulation_case *input, int picture)
{
    if (wants_standard(input))
        return (struct name_list){0};
    const struct picture_input *items = input->output.pictures.items;
    if (items[picture].field.count)
        return items[picture].field;
    return (struct name_list){1, &input->output.pictures.names[picture]};
}

bool picture_has_body(const struct album *album, const struct picture_input *input, int body)
{
    const char *name = body < album->bodies.count ? album->bodies.name[body] : "";
    bool has = input->bodies.count == 0;
    for (int i = 0; i < input->bodies.count; i++)
        has |= !strcmp(input->bodies.names[i], name);
    for (int i = 0; i < input->without.count; i++)
        has &= strcmp(input->without.names[i], name) != 0;
    return has;
}

static void need_field(struct album *album, const char *field)
{
    for (int i = 0; i < album->fields; i++)
        if (!strcmp(album->field[i], field))
            return;
    if (album->fields < FRAME_FIELDS)
        album->field[album->fields++] = field;
}

static void add_panel(struct album *album, struct picture *picture, const char *field)
{
    if (picture->panels == PANELS_MAX)
        return;
    struct panel *panel = &picture->panel[picture->panels++];
    panel->field = field;
    panel->values = panel->extremes = range_empty();
    panel->category = album_is_category(field);
    panel->fragments = !strcmp(field, "fragment");
    panel->schlieren = !strcmp(field, "schlieren");
    if (panel->schlieren)
        panel->field = picture->input->schlieren.field;
    if (!panel->category || panel->fragments)
        need_field(album, panel->field);
}

static void add_picture(struct album *album, const char *name, const struct picture_input *input,
                        struct name_list fields)
{
    struct picture *picture = &album->picture[album->count++];
    picture->name = name;
    picture->input = input;
    picture->view = (struct view){.dimension = album->dimension, .normal = -1};
    for (int i = 0; i < fields.count; i++)
        add_panel(album, picture, fields.names[i]);
    if (!fields.count)
        add_panel(album, picture, name);
}

/* What the keys of a picture are when none is given. */
static struct picture_input standard_input(void)
{
    return (struct picture_input){.view = -1,
                                  .up = -1,
                                  .palette = -1,
                                  .direction = {2, {30.0, 25.0, 0.0}},
                                  .mirror = true,
                                  .outlines = true,
                                  .plane = {{NAN, NAN, NAN}},
                                  .slab = NAN,
                                  .dot = 1.6,
                                  .range = {.low = {.value = NAN},
                                            .high = {.value = NAN},
                                            .percentiles = {2, {0.5, 99.5, 0.0}}}};
}

/* An album without pictures, with room for COUNT. */
static struct error *album_make(const struct simulation_case *input, int threads, int count,
                                struct album **album)
{
    static const char *const always[] = {"velocity.x", "velocity.y",  "velocity.z",
                                         "density",    "sound_speed", "speed"};
    struct album *made = memory_allocate(sizeof *made);
    *album = made;
    if (made)
        made->picture = memory_allocate(((size_t)count + 1) * sizeof *made->picture);
    if (!made || !made->picture)
        return out_of_memory_for("pictures");
    made->input = input;
    made->place = place_whole(input);
    made->threads = threads;
    made->dimension = (int)input->dimension;
    made->gas_alone = is_of_gas(input);
    made->standard = standard_input();
    for (size_t i = 0; i < COUNT_OF(always); i++)
        need_field(made, always[i]);
    return NULL;
}

struct error *album_create(const struct simulation_case *input, int threads, struct album **album)
{
    const struct picture_input *items = input->output.pictures.items;
    TRY(album_make(input, threads, input->output.pictures.count, album));
    for (int i = 0; album_name_of(input, i); i++)
        add_picture(*album, album_name_of(input, i),
                    wants_standard(input) ? &(*album)->standard : &items[i],
                    album_panels(input, i));
    return NULL;
}

void album_set_size(struct album *album, const int size[2])
{
    album->size[0] = size[0];
    album->size[1] = size[1];
}

struct error *album_create_plain(const struct simulation_case *input, const char *const *fields,
                                 int count, struct album **album)
{
    TRY(album_make(input, 1, count, album));
    for (int i = 0; i < count; i++)
        add_picture(*album, fields[i], &(*album)->standard, (struct name_list){0});
    return NULL;
}

void album_free(struct album *album)
{
    if (!album)
        return;
    frame_names_free(&album->bodies);
    frame_names_free(&album->materials);
    free(album->stretch);
    free(album->picture);
    free(album);
}

int album_count(const struct album *album) { return album->count; }

const char *album_name(const struct album *album, int picture)
{
    return album->picture[picture].name;
}

const char *const *album_fields(const struct album *album, int *count)
{
    *count = album->fields;
    return album->field;
}

struct error *album_begin(struct album *album, const struct frame *first, const struct frame *last)
{
    TRY(frame_names_copy(&first->bodies, &album->bodies));
    TRY(frame_names_copy(&first->materials, &album->materials));
    TRY(stretch_find(album, first, &album->stretch));
    for (int i = 0; i < album->count; i++)
        TRY(error_context(view_find(album, first, last, &album->picture[i]), "picture \"%s\"",
                          album->picture[i].name));
    return NULL;
}

/* What a difference of values is small against: their magnitude; of pressures the modulus. */
static double magnitude_of(const struct frame_group *group, const struct panel *panel)
{
    const struct frame_field *density = frame_field(group, "density");
    const struct frame_field *sound = frame_field(group, "sound_speed");
    double largest = 0.0;
    if (strcmp(panel->unit, "Pa") != 0 || !density || !sound)
        return 0.0;
    for (int64_t i = 0; i < group->count; i++) {
        const double modulus = density->value[i] * square(sound->value[i]);
        largest = isfinite(modulus) ? maximum(largest, modulus) : largest;
    }
    return largest;
}

static struct error *add_values(struct album *album, const struct picture *picture,
                                struct panel *panel, const struct frame_group *group)
{
    const struct frame_field *field = frame_field(group, panel->field);
    const struct vector_value *part = &picture->input->range.percentiles;
    const bool apart = album->bodies.count <= BODIES_APART;
    if (!field || !group->count)
        return NULL;
    snprintf(panel->unit, sizeof panel->unit, "%s", field->unit);
    uint8_t *body = memory_allocate((size_t)group->count + 1);
    float *mass = memory_allocate((size_t)group->count * sizeof *mass + 1);
    struct error *error = body && mass ? NULL : out_of_memory_for("pictures");
    for (int64_t i = 0; i < group->count && !error; i++) {
        body[i] = group->cell_dimension ? 255 : apart ? (uint8_t)group->body[i] : 0;
        mass[i] = picture_has_body(album, picture->input, group->body[i]) ? group->mass[i] : NAN;
    }
    if (!error)
        error = spread_find(
            field->value, mass, body, group->count, part->count > 0 ? 0.01 * part->at[0] : 0.0,
            part->count > 1 ? 0.01 * part->at[1] : 1.0, &panel->values, &panel->extremes);
    panel->magnitude = maximum(panel->magnitude, magnitude_of(group, panel));
    free(body);
    free(mass);
    return error;
}

struct error *album_add(struct album *album, const struct frame *frame)
{
    for (int g = 0; g < frame->groups; g++) {
        const struct frame_group *group = &frame->group[g];
        for (int64_t i = 0; i < group->count; i++) {
            album->present[0][group->body[i] & 255] = true;
            album->present[1][group->material[i] & 255] = true;
        }
        for (int i = 0; i < album->count; i++)
            for (int k = 0; k < album->picture[i].panels; k++) {
                struct panel *panel = &album->picture[i].panel[k];
                if (!panel->category || panel->fragments)
                    TRY(add_values(album, &album->picture[i], panel, group));
            }
    }
    return NULL;
}

/* Peaks of a blast fall by decades. */
static bool is_map_of_peaks(const char *field)
{
    static const char start[] = "peak_";
    return !strncmp(field, start, sizeof start - 1);
}

/* The colours of a panel, once its ranges are those of the run. */
static void choose_colours(const struct picture_input *input, struct panel *panel)
{
    struct range range = panel->values;
    const double reach = maximum(range_reach(panel->extremes), panel->magnitude);
    const bool given = !isnan(input->range.low.value) || !isnan(input->range.high.value);
    /* single precision has seven digits */
    const double least = panel->magnitude > 0.0 ? 1e-9 * panel->magnitude : 2e-7 * reach;
    if (!(range.low <= range.high))
        range = (struct range){0.0, 1.0};
    if (range.high - range.low <= least && panel->extremes.high - panel->extremes.low > least)
        range = panel->extremes; /* what is there is in strays alone */
    panel->uniform = !given && !(range.high - range.low > least);
    if (panel->uniform)
        range.low = range.high = 0.5 * (range.low + range.high);
    if (!isnan(input->range.low.value))
        range.low = input->range.low.value;
    if (!isnan(input->range.high.value))
        range.high = input->range.high.value;
    if (range.high < range.low)
        range.high = range.low;
    panel->scale = input->log || is_map_of_peaks(panel->field) ? colour_scale_logarithmic(range)
                                                               : colour_scale_make(range);
    if (!strcmp(panel->unit, "s")) /* a time has no middle */
        colour_scale_choose(&panel->scale, false, false);
    if (input->palette >= 0)
        colour_scale_choose(&panel->scale, input->palette == PALETTE_DIVERGING,
                            input->palette == PALETTE_GREY);
}

void album_share(struct album *album, const struct ranks *ranks)
{
    double present[512];
    for (int i = 0; i < 512; i++)
        present[i] = album->present[i / 256][i % 256];
    ranks_maximum_of(ranks, present, 512);
    for (int i = 0; i < 512; i++)
        album->present[i / 256][i % 256] = present[i] > 0.0;
    for (int i = 0; i < album->count; i++)
        for (int k = 0; k < album->picture[i].panels; k++) {
            struct panel *panel = &album->picture[i].panel[k];
            panel->values = range_of_all(ranks, panel->values);
            panel->extremes = range_of_all(ranks, panel->extremes);
            panel->magnitude = ranks_maximum(ranks, panel->magnitude);
            panel->steepest = ranks_maximum(ranks, panel->steepest);
            choose_colours(album->picture[i].input, panel);
        }
}

bool album_measures(const struct album *album)
{
    bool any = false;
    for (int i = 0; i < album->count; i++)
        for (int k = 0; k < album->picture[i].panels; k++)
            any |= album->picture[i].panel[k].schlieren;
    return any && album->dimension > 1;
}

struct error *album_measure(struct album *album, const struct frame *frame)
{
    for (int i = 0; i < album->count; i++)
        for (int k = 0; k < album->picture[i].panels; k++) {
            struct panel *panel = &album->picture[i].panel[k];
            double steepest = 0.0;
            if (panel->schlieren)
                TRY(sheet_measure(album, &album->picture[i], panel, frame, &steepest));
            panel->steepest = maximum(panel->steepest, steepest);
        }
    return NULL;
}

struct error *album_draw(const struct album *album, int picture, const struct frame *frame,
                         const char *path)
{
    const struct picture *drawn = &album->picture[picture];
    return album->dimension == 1 ? line_draw(album, drawn, frame, path)
                                 : sheet_draw(album, drawn, frame, path);
}

void album_space(const struct album *album, struct album_space *space)
{
    const struct view *view = &album->picture[0].view;
    *space = (struct album_space){.dimension = album->dimension,
                                  .up = view->up,
                                  .up_sign = view->up_sign,
                                  .diameter = view->diameter,
                                  .bodies = &album->bodies};
    for (int axis = 0; axis < 3; axis++) {
        space->computed[axis] =
            (struct album_range){view->computed[axis].low, view->computed[axis].high, NULL};
        space->mirrored[axis] = view->mirrored[axis];
        space->mirror_at[axis] = view->mirror_at[axis];
    }
    for (int k = 0; k < view->cuts; k++) {
        const size_t used = strlen(space->cut);
        snprintf(space->cut + used, sizeof space->cut - used, "%c%c",
                 view->cut[k].sign > 0.0 ? '+' : '-', "xyz"[view->cut[k].axis]);
    }
}

bool album_range(const struct album *album, int picture, struct album_range *range)
{
    const struct panel *panel = &album->picture[picture].panel[0];
    *range = (struct album_range){panel->scale.range.low, panel->scale.range.high, panel->unit};
    return !panel->category && panel->extremes.low <= panel->extremes.high;
}
