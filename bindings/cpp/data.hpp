/* SPDX-License-Identifier: MIT
 * data.hpp: the library's plain structs with their defaults set. They stay the structs of C: write their fields. */
#ifndef TAHR_DATA_HPP
#define TAHR_DATA_HPP

#include <tahr/crowd.h>
#include <tahr/native.h>

#include "view.hpp"

namespace tahr
{
inline namespace TAHR_CPP_KIND
{

namespace detail
{

/* Zeros, and its size: how every sized struct begins. */
template <class T> T sized() noexcept
{
    T made{};
    made.struct_size = sizeof made;
    return made;
}

} // namespace detail

inline tahr_input make_input() noexcept
{
    return detail::sized<tahr_input>();
}

inline tahr_report make_report() noexcept
{
    return detail::sized<tahr_report>();
}

inline tahr_world_desc make_world_desc() noexcept
{
    return detail::sized<tahr_world_desc>();
}

inline tahr_native_desc make_native_desc() noexcept
{
    return detail::sized<tahr_native_desc>();
}

inline tahr_crowd_desc make_crowd_desc() noexcept
{
    return detail::sized<tahr_crowd_desc>();
}

/* Turned by nothing, unless it says how. */
inline tahr_pose make_pose(const tahr_vec3 &position, const tahr_quat &orientation = {0, 0, 0, 1}) noexcept
{
    return {position, orientation};
}

/* A TAHR_PRESET_*. TAHR_E_ARGUMENT where it is none. */
inline result<tahr_config> make_config(std::int32_t preset = TAHR_PRESET_PRECISE) noexcept
{
    tahr_config config{};
    tahr_status code = tahr_config_init(&config, sizeof config, preset);
    if (code < 0)
        return detail::complain(code, "tahr_config_init: preset is %d, which is none", static_cast<int>(preset));
    return {code, config};
}

/* As tahr_config_check; the message names the field. */
inline status check(const tahr_config &config) noexcept
{
    const char *field = nullptr;
    tahr_status code = tahr_config_check(&config, &field);
    if (code >= 0 || !field) return detail::checked("tahr_config_check", code);
    return detail::complain(code, "tahr_config_check: config.%s is out of its range", field);
}

/* As tahr_config_scale. */
inline status scale(tahr_config &config, double factor) noexcept
{
    return detail::checked("tahr_config_scale", tahr_config_scale(&config, factor));
}

/* A character at rest at a place, as tahr_state_init. */
inline result<tahr_state> make_state(const tahr_config &config, const tahr_vec3 &position) noexcept
{
    tahr_state state{};
    tahr_status code = tahr_state_init(&state, &config, &position);
    if (code >= 0) return {code, state};
    if (status bad = check(config); !bad) return bad;
    return detail::complain(code, "tahr_state_init: position is (%g, %g, %g), expected finite and within 1e7 m",
                            position.x, position.y, position.z);
}

/* Puts it somewhere else, as tahr_state_teleport. */
inline status teleport(tahr_state &state, const tahr_vec3 &position) noexcept
{
    tahr_status code = tahr_state_teleport(&state, &position);
    if (code >= 0) return code;
    return detail::complain(code, "tahr_state_teleport: position is (%g, %g, %g), expected finite and within 1e7 m",
                            position.x, position.y, position.z);
}

inline std::uint64_t hash(const tahr_state &state) noexcept
{
    return tahr_state_hash(&state);
}

/* What a step wrote into the arrays of a report. */
inline view<const tahr_event> events(const tahr_report &report) noexcept
{
    return {report.events, report.event_count};
}

inline view<const tahr_decision> decisions(const tahr_report &report) noexcept
{
    return {report.decisions, report.decision_count};
}

inline view<const tahr_query_record> queries(const tahr_report &report) noexcept
{
    return {report.queries, report.query_count};
}

/* A report with room for so many events of each step. Stays where it is: the report points into it. */
template <std::uint32_t Events> class event_report : public tahr_report
{
  public:
    event_report() noexcept : tahr_report(make_report())
    {
        static_assert(Events > 0, "without events a tahr_report will do");
        tahr_report::events = room_;
        event_capacity = Events;
    }
    event_report(const event_report &) = delete;
    event_report &operator=(const event_report &) = delete;

  private:
    tahr_event room_[Events];
};

/* A log that calls a function of yours, write(int32_t level, const char *message), for as long as it lives. It must not
 * throw. */
template <class Function> tahr_log log_to(Function &write) noexcept
{
    static_assert(std::is_invocable_v<Function &, std::int32_t, const char *>);
    return {const_cast<void *>(static_cast<const void *>(&write)),
            [](void *user, std::int32_t level, const char *message) noexcept {
                (*static_cast<Function *>(user))(level, message);
            }};
}

} // namespace TAHR_CPP_KIND
} // namespace tahr
#endif
