/* SPDX-License-Identifier: MIT
 * trace.hpp: a run in one file (<tahr/trace.h>). Not part of tahr.hpp: link libtahr_trace. */
#ifndef TAHR_TRACE_HPP
#define TAHR_TRACE_HPP

#include <tahr/trace.h>

#include "world.hpp"

namespace tahr
{
inline namespace TAHR_CPP_KIND
{

/* A recording of a world: from record() until close() or its end. Keeps the world open. Moves, does not copy. While it
 * lasts only one thread may step, ask or change the world. */
class trace
{
  public:
    /* An empty one. */
    trace() noexcept = default;
    trace(trace &&other) noexcept : world_(std::move(other.world_)), handle_(std::exchange(other.handle_, nullptr))
    {
    }
    trace &operator=(trace &&other) noexcept
    {
        trace old(std::move(*this));
        world_ = std::move(other.world_);
        handle_ = std::exchange(other.handle_, nullptr);
        return *this;
    }
    ~trace()
    {
        (void)end();
    }

    /* Begins to record every step and query of a world to a file, in the place of who has recorded it until now; flags:
     * TAHR_TRACE_*. Needs exclusive access to the world. Statuses of tahr_trace_open and tahr_world_record. */
    static result<trace> record(world &world, const char *path, std::uint32_t flags = 0) noexcept
    {
        trace made;
        if (!path) return detail::complain(TAHR_E_NULL, "%s: path is NULL", "tahr::trace::record");
        const tahr_log log = {nullptr, detail::say_errors};
        tahr_trace_desc desc{};
        desc.struct_size = sizeof desc;
        desc.flags = flags;
        desc.path = path;
        desc.log = &log;
        status s = detail::checked("tahr_trace_open", tahr_trace_open(&desc, &made.handle_));
        if (s) {
            s = detail::checked("tahr_world_record",
                                tahr_world_record(world.handle(), tahr_trace_recorder(made.handle_)));
        }
        if (!s) return s;
        made.world_ = detail::world_access::block(world);
        made.world_->recorder = made.handle_;
        return {s, std::move(made)};
    }

    /* Ends the recording. TAHR_E_FILE where something could not be written; TAHR_OK of an empty one. Needs exclusive
     * access to the world. */
    status close() noexcept
    {
        return detail::checked("tahr_trace_close", end());
    }

    explicit operator bool() const noexcept
    {
        return handle_ != nullptr;
    }
    tahr_trace *handle() const noexcept
    {
        return handle_;
    }

  private:
    tahr_status end() noexcept
    {
        if (world_ && world_->recorder == handle_ && handle_) {
            tahr_world_record(world_->world, nullptr);
            world_->recorder = nullptr;
        }
        world_ = {};
        return tahr_trace_close(std::exchange(handle_, nullptr));
    }

    detail::ref<detail::world_block> world_;
    tahr_trace *handle_ = nullptr;
};

} // namespace TAHR_CPP_KIND
} // namespace tahr
#endif
