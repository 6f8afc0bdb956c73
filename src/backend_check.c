/* SPDX-License-Identifier: MIT
 * backend_check.c: the handshake with a backend, linked or loaded. */
#include "backend_check.h"

#include <stdio.h>
#include <string.h>

#include "message.h"

static const char *const capability_names[] = {
    "TAHR_CAP_MARGIN", "TAHR_CAP_CONTACTS",  "TAHR_CAP_RAY",           "TAHR_CAP_SPHERE",  "TAHR_CAP_CAPSULE",
    "TAHR_CAP_BOX",    "TAHR_CAP_MESH",      "TAHR_CAP_BIT_IDENTICAL", "TAHR_CAP_PLANAR",  "TAHR_CAP_CYLINDER",
    "TAHR_CAP_CONE",   "TAHR_CAP_ELLIPSOID", "TAHR_CAP_HULL",          "TAHR_CAP_SOLIDS",  "TAHR_CAP_ROUND_SOLIDS",
    "TAHR_CAP_HULLS",  "TAHR_CAP_HEIGHTS",   "TAHR_CAP_CHAINS",        "TAHR_CAP_ONE_WAY", "TAHR_CAP_SENSORS"};

const char *tahr__capability_name(uint32_t capabilities)
{
    for (size_t i = 0; i < sizeof capability_names / sizeof capability_names[0]; i++) {
        if (capabilities >> i & 1) {
            return capability_names[i];
        }
    }
    return "?";
}

static const char *missing_slot(const tahr_backend *b)
{
    const struct {
        int there;
        const char *name;
    } needed[] = {{b->name != NULL, "backend.name"},   {b->version != NULL, "backend.version"},
                  {b->open != NULL, "backend.open"},   {b->close != NULL, "backend.close"},
                  {b->sweep != NULL, "backend.sweep"}, {b->contacts != NULL, "backend.contacts"},
                  {b->ray != NULL, "backend.ray"}};
    for (size_t i = 0; i < sizeof needed / sizeof needed[0]; i++) {
        if (!needed[i].there) {
            return needed[i].name;
        }
    }
    return NULL;
}

/* What is wrong, in words; TAHR_OK: nothing. In another ABI the size means nothing, so that the ABI comes first. */
static tahr_status find_problem(const tahr_backend *b, char *text, size_t room)
{
    uint32_t size;
    memcpy(&size, b, sizeof size);
    if (size < offsetof(tahr_backend, capabilities)) {
        snprintf(text, room, "backend.struct_size is %u, expected at least %u", size, (uint32_t)sizeof *b);
        return TAHR_E_STRUCT_SIZE;
    }
    if (tahr_abi_check((uint32_t)b->abi_major << 16 | b->abi_minor) < 0) {
        snprintf(text, room, "backend.abi_major and abi_minor are %u.%u, expected %d.%d: it was built for another ABI",
                 (unsigned)b->abi_major, (unsigned)b->abi_minor, TAHR_ABI_MAJOR, TAHR_ABI_MINOR);
        return TAHR_E_ABI;
    }
    if (size < sizeof *b) {
        snprintf(text, room, "backend.struct_size is %u, expected at least %u", size, (uint32_t)sizeof *b);
        return TAHR_E_STRUCT_SIZE;
    }
    const char *missing = missing_slot(b);
    if (missing) {
        snprintf(text, room, "%s is NULL, expected %s", missing, b->name && b->version ? "a function" : "a text");
        return TAHR_E_NULL;
    }
    return TAHR_OK;
}

tahr_status tahr__backend_check(const tahr_backend *backend, const tahr_log *log, const char *function,
                                const char *where)
{
    char problem[144], text[224];
    tahr_status status = find_problem(backend, problem, sizeof problem);
    if (status < 0) {
        snprintf(text, sizeof text, "%s%s%.72s", problem, where ? ", in " : "", where ? where : "");
        tahr__say(log, TAHR_LOG_ERROR, function, text);
    }
    return status;
}
