/* What the targets of libFuzzer share. */
#ifndef BOLIDE_FUZZ_H
#define BOLIDE_FUZZ_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Stops the target, with WHAT is wrong, unless it HOLDS. */
static inline void insist(bool holds, const char *what)
{
    if (holds)
        return;
    fprintf(stderr, "%s\n", what);
    abort();
}

/* DATA as a file is read, with a zero behind it; the caller frees it. NULL when memory is out. */
static inline char *fuzz_file(const uint8_t *data, size_t size)
{
    char *bytes = malloc(size + 1);
    if (!bytes)
        return NULL;
    if (size)
        memcpy(bytes, data, size);
    bytes[size] = '\0';
    return bytes;
}

#endif
