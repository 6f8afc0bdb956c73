/* SPDX-License-Identifier: MIT
 * json_text.h: text from outside as JSON. */
#ifndef TAHR_CLI_JSON_TEXT_H
#define TAHR_CLI_JSON_TEXT_H

#include <jansson.h>

/* "?" if it is no UTF-8: the names of files, and what comes over a network, need not be. */
static inline json_t *json_text(const char *text)
{
    json_t *string = json_string(text);
    return string != NULL ? string : json_string("?");
}

#endif
