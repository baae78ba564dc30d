/* Errors as values; see error.h. When memory is out, a constant error stands in, so that the caller
 * still learns that something failed. */
#include "base/error.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/visible.h"

/* More messages than this help nobody; the rest are counted. */
enum { MESSAGES_MAX = 50 };

struct error {
    enum error_kind kind;
    int count;
    char **messages; /* and behind them the one about those that are left out */
    int left_out;
    bool known_to_all;
};

static char *const no_memory_text[] = {"out of memory"};
static const struct error no_memory = {ERROR_SYSTEM, 1, (char **)no_memory_text, 0, false};

/* The one cast from const: error_free and the editing functions leave this error alone. */
static struct error *no_memory_error(void) { return (struct error *)&no_memory; }

/* A message in one visible line, whatever of other people's text it quotes. */
static char *message_of(const char *format, va_list arguments)
{
    char *raw = text_vformat(format, arguments);
    char *message = raw ? text_visible(raw) : NULL;
    free(raw);
    return message;
}

struct error *error_new(enum error_kind kind, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *message = message_of(format, arguments);
    va_end(arguments);
    struct error *error = malloc(sizeof *error);
    char **messages = malloc(sizeof *messages);
    if (!message || !error || !messages) {
        free(message);
        free(error);
        free(messages);
        return no_memory_error();
    }
    messages[0] = message;
    *error = (struct error){kind, 1, messages, 0, false};
    return error;
}

struct error *out_of_memory(void) { return error_new(ERROR_SYSTEM, "out of memory"); }

struct error *out_of_memory_for(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *what = text_vformat(format, arguments);
    va_end(arguments);
    struct error *error =
        what ? error_new(ERROR_SYSTEM, "out of memory for %s", what) : out_of_memory();
    free(what);
    return error;
}

struct error *file_error(const char *path, int number)
{
    return error_new(ERROR_SYSTEM, "%s: %s", path, number ? strerror(number) : "cannot be written");
}

struct error *error_context(struct error *error, const char *format, ...)
{
    if (!error || error == &no_memory)
        return error;
    va_list arguments;
    va_start(arguments, format);
    char *context = message_of(format, arguments);
    va_end(arguments);
    for (int i = 0; context && i < error->count; i++) {
        char *joined = text_format("%s: %s", context, error->messages[i]);
        if (joined) {
            free(error->messages[i]);
            error->messages[i] = joined;
        }
    }
    free(context);
    return error;
}

/* Takes as many messages of SECOND as there is room for, and counts the rest. */
static void take_messages(struct error *first, struct error *second)
{
    const int room = MESSAGES_MAX - first->count;
    const int taken = second->count < room ? second->count : room;
    if (first->left_out)
        free(first->messages[first->count]);
    memcpy(first->messages + first->count, second->messages, (size_t)taken * sizeof(char *));
    first->count += taken;
    for (int i = taken; i < second->count + (second->left_out > 0); i++)
        free(second->messages[i]);
    first->left_out += second->count - taken + second->left_out;
    if (!first->left_out)
        return;
    char *rest = text_format("%d more are not shown", first->left_out);
    if (rest)
        first->messages[first->count] = rest;
    else
        first->left_out = 0;
}

struct error *error_join(struct error *first, struct error *second)
{
    if (!first || second == &no_memory) {
        error_free(second ? first : NULL);
        return second ? second : first;
    }
    if (!second || first == &no_memory) {
        error_free(second);
        return first;
    }
    int count =
        first->count + second->count < MESSAGES_MAX ? first->count + second->count : MESSAGES_MAX;
    char **messages = realloc(first->messages, ((size_t)count + 1) * sizeof *messages);
    if (!messages) {
        error_free(second);
        return first;
    }
    first->messages = messages;
    take_messages(first, second);
    if (second->kind > first->kind)
        first->kind = second->kind;
    free(second->messages);
    free(second);
    return first;
}

enum error_kind error_kind(const struct error *error) { return error->kind; }

struct error *error_known_to_all(struct error *error)
{
    if (error != &no_memory)
        error->known_to_all = true;
    return error;
}

bool error_is_known_to_all(const struct error *error) { return error->known_to_all; }

bool error_is_full(const struct error *error) { return error && error->count == MESSAGES_MAX; }

int error_count(const struct error *error) { return error->count + (error->left_out > 0); }

const char *error_message(const struct error *error, int index)
{
    assert(index >= 0 && index < error_count(error));
    return error->messages[index];
}

void error_free(struct error *error)
{
    if (!error || error == &no_memory)
        return;
    for (int i = 0; i < error_count(error); i++)
        free(error->messages[i]);
    free(error->messages);
    free(error);
}
