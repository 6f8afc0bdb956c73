/* SPDX-License-Identifier: MIT
 * json_values.h: text from outside, and counts, as JSON. */
#ifndef TAHR_CLI_JSON_VALUES_H
#define TAHR_CLI_JSON_VALUES_H

#include <jansson.h>
#include <stdint.h>

/* "?" if it is no UTF-8: the names of files, and what comes over a network, need not be. */
static inline json_t *json_text(const char *text)
{
    json_t *string = json_string(text);
    return string != NULL ? string : json_string("?");
}

static inline void json_put_count(json_t *object, const char *key, uint64_t count)
{
    json_object_set_new(object, key, json_integer((json_int_t)count));
}

#endif
