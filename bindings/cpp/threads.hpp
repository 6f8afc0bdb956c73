/* SPDX-License-Identifier: MIT
 * threads.hpp: the pool of threads of <tahr/threads.h> for crowds. Not part of tahr.hpp: link libtahr_threads. */
#ifndef TAHR_THREADS_HPP
#define TAHR_THREADS_HPP

#include <tahr/threads.h>

#include "crowd.hpp"

namespace tahr
{
inline namespace TAHR_CPP_KIND
{

namespace detail
{

struct threads_block : shared {
    tahr_threads *threads = nullptr;
    ~threads_block()
    {
        tahr_threads_destroy(threads);
    }
};

/* What a crowd is given: it keeps the pool. */
struct pool_scheduler {
    ref<threads_block> pool;
    void operator()(task t, std::uint32_t count) const noexcept
    {
        tahr_threads_run(pool ? pool->threads : nullptr, t.function, t.argument, count);
    }
};

} // namespace detail

/* Owns a pool of threads; crowds on it keep it. Moves, does not copy. */
class threads
{
  public:
    /* An empty one: everything runs on the calling thread. */
    threads() noexcept = default;
    threads(threads &&) noexcept = default;
    threads &operator=(threads &&) noexcept = default;

    /* As tahr_threads_create: so many threads, the calling one among them; 0: as many as there are processors. */
    static result<threads> create(std::uint32_t count = 0, const tahr_allocator *allocator = nullptr) noexcept
    {
        threads made;
        made.block_ = detail::make<detail::threads_block>(allocator);
        if (!made.block_) return detail::no_memory("tahr::threads::create");
        tahr_status code = tahr_threads_create(allocator, count, &made.block_->threads);
        if (code == TAHR_E_ARGUMENT) {
            return detail::complain(code, "tahr_threads_create: count is %u, expected at most 256", count);
        }
        status s = detail::checked("tahr_threads_create", code);
        if (!s) return s;
        return {s, std::move(made)};
    }

    explicit operator bool() const noexcept
    {
        return static_cast<bool>(block_);
    }
    std::uint32_t count() const noexcept
    {
        return block_ ? tahr_threads_count(block_->threads) : 0;
    }
    /* For crowd::create. */
    detail::pool_scheduler scheduler() const noexcept
    {
        return {block_};
    }

  private:
    detail::ref<detail::threads_block> block_;
};

} // namespace TAHR_CPP_KIND
} // namespace tahr
#endif
