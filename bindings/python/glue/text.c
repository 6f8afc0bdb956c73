/* SPDX-License-Identifier: MIT
 * text.c: the library's messages, kept until Python makes an exception of them. */
#include "held.h"

#include <stdio.h>
#include <string.h>

enum { LINE = 256, WHOLE = 640 }; /* the library cuts its messages at 256 */

struct glue_text {
    atomic_flag lock;
    unsigned count;
    char first[LINE], last[LINE];
    char whole[WHOLE];
};

static _Thread_local glue_text own = {.lock = ATOMIC_FLAG_INIT};
static _Thread_local glue_text lost = {.lock = ATOMIC_FLAG_INIT};
static _Thread_local glue_text *elsewhere;

glue_text *glue_text_mine(void)
{
    return &own;
}

glue_text *glue_text_nobodys(void)
{
    return &lost;
}

glue_text *glue_text_redirect(glue_text *text)
{
    glue_text *before = elsewhere;
    elsewhere = text;
    return before;
}

static void keep(void *user, int32_t level, const char *message)
{
    glue_text *text = elsewhere ? elsewhere : &own;
    (void)user;
    if (level != TAHR_LOG_ERROR) return;
    while (atomic_flag_test_and_set(&text->lock)) {
    }
    snprintf(text->count == 0 ? text->first : text->last, LINE, "%s", message);
    text->count++;
    atomic_flag_clear(&text->lock);
}

const tahr_log *glue_log(void)
{
    static const tahr_log log = {NULL, keep};
    return &log;
}

void glue_forget(void)
{
    own.count = 0;
}

tahr_status glue_complain(tahr_status status, const char *what)
{
    keep(NULL, TAHR_LOG_ERROR, what);
    return status;
}

/* The last message tells the most; the first, why. Of more than two nobody knows which is the cause of which. */
const char *glue_message(void)
{
    if (own.count == 0) return "";
    if (own.count == 1) return own.first;
    if (own.count == 2) {
        snprintf(own.whole, WHOLE, "%s (%s)", own.last, own.first);
    } else {
        snprintf(own.whole, WHOLE, "%s (and %u messages more, one of them: %s)", own.last, own.count - 1, own.first);
    }
    return own.whole;
}
