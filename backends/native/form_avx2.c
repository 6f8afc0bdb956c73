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

static inline lane root(lane a)
{
    return (lane)_mm256_sqrt_pd((__m256d)a);
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

static inline lane load(const double *a)
{
    return (lane){a[0], a[1], a[2], a[3]};
}

#include "form_kernel.h"

void tahr__form_4(const tahr__map *map, const tahr__raw *raw, float *lanes)
{
    form(map, raw, lanes);
}

#include "../common/avx2_end.h"

#else

/* Nobody takes it: see tahr__former_best. */
void tahr__form_4(const tahr__map *map, const tahr__raw *raw, float *lanes)
{
    (void)map;
    (void)raw;
    (void)lanes;
}

#endif
