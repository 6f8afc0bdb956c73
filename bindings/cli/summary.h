/* SPDX-License-Identifier: MIT
 * summary.h: what a run found, in words or as JSON. */
#ifndef TAHR_CLI_SUMMARY_H
#define TAHR_CLI_SUMMARY_H

#include "run.h"

void summary_words(const struct options *options, const struct level *level, const struct result *result);
void summary_json(const struct options *options, const struct level *level, const struct result *result);

#endif
