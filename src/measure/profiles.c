/* Binned profiles; see profiles.h. Every particle counts once; sums are exact, so that a profile is
 * the same for any order of the particles. */
#include "measure/profiles.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/csv.h"
#include "base/file.h"
#include "base/memory.h"
#include "shape/shape.h"

/* A mistake at KEY of profile NAME. */
static struct error *wrong(const struct simulation *simulation, const char *name, const char *key,
                           const char *text)
{
    char *path = text_format("%s.%s", name, key);
    struct error *error =
        path ? input_error(simulation->problem->input, "profiles", path, "%s", text)
             : out_of_memory_for("a profile");
    free(path);
    return error;
}

/* The ends of the bins at the start: those of `between`, or of all bodies. */
static void find_ends(const struct profile_input *input, const struct simulation_case *of,
                      double *low, double *high)
{
    const bool given = input->between.count == 2;
    *low = given ? input->between.at[0] : (double)INFINITY;
    *high = given ? input->between.at[1] : -(double)INFINITY;
    for (int b = 0; b < of->bodies.count && !given; b++) {
        const struct bounds bounds = shape_bounds(&case_body(of, b)->shape);
        *low = minimum(*low, vec3_at(bounds.low, input->along));
        *high = maximum(*high, vec3_at(bounds.high, input->along));
    }
}

/* Bins in all groups together; their sums take some hundred bytes each. */
static const double places_limit = 2e6;

static int groups_of(const struct profile *profile, const struct simulation_case *input)
{
    return profile->input->by == PROFILE_BY_MATERIAL ? input->materials.count
           : profile->input->by == PROFILE_BY_BODY   ? input->bodies.count
                                                     : 1;
}

static struct error *check_bins(const struct profile *profile, const struct simulation *simulation)
{
    const struct profile_input *input = profile->input;
    const bool of_width = !isnan(input->width);
    double low = 0.0, high = 0.0;
    if (of_width)
        find_ends(input, simulation->problem->input, &low, &high);
    const double bins = of_width ? ceil((high - low) / input->width) : (double)input->bins;
    const double places = bins * groups_of(profile, simulation->problem->input);
    char text[128];
    if (bins > PROFILE_BINS)
        snprintf(text, sizeof text, "%.3g bins over %.6g m are more than %d", bins, high - low,
                 PROFILE_BINS);
    else if (places > places_limit)
        snprintf(text, sizeof text, "%.3g bins for all that `by` tells apart are more than %.0f",
                 places, places_limit);
    else
        return NULL;
    return wrong(simulation, profile->name, of_width ? "width" : "bins", text);
}

static struct error *prepare(struct profile *profile, const struct simulation *simulation,
                             const struct population *population)
{
    population = simulation_seen(simulation, profile->input->of, population);
    TRY(simulation_check_of(simulation, "profiles", profile->name, profile->input->of));
    struct error *told = NULL,
                 *error = fields_choose(population, &profile->input->fields,
                                        simulation->problem->dimension, &profile->fields);
    for (int i = 0; error && i < error_count(error); i++)
        told =
            error_join(told, wrong(simulation, profile->name, "fields", error_message(error, i)));
    error_free(error);
    profile->body = case_find_body(simulation->problem->input, profile->input->of);
    return error_join(told, check_bins(profile, simulation));
}

struct error *profiles_prepare(const struct simulation *simulation,
                               const struct population *population, struct profiles *profiles)
{
    const struct named_map *given = &simulation->problem->input->profiles;
    struct error *error = NULL;
    *profiles = (struct profiles){
        given->count, memory_allocate(((size_t)given->count + 1) * sizeof *profiles->item)};
    if (!profiles->item)
        return out_of_memory_for("a profile");
    for (int i = 0; i < given->count; i++) {
        struct profile *profile = &profiles->item[i];
        profile->name = given->names[i];
        profile->input = case_profile(simulation->problem->input, i);
        error = error_join(error, prepare(profile, simulation, population));
    }
    return error;
}

