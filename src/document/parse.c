/* From YAML text to a tree of nodes. libfyaml parses and finds the mistakes of syntax; anchors,
 * aliases and tags are refused, since a case has `let` for what is used twice. */
#include <libfyaml.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/name_index.h"
#include "base/visible.h"
#include "document/internal.h"

enum { DEPTH_MAX = 48 };

struct parse {
    struct fy_parser *parser;
    struct fy_diag *messages;
    const char *origin;
    const char *text; /* of LENGTH bytes */
    size_t length;
    bool located;
    struct error
        *twins; /* keys given twice: they do not stop the reading, so that all are reported */
};

struct node *node_new(enum node_kind kind, struct mark place)
{
    struct node *node = calloc(1, sizeof *node);
    if (node) {
        node->kind = kind;
        node->place = place;
        node->key_place = place;
    }
    return node;
}

void node_free(struct node *node)
{
    if (!node)
        return;
    for (int i = 0; i < node->count; i++)
        node_free(node->child[i]);
    free(node->child);
    free(node->text);
    free(node->key);
    free(node);
}

/* The room doubles: there is some until the count is a power of two. */
bool node_append(struct node *parent, struct node *child)
{
    const size_t count = (size_t)parent->count;
    if ((count & (count - 1)) == 0) {
        struct node **grown =
            realloc(parent->child, (count ? 2 * count : 1) * sizeof(struct node *));
        if (!grown) {
            node_free(child);
            return false;
        }
        parent->child = grown;
    }
    parent->child[parent->count++] = child;
    return true;
}

struct node *node_copy(const struct node *node)
{
    struct node *copy = node_new(node->kind, node->place);
    if (!copy)
        return NULL;
    copy->plain = node->plain;
    copy->key_place = node->key_place;
    copy->text = text_copy(node->text);
    copy->key = text_copy(node->key);
    bool is_whole = (copy->text || !node->text) && (copy->key || !node->key);
    for (int i = 0; i < node->count && is_whole; i++) {
        struct node *child = node_copy(node->child[i]);
        is_whole = child && node_append(copy, child);
    }
    if (is_whole)
        return copy;
    node_free(copy);
    return NULL;
}

struct node *node_take(struct node *parent, int index)
{
    struct node *taken = parent->child[index];
    parent->count--;
    memmove(parent->child + index, parent->child + index + 1,
            (size_t)(parent->count - index) * sizeof(struct node *));
    return taken;
}

static enum fy_scalar_style style_of(const struct fy_event *event)
{
    struct fy_token *token = event->type == FYET_SCALAR ? event->scalar.value : NULL;
    return token ? fy_token_scalar_style(token) : FYSS_PLAIN;
}

static bool is_quoted(const struct fy_event *event)
{
    enum fy_scalar_style style = style_of(event);
    return style == FYSS_SINGLE_QUOTED || style == FYSS_DOUBLE_QUOTED;
}

/* Where EVENT starts, OTHERWISE when nothing of it stands in the text. */
static struct mark place_of(const struct parse *parse, struct fy_event *event,
                            struct mark otherwise)
{
    const struct fy_mark *mark = fy_event_start_mark(event);
    if (!mark)
        return otherwise;
    struct mark place = {parse->origin, 0, 0};
    if (parse->located) {
        place.line = mark->line + 1;
        place.column = mark->column + 1 - is_quoted(event); /* the mark stands behind a quote */
    }
    return place;
}

