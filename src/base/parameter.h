/* Parameter tables. Everything that a user can name in a case declares its parameters once, in a
 * table of these; the reader, its error messages, the filled-in case, `bolide help` and the
 * reference manual are loops over the tables.
 *
 * A table describes a plain C struct: each parameter says where in the struct its value goes. What
 * a value may be is its kind:
 *
 *   kind       in the case                               in the struct, at `offset`
 *   NUMBER     an expression of dimension `unit`         double, in SI units
 *   QUANTITY   an expression of any dimension            struct quantity; value NAN when not given
 *   INTEGER    a whole number                            int64_t
 *   FLAG       yes | no                                  bool
 *   TEXT       a scalar                                  char *, NULL when not given; the name of a
 *                                                        file (`is_path`) is made absolute, as seen
 *                                                        from the folder of the file that names it
 *   CHOICE     one of `names`                            int, the index in `names`
 *   VECTOR     a list of 1 to 3 expressions              struct vector_value (count 0: not given)
 *   VECTORS    a list of such lists                      struct vector_list
 *   FIELD      an expression that may name `arguments`   struct field_value; constant NAN when not given
 *   FIELDS     a list of 1 to 6 such expressions         struct field_list (count 0: not given)
 *   NAMES      a list of scalars, or one scalar          struct name_list
 *   TABLE      a map with the keys of `table`            the nested struct itself
 *   ONE_OF     {name: {...}} or name, of `kind_of_thing` struct one_of
 *   LIST       a list of such ONE_OF                     struct one_of_list
 *   MAP        {any name: a map of `table`}              struct named_map; with `listed` a list of
 *                                                        names, or one, stands for entries that
 *                                                        have their names as the first parameter
 *
 * A ONE_OF whose key is NULL stands inline: exactly one key of the surrounding map must be a name
 * of `kind_of_thing` (`{box: {...}, velocity: ...}`). Where a thing's value is a scalar or a list
 * instead of a map, it fills the first parameter of the thing's table (`{mean: pressure}`).
 *
 * `standard` is the default as a user would type it, REQUIRED when there is none, OPTIONAL when a
 * value may be missing (NAN, NULL, count 0 or index -1 in the struct). */
#ifndef BOLIDE_PARAMETER_H
#define BOLIDE_PARAMETER_H

#include "base/expression.h"

enum parameter_kind {
    PARAMETER_NUMBER,
    PARAMETER_QUANTITY,
    PARAMETER_INTEGER,
    PARAMETER_FLAG,
    PARAMETER_TEXT,
    PARAMETER_CHOICE,
    PARAMETER_VECTOR,
    PARAMETER_VECTORS,
    PARAMETER_FIELD,
    PARAMETER_FIELDS,
    PARAMETER_NAMES,
    PARAMETER_TABLE,
    PARAMETER_ONE_OF,
    PARAMETER_LIST,
    PARAMETER_MAP,
};

/* Whether a resumed run may have another value than before: never; from the moment of the resume
 * on; or whenever, since it does not change the state. What names none has that of the table or the
 * map that it is in. */
enum parameter_change { CHANGE_AS_AROUND, CHANGE_NEVER, CHANGE_FROM_HERE, CHANGE_FREELY };

#define REQUIRED ((const char *)0)
#define OPTIONAL ""

struct parameter {
    const char *key;
    enum parameter_kind kind;
    size_t offset;
    /* NUMBER, VECTOR(S), FIELD(S): the SI unit that fixes the dimension, "" or NULL for none */
    const char *unit;
    const char *standard; /* default as typed, REQUIRED or OPTIONAL */
    /* NUMBER, INTEGER, constant FIELD: allowed is above < value < below; both 0: anything */
    double above, below;
    bool closed;  /* the bounds themselves are allowed too */
    bool is_path; /* TEXT */
    bool listed;  /* MAP */
    const char *help;
    const struct parameter
        *table;                /* TABLE, MAP: the nested table, ended by a key and kind of zero */
    size_t size;               /* MAP: bytes of one item's struct */
    const char *const *names;  /* CHOICE: the names, ended by NULL */
    const char *kind_of_thing; /* ONE_OF, LIST: a kind of the catalogue: "eos", "shape", ... */
    size_t owned;              /* offset of a pointer to memory that is computed from the values of
                                * the table and freed with them; 0: none */
    unsigned arguments;        /* FIELD(S): what it may name, a sum of enum expression_arguments */
    /* of the key, and of entries that a MAP gets or loses; of what is in it, where that differs */
    enum parameter_change change, change_within;
};

