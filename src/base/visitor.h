/* A visitor is shown every array that a resumed run needs, by name; it saves them, loads them or
 * hashes them. The one who shows an array knows its size beforehand. */
#ifndef BOLIDE_VISITOR_H
#define BOLIDE_VISITOR_H

#include "base/error.h"

enum number { NUMBER_DOUBLE, NUMBER_INT64, NUMBER_UINT64, NUMBER_UINT16 };

BOLIDE_INLINE size_t number_size(enum number number) { return number == NUMBER_UINT16 ? 2 : 8; }

struct visitor {
    /* COUNT rows of COMPONENTS numbers at DATA, under NAME ("particles/velocity"). A loading
     * visitor fills DATA, the others leave it as it is. */
    struct error *(*visit)(struct visitor *visitor, const char *name, enum number number,
                           void *data, int64_t count, int components);
    /* Not zero while the rows that are shown are FIRST and the following of TOTAL, which all ranks
     * show together; other arrays are the same on all ranks. */
    int64_t first, total;
    /* What is loaded has no array of more rows of 8 bytes; 0: nothing is loaded. */
    int64_t most;
};

#endif
