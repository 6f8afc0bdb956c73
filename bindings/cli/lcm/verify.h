/* SPDX-License-Identifier: MIT
 * verify.h: `tahr replay LOG --verify`: a log of LCM, proven by taking every recorded step again. */
#ifndef TAHR_CLI_LCM_VERIFY_H
#define TAHR_CLI_LCM_VERIFY_H

#include "../options.h"

/* glob: of the channels that count, or NULL: all. options: the level; unless they name a backend it becomes that of the
 * recording; with json all that was found is told as JSON. Returns an exit code. */
int verify_log(const char *path, const char *glob, struct options *options);

#endif
