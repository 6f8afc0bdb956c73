/* SPDX-License-Identifier: MIT
 * pages.h: large pages: who steps many characters touches more of the usual ones than a processor remembers. */
#ifndef TAHR_THREADS_PAGES_H
#define TAHR_THREADS_PAGES_H

#include <stddef.h>

enum { TAHR__LARGE_PAGE = 2 << 20 }; /* bytes, of x86-64 and of aarch64 with pages of 4 kB */

/* Asks the system for them where memory, not touched yet and beginning with one, has room for whole ones. It may refuse;
 * only Linux is asked. */
void tahr__pages_prefer_large(void *memory, size_t bytes);

#endif