void profiles_free(struct profiles *profiles)
{
    free(profiles->item);
    *profiles = (struct profiles){0, NULL};
}

/* Which bin and which group each particle belongs to; bins of one group follow each other. */
struct sorting {
    double low, width;
    int groups;
    int64_t bins, places; /* bins of a group; of all */
    int64_t *place;       /* of each particle; -1: none */
    int64_t *count;       /* of the particles of each place */
    int64_t particles;    /* of this rank */
};

static void sorting_free(struct sorting *sorting)
{
    free(sorting->place);
    free(sorting->count);
}

static bool is_seen(const struct profile *profile, const struct population *particles,
                    int32_t index)
{
    const struct profile_input *input = profile->input;
    double at = particles->position[index][input->along];
    return population_has(particles, index) &&
           (profile->body < 0 || particles->body[index] == profile->body) &&
           (input->between.count != 2 ||
            (at >= input->between.at[0] && at <= input->between.at[1]));
}

/* The bins: over `between`, or over the particles; of `width`, then its multiples, or `bins` of
 * them. */
static void lay_bins(const struct profile *profile, const struct simulation *simulation,
                     const struct population *particles, struct sorting *sorting)
{
    const struct profile_input *input = profile->input;
    double low = INFINITY, high = -INFINITY;
    for (int32_t i = 0; i < particles->count; i++)
        if (is_seen(profile, particles, i)) {
            low = minimum(low, particles->position[i][input->along]);
            high = maximum(high, particles->position[i][input->along]);
        }
    low = ranks_minimum(simulation->ranks, low);
    high = ranks_maximum(simulation->ranks, high);
    if (input->between.count == 2) {
        low = input->between.at[0];
        high = input->between.at[1];
    } else if (!isnan(input->width))
        low = floor(low / input->width) * input->width;
    double bins =
        isnan(input->width) ? (double)input->bins : floor((high - low) / input->width + 1.0);
    bool any = low <= high;
    sorting->bins = any ? (int64_t)minimum(bins, PROFILE_BINS) : 0;
    sorting->low = low;
    sorting->width = isnan(input->width) ? (high - low) / bins : input->width;
}

static int group_of(const struct profile *profile, const struct population *particles,
                    int32_t index)
{
    return profile->input->by == PROFILE_BY_MATERIAL ? particles->material[index]
           : profile->input->by == PROFILE_BY_BODY   ? particles->body[index]
                                                     : 0;
}

static int64_t place_of(const struct profile *profile, const struct population *particles,
                        const struct sorting *sorting, int32_t index)
{
    double from_low = particles->position[index][profile->input->along] - sorting->low;
    double bin = sorting->width > 0.0 ? floor(from_low / sorting->width) : 0.0;
    /* What stands on the high end belongs to the last bin. */
    if (isnan(profile->input->width))
        bin = minimum(bin, (double)sorting->bins - 1.0);
    if (!is_seen(profile, particles, index) || !(bin < (double)sorting->bins))
        return -1;
    return group_of(profile, particles, index) * sorting->bins + (int64_t)bin;
}

static struct error *sort(const struct profile *profile, const struct simulation *simulation,
                          const struct population *particles, struct sorting *sorting)
{
    lay_bins(profile, simulation, particles, sorting);
    sorting->particles = particles->count;
    sorting->groups = groups_of(profile, simulation->problem->input);
    sorting->places = sorting->groups * sorting->bins;
    sorting->place = memory_allocate(((size_t)particles->count + 1) * sizeof *sorting->place);
    sorting->count = memory_allocate(((size_t)sorting->places + 1) * sizeof *sorting->count);
    TRY(ranks_agree(simulation->ranks,
                    sorting->place && sorting->count ? NULL : out_of_memory_for("a profile")));
    for (int32_t i = 0; i < particles->count; i++) {
        sorting->place[i] = place_of(profile, particles, sorting, i);
        if (sorting->place[i] >= 0)
            sorting->count[sorting->place[i]]++;
    }
    ranks_sum_of(simulation->ranks, sorting->count, (int)sorting->places);
    return NULL;
}

