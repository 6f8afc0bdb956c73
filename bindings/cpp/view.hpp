/* SPDX-License-Identifier: MIT
 * view.hpp: elements that lie one after the other in somebody else's memory. */
#ifndef TAHR_VIEW_HPP
#define TAHR_VIEW_HPP

#include "status.hpp"

namespace tahr
{
inline namespace TAHR_CPP_KIND
{

/* A pointer and a count, made of a C array or of whatever has data() and size(): std::vector, std::array, std::span.
 * Owns nothing; a function that takes one reads it during the call, unless it says otherwise. */
template <class T> class view
{
    template <class Container>
    using if_it_fits = std::enable_if_t<
        !std::is_same_v<std::remove_cv_t<std::remove_reference_t<Container>>, view> &&
        std::is_convertible_v<std::remove_pointer_t<decltype(std::declval<Container &>().data())> (*)[], T (*)[]> &&
        std::is_convertible_v<decltype(std::declval<Container &>().size()), std::size_t>>;

  public:
    constexpr view() noexcept = default;
    constexpr view(T *data, std::size_t size) noexcept : data_(data), size_(size)
    {
    }
    template <std::size_t N> constexpr view(T (&array)[N]) noexcept : data_(array), size_(N)
    {
    }
    template <class Container, class = if_it_fits<Container>>
    constexpr view(Container &&container) noexcept : data_(container.data()), size_(container.size())
    {
    }
    constexpr T *data() const noexcept
    {
        return data_;
    }
    constexpr std::size_t size() const noexcept
    {
        return size_;
    }
    constexpr bool empty() const noexcept
    {
        return size_ == 0;
    }
    constexpr T *begin() const noexcept
    {
        return data_;
    }
    constexpr T *end() const noexcept
    {
        return data_ + size_;
    }
    constexpr T &operator[](std::size_t i) const noexcept
    {
        return data_[i];
    }
    /* How many of them the library, which counts in 32 bits, can be told to fill. */
    constexpr std::uint32_t capacity() const noexcept
    {
        return size_ < 0xFFFFFFFFu ? static_cast<std::uint32_t>(size_) : 0xFFFFFFFFu;
    }

  private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

namespace detail
{

/* [out] count, if 32 bits can hold it; what names the elements. */
template <class T>
status count_of(const char *function, const char *what, view<T> elements, std::uint32_t &count) noexcept
{
    if (elements.size() > 0xFFFFFFFFu) {
        return complain(TAHR_E_ARGUMENT, "%s: %s has %zu elements, expected at most %u", function, what,
                        elements.size(), 0xFFFFFFFFu);
    }
    count = static_cast<std::uint32_t>(elements.size());
    return TAHR_OK;
}

} // namespace detail
} // namespace TAHR_CPP_KIND
} // namespace tahr
#endif
