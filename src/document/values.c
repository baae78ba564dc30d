/* Values that stand by themselves, numbers, texts, lists of them, and the messages about them. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "document/internal.h"

/* Writes PATH into the SIZE bytes of TEXT; returns the length. */
size_t path_text(const struct path *path, char *text, size_t size)
{
    if (!path) {
        text[0] = '\0';
        return 0;
    }
    size_t length = path_text(path->parent, text, size);
    const char *dot = length > 0 ? "." : "";
    int added = path->key ? snprintf(text + length, size - length, "%s%s", dot, path->key)
                          : snprintf(text + length, size - length, "%s%d", dot, path->item);
    length += (size_t)added;
    return length < size ? length : size - 1;
}

/* Notes the first LENGTH bytes of PATH, unless it is noted already. */
static void mark_part(struct document *document, const char *path, size_t length)
{
    int64_t room = document->wrong_room;
    if (name_index_find_part(&document->marks, path, length) >= 0 ||
        !memory_reserve((void **)&document->wrong, &room, document->wrong_count + 1,
                        document->wrong_count, sizeof *document->wrong))
        return;
    document->wrong_room = (int)room;
    char *text = text_copy_part(path, length);
    if (!text || !name_index_add(&document->marks, text, document->wrong_count))
        free(text);
    else
        document->wrong[document->wrong_count++] = text;
}

/* What holds a mistake is wrong too. */
void mark_wrong(struct reading *reading, const struct path *path)
{
    char text[1024];
    path_text(path, text, sizeof text);
    for (size_t length = 0; text[length]; length++)
        if (text[length] == '.')
            mark_part(reading->document, text, length);
    mark_part(reading->document, text, strlen(text));
}

void complain(struct reading *reading, struct mark place, const struct path *path,
              const char *format, ...)
{
    char text[1024];
    path_text(path, text, sizeof text);
    mark_wrong(reading, path);
    va_list arguments;
    va_start(arguments, format);
    reading->error = error_join(reading->error, place_verror(place, text, format, arguments));
    va_end(arguments);
}

void complain_memory(struct reading *reading)
{
    reading->error = error_join(reading->error, out_of_memory());
}

/* What stands in the file, for "found ...". */
static const char *found_text(const struct node *node, char *buffer)
{
    if (node->kind == NODE_LIST)
        return "a list";
    if (node->kind == NODE_MAP)
        return "a map";
    if (node_is_empty(node))
        return "nothing";
    snprintf(buffer, TEXT_MAX, "\"%.60s\"", node->text);
    return buffer;
}

void complain_kind(struct reading *reading, const struct node *node, const struct path *path,
                   const char *wanted)
{
    char buffer[TEXT_MAX];
    complain(reading, node_place(node), path, "expected %s, found %s", wanted,
             found_text(node, buffer));
}

void list_text(const char *const *names, int count, char *text, size_t size)
{
    size_t length = 0;
    text[0] = '\0';
    for (int i = 0; i < count && length + 1 < size; i++) {
        int added = snprintf(text + length, size - length, "%s%s", i ? ", " : "", names[i]);
        length += (size_t)added;
    }
}

void complain_unknown(struct reading *reading, struct mark place, const struct path *path,
                      const char *what, const char *word, const char *const *names, int count)
{
    const bool full = error_is_full(reading->error);
    const char *near = full ? NULL : nearest_name(word, names, count);
    char known[1024];
    list_text(names, full ? 0 : count, known, sizeof known);
    if (near)
        complain(reading, place, path, "%s \"%.60s\" (did you mean \"%s\"?)", what, word, near);
    else
        complain(reading, place, path, "%s \"%.60s\" (known: %s)", what, word, known);
}

struct dimension_name {
    struct dimension dimension;
    const char *name;
};

