/* SPDX-License-Identifier: MIT
 * sink.hpp: your own receiver of telemetry (<tahr/sink.h>) as a lambda or as an object. Comes with <tahr/telemetry.hpp>
 * and <tahr/lcm.hpp>.
 *
 * What a sink listens to has these names and arguments, one of them at least; of what it lacks it hears nothing. Each
 * returns nothing, which means TAHR_OK, or a tahr_status or tahr::status; flush returns nothing:
 *     state(const tahr_stamp &stamp, const tahr_state &state)         a lambda is this one
 *     event(const tahr_stamp &stamp, const tahr_event &event)
 *     input(const tahr_stamp &stamp, const tahr_sink_input &input)
 *     report(const tahr_stamp &stamp, const tahr_sink_report &report)
 *     snapshot(const tahr_stamp &stamp, const tahr_state &state)
 *     change(const tahr_sink_change &change)
 *     world(const tahr_sink_world &world)
 *     flush()
 * They are called by the telemetry's thread, one at a time.
 *
 * An exception that leaves one of them counts its message as failed (TAHR_E_BACKEND), and the telemetry goes on; the
 * first one comes out of the value() of tahr::telemetry::stop() again as what it was. */
#ifndef TAHR_SINK_HPP
#define TAHR_SINK_HPP

#include <tahr/sink.h>

#include "callbacks.hpp"
#include "shared.hpp"

