/* The options of the commands, each declared once. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/memory.h"
#include "cli/cli.h"

enum option_kind { OPTION_FLAG, OPTION_COUNT, OPTION_THREADS, OPTION_TEXT, OPTION_LIST };

struct option {
    const char *name, *value, *help;
    enum option_kind kind;
    size_t offset;
    unsigned commands;
};

/* More threads than a machine has processors; libgomp ends the program when it cannot have them. */
enum { THREADS_MOST = 1024, COUNT_MOST = 1000000 };

#define AT(member) offsetof(struct cli_options, member)

static const struct option option_table[] = {
    {"--output", "DIR", "folder of the results (default: results/<name of the case>)", OPTION_TEXT,
     AT(output), COMMAND_RUN},
    {"--output", "DIR", "folder of the results (default: none are written)", OPTION_TEXT,
     AT(output), COMMAND_VERIFY},
    {"--output", "DIR", "folder of the results (default: results/<name of the case>-search)",
     OPTION_TEXT, AT(output), COMMAND_SEARCH},
    {"--output", "DIR", "folder of the results (default: results/<name of the case>-calibrate)",
     OPTION_TEXT, AT(output), COMMAND_CALIBRATE},
    {"--overwrite", NULL, "replace the results in the folder", OPTION_FLAG, AT(overwrite),
     COMMAND_RUN | COMMAND_VERIFY | COMMAND_SEARCH | COMMAND_CALIBRATE},
    {"--resume", NULL, "continue from the last checkpoint in the folder of the results",
     OPTION_FLAG, AT(resume), COMMAND_RUN | COMMAND_SEARCH | COMMAND_CALIBRATE},
    {"--change", NULL,
     "with --resume: continue with other loads, boundaries and the like (`bolide help case` marks "
     "them `from here`)",
     OPTION_FLAG, AT(change), COMMAND_RUN},
    {"--threads", "N", "largest number of threads (default: all processors; of a forecast: 1)",
     OPTION_THREADS, AT(threads),
     COMMAND_RUN | COMMAND_CHECK | COMMAND_VERIFY | COMMAND_SEARCH | COMMAND_CALIBRATE |
         COMMAND_PICTURE},
    {"--ranks", "N",
     "number of processes that compute a case together; Bolide starts mpirun itself (default: 1)",
     OPTION_COUNT, AT(ranks_wanted),
     COMMAND_RUN | COMMAND_VERIFY | COMMAND_SEARCH | COMMAND_CALIBRATE},
    {"--set", "PATH=VALUE",
     "replace a value of the case: run.until=3us; without a value, remove the key; may be repeated",
     OPTION_LIST, AT(settings),
     COMMAND_RUN | COMMAND_CHECK | COMMAND_VERIFY | COMMAND_EXACT | COMMAND_SEARCH |
         COMMAND_CALIBRATE | COMMAND_PICTURE},
    {"--output", "FILE", "the page (default: view.html in the folder)", OPTION_TEXT, AT(output),
     COMMAND_VIEW},
    {"--output", "DIR", "folder of the page (default: compare)", OPTION_TEXT, AT(output),
     COMMAND_COMPARE},
    {"--data", "FILE,KEY=...",
     "a measured series: test.csv,time=t_us:us,value=stress_GPa:GPa,probe=gauge,field=pressure,"
     "shift=20ns; may be repeated",
     OPTION_LIST, AT(data), COMMAND_COMPARE},
    {"--fields", "A,B",
     "fields that the page has beside the bodies (default: those of the pictures, speed, pressure)",
     OPTION_TEXT, AT(fields), COMMAND_VIEW},
    {"--frames", "N", "largest number of snapshots on the page (default: 40)", OPTION_COUNT,
     AT(frames), COMMAND_VIEW},
    {"--limit", "SIZE",
     "largest size of the page (default: 20MB): it gets fewer snapshots, then fewer particles",
     OPTION_TEXT, AT(limit), COMMAND_VIEW},
    {"--format", "mp4|webm|apng", "of the film (default: mp4, without ffmpeg apng)", OPTION_TEXT,
     AT(format), COMMAND_FILM},
    {"--rate", "N", "frames a second (default: 10)", OPTION_TEXT, AT(rate), COMMAND_FILM},
    {"--size", "WIDTHxHEIGHT",
     "of the pictures or the film, in pixels (default: as the pictures need)", OPTION_TEXT,
     AT(size), COMMAND_PICTURE | COMMAND_FILM},
    {"--at", "TIME|last|all",
     "the moment to draw, 2us: the snapshot that is nearest (default: all)", OPTION_TEXT, AT(at),
     COMMAND_PICTURE},
    {"--short", NULL, "replace keys of the case by those in its section `short`, for a quick run",
     OPTION_FLAG, AT(quick),
     COMMAND_RUN | COMMAND_CHECK | COMMAND_VERIFY | COMMAND_EXACT | COMMAND_SEARCH |
         COMMAND_CALIBRATE},
    {"--long", NULL, "replace keys of the case by those in its section `long`, for an accurate run",
     OPTION_FLAG, AT(thorough),
     COMMAND_RUN | COMMAND_CHECK | COMMAND_VERIFY | COMMAND_EXACT | COMMAND_SEARCH |
         COMMAND_CALIBRATE},
    {"--all", NULL, "all cases that come with bolide", OPTION_FLAG, AT(all), COMMAND_VERIFY},
    {"--convergence", NULL,
     "study the errors of each case on several resolutions, into results/<its name>; with --all "
     "those that have `convergence`",
     OPTION_FLAG, AT(convergence), COMMAND_VERIFY},
    {"--pilot", NULL,
     "run the case with coarser particles or cells for up to 40 s, and forecast steps and time "
     "from that",
     OPTION_FLAG, AT(pilot), COMMAND_CHECK},
    {"--force", NULL, "accept a run that needs more memory than the machine has", OPTION_FLAG,
     AT(force), COMMAND_RUN | COMMAND_CHECK | COMMAND_VERIFY | COMMAND_SEARCH | COMMAND_CALIBRATE},
    {"--record", NULL,
     "store the measured values in results.csv beside each case; rows of runs with other options "
     "are kept",
     OPTION_FLAG, AT(record), COMMAND_VERIFY},
    {"--compare-record", NULL,
     "fail if a measured value differs from the one in results.csv beside the case", OPTION_FLAG,
     AT(compare), COMMAND_VERIFY},
    {"--time", "T", "the time of the solution, with its unit: 5us; default for a CASE: its end",
     OPTION_TEXT, AT(time), COMMAND_EXACT},
    {"--points", "N", "print the profile at the time in N points, as CSV", OPTION_COUNT, AT(points),
     COMMAND_EXACT},
    {"--curves", NULL, "print isentropes and shock adiabats of the material as CSV", OPTION_FLAG,
     AT(curves), COMMAND_MATERIALS},
    {"--key", "PATH", "the key to vary: a name of let or a path, bodies.plate.density", OPTION_TEXT,
     AT(key), COMMAND_SEARCH},
    {"--from", "A", "one end of the values, with its unit: 300m/s", OPTION_TEXT, AT(from),
     COMMAND_SEARCH},
    {"--to", "B", "the other end", OPTION_TEXT, AT(to), COMMAND_SEARCH},
    {"--check", "NAME", "the check that passes with one of the two values and fails with the other",
     OPTION_TEXT, AT(check), COMMAND_SEARCH},
    {"--within", "W",
     "width of the interval at which to stop: 5m/s, or 1% (default: 1% of the first interval)",
     OPTION_TEXT, AT(within), COMMAND_SEARCH},
    {"--template", "NAME",
     "what to start from: impact, riemann, plate-2d, block-3d, bar-mpm, long-rod (default: the one "
     "of the name NAME, else impact)",
     OPTION_TEXT, AT(template_name), COMMAND_NEW},
};

