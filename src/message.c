/* SPDX-License-Identifier: MIT
 * message.c: one log message from parts, in a buffer on the stack; too long ones are cut. */
#include "message.h"

#include <stdio.h>

enum { MESSAGE_SIZE = 256 };

void tahr__say(const tahr_log *log, int32_t level, const char *function, const char *text)
{
    if (log && log->write) {
        char line[MESSAGE_SIZE];
        snprintf(line, sizeof line, "%s: %s", function, text);
        log->write(log->user, level, line);
    }
}

tahr_status tahr__complain(const tahr_log *log, tahr_status status, const char *function, const char *argument,
                           const char *what)
{
    if (log && log->write) {
        char text[MESSAGE_SIZE];
        snprintf(text, sizeof text, "%s: %s %s", function, argument, what);
        log->write(log->user, TAHR_LOG_ERROR, text);
    }
    return status;
}

tahr_status tahr__complain_value(const tahr_log *log, tahr_status status, const char *function, const char *argument,
                                 double value, const char *what)
{
    if (log && log->write) {
        char text[MESSAGE_SIZE];
        snprintf(text, sizeof text, "%s: %s is %.17g, %s", function, argument, value, what);
        log->write(log->user, TAHR_LOG_ERROR, text);
    }
    return status;
}