/* The columns of one field. */
struct scatter {
    double mean, spread, low, high;
};

/* Sums the values, or with the means known the squares of their distances from them, by place. */
static void sum_up(const struct simulation *simulation, const struct sorting *sorting,
                   const double *value, const struct scatter *mean, struct exact_sum *sums)
{
    memset(sums, 0, (size_t)sorting->places * sizeof *sums);
    for (int32_t i = 0; i < sorting->particles; i++) {
        int64_t k = sorting->place[i];
        if (k >= 0)
            exact_sum_add(&sums[k], mean ? square(value[i] - mean[k].mean) : value[i]);
    }
    ranks_sum_exact(simulation->ranks, sums, (int)sorting->places);
}

/* ENDS has room for two numbers a place. */
static void find_scatter(const struct simulation *simulation, const struct sorting *sorting,
                         const double *value, struct exact_sum *sums, double *ends,
                         struct scatter *scatter)
{
    for (int64_t k = 0; k < 2 * sorting->places; k++)
        ends[k] = -INFINITY;
    sum_up(simulation, sorting, value, NULL, sums);
    for (int64_t k = 0; k < sorting->places; k++)
        scatter[k].mean = exact_sum_value(&sums[k]) / (double)sorting->count[k];
    sum_up(simulation, sorting, value, scatter, sums);
    for (int32_t i = 0; i < sorting->particles; i++) {
        int64_t k = sorting->place[i];
        if (k < 0)
            continue;
        ends[2 * k] = maximum(ends[2 * k], -value[i]);
        ends[2 * k + 1] = maximum(ends[2 * k + 1], value[i]);
    }
    ranks_maximum_of(simulation->ranks, ends, 2 * (int)sorting->places);
    for (int64_t k = 0; k < sorting->places; k++) {
        bool any = sorting->count[k] > 0;
        scatter[k].spread = sqrt(exact_sum_value(&sums[k]) / (double)sorting->count[k]);
        scatter[k].low = any ? -ends[2 * k] : NAN;
        scatter[k].high = any ? ends[2 * k + 1] : NAN;
    }
}

/* The scatter of all fields, one behind the other. */
static struct error *find_all(const struct profile *profile, const struct simulation *simulation,
                              const struct population *population, const struct sorting *sorting,
                              struct scatter *scatter)
{
    const int32_t count = population->count;
    double *value = memory_allocate(((size_t)count + 1) * sizeof *value);
    struct exact_sum *sums = memory_allocate(((size_t)sorting->places + 1) * sizeof *sums);
    double *ends = memory_allocate((2 * (size_t)sorting->places + 1) * sizeof *ends);
    struct error *error = ranks_agree(
        simulation->ranks, value && sums && ends ? NULL : out_of_memory_for("a profile"));
    for (int i = 0; i < profile->fields.count && !error; i++) {
        const struct chosen_field *field = &profile->fields.field[i];
        column_read_component(population, &population->column[field->column], field->component, 0,
                              count, value);
        find_scatter(simulation, sorting, value, sums, ends, scatter + i * sorting->places);
    }
    free(value);
    free(sums);
    free(ends);
    return error;
}

static void put_heads(FILE *file, const struct profile *profile)
{
    static const char *const groups[] = {"", "material,", "body,"};
    static const char *const axes[] = {"x", "y", "z"}, *const parts[] = {"mean", "spread", "min",
                                                                         "max"};
    fputs(groups[profile->input->by], file);
    csv_put_head(file, axes[profile->input->along], "m");
    fputs(",particles", file);
    for (int i = 0; i < profile->fields.count; i++)
        for (size_t k = 0; k < COUNT_OF(parts); k++) {
            fprintf(file, ",%s.", profile->fields.field[i].name);
            csv_put_head(file, parts[k], profile->fields.field[i].unit);
        }
    putc('\n', file);
}