/* What the likelier messages of libfyaml, by their start, mean to who wrote the file. */
static const struct {
    const char *start, *meaning;
} meanings[] = {
    {"could not find expected ':'", "a colon and a blank are missing after this key"},
    {"did not find expected node content", "a value is missing here"},
    {"flow mapping with invalid extra", "no bracket is open that this one could close"},
    {"flow sequence with invalid extra", "no bracket is open that this one could close"},
    {"flow sequence without a closing", "a bracket above is still open"},
    {"invalid indentation in mapping", "this line is indented unlike the keys above it"},
    {"invalid multiline plain key",
     "the next line is indented deeper than this one, or its key has no value"},
    {"invalid nested block mapping",
     "a second colon in this line: a text that contains \": \" needs quotes"},
    {"invalid trailing content after",
     "the quoted text ends before this: put the whole in double quotes"},
    {"mismatched flow", "this bracket is not of the kind of the last one that is open"},
    {"missing comma in flow", "a comma or a closing bracket is missing before this"},
    {"plain scalar cannot start with", "a text that starts with this sign needs quotes"},
    {"tab character may not be used", "a tab cannot indent a line; use blanks"},
    {"wrongly indented double-quoted scalar",
     "the quote that opens here is not closed in its line"},
    {"wrongly indented single-quoted scalar",
     "the quote that opens here is not closed in its line"},
};

static const char *meaning_of(const char *message)
{
    for (size_t i = 0; i < COUNT_OF(meanings); i++)
        if (!strncmp(message, meanings[i].start, strlen(meanings[i].start)))
            return meanings[i].meaning;
    return message;
}

/* What libfyaml found wrong. */
static struct error *syntax_error(const struct parse *parse)
{
    struct error *error = NULL;
    void *step = NULL;
    const struct fy_diag_error *found;
    while ((found = fy_diag_errors_iterate(parse->messages, &step))) {
        struct mark place = {parse->origin, 0, 0};
        if (parse->located) {
            place.line = found->line;
            place.column = found->column;
        }
        error = error_join(error, place_error(place, "", "%s", meaning_of(found->msg)));
    }
    if (!error) {
        struct mark place = {parse->origin, 0, 0};
        error = place_error(place, "", "this is not YAML");
    }
    return error;
}

/* Whether two quotes in a row stand in single quotes, each written twice: libfyaml 0.7.12 takes
 * them for something else, and forgets memory over it. */
static bool has_misread_quotes(const struct parse *parse, struct fy_event *event)
{
    static const char two_quotes[] = "''''";
    enum { SIZE = sizeof two_quotes - 1 };
    const struct fy_mark *start = fy_event_start_mark(event), *end = fy_event_end_mark(event);
    if (style_of(event) != FYSS_SINGLE_QUOTED || !start || !end)
        return false;
    const size_t stop = end->input_pos < parse->length ? end->input_pos : parse->length;
    for (size_t at = start->input_pos; at + SIZE <= stop; at++)
        if (!memcmp(parse->text + at, two_quotes, SIZE))
            return true;
    return false;
}

struct error *refuse_controls(struct mark place, const char *text, bool key)
{
    uint32_t code;
    for (size_t size; *text; text += size) {
        size = utf8_character(text, strnlen(text, 4), &code);
        if (size == 0)
            return place_error(place, "", "this is not UTF-8 text");
        if (is_control(code) && (key || (code != '\n' && code != '\t')))
            return place_error(place, "", "a %s cannot hold the control character %.*s",
                               key ? "key" : "text", (int)size, text);
    }
    return NULL;
}

/* The text of a scalar's event. */
static struct error *take_text(const struct parse *parse, struct fy_event *event, struct mark place,
                               bool key, char **text)
{
    size_t length = 0;
    struct fy_token *token = event->scalar.value;
    if (has_misread_quotes(parse, event))
        return place_error(place, "",
                           "two quotes in a row cannot be in single quotes; use double quotes");
    const char *bytes = token ? fy_token_get_text(token, &length) : "";
    if (!bytes)
        return out_of_memory();
    if (memchr(bytes, '\0', length))
        return place_error(place, "", "a text cannot hold a zero byte");
    *text = text_copy_part(bytes, length);
    struct error *error = *text ? refuse_controls(place, *text, key) : out_of_memory();
    if (error) {
        free(*text);
        *text = NULL;
    }
    return error;
}

