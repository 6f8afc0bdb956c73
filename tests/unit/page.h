/* SPDX-License-Identifier: MIT
 * page.h: all lines that the library writes to a log, for tests of what it says. */
#ifndef PAGE_H
#define PAGE_H

#include <tahr/tahr.h>

typedef struct page {
    char text[4096];
    int lines;
} page;

/* A log that writes to a page, which is zero at first: information alone, each line ends with a newline. */
tahr_log page_log(page *p);
/* Fails if that stands nowhere on it. */
void page_says(const page *p, const char *what);

#endif
