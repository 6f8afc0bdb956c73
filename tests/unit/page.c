/* SPDX-License-Identifier: MIT
 * page.c: see page.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "page.h"

static void write_line(void *user, int32_t level, const char *line)
{
    page *p = user;
    assert_int_equal(level, TAHR_LOG_INFO);
    size_t used = strlen(p->text);
    snprintf(p->text + used, sizeof p->text - used, "%s\n", line);
    p->lines++;
}

tahr_log page_log(page *p)
{
    return (tahr_log){p, write_line};
}

void page_says(const page *p, const char *what)
{
    if (strstr(p->text, what)) return;
    fail_msg("\"%s\" is not in:\n%s", what, p->text);
}
