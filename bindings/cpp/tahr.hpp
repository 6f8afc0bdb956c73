/* SPDX-License-Identifier: MIT
 * tahr.hpp: Tahr for C++17: owners that clean up, lambdas as callbacks, containers as arrays, exceptions if you like
 * them. All of it is inline over the C library, and costs nothing besides. The only include an application needs;
 * <tahr/threads.hpp> and <tahr/trace.hpp>, which need libraries of their own, come beside it.
 *
 * The plain structs of C (tahr_config, tahr_state, tahr_input, ...) stay what they are, with all that their headers say
 * of them; only what owns something is a class here, and every function of C may be called beside them. */
#ifndef TAHR_TAHR_HPP
#define TAHR_TAHR_HPP

#include <tahr/tahr.h>

#include "status.hpp"
#include "view.hpp"
#include "data.hpp"
#include "bodies.hpp"
#include "callbacks.hpp"
#include "plugin.hpp"
#include "world.hpp"
#include "mover.hpp"
#include "crowd.hpp"

#endif
