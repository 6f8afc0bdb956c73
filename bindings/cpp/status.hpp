/* SPDX-License-Identifier: MIT
 * status.hpp: what a call came to: status, result and error, with and without exceptions.
 *
 * Every function of this binding that can fail returns a status or a result, and throws nothing itself. value() of
 * either is the one place where a failure becomes something else: it throws tahr::error (or what a callback of the
 * user's threw, see callbacks.hpp); without exceptions it writes the message to stderr and aborts. So both kinds of
 * program use the same functions: one says .value(), the other looks first.
 *
 * There are no exceptions where the compiler has them switched off (-fno-exceptions), or with TAHR_CPP_NO_EXCEPTIONS
 * defined. Both kinds of files may be parts of one program; a tahr::world that one of them hands to the other does not
 * link. */
#ifndef TAHR_STATUS_HPP
#define TAHR_STATUS_HPP

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <type_traits>
#include <utility>

#include <tahr/abi.h>

#if !defined(TAHR_CPP_NO_EXCEPTIONS) && !defined(__cpp_exceptions) && !defined(_CPPUNWIND)
#define TAHR_CPP_NO_EXCEPTIONS
#endif
/* The bodies of inline functions differ, so their names do too. */
#ifdef TAHR_CPP_NO_EXCEPTIONS
#define TAHR_CPP_KIND without_exceptions
#else
#define TAHR_CPP_KIND with_exceptions
#include <exception>
#include <stdexcept>
#endif

namespace tahr
{
inline namespace TAHR_CPP_KIND
{

namespace detail
{

/* Why the last call of a thread failed. While `open` it belongs to a call that has not returned yet: the log and the
 * callbacks add to it. */
struct trouble {
    char text[512];
    std::size_t length;
    tahr_status code;
    bool open;
#ifndef TAHR_CPP_NO_EXCEPTIONS
    std::exception_ptr thrown;
#endif
};

/* Of this thread, for the log is called on the one that called the library. Looked at only where something failed. */
inline trouble &trouble_here() noexcept
{
    static thread_local trouble here{};
    return here;
}

inline trouble &open_trouble() noexcept
{
    trouble &t = trouble_here();
    if (!t.open) {
        t = trouble{};
        t.open = true;
    }
    return t;
}

inline void append(trouble &t, const char *text) noexcept
{
    std::size_t room = sizeof t.text - 1 - t.length, length = std::strlen(text);
    length = length < room ? length : room;
    std::memcpy(t.text + t.length, text, length);
    t.length += length;
    t.text[t.length] = 0;
}

/* Adds a sentence to what the call under way will be told to have failed for. Where there is no room the older ones go:
 * they may be of calls that did not go through this binding. */
inline void say(const char *text) noexcept
{
    trouble &t = open_trouble();
    if (t.length + 2 + std::strlen(text) >= sizeof t.text) t.length = 0;
    if (t.length) append(t, "; ");
    append(t, text);
}

/* A call has failed: what was said belongs to it from now on; where nothing was, the meaning of the status. */
inline tahr_status settle(const char *function, tahr_status code) noexcept
{
    trouble &t = open_trouble();
    if (!t.length) {
        append(t, function);
        append(t, ": ");
        append(t, tahr_status_message(code));
    }
#ifndef TAHR_CPP_NO_EXCEPTIONS
    if (code != TAHR_E_BACKEND) t.thrown = nullptr; /* left by a call that did not go through this binding */
#endif
    t.open = false;
    t.code = code;
    return code;
}

} // namespace detail

/* A tahr_status that wants to be looked at. Costs what the number costs. */
class [[nodiscard]] status
{
  public:
    constexpr status(tahr_status code = TAHR_OK) noexcept : code_(code)
    {
    }
    /* TAHR_OK, a positive "ok, but", or a negative error. */
    constexpr tahr_status code() const noexcept
    {
        return code_;
    }
    /* Not an error. */
    constexpr bool ok() const noexcept
    {
        return code_ >= 0;
    }
    constexpr explicit operator bool() const noexcept
    {
        return ok();
    }
    /* "argument"; static memory. */
    const char *name() const noexcept
    {
        return tahr_status_name(code_);
    }
    /* What was wrong, and with what. Of an error the words of the library's log, as long as no later call on this
     * thread has failed; then, and of all else, what the number means. Never NULL. */
    const char *message() const noexcept
    {
        const detail::trouble *t = code_ < 0 ? &detail::trouble_here() : nullptr;
        return t && t->code == code_ && t->length ? t->text : tahr_status_message(code_);
    }
    /* The code; of an error throws, or aborts without exceptions. */
    tahr_status value() const;

  private:
    tahr_status code_;
};

#ifndef TAHR_CPP_NO_EXCEPTIONS
/* An error, in the words of status::message(). */
class error : public std::runtime_error
{
  public:
    explicit error(status s) : std::runtime_error(s.message()), code_(s.code())
    {
    }
    tahr_status code() const noexcept
    {
        return code_;
    }

  private:
    tahr_status code_;
};
#endif

namespace detail
{

[[noreturn]] inline void end_with(status s)
{
#ifdef TAHR_CPP_NO_EXCEPTIONS
    std::fprintf(stderr, "%s\n", s.message());
    std::abort();
#else
    trouble &t = trouble_here();
    if (t.code == s.code() && t.thrown) std::rethrow_exception(std::exchange(t.thrown, nullptr));
    throw error(s);
#endif
}

/* The status of a call of the library, with its words kept if it is an error. */
inline status checked(const char *function, tahr_status code) noexcept
{
    return code < 0 ? settle(function, code) : code;
}

/* For what this binding finds wrong itself. */
template <class... Values> status complain(tahr_status code, const char *format, Values... values) noexcept
{
    char text[256];
    std::snprintf(text, sizeof text, format, values...);
    say(text);
    return settle("tahr", code);
}

} // namespace detail

inline tahr_status status::value() const
{
    if (code_ < 0) detail::end_with(*this);
    return code_;
}

/* A status, and what the call made if that is no error: a default T if it is. */
template <class T> class [[nodiscard]] result : public status
{
  public:
    result(status failed) noexcept : status(failed)
    {
    }
    result(status s, T made) noexcept : status(s), made_(std::move(made))
    {
    }
    /* What was made; of an error throws, or aborts without exceptions. */
    T value() &&
    {
        status::value();
        return std::move(made_);
    }
    T &value() &
    {
        status::value();
        return made_;
    }
    const T &value() const &
    {
        status::value();
        return made_;
    }
    /* For who has looked whether it is ok. */
    T &operator*() noexcept
    {
        return made_;
    }
    const T &operator*() const noexcept
    {
        return made_;
    }
    T *operator->() noexcept
    {
        return &made_;
    }
    const T *operator->() const noexcept
    {
        return &made_;
    }

  private:
    static_assert(std::is_nothrow_move_constructible_v<T>);
    T made_{};
};

} // namespace TAHR_CPP_KIND
} // namespace tahr
#endif
