/* The parameter tables of equations of state, strength, failure and burn models, made of the rows
 * in their headers:
 *
 *   NUMBER(T, member, unit, default, range, help)
 *   CHOICE(T, member, default, help, names...)      an int, the index of the name
 *   COUNT(T, member, default, help)                 an int that is not negative, of the start
 *   FLAG(T, member, default, help)                  a bool
 *
 * T is the struct, and the key in a case is the member's name. A default is text as a user would
 * type it, REQUIRED or OPTIONAL (not a number where it is not given). The ranges are below. See
 * parameter.h and choices.h. */
#include "material/choices.h"

/* After a range: what is decided at the start of a run. */
#define AT_START(...) __VA_ARGS__, .change = CHANGE_NEVER
#define ANY .above = 0.0, .below = 0.0
#define POSITIVE .above = 0.0, .below = INFINITY
#define NOT_NEGATIVE .above = 0.0, .below = INFINITY, .closed = true
#define ABOVE_ONE .above = 1.0, .below = INFINITY
#define BETWEEN_ZERO_AND_ONE .above = 0.0, .below = 1.0
#define FROM_ZERO_TO_ONE .above = 0.0, .below = 1.0, .closed = true

#define NUMBER(T, member, of, as_typed, range, text) \
    PARAMETER(NUMBER, T, member, as_typed, text, .unit = of, range),
#define CHOICE(T, member, as_typed, text, ...) \
    PARAMETER(CHOICE, T, member, as_typed, text, .names = (const char *const[]){__VA_ARGS__, 0}),
#define COUNT(T, member, as_typed, text) \
    PARAMETER(INTEGER, T, member, as_typed, text, AT_START(NOT_NEGATIVE)),
#define FLAG(T, member, as_typed, text) PARAMETER(FLAG, T, member, as_typed, text),

#define EOS_TABLE(name)                                                                            \
    const struct parameter eos_##name##_parameters[] = {EOS_##name##_PARAMETERS(struct eos_##name) \
                                                            PARAMETER_END};
EOS_LIST(EOS_TABLE)

#define STRENGTH_TABLE(name)                                         \
    static const struct parameter strength_##name##_parameters[] = { \
        STRENGTH_##name##_PARAMETERS(struct strength_##name) PARAMETER_END};
STRENGTH_LIST(STRENGTH_TABLE)

#define FAILURE_TABLE(name)                                         \
    static const struct parameter failure_##name##_parameters[] = { \
        FAILURE_##name##_PARAMETERS(struct failure_##name) PARAMETER_END};
FAILURE_LIST(FAILURE_TABLE)

#define BURN_TABLE(name)                                         \
    static const struct parameter burn_##name##_parameters[] = { \
        BURN_##name##_PARAMETERS(struct burn_##name) PARAMETER_END};
BURN_LIST(BURN_TABLE)

#define EOS_CHOICE(name)                                                           \
    [EOS_##name] = {EOS_##name##_NAME, EOS_##name##_HELP, eos_##name##_parameters, \
                    sizeof(struct eos_##name), NULL},
const struct choice eos_choices[EOS_KINDS] = {EOS_LIST(EOS_CHOICE)};

#define STRENGTH_CHOICE(name)                                            \
    [STRENGTH_##name] = {STRENGTH_##name##_NAME, STRENGTH_##name##_HELP, \
                         strength_##name##_parameters, sizeof(struct strength_##name), NULL},
const struct choice strength_choices[STRENGTH_KINDS] = {
    [STRENGTH_NONE] = {"none", "no shear strength: a fluid", NULL, 0, NULL},
    STRENGTH_LIST(STRENGTH_CHOICE)};

#define FAILURE_CHOICE(name)                                                                       \
    [FAILURE_##name] = {FAILURE_##name##_NAME, FAILURE_##name##_HELP, failure_##name##_parameters, \
                        sizeof(struct failure_##name), NULL},
const struct choice failure_choices[FAILURE_KINDS] = {
    [FAILURE_NONE] = {"none", "never fails", NULL, 0, NULL}, FAILURE_LIST(FAILURE_CHOICE)};

#define BURN_CHOICE(name)                                                              \
    [BURN_##name] = {BURN_##name##_NAME, BURN_##name##_HELP, burn_##name##_parameters, \
                     sizeof(struct burn_##name), NULL},
const struct choice burn_choices[BURN_KINDS] = {
    [BURN_INSTANT] = {"instant", "burnt from the start: instantaneous detonation", NULL, 0, NULL},
    BURN_LIST(BURN_CHOICE)};
