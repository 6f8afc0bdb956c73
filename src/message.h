/* SPDX-License-Identifier: MIT
 * message.h: the one way something becomes a log message. */
#ifndef TAHR_MESSAGE_H
#define TAHR_MESSAGE_H

#include <tahr/abi.h>

/* Writes "function: text" to the log (log may be NULL). */
void tahr__say(const tahr_log *log, int32_t level, const char *function, const char *text);

/* Writes "function: argument what" to the log as an error (log may be NULL). Returns status. */
tahr_status tahr__complain(const tahr_log *log, tahr_status status, const char *function, const char *argument,
                           const char *what);

/* The same with the number that was wrong: "function: argument is 1.5, what". */
tahr_status tahr__complain_value(const tahr_log *log, tahr_status status, const char *function, const char *argument,
                                 double value, const char *what);

#endif
