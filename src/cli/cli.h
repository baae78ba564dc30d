/* What the subcommands share: options, words to the user, folders of shared files. This is the one
 * module that prints, exits and holds a static variable (the flags of signals). */
#ifndef BOLIDE_CLI_H
#define BOLIDE_CLI_H

#include "output/report.h"
#include "run/catalogue.h"
#include "run/run.h"
#include "study/verify.h"

enum { EXIT_OK = 0, EXIT_USAGE = ERROR_INPUT };

/* A list of texts that belong to argv. */
struct text_list {
    int count;
    const char **text;
};

/* All options of all commands, and the arguments that are none. */
struct cli_options {
    const char *output;
    int64_t threads, points, ranks_wanted;
    bool overwrite, resume, change, quick, thorough, all, convergence, curves, record, compare,
        pilot, force;
    const char *time, *at, *template_name;
    const char *fields, *limit, *format, *rate, *size; /* of view, film and picture */
    int64_t frames;
    const char *key, *from, *to, *check, *within; /* of a search */
    struct text_list settings, names, data;
    char **located;            /* the paths of cases that names gives by their folders */
    const struct ranks *ranks; /* all processes that were started together */
};

enum command_bit {
    COMMAND_RUN = 1,
    COMMAND_CHECK = 2,
    COMMAND_VERIFY = 4,
    COMMAND_EXACT = 8,
    COMMAND_REPORT = 32,
    COMMAND_NEW = 256,
    COMMAND_SCHEMA = 512,
    COMMAND_MATERIALS = 1024,
    COMMAND_SEARCH = 2048,
    COMMAND_PICTURE = 4096,
    COMMAND_VIEW = 8192,
    COMMAND_FILM = 16384,
    COMMAND_COMPARE = 32768,
    COMMAND_CALIBRATE = 65536,
    COMMAND_HELP = 16
};

struct command {
    enum command_bit bit;
    const char *name, *usage, *help;
    int least_names, most_names;                   /* arguments beside the options */
    int (*run)(const struct cli_options *options); /* gives the exit status */
};

extern const struct command commands[];
extern const int command_count;

int command_run(const struct cli_options *options);
int command_check(const struct cli_options *options);
int command_verify(const struct cli_options *options);
int command_calibrate(const struct cli_options *options);
int command_exact(const struct cli_options *options);
int command_report(const struct cli_options *options);
int command_picture(const struct cli_options *options);
int command_view(const struct cli_options *options);
int command_film(const struct cli_options *options);
int command_compare(const struct cli_options *options);
int command_new(const struct cli_options *options);
int command_schema(const struct cli_options *options);
int command_materials(const struct cli_options *options);
int command_search(const struct cli_options *options);
int command_help(const struct cli_options *options);

/* material_curves.c: false where MATERIAL has no state of rest. */
struct material;
bool print_curves(const struct material *material);

/* detonations.c: after BEFORE, the detonation that follows from the constants of MATERIAL, its
 * states after BETWEEN; false where it is no explosive. */
bool print_detonation(const char *before, const char *between, const struct material *material);

/* command_picture.c: draws what OPTIONS want of the snapshots in the first of their names, into
 * `into` of REQUEST; COUNT pictures. */
struct pictures_request;
struct error *draw_again(const struct cli_options *options, struct pictures_request *request,
                         int64_t *count);

/* many_runs.c */

/* How OPTIONS want a case to be run, into FOLDER (NULL: nothing is written); RATES is
 * rates_path(). */
struct run_options running_of(const struct cli_options *options, const char *folder,
                              const struct listener *listener, const char *rates);

/* What a command that runs many cases keeps meanwhile. */
struct many_runs {
    struct verify_options verifying;
    struct listener listener; /* that of progress alone, on a terminal */
    char *materials;
};
/* Fills MANY, which then stays where it is, and gives what verify takes, without `ended`. */
struct verify_options *many_runs_begin(struct many_runs *many, const struct cli_options *options,
                                       const char *folder);
/* Reports ERROR (taken) and frees what MANY keeps. True when a signal has stopped the runs. */
bool many_runs_end(struct many_runs *many, struct error *error, int *status);

/* convergence.c */

/* Makes the convergence studies of the COUNT cases at PATHS, or with OF_ALL of those among them
 * that ask for one; prints their tables, writes their pages, and gives the exit status. */
int verify_convergence(const char *const *paths, int count, bool of_all,
                       const struct cli_options *options);

/* help_search.c */

/* Lists what has TEXT in its name or its help; false when nothing has. */
bool help_search(const char *text);