namespace tahr
{
inline namespace TAHR_CPP_KIND
{

/* A sink of C, and what keeps it. Made of a pointer it keeps nothing: then the sink is yours to keep. */
class sink_ref
{
  public:
    sink_ref(const tahr_sink *sink) noexcept : sink_(sink)
    {
    }
    sink_ref(const tahr_sink *sink, detail::ref<detail::shared> owner) noexcept : owner_(std::move(owner)), sink_(sink)
    {
    }
    const tahr_sink *get() const noexcept
    {
        return sink_;
    }
    const detail::ref<detail::shared> &owner() const noexcept
    {
        return owner_;
    }

  private:
    detail::ref<detail::shared> owner_;
    const tahr_sink *sink_;
};

namespace detail
{

TAHR_CPP_MEMBER("sink.hpp", state, std::declval<const tahr_stamp &>(), std::declval<const tahr_state &>())
TAHR_CPP_MEMBER("sink.hpp", event, std::declval<const tahr_stamp &>(), std::declval<const tahr_event &>())
TAHR_CPP_MEMBER("sink.hpp", input, std::declval<const tahr_stamp &>(), std::declval<const tahr_sink_input &>())
TAHR_CPP_MEMBER("sink.hpp", report, std::declval<const tahr_stamp &>(), std::declval<const tahr_sink_report &>())
TAHR_CPP_MEMBER("sink.hpp", snapshot, std::declval<const tahr_stamp &>(), std::declval<const tahr_state &>())
TAHR_CPP_MEMBER("sink.hpp", change, std::declval<const tahr_sink_change &>())
TAHR_CPP_MEMBER("sink.hpp", world, std::declval<const tahr_sink_world &>())
TAHR_CPP_MEMBER("sink.hpp", flush, ) /* nothing */

/* A lambda or a function of states. */
template <class E> constexpr bool takes_states = std::is_invocable_v<E &, const tahr_stamp &, const tahr_state &>;

/* An object that has any of the names: those with other arguments are refused by name. */
template <class E> constexpr bool listens() noexcept
{
    if constexpr (!std::is_class_v<E> || std::is_same_v<std::remove_cv_t<E>, tahr_sink>) {
        return false;
    } else {
        return calls_state<E>::value || calls_event<E>::value || calls_input<E>::value || calls_report<E>::value ||
               calls_snapshot<E>::value || calls_change<E>::value || calls_world<E>::value || calls_flush<E>::value ||
               names_state<E>::value || names_event<E>::value || names_input<E>::value || names_report<E>::value ||
               names_snapshot<E>::value || names_change<E>::value || names_world<E>::value || names_flush<E>::value;
    }
}

/* What a telemetry and its thread own together; of a sink of C what keeps it, and no more. */
struct sink_block : logged {
    ref<shared> below;
    tahr_sink sink{};
#ifndef TAHR_CPP_NO_EXCEPTIONS
    std::atomic<bool> threw{false}; /* first is written, and is so only once */
    trouble first{};
    /* On the telemetry's thread, after each call of the sink. */
    void keep() noexcept
    {
        trouble &t = trouble_here();
        if (!t.open) return;
        if (t.thrown && !threw.load(std::memory_order_relaxed)) {
            first = t;
            threw.store(true, std::memory_order_release);
        }
        t = trouble{};
    }
#endif
};

/* A Held, or what it points to, as a sink of C. */
template <class Held> struct telling : sink_block {
    using E = std::conditional_t<std::is_class_v<std::remove_pointer_t<Held>>, std::remove_pointer_t<Held>, Held>;

    explicit telling(Held &&given) noexcept(std::is_nothrow_move_constructible_v<Held>) : held(std::move(given))
    {
        sink.struct_size = sizeof sink;
        sink.abi_major = TAHR_ABI_MAJOR;
        sink.abi_minor = TAHR_ABI_MINOR;
        sink.name = "cpp";
        sink.user = this;
        if constexpr (takes_states<E> || has_state<E>()) sink.state = state;
        if constexpr (has_event<E>()) sink.event = event;
        if constexpr (has_input<E>()) sink.input = input;
        if constexpr (has_report<E>()) sink.report = report;
        if constexpr (has_snapshot<E>()) sink.snapshot = snapshot;
        if constexpr (has_change<E>()) sink.change = change;
        if constexpr (has_world<E>()) sink.world = world;
        if constexpr (has_flush<E>()) sink.flush = flush;
    }
    E &target() noexcept
    {
        if constexpr (std::is_same_v<E, Held>) {
            return held;
        } else {
            return *held;
        }
    }

  private:
    template <class Call> static tahr_status tell(void *user, Call call) noexcept
    {
        telling &self = *static_cast<telling *>(user);
        tahr_status code = guarded([&] { return call(self.target()); });
#ifndef TAHR_CPP_NO_EXCEPTIONS
        self.keep();
#endif
        return code;
    }
    static tahr_status state(void *user, const tahr_stamp *stamp, const tahr_state *state) noexcept
    {
        if constexpr (takes_states<E>) {
            return tell(user, [&](E &to) { return to(*stamp, *state); });
        } else {
            return tell(user, [&](E &to) { return to.state(*stamp, *state); });
        }
    }
    static tahr_status event(void *user, const tahr_stamp *stamp, const tahr_event *event) noexcept
    {
        return tell(user, [&](E &to) { return to.event(*stamp, *event); });
    }
    static tahr_status input(void *user, const tahr_stamp *stamp, const tahr_sink_input *input) noexcept
    {
        return tell(user, [&](E &to) { return to.input(*stamp, *input); });
    }
    static tahr_status report(void *user, const tahr_stamp *stamp, const tahr_sink_report *report) noexcept
    {
        return tell(user, [&](E &to) { return to.report(*stamp, *report); });
    }
    static tahr_status snapshot(void *user, const tahr_stamp *stamp, const tahr_state *state) noexcept
    {
        return tell(user, [&](E &to) { return to.snapshot(*stamp, *state); });
    }
    static tahr_status change(void *user, const tahr_sink_change *change) noexcept
    {
        return tell(user, [&](E &to) { return to.change(*change); });
    }
    static tahr_status world(void *user, const tahr_sink_world *world) noexcept
    {
        return tell(user, [&](E &to) { return to.world(*world); });
    }
    static void flush(void *user) noexcept
    {
        (void)tell(user, [](E &to) { to.flush(); });
    }

    Held held;
};

} // namespace detail
} // namespace TAHR_CPP_KIND
} // namespace tahr
#endif
