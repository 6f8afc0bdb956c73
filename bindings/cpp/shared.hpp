/* SPDX-License-Identifier: MIT
 * shared.hpp: what several owners keep alive together: a world and its movers, a plugin and its worlds. Internal. */
#ifndef TAHR_SHARED_HPP
#define TAHR_SHARED_HPP

#include <atomic>
#include <new>

#include "status.hpp"

namespace tahr
{
inline namespace TAHR_CPP_KIND
{
namespace detail
{

/* Counts its owners, and knows how it was made. */
struct shared {
    std::atomic<std::uint32_t> owners{1};
    tahr_allocator allocator{};
    void (*destroy)(shared *self) noexcept = nullptr;
};

/* One owner of a T, which derives from shared. */
template <class T> class ref
{
  public:
    ref() noexcept = default;
    explicit ref(T *adopted) noexcept : object_(adopted)
    {
    }
    ref(const ref &other) noexcept : object_(other.object_)
    {
        if (object_) object_->owners.fetch_add(1, std::memory_order_relaxed);
    }
    ref(ref &&other) noexcept : object_(std::exchange(other.object_, nullptr))
    {
    }
    template <class Derived> ref(ref<Derived> other) noexcept : object_(other.release())
    {
    }
    ref &operator=(ref other) noexcept
    {
        std::swap(object_, other.object_);
        return *this;
    }
    ~ref()
    {
        /* Whoever is last sees all that the others did. */
        if (object_ && object_->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) object_->destroy(object_);
    }
    T *get() const noexcept
    {
        return object_;
    }
    T *operator->() const noexcept
    {
        return object_;
    }
    explicit operator bool() const noexcept
    {
        return object_ != nullptr;
    }
    T *release() noexcept
    {
        return std::exchange(object_, nullptr);
    }

  private:
    T *object_ = nullptr;
};

inline void *new_memory(void *, std::size_t size, std::size_t alignment) noexcept
{
    return ::operator new(size, std::align_val_t(alignment), std::nothrow);
}

inline void delete_memory(void *, void *memory, std::size_t, std::size_t alignment) noexcept
{
    ::operator delete(memory, std::align_val_t(alignment));
}

template <class T> void destroy_shared(shared *self) noexcept
{
    const tahr_allocator allocator = self->allocator;
    T *object = static_cast<T *>(self);
    object->~T();
    allocator.free(allocator.user, object, sizeof(T), alignof(T));
}

/* A new T from the user's allocator, or from operator new. Empty if there is no memory. */
template <class T, class... Arguments> ref<T> make(const tahr_allocator *from, Arguments &&...arguments) noexcept
{
    static_assert(alignof(T) <= 64, "a tahr_allocator is asked for alignments of up to 64");
    static_assert(std::is_nothrow_constructible_v<T, Arguments &&...>,
                  "what a world keeps must move without throwing: hand over a pointer to it instead");
    const tahr_allocator allocator =
        from && from->alloc && from->free ? *from : tahr_allocator{nullptr, new_memory, delete_memory};
    void *memory = allocator.alloc(allocator.user, sizeof(T), alignof(T));
    if (!memory) return ref<T>();
    T *object = new (memory) T(std::forward<Arguments>(arguments)...);
    object->allocator = allocator;
    object->destroy = destroy_shared<T>;
    return ref<T>(object);
}

/* A value of the user's, kept alive. */
template <class T> struct kept : shared {
    explicit kept(T &&given) noexcept(std::is_nothrow_move_constructible_v<T>) : value(std::move(given))
    {
    }
    T value;
};

inline status no_memory(const char *function) noexcept
{
    return complain(TAHR_E_MEMORY, "%s: the allocator returned NULL", function);
}

} // namespace detail
} // namespace TAHR_CPP_KIND
} // namespace tahr
#endif
