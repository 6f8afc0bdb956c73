/* SPDX-License-Identifier: MIT
 * peer.h: what the other engines' controllers share. Each is a shared object peer_NAME.so of its own that exports
 * method_NAME, so that one which cannot be built is just not there. */
#ifndef TAHR_BENCH_PEER_H
#define TAHR_BENCH_PEER_H

#include "method.h"

#if defined __cplusplus
#define PEER_EXPORT extern "C" __attribute__((visibility("default")))
#else
#define PEER_EXPORT __attribute__((visibility("default")))
#endif

/* What a shared object exports as method_NAME. Static memory. */
typedef const method *peer_entry(void);

#endif