/* "a length (m)", "a quantity in m^2/s" or "a plain number". */
static const char *quantity_text(struct dimension dimension, char *buffer)
{
    static const struct dimension_name names[] = {
        {{1, 0, 0, 0}, "a length"},
        {{0, 1, 0, 0}, "a mass"},
        {{0, 0, 1, 0}, "a time"},
        {{0, 0, 0, 1}, "a temperature"},
        {{1, 0, -1, 0}, "a velocity"},
        {{1, 0, -2, 0}, "an acceleration"},
        {{-3, 1, 0, 0}, "a density"},
        {{-1, 1, -2, 0}, "a pressure"},
        {{2, 0, -2, 0}, "an energy per mass"},
        {{2, 1, -2, 0}, "an energy"},
        {{1, 1, -2, 0}, "a force"},
        {{2, 0, 0, 0}, "an area"},
        {{3, 0, 0, 0}, "a volume"},
    };
    char unit[DIMENSION_TEXT];
    dimension_text(dimension, unit);
    if (!unit[0])
        return "a plain number";
    for (size_t i = 0; i < COUNT_OF(names); i++) {
        if (dimension_equal(dimension, names[i].dimension)) {
            snprintf(buffer, TEXT_MAX, "%s (%s)", names[i].name, unit);
            return buffer;
        }
    }
    snprintf(buffer, TEXT_MAX, "a quantity in %s", unit);
    return buffer;
}

static bool is_word_letter(char letter) { return isalnum((unsigned char)letter) || letter == '_'; }

static bool uses_name(const char *text, const char *name)
{
    size_t length = strlen(name);
    for (const char *at = text; (at = strstr(at, name)); at++)
        if ((at == text || !is_word_letter(at[-1])) && !is_word_letter(at[length]))
            return true;
    return false;
}

/* The names that the text of NODE may use: a file of the library has none, as it means the same in
 * every case. */
static const struct named_quantities *names_for(const struct reading *reading,
                                                const struct node *node)
{
    static const struct named_quantities none = {0};
    return node->foreign ? &none : &reading->names;
}

/* True when NODE uses a name of `let` whose own expression is wrong; that has been told already. */
static bool rests_on_mistake(const struct reading *reading, const struct node *node)
{
    for (const char *at = node->text; *at && reading->wrong_names > 0 && !node->foreign;) {
        size_t length = 0;
        while (is_word_letter(at[length]))
            length++;
        const int name = length ? name_index_find_part(&reading->names.index, at, length) : -1;
        if (name >= 0 && isnan(reading->name[name].quantity.value))
            return true;
        at += length ? length : 1;
    }
    return false;
}

/* " (--set let.speed=2000)" when a name in TEXT comes from a setting, which may be what is
 * wrong. */
static const char *setting_text(const struct reading *reading, const char *text, char *buffer)
{
    buffer[0] = '\0';
    for (int i = 0; reading->let && i < reading->let->count; i++) {
        const struct node *entry = reading->let->child[i];
        if (entry->place.line == 0 && uses_name(text, entry->key))
            snprintf(buffer, TEXT_MAX, " (%s)", entry->place.origin);
    }
    return buffer;
}

/* Any expression; it may name ARGUMENTS where FIELD is not NULL. */
static bool read_expression(struct reading *reading, const struct node *node,
                            const struct path *path, const char *wanted, unsigned arguments,
                            struct quantity *quantity, struct varying_expression **field)
{
    if (node->kind != NODE_SCALAR || node_is_empty(node)) {
        complain_kind(reading, node, path, wanted);
        return false;
    }
    /* once no more messages are wanted, what is left need not be judged */
    if (error_is_full(reading->error) || rests_on_mistake(reading, node)) {
        mark_wrong(reading, path);
        return false;
    }
    const struct named_quantities *names = names_for(reading, node);
    struct error *error =
        field ? varying_expression_compile(node->text, arguments, names, quantity, field)
              : expression_evaluate(node->text, names, quantity);
    char from[TEXT_MAX];
    for (int i = 0; error && i < error_count(error); i++)
        complain(reading, node->place, path, "\"%.60s\": %s%s", node->text, error_message(error, i),
                 setting_text(reading, node->text, from));
    error_free(error);
    return !error;
}

bool read_quantity(struct reading *reading, const struct node *node, const struct path *path,
                   const char *wanted, struct quantity *quantity)
{
    return read_expression(reading, node, path, wanted, 0, quantity, NULL);
}

static struct dimension unit_dimension(const char *unit)
{
    struct unit parsed = {0};
    struct error *error = unit_parse(unit ? unit : "", &parsed);
    assert(!error && "a table names an unknown unit");
    error_free(error);
    return parsed.dimension;
}

/* An expression of the dimension that PARAMETER has; a bare zero has every dimension. FIELD is as
 * above. */
