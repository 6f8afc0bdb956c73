/* SPDX-License-Identifier: MIT
 * status.c: names of numbers, the version, the ABI handshake. */
#include <tahr/tahr.h>

tahr_status tahr_abi_check(uint32_t header_abi)
{
    uint32_t major = header_abi >> 16, minor = header_abi & 0xFFFFu;
    /* Before 1.0 only the same minor fits; from 1.0 on any minor up to the library's own will. */
    return major == TAHR_ABI_MAJOR && minor == TAHR_ABI_MINOR ? TAHR_OK : TAHR_E_ABI;
}

#define TAHR__STRING_(x) #x
#define TAHR__STRING(x) TAHR__STRING_(x)

const char *tahr_version(void)
{
    return TAHR__STRING(TAHR_VERSION_MAJOR) "." TAHR__STRING(TAHR_VERSION_MINOR) "." TAHR__STRING(TAHR_VERSION_PATCH);
}

const char *tahr_status_name(tahr_status status)
{
    switch (status) {
#define NAME(constant, value, name, message) \
    case constant: return name;
        TAHR_STATUS_TABLE(NAME)
#undef NAME
    default: return "?";
    }
}

const char *tahr_status_message(tahr_status status)
{
    switch (status) {
#define MESSAGE(constant, value, name, message) \
    case constant: return message;
        TAHR_STATUS_TABLE(MESSAGE)
#undef MESSAGE
    default: return "not a status of this library";
    }
}

const char *tahr_event_name(uint32_t type)
{
    static const char *const names[] = {"?",       "landed",     "left_ground",  "jumped",        "apex",
                                        "stopped", "stepped_up", "stepped_down", "hit",           "depenetrated",
                                        "crushed", "stuck",      "mode",         "overlap_begin", "overlap_end",
                                        "base",    "shape",      "launched",     "pushed",        "wall_jumped",
                                        "grabbed", "custom"};
    return type < sizeof names / sizeof names[0] ? names[type] : "?";
}

const char *tahr_rule_name(uint32_t rule)
{
    switch (rule) {
#define NAME(constant, value, name) \
    case constant: return name;
        TAHR_RULE_TABLE(NAME)
#undef NAME
    default: return "?";
    }
}

const char *tahr_shortcut_name(uint32_t shortcut)
{
    switch (shortcut) {
#define NAME(constant, value, name) \
    case constant: return name;
        TAHR_SHORTCUT_TABLE(NAME)
#undef NAME
    default: return "?";
    }
}
