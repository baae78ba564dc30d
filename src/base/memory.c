/* Memory and text on the heap; see memory.h. */
#include "base/memory.h"

#include <limits.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum { HUGE_PAGE = 2 << 20 };

/* Memory that nothing has touched yet: what is never used costs no page. Large arrays ask for huge
 * pages, since a step walks them in an order that ordinary ones make the processor look up again
 * and again. */
static void *allocate_raw(size_t size)
{
    size_t alignment = size < 2 * (size_t)HUGE_PAGE ? MEMORY_ALIGNMENT : HUGE_PAGE;
    size_t rounded = (size + alignment - 1) / alignment * alignment;
    if (rounded < size)
        return NULL;
    void *memory = aligned_alloc(alignment, rounded ? rounded : alignment);
#if defined(MADV_HUGEPAGE)
    /* a wish: without them it is slower, no more */
    if (memory && alignment == HUGE_PAGE)
        (void)madvise(memory, rounded, MADV_HUGEPAGE);
#endif
    return memory;
}

void *memory_allocate(size_t size)
{
    void *memory = allocate_raw(size);
    if (memory)
        memset(memory, 0, size);
    return memory;
}

void memory_keep_freed(void)
{
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, INT_MAX);
}

bool memory_reserve(void **array, int64_t *capacity, int64_t needed, int64_t kept, size_t element)
{
    if (needed <= *capacity)
        return true;
    int64_t wanted = *capacity + *capacity / 2;
    if (wanted < needed)
        wanted = needed;
    void *grown = allocate_raw((size_t)wanted * element);
    if (!grown)
        return false;
    if (kept > 0)
        memcpy(grown, *array, (size_t)kept * element);
    free(*array);
    *array = grown;
    *capacity = wanted;
    return true;
}

bool scratch_begin(struct scratch *scratch, size_t bytes)
{
    size_t wanted = bytes + (size_t)SCRATCH_PARTS * MEMORY_ALIGNMENT;
    scratch->used = 0;
    if (wanted <= scratch->size)
        return true;
    const size_t grown = scratch->size + scratch->size / 8;
    wanted = wanted > grown ? wanted : grown;
    free(scratch->memory);
    scratch->memory = allocate_raw(wanted);
    scratch->size = scratch->memory ? wanted : 0;
    return scratch->memory != NULL;
}

void *scratch_part(struct scratch *scratch, size_t bytes)
{
    void *part = scratch->memory + scratch->used;
    scratch->used += (bytes + MEMORY_ALIGNMENT - 1) / MEMORY_ALIGNMENT * MEMORY_ALIGNMENT;
    assert(scratch->used <= scratch->size);
    return part;
}

char *text_vformat(const char *format, va_list arguments)
{
    va_list again;
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, again);
    va_end(again);
    char *text = length < 0 ? NULL : malloc((size_t)length + 1);
    if (text)
        vsnprintf(text, (size_t)length + 1, format, arguments);
    return text;
}

char *text_format(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *text = text_vformat(format, arguments);
    va_end(arguments);
    return text;
}

char *text_copy(const char *text) { return text ? text_copy_part(text, strlen(text)) : NULL; }

char *text_copy_part(const char *text, size_t length)
{
    char *copy = malloc(length + 1);
    if (copy) {
        memcpy(copy, text, length);
        copy[length] = '\0';
    }
    return copy;
}
