/* SPDX-License-Identifier: MIT
 * world.hpp: a scene that is open: on a backend, on a plugin, or on your own engine. */
#ifndef TAHR_WORLD_HPP
#define TAHR_WORLD_HPP

#include "bodies.hpp"
#include "callbacks.hpp"
#include "data.hpp"
#include "plugin.hpp"
#include "shared.hpp"

namespace tahr
{
inline namespace TAHR_CPP_KIND
{

namespace detail
{

/* What a world and its movers own together. It is closed when the last of them is gone, and what it was opened on
 * after it. */
struct world_block : shared {
    ref<shared> below; /* engine, plugin, or function that gathers */
    tahr_log log{};    /* the user's */
    tahr_world *world = nullptr;
    const void *recorder = nullptr; /* whoever of this binding watches it */
    ~world_block()
    {
        tahr_world_close(world);
    }
    /* The world's log: errors are kept for the call that they end. */
    static void write(void *user, std::int32_t level, const char *message) noexcept
    {
        const tahr_log &log = static_cast<world_block *>(user)->log;
        if (level == TAHR_LOG_ERROR) say(message);
        if (log.write) log.write(log.user, level, message);
    }
};

/* How those who need a world hold it. */
struct world_access {
    template <class World> static const ref<world_block> &block(const World &world) noexcept
    {
        return world.block_;
    }
};

} // namespace detail

/* Owns a tahr_world. Moves, does not copy. Movers, crowds and recordings keep it open: they may outlive this object.
 * const are the members that may run on several threads at once; the others need exclusive access: no step of a mover
 * of this world, and no other member, may run meanwhile. */
class world
{
  public:
    /* An empty one: whatever is asked of it is TAHR_E_NULL. */
    world() noexcept = default;
    world(world &&) noexcept = default;
    world &operator=(world &&) noexcept = default;

    /* Opens a scene on a backend (tahr_backend_v1_native(), ...), as tahr_world_open. Of desc the arrays are read, the
     * log is called beside this binding's own. */
    static result<world> open(const tahr_backend *backend, const tahr_world_desc &desc) noexcept
    {
        return open_on(desc, {}, [&](const tahr_world_desc &logged, tahr_world **made) {
            return checked("tahr_world_open", tahr_world_open(backend, &logged, made));
        });
    }
    static result<world> open(const tahr_backend *backend, view<const tahr_body_desc> bodies) noexcept
    {
        result<tahr_world_desc> desc = scene_of(bodies);
        return desc ? open(backend, *desc) : result<world>(desc);
    }
    /* On a plugin, which stays loaded as long as the world is open. */
    static result<world> open(const plugin &plugin, const tahr_world_desc &desc) noexcept
    {
        return open_on(desc, plugin.block_, [&](const tahr_world_desc &logged, tahr_world **made) {
            return checked("tahr_world_open", tahr_world_open(plugin.backend(), &logged, made));
        });
    }
    static result<world> open(const plugin &plugin, view<const tahr_body_desc> bodies) noexcept
    {
        result<tahr_world_desc> desc = scene_of(bodies);
        return desc ? open(plugin, *desc) : result<world>(desc);
    }
    /* Your engine: a lambda that sweeps, or an object (callbacks.hpp); flags: TAHR_CALLBACKS_*. The world owns what it
     * is given and keeps it in one place, however it is moved itself; of a pointer it owns nothing. As
     * tahr_world_open_callbacks: of desc only allocator and log are used. */
    template <class Engine, class = std::enable_if_t<detail::is_engine<Engine>()>>
    static result<world> open(Engine engine, std::uint32_t flags = 0,
                              const tahr_world_desc &desc = make_world_desc()) noexcept
    {
        auto kept = detail::make<detail::kept<Engine>>(desc.allocator, std::move(engine));
        if (!kept) return detail::no_memory("tahr::world::open");
        return open_callbacks(detail::callbacks_of(kept->value, flags), desc, kept);
    }
    template <class Engine, class = std::enable_if_t<std::is_class_v<Engine> && detail::is_engine<Engine>()>>
    static result<world> open(Engine *engine, std::uint32_t flags = 0,
                              const tahr_world_desc &desc = make_world_desc()) noexcept
    {
        if (!engine) return detail::complain(TAHR_E_NULL, "%s: engine is NULL", "tahr::world::open");
        return open_callbacks(detail::callbacks_of(*engine, flags), desc, {});
    }
    /* Native over your own triangles, and bodies besides. desc.options are not read: they are in source. */
    template <class Function>
    static result<world> open(gathering<Function> source, const tahr_world_desc &desc) noexcept
    {
        static_assert(std::is_invocable_v<Function &, const tahr_bounds &, std::uint32_t, triangles &>,
                      "what gathers takes (const tahr_bounds &, uint32_t mask, tahr::triangles &)");
        auto kept = detail::make<detail::kept<Function>>(desc.allocator, std::move(source.gather));
        if (!kept) return detail::no_memory("tahr::world::open");
        tahr_native_desc native = source.options.struct_size ? source.options : make_native_desc();
        native.gather = detail::trampoline<Function>::gather;
        native.gather_user = &kept->value;
        tahr_world_desc scene = desc;
        scene.options = &native;
        return open_on(scene, kept, [&](const tahr_world_desc &logged, tahr_world **made) {
            return checked("tahr_world_open", tahr_world_open(tahr_backend_v1_native(), &logged, made));
        });
    }
    template <class Function>
    static result<world> open(gathering<Function> source, view<const tahr_body_desc> bodies = {}) noexcept
    {
        result<tahr_world_desc> desc = scene_of(bodies);
        return desc ? open(std::move(source), *desc) : result<world>(desc);
    }

    explicit operator bool() const noexcept
    {
        return static_cast<bool>(block_);
    }
    /* For functions of C; NULL of an empty one. This binding's log is told of their errors too. */
    tahr_world *handle() const noexcept
    {
        return block_ ? block_->world : nullptr;
    }

    /* As tahr_world_set, _move and _touch. */
    status set(view<const tahr_body_pose> poses) noexcept
    {
        std::uint32_t count = 0;
        status s = detail::count_of("tahr::world::set", "poses", poses, count);
        return s ? checked("tahr_world_set", tahr_world_set(handle(), poses.data(), count)) : s;
    }
    status move(view<const tahr_body_pose> poses, double dt) noexcept
    {
        std::uint32_t count = 0;
        status s = detail::count_of("tahr::world::move", "poses", poses, count);
        return s ? checked("tahr_world_move", tahr_world_move(handle(), poses.data(), count, dt)) : s;
    }
    status touch() noexcept
    {
        return checked("tahr_world_touch", tahr_world_touch(handle()));
    }

    /* The questions, as tahr_world_sweep and the others. Of one answer: blocking 0, and fraction 1, if nothing is met.
     * Of several: how many there are, the first of them in the room given. */
    result<tahr_hit> sweep(const tahr_sweep &query) const noexcept
    {
        tahr_hit hit{};
        std::uint32_t count = 0;
        status s = checked("tahr_world_sweep", tahr_world_sweep(handle(), &query, &hit, 1, &count));
        return {s, count ? hit : nothing()};
    }
    result<std::uint32_t> sweep(const tahr_sweep &query, view<tahr_hit> hits) const noexcept
    {
        std::uint32_t count = 0;
        status s =
            checked("tahr_world_sweep", tahr_world_sweep(handle(), &query, hits.data(), hits.capacity(), &count));
        return {s, count};
    }
    result<std::uint32_t> contacts(const tahr_contact_query &query, view<tahr_contact> contacts) const noexcept
    {
        std::uint32_t count = 0;
        status s = checked("tahr_world_contacts",
                           tahr_world_contacts(handle(), &query, contacts.data(), contacts.capacity(), &count));
        return {s, count};
    }
    result<tahr_hit> ray(const tahr_ray &query) const noexcept
    {
        tahr_hit hit{};
        std::uint32_t count = 0;
        status s = checked("tahr_world_ray", tahr_world_ray(handle(), &query, &hit, &count));
        return {s, count ? hit : nothing()};
    }
    result<tahr_fluid> fluid(const tahr_fluid_query &query) const noexcept
    {
        tahr_fluid fluid{};
        status s = checked("tahr_world_fluid", tahr_world_fluid(handle(), &query, &fluid));
        return {s, fluid};
    }
    result<tahr_body_motion> body(std::uint32_t id) const noexcept
    {
        tahr_body_motion motion{};
        status s = checked("tahr_world_body", tahr_world_body(handle(), id, &motion));
        return {s, motion};
    }

    /* What it is made of, line by line: write(const char *line). As tahr_world_describe. What write throws comes out of
     * value(). */
    template <class Function> status describe(Function &&write) const noexcept
    {
        struct sink {
            std::remove_reference_t<Function> &write;
            tahr_status code;
        } to = {write, TAHR_OK};
        const tahr_log log = {&to, [](void *user, std::int32_t, const char *line) noexcept {
                                  sink &s = *static_cast<sink *>(user);
                                  if (s.code >= 0) s.code = detail::guarded([&] { return s.write(line); });
                              }};
        tahr_status code = tahr_world_describe(handle(), &log);
        return checked("tahr_world_describe", code < 0 ? code : to.code);
    }
    std::uint64_t revision() const noexcept
    {
        return tahr_world_revision(handle());
    }
    std::uint64_t memory() const noexcept
    {
        return tahr_world_memory(handle());
    }
    /* "native", "callbacks"; "?" of an empty one. */
    const char *backend_name() const noexcept
    {
        return tahr_world_backend_name(handle());
    }

  private:
    friend struct detail::world_access;

    static status checked(const char *function, tahr_status code) noexcept
    {
        return detail::checked(function, code);
    }
    static tahr_hit nothing() noexcept
    {
        tahr_hit hit{};
        hit.fraction = 1;
        return hit;
    }
    static result<tahr_world_desc> scene_of(view<const tahr_body_desc> bodies) noexcept
    {
        tahr_world_desc desc = make_world_desc();
        desc.bodies = bodies.data();
        status s = detail::count_of("tahr::world::open", "bodies", bodies, desc.body_count);
        return {s, desc};
    }
    /* opener: what makes the world, given a description with this binding's log in it. */
    template <class Opener>
    static result<world> open_on(const tahr_world_desc &desc, detail::ref<detail::shared> below, Opener opener) noexcept
    {
        world opened;
        opened.block_ = detail::make<detail::world_block>(desc.allocator);
        if (!opened.block_) return detail::no_memory("tahr::world::open");
        detail::world_block &block = *opened.block_.get();
        block.below = std::move(below);
        if (desc.log) block.log = *desc.log;
        const tahr_log log = {&block, detail::world_block::write};
        tahr_world_desc logged = desc;
        logged.log = &log;
        status s = opener(logged, &block.world);
        if (!s) return s;
        return {s, std::move(opened)};
    }
    static result<world> open_callbacks(const tahr_callbacks &callbacks, const tahr_world_desc &desc,
                                        detail::ref<detail::shared> below) noexcept
    {
        return open_on(desc, std::move(below), [&](const tahr_world_desc &logged, tahr_world **made) {
            return checked("tahr_world_open_callbacks", tahr_world_open_callbacks(&callbacks, &logged, made));
        });
    }

    detail::ref<detail::world_block> block_;
};

} // namespace TAHR_CPP_KIND
} // namespace tahr
#endif
