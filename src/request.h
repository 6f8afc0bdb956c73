/* SPDX-License-Identifier: MIT
 * request.h: another mode, because the input asks for it. */
#ifndef TAHR_REQUEST_H
#define TAHR_REQUEST_H

#include "core.h"

/* With TAHR_INPUT_MODE: changes to input.mode, or reports that it was refused. 0 queries; walking asks for its floor,
 * swimming one fluid query. */
void tahr__ask_mode(tahr__step *step);

#endif
