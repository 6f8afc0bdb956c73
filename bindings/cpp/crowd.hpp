/* SPDX-License-Identifier: MIT
 * crowd.hpp: many characters in one step, on a scheduler of yours. */
#ifndef TAHR_CROWD_HPP
#define TAHR_CROWD_HPP

#include <tahr/crowd.h>

#include "world.hpp"

namespace tahr
{
inline namespace TAHR_CPP_KIND
{

/* What a scheduler runs: call it once for every index below the count that came with it, on any threads and in any
 * order, and return when all of these calls have. */
struct task {
    tahr_task_fn function;
    void *argument;
    void operator()(std::uint32_t index) const noexcept
    {
        function(argument, index);
    }
};

/* What a tick may bring besides inputs and states: each empty, or of as many elements. See tahr_crowd_tick. */
struct crowd_arrays {
    view<const tahr_member> members;
    view<tahr_report> reports;
    view<tahr_status> statuses;
    view<tahr_delay> delays;
};

namespace detail
{

/* What went wrong inside a tick, wherever it ran: of all threads the first one to say so. */
struct crowd_block : shared {
    ref<world_block> world;
    std::atomic<bool> told{false};
    trouble first{};
};

/* Carries tasks to a scheduler, and back to the thread that steps what they complained of. */
template <class Scheduler> struct scheduling : crowd_block {
    explicit scheduling(Scheduler &&given) noexcept(std::is_nothrow_move_constructible_v<Scheduler>)
        : scheduler(std::move(given))
    {
    }
    struct job {
        crowd_block *block;
        task inner;
        static void run(void *argument, std::uint32_t index) noexcept
        {
            const job &j = *static_cast<job *>(argument);
            j.inner(index);
            trouble &t = trouble_here();
            if (!t.open) return;
            if (!j.block->told.exchange(true)) j.block->first = t;
            t = trouble{};
        }
    };
    static void run(void *user, tahr_task_fn function, void *argument, std::uint32_t count) noexcept
    {
        scheduling &self = *static_cast<scheduling *>(user);
        job j{&self, {function, argument}};
        self.scheduler(task{job::run, &j}, count);
    }
    Scheduler scheduler;
};

/* A scheduler of C. */
struct c_scheduler {
    tahr_run_tasks_fn run;
    void *user;
    void operator()(task t, std::uint32_t count) const noexcept
    {
        run(user, t.function, t.argument, count);
    }
};

} // namespace detail

/* Owns a tahr_crowd, and keeps its world open. Moves, does not copy. Creating and destroying one needs exclusive access
 * to the world. */
class crowd
{
  public:
    /* An empty one: whatever is asked of it is TAHR_E_NULL. */
    crowd() noexcept = default;
    crowd(crowd &&other) noexcept : block_(std::move(other.block_)), handle_(std::exchange(other.handle_, nullptr))
    {
    }
    crowd &operator=(crowd &&other) noexcept
    {
        crowd old(std::move(*this));
        block_ = std::move(other.block_);
        handle_ = std::exchange(other.handle_, nullptr);
        return *this;
    }
    ~crowd()
    {
        tahr_crowd_destroy(handle_);
    }

    /* As tahr_crowd_create, on the scheduler that desc names, or on the calling thread. */
    static result<crowd> create(world &world, const tahr_crowd_desc &desc) noexcept
    {
        if (desc.run_tasks) return create(world, desc, detail::c_scheduler{desc.run_tasks, desc.run_user});
        return open(world, desc, detail::make<detail::crowd_block>(allocator_of(world)));
    }
    /* On a scheduler of yours, schedule(tahr::task task, uint32_t count), which the crowd owns, and which must not
     * throw: nobody could know which of the calls have returned. desc.run_tasks and run_user are not read. */
    template <class Scheduler>
    static result<crowd> create(world &world, const tahr_crowd_desc &desc, Scheduler schedule) noexcept
    {
        static_assert(std::is_invocable_v<Scheduler &, task, std::uint32_t>,
                      "a scheduler takes (tahr::task, uint32_t count)");
        using block_type = detail::scheduling<Scheduler>;
        auto block = detail::make<block_type>(allocator_of(world), std::move(schedule));
        tahr_crowd_desc scheduled = desc;
        scheduled.run_tasks = block_type::run;
        scheduled.run_user = block.get();
        return open(world, scheduled, std::move(block));
    }

    explicit operator bool() const noexcept
    {
        return handle_ != nullptr;
    }
    tahr_crowd *handle() const noexcept
    {
        return handle_;
    }

    /* As tahr_crowd_step: allocates nothing, throws nothing. */
    status step(const tahr_crowd_tick &tick) noexcept
    {
        tahr_status code = tahr_crowd_step(handle_, &tick);
        if (block_ && block_->told.load(std::memory_order_acquire)) hear(code);
        return detail::checked("tahr_crowd_step", code);
    }
    /* The same over containers of one size; TAHR_E_ARGUMENT where they differ. */
    status step(double dt, view<const tahr_input> inputs, view<tahr_state> states,
                const crowd_arrays &more = {}) noexcept
    {
        tahr_crowd_tick tick{};
        tick.struct_size = sizeof tick;
        status s = detail::count_of("tahr::crowd::step", "states", states, tick.count);
        if (s) s = same_size("inputs", inputs.size(), states.size());
        if (s && !more.members.empty()) s = same_size("members", more.members.size(), states.size());
        if (s && !more.reports.empty()) s = same_size("reports", more.reports.size(), states.size());
        if (s && !more.statuses.empty()) s = same_size("statuses", more.statuses.size(), states.size());
        if (s && !more.delays.empty()) s = same_size("delays", more.delays.size(), states.size());
        if (!s) return s;
        tick.dt = dt;
        tick.inputs = inputs.data();
        tick.states = states.data();
        tick.members = more.members.data();
        tick.reports = more.reports.data();
        tick.statuses = more.statuses.data();
        tick.delays = more.delays.data();
        return step(tick);
    }
    result<tahr_crowd_counts> counts() const noexcept
    {
        tahr_crowd_counts counts{};
        counts.struct_size = sizeof counts;
        status s = detail::checked("tahr_crowd_get_counts", tahr_crowd_get_counts(handle_, &counts));
        return {s, counts};
    }

  private:
    static const tahr_allocator *allocator_of(const world &world) noexcept
    {
        const detail::world_block *block = detail::world_access::block(world).get();
        return block ? &block->allocator : nullptr;
    }
    static result<crowd> open(world &world, const tahr_crowd_desc &desc,
                              detail::ref<detail::crowd_block> block) noexcept
    {
        if (!block) return detail::no_memory("tahr::crowd::create");
        crowd made;
        made.block_ = std::move(block);
        made.block_->world = detail::world_access::block(world);
        status s = detail::checked("tahr_crowd_create", tahr_crowd_create(world.handle(), &desc, &made.handle_));
        if (!s) return s;
        return {s, std::move(made)};
    }
    static status same_size(const char *what, std::size_t size, std::size_t expected) noexcept
    {
        if (size == expected) return TAHR_OK;
        return detail::complain(TAHR_E_ARGUMENT,
                                "tahr::crowd::step: %s has %zu elements, expected %zu, as many as states", what, size,
                                expected);
    }
    /* What was complained of inside the tasks is complained of here, if it was what the tick failed for. */
    void hear(tahr_status code) noexcept
    {
        const detail::trouble first = std::exchange(block_->first, detail::trouble{});
        block_->told.store(false, std::memory_order_release);
        if (code >= 0) return;
        detail::say(first.text);
#ifndef TAHR_CPP_NO_EXCEPTIONS
        detail::open_trouble().thrown = first.thrown;
#endif
    }

    detail::ref<detail::crowd_block> block_;
    tahr_crowd *handle_ = nullptr;
};

} // namespace TAHR_CPP_KIND
} // namespace tahr
#endif