#undef AT

static struct error *unknown_option(const struct command *command, const char *word, int length)
{
    const char *names[COUNT_OF(option_table)];
    int count = 0;
    for (size_t i = 0; i < COUNT_OF(option_table); i++)
        if (option_table[i].commands & command->bit)
            names[count++] = option_table[i].name;
    char *name = text_copy_part(word, (size_t)length);
    const char *nearest = name ? nearest_name(name, names, count) : NULL;
    struct error *error =
        nearest ? error_new(ERROR_INPUT, "%s: unknown option %.*s (did you mean %s?)",
                            command->name, length, word, nearest)
                : error_new(ERROR_INPUT, "%s: unknown option %.*s; see `bolide help %s`",
                            command->name, length, word, command->name);
    free(name);
    return error;
}

static const struct option *find_option(const struct command *command, const char *word, int length)
{
    for (size_t i = 0; i < COUNT_OF(option_table); i++) {
        const struct option *option = &option_table[i];
        if ((option->commands & command->bit) && (int)strlen(option->name) == length &&
            !strncmp(option->name, word, (size_t)length))
            return option;
    }
    return NULL;
}

static struct error *append(struct text_list *list, const char *text)
{
    const char **grown = realloc(list->text, ((size_t)list->count + 1) * sizeof *grown);
    if (!grown)
        return out_of_memory();
    list->text = grown;
    list->text[list->count++] = text;
    return NULL;
}

