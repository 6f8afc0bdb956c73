/* SPDX-License-Identifier: MIT
 * telemetry.hpp: what characters do, handed from the threads that step them to a sink (<tahr/telemetry.h>, sink.hpp).
 * Not part of tahr.hpp: link libtahr_threads. */
#ifndef TAHR_TELEMETRY_HPP
#define TAHR_TELEMETRY_HPP

#include <tahr/telemetry.h>

#include "mover.hpp"
#include "sink.hpp"

namespace tahr
{
inline namespace TAHR_CPP_KIND
{

inline tahr_telemetry_desc make_telemetry_desc() noexcept
{
    return detail::sized<tahr_telemetry_desc>();
}

/* Whose telemetry: a character's id; the lane of the thread that steps it, always the same one; which of the
 * description's configs its mover was created with. */
struct track {
    std::uint32_t character = 0;
    std::uint32_t lane = 0;
    std::uint32_t config = 0;
};

/* Owns a tahr_telemetry, and keeps its sink. Moves, does not copy. */
class telemetry
{
  public:
    /* An empty one: whatever is asked of it is TAHR_E_NULL. */
    telemetry() noexcept = default;
    telemetry(telemetry &&other) noexcept
        : block_(std::move(other.block_)), handle_(std::exchange(other.handle_, nullptr)), limits_(other.limits_)
    {
    }
    telemetry &operator=(telemetry &&other) noexcept
    {
        telemetry old(std::move(*this));
        block_ = std::move(other.block_);
        handle_ = std::exchange(other.handle_, nullptr);
        limits_ = other.limits_;
        return *this;
    }
    /* Delivers what is left, for up to 2 s, if it was not stopped. What then goes wrong goes to the log alone. */
    ~telemetry()
    {
        if (!handle_) return;
        detail::trouble before = std::move(detail::trouble_here());
        tahr_telemetry_destroy(handle_);
        detail::trouble_here() = std::move(before);
    }

    /* As tahr_telemetry_create; of desc the sink is not read, the log is called beside this binding's own. The sink: a
     * lambda of states or an object (sink.hpp). The telemetry owns what it is given, keeps it in one place, and ends it
     * when the last call of it has returned, be that after a stop() that did not wait any longer, on the telemetry's
     * thread; of a pointer it owns nothing. */
    template <class Sink, class = std::enable_if_t<detail::takes_states<Sink> || detail::listens<Sink>()>>
    static result<telemetry> create(const tahr_telemetry_desc &desc, Sink sink) noexcept
    {
        auto block = detail::make<detail::telling<Sink>>(desc.allocator, std::move(sink));
        const tahr_sink *told = block ? &block->sink : nullptr;
        return start(desc, told, std::move(block));
    }
    template <class Sink, class = std::enable_if_t<std::is_class_v<Sink> &&
                                                   (detail::takes_states<Sink> || detail::listens<Sink>())>>
    static result<telemetry> create(const tahr_telemetry_desc &desc, Sink *sink) noexcept
    {
        if (!sink) return detail::complain(TAHR_E_NULL, "%s: sink is NULL", "tahr::telemetry::create");
        auto block = detail::make<detail::telling<Sink *>>(desc.allocator, std::move(sink));
        const tahr_sink *told = block ? &block->sink : nullptr;
        return start(desc, told, std::move(block));
    }
    /* A sink of C, or a tahr::lcm, which the telemetry keeps open. */
    static result<telemetry> create(const tahr_telemetry_desc &desc, const sink_ref &sink) noexcept
    {
        if (!sink.get()) return detail::complain(TAHR_E_NULL, "%s: sink is NULL", "tahr::telemetry::create");
        auto block = detail::make<detail::sink_block>(desc.allocator);
        if (block) block->below = sink.owner();
        return start(desc, sink.get(), std::move(block));
    }
    /* Ids below characters, on one lane; the rest by default, and as the world says. */
    template <class Sink>
    static result<telemetry> create(const world &world, view<const tahr_config> configs, std::uint32_t characters,
                                    Sink &&sink) noexcept
    {
        tahr_telemetry_desc desc = make_telemetry_desc();
        status s = detail::count_of("tahr::telemetry::create", "configs", configs, desc.config_count);
        if (!s) return s;
        desc.configs = configs.data();
        desc.characters = characters;
        desc.backend = world.backend_name();
        desc.revision = world.revision();
        return create(desc, std::forward<Sink>(sink));
    }

    explicit operator bool() const noexcept
    {
        return handle_ != nullptr;
    }
    tahr_telemetry *handle() const noexcept
    {
        return handle_;
    }

    /* As tahr_telemetry_begin. */
    status begin(const track &who, const tahr_state &state) noexcept
    {
        return answered("tahr_telemetry_begin",
                        tahr_telemetry_begin(handle_, who.lane, who.character, who.config, &state), who, 0);
    }
    /* As tahr_telemetry_push; step.character is not read. */
    status push(const track &who, const tahr_telemetry_step &step) noexcept
    {
        tahr_telemetry_step taken = step;
        taken.character = who.character;
        return answered("tahr_telemetry_push", tahr_telemetry_push(handle_, who.lane, &taken), who, step.dt);
    }
    /* A step with what belongs before and after it: begin, mover.step, push. The status is the step's; nothing is
     * stepped where who is wrong; messages for which there was no room are in the counts alone. A mover with a mode of
     * its own (mover::set_custom_mode) steps as TAHR_STEP_CUSTOM. */
    status step(const track &who, mover &mover, const tahr_input &input, double dt, tahr_state &state,
                tahr_report *report = nullptr) noexcept
    {
        status s = begin(who, state);
        if (!s) return s;
        s = mover.step(input, dt, state, report);
        if (!s) return s;
        tahr_telemetry_step taken{};
        taken.status = s.code();
        taken.input = &input;
        taken.state = &state;
        taken.report = report;
        taken.dt = dt;
        taken.flags = mover.has_custom_mode() ? TAHR_STEP_CUSTOM : 0;
        status pushed = push(who, taken);
        return pushed ? s : pushed;
    }
    /* As tahr_telemetry_change, after world.set, move (with its dt) or touch. */
    status change(const world &world, std::uint32_t kind, view<const tahr_body_pose> poses = {}, double dt = 0) noexcept
    {
        std::uint32_t count = 0;
        status s = detail::count_of("tahr::telemetry::change", "poses", poses, count);
        if (!s) return s;
        tahr_status code = tahr_telemetry_change(handle_, kind, poses.data(), count, dt, world.revision());
        if (code != TAHR_E_ARGUMENT) return detail::checked("tahr_telemetry_change", code);
        return detail::complain(code,
                                "tahr_telemetry_change: kind %u with %u poses and dt %g, expected TAHR_CHANGE_SET, "
                                "_MOVE or _TOUCH; at most 65536 poses, of TOUCH none; dt above 0 for MOVE, else 0",
                                kind, count, dt);
    }

    /* As tahr_telemetry_latest: state and stamp stay as they are unless it is TAHR_OK. May run on any thread. */
    status latest(std::uint32_t character, tahr_state &state, tahr_stamp *stamp = nullptr) const noexcept
    {
        tahr_status code = tahr_telemetry_latest(handle_, character, &state, stamp);
        if (code != TAHR_E_ARGUMENT) return detail::checked("tahr_telemetry_latest", code);
        return detail::complain(code, "tahr_telemetry_latest: character is %u, expected below %u", character,
                                limits_.character);
    }
    /* As tahr_telemetry_get_counts. May run on any thread. */
    result<tahr_telemetry_counts> counts() const noexcept
    {
        tahr_telemetry_counts counts{};
        counts.struct_size = sizeof counts;
        status s = detail::checked("tahr_telemetry_get_counts", tahr_telemetry_get_counts(handle_, &counts));
        return {s, counts};
    }
    /* As tahr_telemetry_stop; TAHR_E_BACKEND if it ended and the sink had thrown: value() throws the first of that, and
     * another stop() has nothing more to say. */
    status stop(std::uint32_t how = TAHR_STOP_DRAIN, double timeout = 2) noexcept
    {
        tahr_status code = tahr_telemetry_stop(handle_, how, timeout);
        if (code == TAHR_E_ARGUMENT) {
            return detail::complain(code,
                                    "tahr_telemetry_stop: how is %u and timeout %g, expected TAHR_STOP_DRAIN or "
                                    "_ABANDON and 0 to 1e6 s",
                                    how, timeout);
        }
#ifndef TAHR_CPP_NO_EXCEPTIONS
        if (code >= 0 && block_ && block_->threw.exchange(false, std::memory_order_acquire)) {
            detail::trouble_here() = std::move(block_->first);
            code = TAHR_E_BACKEND;
        }
#endif
        return detail::checked("tahr_telemetry_stop", code);
    }

  private:
    /* The telemetry's memory keeps the sink: a thread that was left alone frees both. */
    static void *take(void *user, std::size_t size, std::size_t alignment) noexcept
    {
        auto *block = static_cast<detail::sink_block *>(user);
        void *memory = block->allocator.alloc(block->allocator.user, size, alignment);
        if (memory) block->owners.fetch_add(1, std::memory_order_relaxed);
        return memory;
    }
    static void give_back(void *user, void *memory, std::size_t size, std::size_t alignment) noexcept
    {
        const detail::ref<detail::sink_block> block(static_cast<detail::sink_block *>(user));
        block->allocator.free(block->allocator.user, memory, size, alignment);
    }
    static result<telemetry> start(const tahr_telemetry_desc &desc, const tahr_sink *sink,
                                   detail::ref<detail::sink_block> block) noexcept
    {
        if (!block) return detail::no_memory("tahr::telemetry::create");
        telemetry made;
        made.block_ = std::move(block);
        made.limits_ = {desc.characters, desc.lanes ? desc.lanes : 1, desc.config_count};
        if (desc.log) made.block_->users = *desc.log;
        const tahr_log log = made.block_->log();
        const tahr_allocator keeping = {made.block_.get(), take, give_back};
        tahr_telemetry_desc kept = desc;
        kept.sink = sink;
        kept.log = &log;
        if (!desc.allocator || (desc.allocator->alloc && desc.allocator->free)) kept.allocator = &keeping;
        status s = detail::checked("tahr_telemetry_create", tahr_telemetry_create(&kept, &made.handle_));
        if (!s) return s;
        return {s, std::move(made)};
    }
    /* The library does not log what it is asked in every step. */
    status answered(const char *function, tahr_status code, const track &who, double dt) const noexcept
    {
        if (code != TAHR_E_ARGUMENT) return detail::checked(function, code);
        return detail::complain(code,
                                "%s: character %u on lane %u with config %u, dt %g, expected below %u, %u and %u, "
                                "always the same lane, 0 to 10 s",
                                function, who.character, who.lane, who.config, dt, limits_.character, limits_.lane,
                                limits_.config);
    }

    detail::ref<detail::sink_block> block_;
    tahr_telemetry *handle_ = nullptr;
    track limits_; /* below which numbers must be */
};

} // namespace TAHR_CPP_KIND
} // namespace tahr
#endif