bool is_library_material(const char *name);

/* help_words.c */

/* Prints what to do about TOPIC, a word of users that is no name of the program; false if there is
 * nothing to say. */
bool help_word(const char *topic);

/* options.c */

/* Reads what follows the command's name; ERROR_INPUT with the nearest right spelling. */
struct error *options_read(const struct command *command, int count, char **words,
                           struct cli_options *options);
void options_free(struct cli_options *options);
/* True when the user wants all threads all the time: OMP_DYNAMIC=false. */
bool options_fix_threads(void);
/* Name, help and takers (bits of commands) of option INDEX; false after the last. */
bool options_at(int index, const char **name, const char **help, unsigned *takers);
void options_print(const struct command *command);

/* terminal.c */

/* Prints the messages of ERROR on stderr, one a line, frees it, and gives its exit status. */
int report_error(struct error *error);

/* Of several ranks the first speaks for all. Only an ERROR that a rank alone has is reported by
 * that rank, and ends them all. */
void terminal_silence(const struct ranks *ranks);
void terminal_alarm(const struct ranks *ranks, const struct error *error);

/* Words and progress of a run; on a terminal the progress line is drawn over, elsewhere it is a
 * line every ten per cent, or after ten seconds without. */
struct listener terminal_listener(void);
struct progress_pace terminal_pace(void);
void terminal_clear_line(void);

/* Escape sequences for stdout, "" where it is no terminal, or with NO_COLOR in the environment. */
enum colour { COLOUR_NONE, COLOUR_GOOD, COLOUR_BAD, COLOUR_FAINT, COLOUR_STRONG, COLOUR_WARN };
const char *colour(enum colour which);

/* Opens /dev/null on those of stdin, stdout and stderr that are closed. Otherwise the next file
 * that is opened takes such a number, and what is printed goes into it. Call before anything
 * else. */
void terminal_open_closed_streams(void);

/* launch.c */

/* Starts this program, called with the COUNT WORDS, as RANKS ranks by mpirun, waits for them, and
 * gives their exit status. */
int launch_ranks(int count, char **words, int64_t ranks);
/* True in a rank that was started so. */
bool launch_has_made_us(void);
/* In such a rank: tells STATUS to the process that started it; what is left to tell mpirun. */
int launch_tell_status(const struct ranks *ranks, int status);
/* What is wrong with WANTED ranks here. */
struct error *launch_check(const struct ranks *ranks, int64_t wanted);

/* signals.c */

/* Catches the signals that stop a run, in a rank that launch_ranks made SIGUSR2 among them, and
 * SIGUSR1, which asks for a checkpoint; the flag that the former set, and how often the latter
 * came. */
const volatile sig_atomic_t *signals_catch(void);
const volatile sig_atomic_t *signals_checkpoints(void);
/* 128 + the signal that came. */
int signals_status(void);

/* results.c */

/* The ERROR_INPUT with which FOLDER, the value of OPTION, is refused as one to write to. */
struct error *own_folder_check(const char *option, const char *folder);

/* The folder that a run of the case at PATH, called NAME, writes to: that of `--output`, else
 * results/NAME. Free it. */
struct error *results_folder(const struct cli_options *options, const char *path, const char *name,
                             char **folder);

/* share.c */

/* The folder NAME ("examples", "materials") of files that come with the program: in $BOLIDE_SHARE,
 * beside the build, where the program is installed, or here. NULL if there is none; free it. */
char *share_folder(const char *name);

/* The path of the case that GIVEN means, in fresh memory: GIVEN itself, or the case.yaml in the
 * folder GIVEN. ERROR_INPUT for a folder without one. */
struct error *case_locate(const char *given, char **path);
/* Puts the paths of the cases in the place of OPTIONS' names; options_free frees them. */
struct error *cases_locate(struct cli_options *options);

/* The table of the rates of runs on this machine, $XDG_CACHE_HOME/bolide/rates.csv or
 * ~/.cache/bolide/rates.csv, in fresh memory; NULL where there is no such place. */
char *rates_path(void);

/* How OPTIONS want a case to be read, with the materials in the folder MATERIALS (NULL: none). */
struct case_options case_reading(const struct cli_options *options, const char *const *materials);

/* Reads the case at PATH as OPTIONS want it; and the run RUN, from 1, of its sweep. */
struct error *read_case(const char *path, const struct cli_options *options,
                        struct simulation_case **input);
struct error *read_run_of_sweep(const char *path, const struct cli_options *options, int run,
                                struct simulation_case **input);

#endif
