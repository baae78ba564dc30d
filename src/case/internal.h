/* Between the reader of cases and its check of meaning. */
#ifndef BOLIDE_CASE_INTERNAL_H
#define BOLIDE_CASE_INTERNAL_H

#include "case/case.h"
#include "document/nodes.h"

/* The format that this program reads. */
enum { CASE_FORMAT = 1 };

/* An entry of `materials`, and a file of the library. */
extern const struct parameter case_material_table[];
extern const struct parameter case_detonation_table[];  /* struct detonation_input */
extern const struct parameter case_contact_table[];     /* struct contact_input */
extern const struct parameter case_domain_table[];      /* struct domain_input */
extern const struct parameter case_start_table[];       /* struct start_input */
extern const struct parameter case_boundary_table[];    /* struct boundary_input */
extern const struct parameter case_load_table[];        /* struct load_input */
extern const struct parameter case_probe_table[];       /* struct probe_input */
extern const struct parameter case_profile_table[];     /* struct profile_input */
extern const struct parameter case_map_table[];         /* struct map_input */
extern const struct parameter case_histogram_table[];   /* struct histogram_input */
extern const struct parameter case_picture_table[];     /* struct picture_input */
extern const struct parameter case_fit_table[];         /* struct fit_input */
extern const struct parameter case_expected_table[];    /* struct expected_warning_input */
extern const struct parameter case_convergence_table[]; /* struct convergence_input */
extern const struct parameter case_calibrate_table[];   /* struct calibrate_input */

/* Makes material->material, plain data, from what was read. */
struct error *case_fill_material(struct material_input *material);

/* What the case includes in run RUN of its sweep, a part of the document; NULL where the sweep does
 * not vary that, or is wrong. *RUNS is the number of runs, 0 for a mistake. */
const struct node *case_swept_include(const struct document *document, int run, int *runs);

/* Takes the sweep out of the document and tells its mistakes; puts the values of its run RUN, 1 to
 * sweep_runs, where they belong. 0: none of them. */
struct error *case_take_sweep(struct simulation_case *input, int run);

/* The path that KEY is about: a name of `let` before anything else. Mistakes name TOLD at PLACE. */
struct error *case_find_target(const struct document *document, const char *key, struct mark place,
                               const char *told, char **path);

/* Looks at what `convergence` varies and tells its mistakes. With OPTIONS->convergence its runs are
 * those of the sweep, and the value of the run that is asked for is put where it belongs. */
struct error *case_take_study(struct simulation_case *input, const struct case_options *options);

/* Puts what other spellings say of boundaries under `boundaries`, with a note of each
 * (spelling.c). */
struct error *case_take_spellings(struct simulation_case *input);

/* Fills the quantities of the values of a case that has been read. */
void case_measure_sweep(struct simulation_case *input);

/* Checks what the tables cannot say of a case that has been read, names of materials and bodies,
 * numbers of components, states at the start, and fills what follows from it. All mistakes come
 * joined. Of a case that was read with mistakes it checks the rest. */
struct error *case_check_meaning(struct simulation_case *input);

/* What is given of a state at the start; NAN: not given. */
struct start_given {
    double density, pressure, energy, temperature;
    bool stressed; /* a stress in place of the pressure */
    struct sym3 stress;
};

/* The functions below return NULL, or a text (static) that tells what is wrong; *key is then the
 * key of a body that it is about, "" for the body as a whole. */

/* The state that follows from what is GIVEN, of density, pressure and energy two at most. */
const char *start_state(const struct start_given *given, const struct material *material,
                        struct point *result, const char **key);

/* What is wrong with the choice of what BODY gives, whatever the values. */
const char *body_start_wrong(const struct body_input *body, const struct material *material,
                             const char **key);

/* True when BODY gives its state by expressions of the position. */
bool body_varies(const struct body_input *body);

/* The state that the keys of BODY give at PLACE. */
const char *body_state_at(const struct body_input *body, const struct material *material,
                          struct vec3 place, struct point *point, const char **key);

/* Fills `recorded` of the checks and fits that have a regression bound from the record of the case
 * at PATH; ERROR_INPUT where it has no such value. */
struct error *case_take_record(struct simulation_case *input, const char *path);

/* The rows of what a check allows, in a table of TYPE whose struct check_input is MEMBER (with a
 * dot after it, or nothing). */
#define CASE_LIMITS(type, member)                                                                  \
    PARAMETER_AS("is", QUANTITY, type, member is, OPTIONAL, "the expected value"),                 \
        PARAMETER_AS("within", QUANTITY, type, member within, OPTIONAL,                            \
                     "allowed distance from `is`: a fraction of it or a quantity like it"),        \
        PARAMETER_AS("at_most", QUANTITY, type, member at_most, OPTIONAL,                          \
                     "largest value allowed"),                                                     \
        PARAMETER_AS("at_least", QUANTITY, type, member at_least, OPTIONAL,                        \
                     "smallest value allowed"),                                                    \
        PARAMETER_AS("source", TEXT, type, member source, OPTIONAL,                                \
                     "source of the expected value"),                                              \
        PARAMETER_AS("known_deviation", TEXT, type, member known_deviation, OPTIONAL,              \
                     "why the check is expected to fail: it is listed separately and does not "    \
                     "fail the run; if it passes, the run fails, so that the key gets removed"),   \
        PARAMETER_AS(                                                                              \
            "known_deviation_if", NUMBER, type, member known_deviation_if, "1",                    \
            "`known_deviation` applies only where this is above 0, as in some runs of a sweep",    \
            .above = -INFINITY, .below = INFINITY),                                                \
        PARAMETER_AS("recorded_value", QUANTITY, type, member recorded, OPTIONAL,                  \
                     "the earlier result that `regression_bound` compares with; default: that of " \
                     "the record beside the case, which `bolide verify --record` makes"),          \
        PARAMETER_AS("regression_bound", QUANTITY, type, member regression_bound, OPTIONAL,        \
                     "by how much the error may exceed the recorded one, as a fraction of it or "  \
                     "a quantity; the error is the distance from `is` or from the exact "          \
                     "solution. Without either, by how much the value may change. It detects "     \
                     "changes only, and is counted separately")

/* Reads the case that `start` names, if any, from the folder of the case at PATH. */
struct error *case_read_start(struct simulation_case *input, const char *path,
                              const struct case_options *options);
/* Reads the cases that the records of loads name. */
struct error *case_read_records(struct simulation_case *input, const char *path,
                                const struct case_options *options);

#endif
