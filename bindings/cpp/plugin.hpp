/* SPDX-License-Identifier: MIT
 * plugin.hpp: a backend from a shared object. */
#ifndef TAHR_PLUGIN_HPP
#define TAHR_PLUGIN_HPP

#include <tahr/plugin.h>

#include "shared.hpp"

namespace tahr
{
inline namespace TAHR_CPP_KIND
{

namespace detail
{

struct plugin_block : shared {
    tahr_plugin *plugin = nullptr;
    ~plugin_block()
    {
        tahr_plugin_unload(plugin);
    }
};

inline void say_errors(void *, std::int32_t level, const char *message) noexcept
{
    if (level == TAHR_LOG_ERROR) say(message);
}

} // namespace detail

/* A plugin that is loaded; worlds on it keep it so. */
class plugin
{
  public:
    /* An empty one. */
    plugin() noexcept = default;

    /* As tahr_plugin_load: the path of a shared object, never searched for. Load only what you trust. */
    static result<plugin> load(const char *path) noexcept
    {
        plugin loaded;
        loaded.block_ = detail::make<detail::plugin_block>(nullptr);
        if (!loaded.block_) return detail::no_memory("tahr::plugin::load");
        const tahr_log log = {nullptr, detail::say_errors};
        status s = detail::checked("tahr_plugin_load", tahr_plugin_load(path, &log, &loaded.block_->plugin));
        if (!s) return s;
        return {s, std::move(loaded)};
    }
    plugin(plugin &&) noexcept = default;
    plugin &operator=(plugin &&) noexcept = default;

    explicit operator bool() const noexcept
    {
        return static_cast<bool>(block_);
    }
    /* What it brought; NULL of an empty one. Valid as long as this or a world on it lives. */
    const tahr_backend *backend() const noexcept
    {
        return block_ ? tahr_plugin_backend(block_->plugin) : nullptr;
    }

  private:
    friend class world;
    detail::ref<detail::plugin_block> block_;
};

} // namespace TAHR_CPP_KIND
} // namespace tahr
#endif
