/* SPDX-License-Identifier: MIT
 * tahr.h: the only include an application needs. Character movement over any collision engine. */
#ifndef TAHR_TAHR_H
#define TAHR_TAHR_H

#include <tahr/abi.h>
#include <tahr/types.h>
#include <tahr/config.h>
#include <tahr/world.h>
#include <tahr/state.h>
#include <tahr/report.h>
#include <tahr/mover.h>
#include <tahr/crowd.h>
#include <tahr/custom_mode.h>

#endif
