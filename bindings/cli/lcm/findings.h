/* SPDX-License-Identifier: MIT
 * findings.h: what a judge found of a run, in words or as JSON. */
#ifndef TAHR_CLI_LCM_FINDINGS_H
#define TAHR_CLI_LCM_FINDINGS_H

#include "judge.h"

#include <jansson.h>

void findings_print(const struct verdict *verdict);

/* Into an object: counts of everything, and the first FINDINGS_SAID of each kind. */
void findings_put(json_t *run, const struct verdict *verdict);

#endif
