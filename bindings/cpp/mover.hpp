/* SPDX-License-Identifier: MIT
 * mover.hpp: the step of a character, and modes of your own. */
#ifndef TAHR_MOVER_HPP
#define TAHR_MOVER_HPP

#include <tahr/custom_mode.h>

#include "world.hpp"

namespace tahr
{
inline namespace TAHR_CPP_KIND
{

/* The step under way, as a function of your own mode sees it (custom_mode.h). */
class custom_step
{
  public:
    explicit custom_step(tahr_step *step) noexcept : step_(step)
    {
    }
    tahr_step *handle() const noexcept
    {
        return step_;
    }
    const tahr_state &state() const noexcept
    {
        return *tahr_step_state(step_);
    }
    const tahr_input &input() const noexcept
    {
        return *tahr_step_input(step_);
    }
    const tahr_config &config() const noexcept
    {
        return *tahr_step_config(step_);
    }
    const tahr_vec3 &gravity() const noexcept
    {
        return *tahr_step_gravity(step_);
    }
    status set_velocity(const tahr_vec3 &velocity) noexcept
    {
        return detail::checked("tahr_step_set_velocity", tahr_step_set_velocity(step_, &velocity));
    }
    result<tahr_step_moved> slide(const tahr_vec3 &motion) noexcept
    {
        tahr_step_moved moved{};
        status s = detail::checked("tahr_step_slide", tahr_step_slide(step_, &motion, &moved));
        return {s, moved};
    }
    result<tahr_hit> sweep(const tahr_vec3 &motion) noexcept
    {
        tahr_hit hit{};
        status s = detail::checked("tahr_step_sweep", tahr_step_sweep(step_, &motion, &hit));
        return {s, hit};
    }
    result<tahr_hit> ray(const tahr_vec3 &origin, const tahr_vec3 &motion) noexcept
    {
        tahr_hit hit{};
        status s = detail::checked("tahr_step_ray", tahr_step_ray(step_, &origin, &motion, &hit));
        return {s, hit};
    }
    result<tahr_fluid> fluid() noexcept
    {
        tahr_fluid fluid{};
        status s = detail::checked("tahr_step_fluid", tahr_step_fluid(step_, &fluid));
        return {s, fluid};
    }
    status event(double after, double value) noexcept
    {
        return detail::checked("tahr_step_event", tahr_step_event(step_, after, value));
    }

  private:
    tahr_step *step_;
};

/* Owns a tahr_mover, and keeps its world open. Moves, does not copy. By one thread at a time; different movers of one
 * world on different threads. */
class mover
{
  public:
    /* An empty one: whatever is asked of it is TAHR_E_NULL. */
    mover() noexcept = default;
    mover(mover &&other) noexcept
        : world_(std::move(other.world_)), mode_(std::move(other.mode_)), handle_(std::exchange(other.handle_, nullptr))
    {
    }
    mover &operator=(mover &&other) noexcept
    {
        mover old(std::move(*this));
        world_ = std::move(other.world_);
        mode_ = std::move(other.mode_);
        handle_ = std::exchange(other.handle_, nullptr);
        return *this;
    }
    ~mover()
    {
        tahr_mover_destroy(handle_);
    }

    /* As tahr_mover_create. */
    static result<mover> create(const world &world, const tahr_config &config) noexcept
    {
        mover made;
        made.world_ = detail::world_access::block(world);
        status s = detail::checked("tahr_mover_create", tahr_mover_create(world.handle(), &config, &made.handle_));
        if (!s) return s;
        return {s, std::move(made)};
    }

    explicit operator bool() const noexcept
    {
        return handle_ != nullptr;
    }
    tahr_mover *handle() const noexcept
    {
        return handle_;
    }

    /* As tahr_mover_step, and as cheap: allocates nothing, throws nothing. */
    status step(const tahr_input &input, double dt, tahr_state &state, tahr_report *report = nullptr) noexcept
    {
        return detail::checked("tahr_mover_step", tahr_mover_step(handle_, &input, dt, &state, report));
    }

    /* The function of TAHR_MODE_CUSTOM: mode(tahr::custom_step &step, double time, tahr_custom_next &next). Returns and
     * throws as the functions of an engine do (callbacks.hpp). The mover owns it. As tahr_mover_set_custom_mode, and
     * TAHR_E_MEMORY. */
    template <class Function> status set_custom_mode(Function mode) noexcept
    {
        static_assert(std::is_invocable_v<Function &, custom_step &, double, tahr_custom_next &>,
                      "a mode takes (tahr::custom_step &, double, tahr_custom_next &)");
        const detail::world_block *block = world_.get();
        auto kept = detail::make<detail::kept<Function>>(block ? &block->allocator : nullptr, std::move(mode));
        if (!kept) return detail::no_memory("tahr::mover::set_custom_mode");
        status s = checked_mode(run_mode<Function>, &kept->value);
        if (s) mode_ = kept;
        return s;
    }
    status set_custom_mode(std::nullptr_t) noexcept
    {
        status s = checked_mode(nullptr, nullptr);
        if (s) mode_ = {};
        return s;
    }

  private:
    template <class Function>
    static tahr_status run_mode(void *user, tahr_step *step, double time, tahr_custom_next *next) noexcept
    {
        custom_step view(step);
        return detail::guarded([&] { return (*static_cast<Function *>(user))(view, time, *next); });
    }
    status checked_mode(tahr_custom_mode_fn function, void *user) noexcept
    {
        return detail::checked("tahr_mover_set_custom_mode", tahr_mover_set_custom_mode(handle_, function, user));
    }

    detail::ref<detail::world_block> world_;
    detail::ref<detail::shared> mode_;
    tahr_mover *handle_ = nullptr;
};

} // namespace TAHR_CPP_KIND
} // namespace tahr
#endif