static void put_row(FILE *file, const struct profile *profile, const struct sorting *sorting,
                    const struct scatter *scatter, int64_t place)
{
    csv_put_number(file, sorting->low + ((double)(place % sorting->bins) + 0.5) * sorting->width);
    fprintf(file, ",%lld", (long long)sorting->count[place]);
    for (int i = 0; i < profile->fields.count; i++) {
        const struct scatter *s = &scatter[i * sorting->places + place];
        const double numbers[] = {s->mean, s->spread, s->low, s->high};
        for (size_t k = 0; k < COUNT_OF(numbers); k++) {
            putc(',', file);
            csv_put_number(file, numbers[k]);
        }
    }
    putc('\n', file);
}

static bool has_particles(const struct sorting *sorting, int group)
{
    int64_t found = 0;
    for (int64_t bin = 0; bin < sorting->bins; bin++)
        found += sorting->count[group * sorting->bins + bin];
    return found > 0;
}

/* Groups without a particle are left out; the others have a row for each bin. */
static void put_rows(FILE *file, const struct profile *profile, const struct simulation *simulation,
                     const struct sorting *sorting, const struct scatter *scatter)
{
    const struct simulation_case *input = simulation->problem->input;
    char *const *names =
        profile->input->by == PROFILE_BY_MATERIAL ? input->materials.names : input->bodies.names;
    for (int group = 0; group < sorting->groups; group++) {
        if (!has_particles(sorting, group))
            continue;
        for (int64_t bin = 0; bin < sorting->bins; bin++) {
            if (profile->input->by != PROFILE_BY_NOTHING) {
                csv_put_text(file, names[group]);
                putc(',', file);
            }
            put_row(file, profile, sorting, scatter, group * sorting->bins + bin);
        }
    }
}

static struct error *write_one(const struct profile *profile, const struct simulation *simulation,
                               const struct population *population, const char *path)
{
    FILE *file;
    struct sorting sorting = {0};
    population = simulation_seen(simulation, profile->input->of, population);
    struct scatter *scatter = NULL;
    struct error *error = sort(profile, simulation, population, &sorting);
    if (!error) {
        size_t room = (size_t)profile->fields.count * (size_t)sorting.places + 1;
        scatter = memory_allocate(room * sizeof *scatter);
        error = scatter ? find_all(profile, simulation, population, &sorting, scatter)
                        : out_of_memory_for("a profile");
    }
    error = ranks_agree(simulation->ranks, error);
    if (!error && simulation->ranks->rank == 0)
        error = file_begin(path, &file);
    if (!error && simulation->ranks->rank == 0) {
        put_heads(file, profile);
        put_rows(file, profile, simulation, &sorting, scatter);
        error = file_end(path, file);
    }
    free(scatter);
    sorting_free(&sorting);
    return error;
}

struct error *profiles_write(const struct profiles *profiles, const struct simulation *simulation,
                             const struct population *population, const char *folder,
                             int64_t number)
{
    if (profiles->count == 0)
        return NULL;
    char *own = path_join(folder, "profiles");
    struct error *error = !own                           ? out_of_memory_for("a profile")
                          : simulation->ranks->rank == 0 ? folder_make(own)
                                                         : NULL;
    error = ranks_agree(simulation->ranks, error);
    for (int i = 0; i < profiles->count && !error; i++) {
        char *path =
            text_format("%s/%s-%06lld.csv", own, profiles->item[i].name, (long long)number);
        error = ranks_agree(simulation->ranks,
                            path ? file_check_folder(path) : out_of_memory_for("a profile"));
        if (!error)
            error = ranks_agree(simulation->ranks,
                                write_one(&profiles->item[i], simulation, population, path));
        free(path);
    }
    free(own);
    return error;
}
