/* SPDX-License-Identifier: MIT
 * form_avx2.c: four triangles at a time. Only called where the processor has AVX2; without FMA, so that it does the
 * operations of the scalar twin. */
#include "form.h"

#include <string.h>

#if defined(__GNUC__) && defined(__x86_64__)

#include "../common/avx2_begin.h"

#include <immintrin.h>

enum { WIDTH = 4 };

typedef double lane __attribute__((vector_size(32)));
typedef int64_t mask __attribute__((vector_size(32)));

typedef struct vec {
    lane x, y, z;
} vec;

static inline lane one_over_root(lane a)
{
    return (lane)_mm256_cvtps_pd(_mm_div_ps(_mm_set1_ps(1), _mm_sqrt_ps(_mm256_cvtpd_ps((__m256d)a))));
}

static inline lane lower(lane a, lane b)
{
    return (lane)_mm256_min_pd((__m256d)a, (__m256d)b);
}

static inline lane higher(lane a, lane b)
{
    return (lane)_mm256_max_pd((__m256d)a, (__m256d)b);
}

static inline void put(float *to, lane x)
{
    _mm_storeu_ps(to, _mm256_cvtpd_ps((__m256d)x));
}

static inline __m256d both(const double *low, const double *high)
{
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(low)), _mm_loadu_pd(high), 1);
}

static inline vec load(const tahr_vec3 *const v[TAHR__FORMED])
{
    const __m256d even = both(&v[0]->x, &v[2]->x), odd = both(&v[1]->x, &v[3]->x);
    const __m256d z = {v[0]->z, v[1]->z, v[2]->z, v[3]->z};
    return (vec){(lane)_mm256_unpacklo_pd(even, odd), (lane)_mm256_unpackhi_pd(even, odd), (lane)z};
}

#include "form_kernel.h"

void tahr__form_4(const tahr__map *map, const tahr__raw *raw, float *lanes)
{
    form(map, raw, lanes);
}

#include "../common/avx2_end.h"

#else

/* Nobody takes it: see tahr__former_of. */
void tahr__form_4(const tahr__map *map, const tahr__raw *raw, float *lanes)
{
    (void)map;
    (void)raw;
    (void)lanes;
}

#endif
