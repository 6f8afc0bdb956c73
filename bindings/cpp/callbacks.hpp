/* SPDX-License-Identifier: MIT
 * callbacks.hpp: your own collision engine as a lambda, as several, or as an object; and what carries the library's
 * calls to it.
 *
 * What an engine answers to has these names and arguments; sweep is required, the others may be missing
 * (tahr_callbacks says what then). Each returns nothing, which means TAHR_OK, or a tahr_status or tahr::status:
 *     sweep(const tahr_sweep &query, tahr_hit &hit)
 *     contacts(const tahr_contact_query &query, tahr::answers<tahr_contact> &contacts)
 *     ray(const tahr_ray &query, tahr_hit &hit)
 *     sensors(const tahr_sweep &query, tahr::answers<tahr_hit> &hits)
 *     body(uint32_t body, tahr_body_motion &motion)
 *     fluid(const tahr_fluid_query &query, tahr_fluid &fluid)
 * They are called from several threads at once if you step on several.
 *
 * An exception that leaves one of them ends the call under way with TAHR_E_BACKEND and the state untouched, and comes
 * out of status::value() again as what it was. */
#ifndef TAHR_CALLBACKS_HPP
#define TAHR_CALLBACKS_HPP

#include <tahr/native.h>
#include <tahr/world.h>

#include "status.hpp"

