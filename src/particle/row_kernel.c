/* The search for neighbours for one instruction set, named by BOLIDE_ISA; see row_kernel.h. */
#include "particle/row_body.h"

#include "base/isa.h"

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

#if defined(__AVX512F__)
/* Eight candidates at once; those behind the last are infinitely far. */
static int32_t keep(const struct candidates *c, const struct row_point *own, uint32_t *key,
                    uint32_t *entry)
{
    int32_t kept = 0;
    for (int32_t k = c->count; k % 8 != 0; k++) {
        c->x[k] = (double)INFINITY;
        c->y[k] = c->z[k] = c->reach[k] = 0.0;
        c->key[k] = c->entry[k] = 0;
    }
    const __m512d x = _mm512_set1_pd(own->x), y = _mm512_set1_pd(own->y),
                  z = _mm512_set1_pd(own->z), reach = _mm512_set1_pd(own->reach);
    const __m256i self = _mm256_set1_epi32((int)own->key);
    for (int32_t k = 0; k < c->count; k += 8) {
        const __m512d dx = _mm512_sub_pd(_mm512_loadu_pd(c->x + k), x);
        const __m512d dy = _mm512_sub_pd(_mm512_loadu_pd(c->y + k), y);
        const __m512d dz = _mm512_sub_pd(_mm512_loadu_pd(c->z + k), z);
        const __m512d range = _mm512_add_pd(reach, _mm512_loadu_pd(c->reach + k));
        const __m512d square = _mm512_add_pd(
            _mm512_add_pd(_mm512_mul_pd(dx, dx), _mm512_mul_pd(dy, dy)), _mm512_mul_pd(dz, dz));
        const __m256i theirs = _mm256_loadu_si256((const __m256i *)(c->key + k));
        const __mmask8 near = _mm512_cmp_pd_mask(square, _mm512_mul_pd(range, range), _CMP_LT_OQ) &
                              _mm256_cmpneq_epi32_mask(theirs, self);
        const __m256i entries = _mm256_loadu_si256((const __m256i *)(c->entry + k));
        _mm256_storeu_si256((__m256i *)(key + kept), _mm256_maskz_compress_epi32(near, theirs));
        _mm256_storeu_si256((__m256i *)(entry + kept), _mm256_maskz_compress_epi32(near, entries));
        kept += __builtin_popcount(near);
    }
    return kept;
}
#endif

ISA_KERNEL(int32_t, row_find, const struct candidates *candidates, const struct row_point *own,
           uint32_t *key, uint32_t *entry, uint32_t *row)
{
#if defined(__AVX512F__)
    const int32_t count = keep(candidates, own, key, entry);
#else
    const int32_t count = row_keep(candidates, own, key, entry);
#endif
    row_order(key, entry, count, row);
    return count;
}
