/* All messages of an error, a line each. */
#ifndef BOLIDE_TEST_MESSAGES_H
#define BOLIDE_TEST_MESSAGES_H

#include "base/error.h"
#include "base/memory.h"

/* To be freed. */
static inline char *messages(const struct error *error)
{
    char *text = text_copy("");
    for (int i = 0; error && i < error_count(error); i++) {
        char *longer = text_format("%s%s\n", text, error_message(error, i));
        free(text);
        text = longer;
    }
    assert_non_null(text);
    return text;
}

#endif
