/* bolide: the command line. Exit status: 0 all is well, 1 a check failed, 2 bad input or usage, 3
 * an impossible state in a run, 4 a disk, memory or library that failed; 128 + the signal when
 * stopped. */
#include <malloc.h>
#include <stdio.h>
#include <string.h>

#include "cli/cli.h"

const struct command commands[] = {
    {COMMAND_RUN, "run", "CASE", "run a case and judge its checks", 1, 1, command_run},
    {COMMAND_CHECK, "check", "CASE...", "check a case and forecast its cost, without computing it",
     1, 1000, command_check},
    {COMMAND_VERIFY, "verify", "CASE... | --all",
     "run cases and print all their checks as one table", 0, 1000, command_verify},
    {COMMAND_SEARCH, "search", "CASE",
     "find by bisection the value of a key at which a check begins to fail", 1, 1, command_search},
    {COMMAND_CALIBRATE, "calibrate", "CASE",
     "fit keys of a case to measured values, as its `calibrate` says", 1, 1, command_calibrate},
    {COMMAND_EXACT, "exact", "[NAME | CASE]",
     "print an exact solution: its numbers, and its profile", 0, 1, command_exact},
    {COMMAND_REPORT, "report", "FOLDER...", "make report.html of the results in a folder", 1, 1000,
     command_report},
    {COMMAND_PICTURE, "picture", "FOLDER [NAME | FIELD ...]",
     "draw pictures from the snapshots in a folder of results", 1, 100, command_picture},
    {COMMAND_VIEW, "view", "FOLDER...",
     "write view.html, a page that shows the particles of a run from any side", 1, 100,
     command_view},
    {COMMAND_FILM, "film", "FOLDER [NAME ...]", "join the frames of pictures to a film", 1, 100,
     command_film},
    {COMMAND_COMPARE, "compare", "FOLDER...",
     "plot the probes of several runs, and measurements, in one page", 1, 8, command_compare},
    {COMMAND_NEW, "new", "NAME", "write NAME/case.yaml, a commented case as a starting point", 1, 1,
     command_new},
    {COMMAND_SCHEMA, "schema", "", "print the JSON Schema of a case, for editors", 0, 0,
     command_schema},
    {COMMAND_MATERIALS, "materials", "[NAME]",
     "list the material library, or print one material with its sources", 0, 1, command_materials},
    {COMMAND_HELP, "help", "[TOPIC]",
     "explain a command, a key of a case, a model, or a word that you look for", 0, 6,
     command_help},
};
const int command_count = COUNT_OF(commands);

/* Those that compute cases, in which all ranks take part. */
enum { RUNNING_COMMANDS = COMMAND_RUN | COMMAND_VERIFY | COMMAND_SEARCH | COMMAND_CALIBRATE };

static const struct command *find_command(const char *name)
{
    for (int i = 0; i < command_count; i++)
        if (!strcmp(commands[i].name, name))
            return &commands[i];
    return NULL;
}

static int unknown_command(const char *word)
{
    const char *names[COUNT_OF(commands)];
    for (int i = 0; i < command_count; i++)
        names[i] = commands[i].name;
    const char *nearest = nearest_name(word, names, command_count);
    if (nearest)
        return report_error(
            error_new(ERROR_INPUT, "unknown command \"%s\" (did you mean \"%s\"?)", word, nearest));
    return report_error(
        error_new(ERROR_INPUT, "unknown command \"%s\"; `bolide help` lists them", word));
}

static bool is_one_of(const char *word, const char *a, const char *b)
{
    return !strcmp(word, a) || !strcmp(word, b);
}

/* True for `bolide run --help`. */
static bool wants_help(int count, char **words)
{
    for (int i = 0; i < count && strcmp(words[i], "--") != 0; i++)
        if (is_one_of(words[i], "--help", "-h"))
            return true;
    return false;
}

static int run_command(int count, char **words, const struct ranks *ranks)
{
    if (count < 2) {
        command_help(&(struct cli_options){0});
        return EXIT_USAGE;
    }
    if (is_one_of(words[1], "--version", "-V")) {
        printf("bolide %s\n", BOLIDE_VERSION);
        return EXIT_OK;
    }
    const char *name = is_one_of(words[1], "--help", "-h") ? "help" : words[1];
    const struct command *command = find_command(name);
    if (!command)
        return unknown_command(name);
    if (wants_help(count - 2, words + 2))
        return command_help(&(struct cli_options){.names = {1, &name}});
    struct cli_options options;
    struct error *error = options_read(command, count - 2, words + 2, &options);
    options.ranks = ranks;
    if (!error && options.ranks_wanted > 1)
        error = ranks_agree(ranks, launch_check(ranks, options.ranks_wanted));
    if (!error && options.ranks_wanted > 1 && !ranks->joined) {
        options_free(&options);
        return launch_ranks(count, words, options.ranks_wanted);
    }
    if (!error && command->bit & (COMMAND_CHECK | RUNNING_COMMANDS))
        error = ranks_agree(ranks, cases_locate(&options));
    int status = EXIT_OK;
    if (error)
        status = report_error(error);
    else if (ranks->rank == 0 || command->bit & RUNNING_COMMANDS)
        status = command->run(&options);
    options_free(&options);
    const bool unwritten = fflush(stdout) || ferror(stdout);
    if (unwritten && status == EXIT_OK)
        status = report_error(error_new(ERROR_SYSTEM, "the output could not be written"));
    return status;
}

int main(int count, char **words)
{
    terminal_open_closed_streams();
    /* Arrays of a megabyte and more get pages of their own, which go back when they are freed:
     * glibc's moving threshold would keep several hundred bytes a particle in its heap. */
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
    const struct ranks ranks = ranks_join();
    terminal_silence(&ranks);
    if (launch_has_made_us()) /* before a request to stop may come, which would end it */
        signals_catch();
    int status = launch_tell_status(&ranks, run_command(count, words, &ranks));
    ranks_leave(&ranks);
    return status;
}