namespace tahr
{
inline namespace TAHR_CPP_KIND
{

/* Where contacts and sensors go: room for as many as the caller asked for, zeroed. Put them in in the order that
 * tahr_callbacks asks for, or sort them between begin() and end(). */
template <class T> class answers
{
  public:
    answers(T *room, std::uint32_t capacity, std::uint32_t &count) noexcept
        : room_(room), capacity_(capacity), count_(count)
    {
    }
    /* Takes one; false where there is no room for it, which the caller then hears of. */
    bool add(const T &answer) noexcept
    {
        if (count_ == capacity_) {
            lost_ = true;
            return false;
        }
        room_[count_++] = answer;
        return true;
    }
    std::uint32_t size() const noexcept
    {
        return count_;
    }
    std::uint32_t capacity() const noexcept
    {
        return capacity_;
    }
    bool lost() const noexcept
    {
        return lost_;
    }
    T *begin() const noexcept
    {
        return room_;
    }
    T *end() const noexcept
    {
        return room_ + count_;
    }

  private:
    T *room_;
    std::uint32_t capacity_;
    std::uint32_t &count_;
    bool lost_ = false;
};

/* Several lambdas as one engine: tahr::engine{tahr::on_sweep{...}, tahr::on_ray{...}}. */
template <class Function> struct on_sweep {
    Function sweep;
};
template <class Function> struct on_contacts {
    Function contacts;
};
template <class Function> struct on_ray {
    Function ray;
};
template <class Function> struct on_sensors {
    Function sensors;
};
template <class Function> struct on_body {
    Function body;
};
template <class Function> struct on_fluid {
    Function fluid;
};
template <class Function> on_sweep(Function) -> on_sweep<Function>;
template <class Function> on_contacts(Function) -> on_contacts<Function>;
template <class Function> on_ray(Function) -> on_ray<Function>;
template <class Function> on_sensors(Function) -> on_sensors<Function>;
template <class Function> on_body(Function) -> on_body<Function>;
template <class Function> on_fluid(Function) -> on_fluid<Function>;

template <class... Parts> struct engine : Parts... {
};
template <class... Parts> engine(Parts...) -> engine<Parts...>;

/* Where triangles go. */
class triangles
{
  public:
    explicit triangles(tahr_gather *out) noexcept : out_(out)
    {
    }
    /* Copies one; false when no more are needed, which may be passed over. */
    bool add(const tahr_triangle &triangle) noexcept
    {
        return out_->add(out_, &triangle) != 0;
    }

  private:
    tahr_gather *out_;
};

/* Native's narrow phase over your own triangles (tahr_native_desc.gather), the rest of its options as they are:
 *     gather(const tahr_bounds &box, uint32_t mask, tahr::triangles &out)
 * returns and throws as the functions of an engine do. */
template <class Function> struct gathering {
    explicit gathering(Function function, const tahr_native_desc &native = {})
        : gather(std::move(function)), options(native)
    {
    }
    Function gather;
    tahr_native_desc options;
};

namespace detail
{

#ifndef TAHR_CPP_NO_EXCEPTIONS
/* Keeps the exception that is being handled for status::value(). */
inline tahr_status caught(const char *what) noexcept
{
    trouble &t = open_trouble();
    say("a callback threw: ");
    append(t, what);
    t.thrown = std::current_exception();
    return TAHR_E_BACKEND;
}
#endif

template <class Call> tahr_status status_of(Call &call)
{
    using Answer = decltype(call());
    static_assert(!std::is_same_v<Answer, bool>, "a callback returns a tahr_status, tahr::status or nothing, no bool");
    if constexpr (std::is_void_v<Answer>) {
        call();
        return TAHR_OK;
    } else {
        return status(call()).code();
    }
}

/* Calls into the user's code; no exception leaves it. */
template <class Call> tahr_status guarded(Call call) noexcept
{
#ifdef TAHR_CPP_NO_EXCEPTIONS
    return status_of(call);
#else
    try {
        return status_of(call);
    } catch (const std::exception &e) {
        return caught(e.what());
    } catch (...) {
        return caught("something that is no std::exception");
    }
#endif
}

/* calls<E>: E has a member of that name that takes these arguments. names<E>: it has one member of that name. */
#define TAHR_CPP_MEMBER(member, ...)                                                                            \
    template <class E, class = void> struct calls_##member : std::false_type {                                  \
    };                                                                                                          \
    template <class E>                                                                                          \
    struct calls_##member<E, std::void_t<decltype(std::declval<E &>().member(__VA_ARGS__))>> : std::true_type { \
    };                                                                                                          \
    template <class E, class = void> struct names_##member : std::false_type {                                  \
    };                                                                                                          \
    template <class E> struct names_##member<E, std::void_t<decltype(&E::member)>> : std::true_type {           \
    };                                                                                                          \
    template <class E> constexpr bool has_##member() noexcept                                                   \
    {                                                                                                           \
        static_assert(calls_##member<E>::value || !names_##member<E>::value,                                    \
                      "this engine's " #member " does not take the arguments that callbacks.hpp says");         \
        return calls_##member<E>::value;                                                                        \
    }
TAHR_CPP_MEMBER(sweep, std::declval<const tahr_sweep &>(), std::declval<tahr_hit &>())
TAHR_CPP_MEMBER(contacts, std::declval<const tahr_contact_query &>(), std::declval<answers<tahr_contact> &>())
TAHR_CPP_MEMBER(ray, std::declval<const tahr_ray &>(), std::declval<tahr_hit &>())
TAHR_CPP_MEMBER(sensors, std::declval<const tahr_sweep &>(), std::declval<answers<tahr_hit> &>())
TAHR_CPP_MEMBER(body, std::uint32_t{}, std::declval<tahr_body_motion &>())
TAHR_CPP_MEMBER(fluid, std::declval<const tahr_fluid_query &>(), std::declval<tahr_fluid &>())
#undef TAHR_CPP_MEMBER

/* The functions that the library calls, with an E behind user. */
template <class E> struct trampoline {
    static E &of(void *user) noexcept
    {
        return *static_cast<E *>(user);
    }
    static tahr_status sweep(void *user, const tahr_sweep *query, tahr_hit *hit) noexcept
    {
        if constexpr (std::is_invocable_v<E &, const tahr_sweep &, tahr_hit &>) {
            return guarded([&] { return of(user)(*query, *hit); });
        } else {
            return guarded([&] { return of(user).sweep(*query, *hit); });
        }
    }
    static tahr_status contacts(void *user, const tahr_contact_query *query, tahr_contact *contacts,
                                std::uint32_t capacity, std::uint32_t *count) noexcept
    {
        answers<tahr_contact> out(contacts, capacity, *count);
        tahr_status code = guarded([&] { return of(user).contacts(*query, out); });
        return code == TAHR_OK && out.lost() ? TAHR_TRUNCATED : code;
    }
    static tahr_status ray(void *user, const tahr_ray *query, tahr_hit *hit) noexcept
    {
        return guarded([&] { return of(user).ray(*query, *hit); });
    }
    static tahr_status sensors(void *user, const tahr_sweep *query, tahr_hit *hits, std::uint32_t capacity,
                               std::uint32_t *count) noexcept
    {
        answers<tahr_hit> out(hits, capacity, *count);
        tahr_status code = guarded([&] { return of(user).sensors(*query, out); });
        return code == TAHR_OK && out.lost() ? TAHR_TRUNCATED : code;
    }
    static tahr_status body(void *user, std::uint32_t id, tahr_body_motion *motion) noexcept
    {
        return guarded([&] { return of(user).body(id, *motion); });
    }
    static tahr_status fluid(void *user, const tahr_fluid_query *query, tahr_fluid *fluid) noexcept
    {
        return guarded([&] { return of(user).fluid(*query, *fluid); });
    }
    static tahr_status gather(void *user, const tahr_bounds *box, std::uint32_t mask, tahr_gather *out) noexcept
    {
        triangles to(out);
        return guarded([&] { return of(user)(*box, mask, to); });
    }
};

/* A lambda, or an object with a sweep. */
template <class E> constexpr bool is_engine() noexcept
{
    return std::is_invocable_v<E &, const tahr_sweep &, tahr_hit &> || calls_sweep<E>::value;
}

template <class E> tahr_callbacks callbacks_of(E &engine, std::uint32_t flags) noexcept
{
    using to = trampoline<E>;
    tahr_callbacks c{};
    c.struct_size = sizeof c;
    c.flags = flags;
    c.user = &engine;
    c.sweep = to::sweep;
    if constexpr (has_contacts<E>()) c.contacts = to::contacts;
    if constexpr (has_ray<E>()) c.ray = to::ray;
    if constexpr (has_sensors<E>()) c.sensors = to::sensors;
    if constexpr (has_body<E>()) c.body = to::body;
    if constexpr (has_fluid<E>()) c.fluid = to::fluid;
    return c;
}

} // namespace detail
} // namespace TAHR_CPP_KIND
} // namespace tahr
#endif