static struct error *store(const struct option *option, const char *value,
                           struct cli_options *options)
{
    void *place = (char *)options + option->offset;
    switch (option->kind) {
    case OPTION_FLAG:
        *(bool *)place = true;
        return NULL;
    case OPTION_TEXT:
        *(const char **)place = value;
        return NULL;
    case OPTION_LIST:
        return append(place, value);
    case OPTION_COUNT:
    case OPTION_THREADS: {
        const long most = option->kind == OPTION_THREADS ? THREADS_MOST : COUNT_MOST;
        char *end;
        errno = 0;
        long long number = strtoll(value, &end, 10);
        if (end == value || *end || errno || number < 1 || number > most)
            return error_new(ERROR_INPUT, "%s: \"%s\" is not a whole number from 1 to %ld",
                             option->name, value, most);
        *(int64_t *)place = number;
        return NULL;
    }
    }
    return NULL;
}

/* Reads the option at words[*at], and its value behind a `=` or in the next word. */
static struct error *read_option(const struct command *command, int count, char **words, int *at,
                                 struct cli_options *options)
{
    const char *word = words[*at];
    int length = (int)strcspn(word, "=");
    const struct option *option = find_option(command, word, length);
    if (!option)
        return unknown_option(command, word, length);
    const char *value = word[length] ? word + length + 1 : NULL;
    if (option->kind == OPTION_FLAG && value)
        return error_new(ERROR_INPUT, "%s takes no value", option->name);
    if (option->kind != OPTION_FLAG && !value) {
        if (*at + 1 >= count)
            return error_new(ERROR_INPUT, "%s needs %s", option->name, option->value);
        value = words[++*at];
    }
    return store(option, value, options);
}

/* OMP_NUM_THREADS, of which the first number counts here. OpenMP itself ignores what is no
 * number. */
static struct error *check_environment(void)
{
    const char *text = getenv("OMP_NUM_THREADS");
    if (!text || strtol(text, NULL, 10) <= THREADS_MOST)
        return NULL;
    return error_new(ERROR_INPUT, "OMP_NUM_THREADS: \"%s\" is more than %d threads", text,
                     THREADS_MOST);
}

bool options_fix_threads(void)
{
    const char *text = getenv("OMP_DYNAMIC");
    return text && !strcasecmp(text, "false");
}

struct error *options_read(const struct command *command, int count, char **words,
                           struct cli_options *options)
{
    struct error *error = NULL;
    bool only_names = false;
    *options = (struct cli_options){0};
    for (int at = 0; at < count; at++) {
        if (!only_names && !strcmp(words[at], "--"))
            only_names = true;
        else if (!only_names && words[at][0] == '-' && words[at][1])
            error = error_join(error, read_option(command, count, words, &at, options));
        else
            error = error_join(error, append(&options->names, words[at]));
    }
    if (!error &&
        (options->names.count < command->least_names || options->names.count > command->most_names))
        error = error_new(ERROR_INPUT, "usage: bolide %s %s [options]; see `bolide help %s`",
                          command->name, command->usage, command->name);
    if (!error && options->overwrite && options->resume)
        error = error_new(ERROR_INPUT, "--overwrite and --resume exclude each other");
    if (!error && options->change && !options->resume)
        error = error_new(ERROR_INPUT, "--change needs --resume");
    if (!error && options->quick && options->thorough)
        error = error_new(ERROR_INPUT, "--short and --long exclude each other");
    if (!error && options->record + options->compare + options->convergence > 1)
        error = error_new(ERROR_INPUT,
                          "--record, --compare-record and --convergence exclude each other");
    if (!error && !options->threads &&
        command->bit & (COMMAND_RUN | COMMAND_VERIFY | COMMAND_SEARCH))
        error = check_environment();
    if (!error && options->output)
        error = own_folder_check("--output", options->output);
    return error;
}

void options_free(struct cli_options *options)
{
    for (int i = 0; options->located && i < options->names.count; i++)
        free(options->located[i]);
    free(options->located);
    free(options->settings.text);
    free(options->data.text);
    free(options->names.text);
}

bool options_at(int index, const char **name, const char **help, unsigned *takers)
{
    if (index >= (int)COUNT_OF(option_table))
        return false;
    *name = option_table[index].name;
    *help = option_table[index].help;
    *takers = option_table[index].commands;
    return true;
}

void options_print(const struct command *command)
{
    for (size_t i = 0; i < COUNT_OF(option_table); i++) {
        const struct option *option = &option_table[i];
        if (!(option->commands & command->bit))
            continue;
        char name[48];
        snprintf(name, sizeof name, "%s%s%s", option->name, option->value ? " " : "",
                 option->value ? option->value : "");
        printf("  %-18s  %s\n", name, option->help);
    }
}