/* A row of a table: the key MEMBER of the struct T, the default, help, then what else the kind has,
 * by name:
 *   PARAMETER(NUMBER, struct blast_input, mass, OPTIONAL, "mass of the charge", .unit = "kg")
 * PARAMETER_AS is for a KEY that is not the name of the member. */
#define PARAMETER(of_kind, T, member, ...) PARAMETER_AS(#member, of_kind, T, member, __VA_ARGS__)
#define PARAMETER_AS(name, of_kind, T, member, as_typed, ...)                    \
    {                                                                            \
        .key = name, .kind = PARAMETER_##of_kind, .offset = offsetof(T, member), \
        .standard = as_typed, .help = __VA_ARGS__                                \
    }

/* The last entry of every table. */
#define PARAMETER_END \
    {                 \
        0             \
    }
#define PARAMETER_IS_END(parameter) (!(parameter)->key && !(parameter)->kind_of_thing)

/* Names of choices that many tables have: x, y, z; low, high. */
extern const char *const parameter_axes[], *const parameter_sides[];

struct vector_value {
    int count;
    double at[3];
};

struct vector_list {
    int count;
    struct vector_value *items;
};

/* A number, or an expression of the position or the time. */
struct field_value {
    double constant;
    struct varying_expression *varying; /* NULL: the number */
};

enum { FIELD_COMPONENTS = 6 };
struct field_list {
    int count;
    struct field_value at[FIELD_COMPONENTS];
};

static inline bool field_is_given(const struct field_value *field)
{
    return field->varying || !isnan(field->constant);
}

static inline double field_at(const struct field_value *field, struct vec3 place, double time)
{
    return field->varying ? varying_expression_at(field->varying, place, time) : field->constant;
}

/* Whether it names the time. */
static inline bool field_is_of_time(const struct field_value *field)
{
    return field->varying && varying_expression_uses(field->varying, ARGUMENT_T);
}

struct name_list {
    int count;
    char **names;
};

/* A thing that a case can name: `name` chooses it, `table` (may be NULL) describes its parameters,
 * a struct of `size` bytes holds them, `thing` is what the owner of the kind needs to use it. */
struct choice {
    const char *name, *help;
    const struct parameter *table;
    size_t size;
    const void *thing;
};

struct one_of {
    int index;                   /* in the list of its kind; -1: not given */
    const struct choice *choice; /* NULL: not given */
    void *value;                 /* choice->size bytes, NULL when the size is zero */
};

struct one_of_list {
    int count;
    struct one_of *items;
};

/* Items in the order of the file. */
struct named_map {
    int count;
    char **names;
    void *items;             /* count structs of the parameter's `size` */
    struct name_index index; /* of the names; empty: they are looked through */
};

/* All things of all kinds; the kinds end with a NULL name. */
struct choice_list {
    const char *kind_of_thing, *help;
    const struct choice *choices;
    int count;
};

struct catalogue {
    const struct choice_list *lists;
};

/* The item called NAME; -1 when there is none. */
int named_map_find(const struct named_map *map, const char *name);

const struct choice_list *catalogue_list(const struct catalogue *catalogue, const char *kind);

/* The choice NAME of KIND, NULL if there is none. */
const struct choice *catalogue_find(const struct catalogue *catalogue, const char *kind,
                                    const char *name);

/* Frees what the values of TABLE in VALUES own (texts, lists, nested things), not VALUES itself. */
void parameters_release(const struct parameter *table, void *values);

#endif