static struct error *build(struct parse *parse, struct fy_event *event, struct mark before,
                           int depth, struct node **result);

/* The next event, NULL on a mistake of syntax. */
static struct fy_event *next_event(const struct parse *parse)
{
    return fy_parser_get_stream_error(parse->parser) ? NULL : fy_parser_parse(parse->parser);
}

/* Builds what the event starts and gives the event back to the parser. */
static struct error *build_and_free(struct parse *parse, struct fy_event *event, struct mark before,
                                    int depth, struct node **result)
{
    struct error *error = build(parse, event, before, depth, result);
    fy_parser_event_free(parse->parser, event);
    return error;
}

/* Puts VALUE (taken) under KEY (taken) into MAP, whose keys are in INDEX. The key is not quoted:
 * the file may be none of ours. */
static struct error *add_entry(struct parse *parse, struct node *map, struct name_index *index,
                               struct node *value, char *key)
{
    value->key = key;
    const int twin = name_index_find(index, key);
    if (twin >= 0) {
        assert(map->child);
        parse->twins =
            error_join(parse->twins, place_error(value->key_place, "",
                                                 "this key is given twice, first in line %d",
                                                 map->child[twin]->key_place.line));
        node_free(value);
        return NULL;
    }
    if (!name_index_add(index, key, map->count)) {
        node_free(value);
        return out_of_memory();
    }
    return node_append(map, value) ? NULL : out_of_memory();
}

/* Reads a key and its value into MAP; the event is the key's. */
static struct error *build_entry(struct parse *parse, struct fy_event *event, int depth,
                                 struct node *map, struct name_index *index)
{
    struct mark place = place_of(parse, event, map->place);
    bool simple = event->type == FYET_SCALAR;
    char *key = NULL;
    struct error *error = simple ? take_text(parse, event, place, true, &key) : NULL;
    fy_parser_event_free(parse->parser, event);
    if (error)
        return error;
    if (!simple)
        return place_error(place, "", "a key must be a single name");
    struct fy_event *next = next_event(parse);
    struct node *value = NULL;
    error = next ? build_and_free(parse, next, place, depth + 1, &value) : syntax_error(parse);
    if (!value) {
        free(key);
        return error;
    }
    value->key_place = place;
    return add_entry(parse, map, index, value, key);
}

/* Reads entries or items until the end of the collection; INDEX is that of the keys of a map. */
static struct error *build_children(struct parse *parse, int depth, struct node *node,
                                    struct name_index *index)
{
    for (;;) {
        struct fy_event *event = next_event(parse);
        if (!event)
            return syntax_error(parse);
        if (event->type == FYET_MAPPING_END || event->type == FYET_SEQUENCE_END) {
            fy_parser_event_free(parse->parser, event);
            return NULL;
        }
        if (node->kind == NODE_MAP) {
            TRY(build_entry(parse, event, depth, node, index));
            continue;
        }
        struct node *item = NULL;
        TRY(build_and_free(parse, event, node->place, depth + 1, &item));
        if (!node_append(node, item))
            return out_of_memory();
    }
}

/* BEFORE is the place of the key, for a value of which nothing stands in the file. */
static struct error *build(struct parse *parse, struct fy_event *event, struct mark before,
                           int depth, struct node **result)
{
    struct mark place = place_of(parse, event, before);
    if (event->type == FYET_ALIAS || fy_event_get_anchor_token(event))
        return place_error(place, "",
                           "anchors and aliases (& and *) are not supported; a text that starts "
                           "with one needs quotes");
    if (fy_event_get_tag_token(event))
        return place_error(place, "", "tags (!) are not supported");
    if (depth > DEPTH_MAX)
        return place_error(place, "", "nested too deeply");
    struct node *node = node_new(event->type == FYET_MAPPING_START    ? NODE_MAP
                                 : event->type == FYET_SEQUENCE_START ? NODE_LIST
                                                                      : NODE_SCALAR,
                                 place);
    if (!node)
        return out_of_memory();
    struct error *error;
    if (node->kind == NODE_SCALAR) {
        node->plain = style_of(event) == FYSS_PLAIN;
        error = take_text(parse, event, place, false, &node->text);
    } else {
        struct name_index index = {0};
        error = build_children(parse, depth, node, &index);
        name_index_free(&index);
    }
    if (error) {
        node_free(node);
        return error;
    }
    *result = node;
    return NULL;
}

