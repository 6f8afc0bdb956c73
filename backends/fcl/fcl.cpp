/* SPDX-License-Identifier: MIT
 * fcl.cpp: the table of the fcl backend and its life cycle. */
#include <tahr/fcl.h>

const tahr_backend *tahr_backend_v1_fcl(void)
{
    return nullptr;
}