static bool read_dimensioned(struct reading *reading, const struct node *node,
                             const struct path *path, const struct parameter *parameter,
                             double *value, struct varying_expression **field)
{
    struct dimension wanted = unit_dimension(parameter->unit);
    struct quantity quantity;
    char buffer[TEXT_MAX], other[TEXT_MAX], from[TEXT_MAX];
    if (!read_expression(reading, node, path, quantity_text(wanted, buffer), parameter->arguments,
                         &quantity, field))
        return false;
    bool zero = quantity.value == 0.0 && dimension_equal(quantity.dimension, unit_dimension(""));
    if (!zero && !dimension_equal(quantity.dimension, wanted)) {
        complain(reading, node->place, path, "\"%.60s\" is %s, expected %s%s", node->text,
                 quantity_text(quantity.dimension, other), quantity_text(wanted, buffer),
                 setting_text(reading, node->text, from));
        return false;
    }
    *value = quantity.value;
    return true;
}

static void check_range(struct reading *reading, const struct node *node, const struct path *path,
                        const struct parameter *parameter, double value)
{
    double above = parameter->above, below = parameter->below;
    if (above == 0.0 && below == 0.0)
        return;
    bool closed = parameter->closed;
    if (closed ? value >= above && value <= below : value > above && value < below)
        return;
    const char *unit = parameter->unit && parameter->unit[0] ? parameter->unit : "";
    const char *space = unit[0] ? " " : "";
    if (isinf(below))
        complain(reading, node->place, path, "\"%.60s\" is out of range: it must be %s %g%s%s",
                 node->text, closed ? "at least" : "more than", above, space, unit);
    else if (isinf(above))
        complain(reading, node->place, path, "\"%.60s\" is out of range: it must be %s %g%s%s",
                 node->text, closed ? "at most" : "less than", below, space, unit);
    else
        complain(reading, node->place, path, "\"%.60s\" is out of range: it must be %g to %g%s%s%s",
                 node->text, above, below, space, unit, closed ? "" : ", without the ends");
}

static void read_number(struct reading *reading, const struct node *node, const struct path *path,
                        const struct parameter *parameter, double *value)
{
    double number;
    if (!read_dimensioned(reading, node, path, parameter, &number, NULL))
        return;
    *value = number;
    check_range(reading, node, path, parameter, number);
}

static void read_integer(struct reading *reading, const struct node *node, const struct path *path,
                         const struct parameter *parameter, int64_t *value)
{
    struct quantity quantity;
    if (!read_quantity(reading, node, path, "a whole number", &quantity))
        return;
    if (!dimension_equal(quantity.dimension, unit_dimension("")) ||
        quantity.value != floor(quantity.value) || fabs(quantity.value) > 0x1p53) {
        complain_kind(reading, node, path, "a whole number");
        return;
    }
    *value = (int64_t)quantity.value;
    check_range(reading, node, path, parameter, quantity.value);
}

static void read_flag(struct reading *reading, const struct node *node, const struct path *path,
                      bool *value)
{
    if (node->kind == NODE_SCALAR && (!strcmp(node->text, "yes") || !strcmp(node->text, "no")))
        *value = node->text[0] == 'y';
    else
        complain_kind(reading, node, path, "yes or no");
}

/* A scalar as it stands; "" is not among them. */
static bool read_text(struct reading *reading, const struct node *node, const struct path *path,
                      char **value)
{
    if (node->kind != NODE_SCALAR || node_is_empty(node)) {
        complain_kind(reading, node, path, "a text");
        return false;
    }
    *value = text_copy(node->text);
    if (!*value)
        complain_memory(reading);
    return *value;
}

static void read_choice(struct reading *reading, const struct node *node, const struct path *path,
                        const struct parameter *parameter, int *value)
{
    int count = 0;
    while (parameter->names[count])
        count++;
    if (node->kind != NODE_SCALAR || node_is_empty(node)) {
        char known[TEXT_MAX], wanted[TEXT_MAX + 16];
        list_text(parameter->names, count, known, sizeof known);
        snprintf(wanted, sizeof wanted, "one of %s", known);
        complain_kind(reading, node, path, wanted);
        return;
    }
    for (int i = 0; i < count; i++) {
        if (!strcmp(node->text, parameter->names[i])) {
            *value = i;
            return;
        }
    }
    complain_unknown(reading, node->place, path, "unknown choice", node->text, parameter->names,
                     count);
}

