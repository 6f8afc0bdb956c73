/* SPDX-License-Identifier: MIT
 * form_avx512.c: eight triangles at a time. Only called where tahr__has_avx512 says so; without FMA, so that it does
 * the operations of the scalar twin. */
#include "form.h"

#include <string.h>

#if defined(__GNUC__) && defined(__x86_64__)

#include "../common/avx512_begin.h"

#include <immintrin.h>

enum { WIDTH = 8 };

typedef double lane __attribute__((vector_size(64)));
typedef int64_t mask __attribute__((vector_size(64)));

typedef struct vec {
    lane x, y, z;
} vec;

static inline lane one_over_root(lane a)
{
    return (lane)_mm512_cvtps_pd(_mm256_div_ps(_mm256_set1_ps(1), _mm256_sqrt_ps(_mm512_cvtpd_ps((__m512d)a))));
}

static inline lane lower(lane a, lane b)
{
    return (lane)_mm512_min_pd((__m512d)a, (__m512d)b);
}

static inline lane higher(lane a, lane b)
{
    return (lane)_mm512_max_pd((__m512d)a, (__m512d)b);
}

static inline void put(float *to, lane x)
{
    _mm256_storeu_ps(to, _mm512_cvtpd_ps((__m512d)x));
}

/* x and y of every other one. */
static inline __m512d four(const tahr_vec3 *const *v)
{
    __m512d all = _mm512_castpd128_pd512(_mm_loadu_pd(&v[0]->x));
    all = _mm512_insertf64x2(all, _mm_loadu_pd(&v[2]->x), 1);
    all = _mm512_insertf64x2(all, _mm_loadu_pd(&v[4]->x), 2);
    return _mm512_insertf64x2(all, _mm_loadu_pd(&v[6]->x), 3);
}

static inline vec load(const tahr_vec3 *const v[TAHR__FORMED])
{
    const __m512d even = four(v), odd = four(v + 1);
    const lane z = {v[0]->z, v[1]->z, v[2]->z, v[3]->z, v[4]->z, v[5]->z, v[6]->z, v[7]->z};
    return (vec){(lane)_mm512_unpacklo_pd(even, odd), (lane)_mm512_unpackhi_pd(even, odd), z};
}

#include "form_kernel.h"

void tahr__form_8(const tahr__map *map, const tahr__raw *raw, float *lanes)
{
    form(map, raw, lanes);
}

#include "../common/avx2_end.h"

#else

/* Nobody takes it: see tahr__former_of. */
void tahr__form_8(const tahr__map *map, const tahr__raw *raw, float *lanes)
{
    (void)map;
    (void)raw;
    (void)lanes;
}

#endif
