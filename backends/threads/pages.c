/* SPDX-License-Identifier: MIT
 * pages.c: see pages.h. */
#ifdef __linux__
#define _DEFAULT_SOURCE /* madvise */
#include <sys/mman.h>
#endif

#include "pages.h"

void tahr__pages_prefer_large(void *memory, size_t bytes)
{
#ifdef MADV_HUGEPAGE
    const size_t whole = bytes / TAHR__LARGE_PAGE * TAHR__LARGE_PAGE;
    if (whole > 0) madvise(memory, whole, MADV_HUGEPAGE);
#else
    (void)memory, (void)bytes;
#endif
}
