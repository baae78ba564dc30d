/* Memory and text on the heap. */
#ifndef BOLIDE_MEMORY_H
#define BOLIDE_MEMORY_H

#include <stdarg.h>

#include "base/base.h"

/* Alignment of every array that a kernel reads: one cache line, one AVX-512 register. */
enum { MEMORY_ALIGNMENT = 64 };

/* SIZE bytes aligned to MEMORY_ALIGNMENT, zeroed; NULL when memory is out. Free with free(). */
void *memory_allocate(size_t size);

/* From now on the process keeps memory that is freed, to give it out again: for large arrays that
 * come and go during a run, whose pages the system would have to clear each time. */
void memory_keep_freed(void);

/* Makes *array hold at least NEEDED elements of ELEMENT bytes, keeping its first KEPT elements.
 * *capacity counts elements and grows by half at least; what is new is not cleared. False when
 * memory is out. */
bool memory_reserve(void **array, int64_t *capacity, int64_t needed, int64_t kept, size_t element);

/* Memory for what is needed for a while, again and again: it grows and stays. Whoever begins with
 * it takes it from who had it before. Free `memory` with free(). */
struct scratch {
    char *memory;
    size_t size, used;
};

/* Makes room for parts of BYTES together, SCRATCH_PARTS of them at most, which are then taken one
 * after the other, aligned and not cleared. False when memory is out. */
enum { SCRATCH_PARTS = 16 };
bool scratch_begin(struct scratch *scratch, size_t bytes);
void *scratch_part(struct scratch *scratch, size_t bytes);

/* A printf into fresh memory; NULL when memory is out. */
char *text_format(const char *format, ...) BOLIDE_PRINTF(1, 2);
char *text_vformat(const char *format, va_list arguments);

/* A copy of TEXT (NULL gives NULL), and of its first LENGTH bytes. */
char *text_copy(const char *text);
char *text_copy_part(const char *text, size_t length);

#endif