/* Runs through the stream: one document, whose only node becomes the root. */
static struct error *build_document(struct parse *parse, struct node **root)
{
    struct mark start = {parse->origin, parse->located ? 1 : 0, 1};
    for (;;) {
        struct fy_event *event = next_event(parse);
        if (!event)
            return syntax_error(parse);
        enum fy_event_type type = event->type;
        if (type == FYET_STREAM_START || type == FYET_DOCUMENT_END) {
            fy_parser_event_free(parse->parser, event);
            continue;
        }
        if (type == FYET_DOCUMENT_START || type == FYET_STREAM_END) {
            struct mark place = place_of(parse, event, start);
            fy_parser_event_free(parse->parser, event);
            if (type == FYET_STREAM_END)
                break;
            if (*root)
                return place_error(place, "", "a second document starts here; only one is allowed");
            continue;
        }
        TRY(build_and_free(parse, event, start, 0, root));
    }
    if (*root)
        return NULL;
    *root = node_new(NODE_SCALAR, start);
    if (*root)
        (*root)->text = text_copy("");
    if (!*root || !(*root)->text)
        return out_of_memory();
    (*root)->plain = true;
    return NULL;
}

/* What libfyaml 0.7.12 does not survive (a directive with malformed UTF-8 never ends) or
 * takes for an end (a zero byte). No case has a use for directives. */
static struct error *check_bytes(const char *text, size_t length, const char *origin, bool located)
{
    struct mark place = {origin, 1, 1};
    const char *wrong = NULL;
    uint32_t code;
    for (size_t at = 0, size; at < length && !wrong; at += size) {
        size = utf8_character(text + at, length - at, &code);
        if (size == 0)
            wrong = "this is not UTF-8 text";
        else if (text[at] == '\0')
            wrong = "a text cannot hold a zero byte";
        else if (text[at] == '%' && place.column == 1)
            wrong = "a line cannot start with %";
        else if (text[at] == '\n')
            place = (struct mark){origin, place.line + 1, 1};
        else
            place.column++;
    }
    if (!located)
        place.line = 0;
    return wrong ? place_error(place, "", "%s", wrong) : NULL;
}

struct error *node_parse(const char *text, size_t length, const char *origin, bool located,
                         struct node **root)
{
    *root = NULL;
    TRY(check_bytes(text, length, origin, located));
    struct fy_diag_cfg quiet;
    fy_diag_cfg_default(&quiet);
    quiet.fp = NULL;
    struct parse parse = {.origin = origin, .text = text, .length = length, .located = located};
    parse.messages = fy_diag_create(&quiet);
    if (!parse.messages)
        return out_of_memory();
    fy_diag_set_collect_errors(parse.messages, true);
    struct fy_parse_cfg how = {.flags = FYPCF_QUIET | FYPCF_JSON_NONE, .diag = parse.messages};
    parse.parser = fy_parser_create(&how);
    struct error *error = NULL;
    if (!parse.parser || fy_parser_set_string(parse.parser, text, length) != 0)
        error = error_new(ERROR_SYSTEM, "the YAML parser cannot start");
    else
        error = build_document(&parse, root);
    error = error_join(parse.twins, error);
    if (error) {
        node_free(*root);
        *root = NULL;
    }
    if (parse.parser)
        fy_parser_destroy(parse.parser);
    fy_diag_destroy(parse.messages);
    return error;
}
