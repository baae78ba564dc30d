/* Errors as values; see error.h. When memory is out, a constant error stands in, so that the caller
 * still learns that something failed. */
#include "base/error.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

struct error {
    enum error_kind kind;
    int count;
    char **messages;
    bool known_to_all;
};

static char *const out_of_memory_text[] = {"out of memory"};
static const struct error out_of_memory = {ERROR_SYSTEM, 1, (char **)out_of_memory_text, false};

/* The one cast from const: error_free and the editing functions leave this error alone. */
static struct error *error_out_of_memory(void) { return (struct error *)&out_of_memory; }

struct error *error_new(enum error_kind kind, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *message = text_vformat(format, arguments);
    va_end(arguments);
    struct error *error = malloc(sizeof *error);
    char **messages = malloc(sizeof *messages);
    if (!message || !error || !messages) {
        free(message);
        free(error);
        free(messages);
        return error_out_of_memory();
    }
    messages[0] = message;
    *error = (struct error){kind, 1, messages, false};
    return error;
}

struct error *error_context(struct error *error, const char *format, ...)
{
    if (!error || error == &out_of_memory)
        return error;
    va_list arguments;
    va_start(arguments, format);
    char *context = text_vformat(format, arguments);
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

struct error *error_join(struct error *first, struct error *second)
{
    if (!first || second == &out_of_memory) {
        error_free(second ? first : NULL);
        return second ? second : first;
    }
    if (!second || first == &out_of_memory) {
        error_free(second);
        return first;
    }
    int count = first->count + second->count;
    char **messages = realloc(first->messages, (size_t)count * sizeof *messages);
    if (!messages) {
        error_free(second);
        return first;
    }
    memcpy(messages + first->count, second->messages, (size_t)second->count * sizeof *messages);
    first->messages = messages;
    first->count = count;
    if (second->kind > first->kind)
        first->kind = second->kind;
    free(second->messages);
    free(second);
    return first;
}

enum error_kind error_kind(const struct error *error) { return error->kind; }

struct error *error_known_to_all(struct error *error)
{
    if (error != &out_of_memory)
        error->known_to_all = true;
    return error;
}

bool error_is_known_to_all(const struct error *error) { return error->known_to_all; }

int error_count(const struct error *error) { return error->count; }

const char *error_message(const struct error *error, int index)
{
    assert(index >= 0 && index < error->count);
    return error->messages[index];
}

void error_free(struct error *error)
{
    if (!error || error == &out_of_memory)
        return;
    for (int i = 0; i < error->count; i++)
        free(error->messages[i]);
    free(error->messages);
    free(error);
}