static void read_vector(struct reading *reading, const struct node *node, const struct path *path,
                        const struct parameter *parameter, struct vector_value *value)
{
    if (node->kind != NODE_LIST || node->count < 1 || node->count > 3) {
        complain_kind(reading, node, path, "a list of 1 to 3 values");
        return;
    }
    value->count = node->count;
    for (int i = 0; i < node->count; i++) {
        struct path item = {path, NULL, i + 1};
        read_number(reading, node->child[i], &item, parameter, &value->at[i]);
    }
}

static void read_vectors(struct reading *reading, const struct node *node, const struct path *path,
                         const struct parameter *parameter, struct vector_list *value)
{
    if (node->kind != NODE_LIST) {
        complain_kind(reading, node, path, "a list of lists");
        return;
    }
    value->items = memory_allocate((size_t)node->count * sizeof *value->items);
    if (!value->items) {
        complain_memory(reading);
        return;
    }
    value->count = node->count;
    for (int i = 0; i < node->count; i++) {
        struct path item = {path, NULL, i + 1};
        read_vector(reading, node->child[i], &item, parameter, &value->items[i]);
    }
}

/* What an expression of arguments may come to is judged where it is evaluated. */
static void read_field(struct reading *reading, const struct node *node, const struct path *path,
                       const struct parameter *parameter, struct field_value *value)
{
    struct field_value field = {NAN, NULL};
    if (read_dimensioned(reading, node, path, parameter, &field.constant, &field.varying)) {
        *value = field;
        if (!field.varying)
            check_range(reading, node, path, parameter, field.constant);
    } else {
        varying_expression_free(field.varying);
    }
}

static void read_fields(struct reading *reading, const struct node *node, const struct path *path,
                        const struct parameter *parameter, struct field_list *value)
{
    if (node->kind != NODE_LIST) {
        complain_kind(reading, node, path, "a list of values");
        return;
    }
    if (node->count < 1 || node->count > FIELD_COMPONENTS) {
        complain(reading, node->place, path, "expected 1 to %d values, found %d", FIELD_COMPONENTS,
                 node->count);
        return;
    }
    value->count = node->count;
    for (int i = 0; i < node->count; i++) {
        struct path item = {path, NULL, i + 1};
        read_field(reading, node->child[i], &item, parameter, &value->at[i]);
    }
}

static void read_names(struct reading *reading, const struct node *node, const struct path *path,
                       struct name_list *value)
{
    if (node->kind == NODE_MAP || node_is_empty(node)) {
        complain_kind(reading, node, path, "a list of names");
        return;
    }
    int count = node->kind == NODE_LIST ? node->count : 1;
    value->names = calloc((size_t)count + 1, sizeof *value->names);
    if (!value->names) {
        complain_memory(reading);
        return;
    }
    for (int i = 0; i < count; i++) {
        struct path item = {path, NULL, i + 1};
        bool list = node->kind == NODE_LIST;
        if (!read_text(reading, list ? node->child[i] : node, list ? &item : path,
                       &value->names[i]))
            return;
        value->count++;
    }
}

void read_scalar(struct reading *reading, const struct node *node, const struct path *path,
                 const struct parameter *parameter, void *value)
{
    switch (parameter->kind) {
    case PARAMETER_NUMBER:
        read_number(reading, node, path, parameter, value);
        break;
    case PARAMETER_QUANTITY:
        read_quantity(reading, node, path, "a quantity", value);
        break;
    case PARAMETER_INTEGER:
        read_integer(reading, node, path, parameter, value);
        break;
    case PARAMETER_FLAG:
        read_flag(reading, node, path, value);
        break;
    case PARAMETER_TEXT:
        if (read_text(reading, node, path, value) && parameter->is_path &&
            !make_path_whole(node->place, value))
            complain_memory(reading);
        break;
    case PARAMETER_CHOICE:
        read_choice(reading, node, path, parameter, value);
        break;
    case PARAMETER_VECTOR:
        read_vector(reading, node, path, parameter, value);
        break;
    case PARAMETER_VECTORS:
        read_vectors(reading, node, path, parameter, value);
        break;
    case PARAMETER_FIELD:
        read_field(reading, node, path, parameter, value);
        break;
    case PARAMETER_FIELDS:
        read_fields(reading, node, path, parameter, value);
        break;
    case PARAMETER_NAMES:
        read_names(reading, node, path, value);
        break;
    default:
        assert(false);
    }
}
