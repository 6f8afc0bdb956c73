/* SPDX-License-Identifier: MIT
 * lcm.hpp: telemetry published over LCM (<tahr/lcm.h>). Not part of tahr.hpp: link libtahr_lcm and liblcm. */
#ifndef TAHR_LCM_HPP
#define TAHR_LCM_HPP

#include <tahr/lcm.h>

#include "data.hpp"
#include "sink.hpp"

namespace tahr
{
inline namespace TAHR_CPP_KIND
{

namespace detail
{

struct lcm_block : logged {
    tahr_lcm *lcm = nullptr;
    ~lcm_block()
    {
        tahr_lcm_close(lcm);
    }
};

} // namespace detail

inline tahr_lcm_desc make_lcm_desc() noexcept
{
    return detail::sized<tahr_lcm_desc>();
}

/* Owns a tahr_lcm. Moves, does not copy. For tahr::telemetry::create as it is: of one telemetry at a time, which keeps
 * it open. */
class lcm
{
  public:
    /* An empty one. */
    lcm() noexcept = default;
    lcm(lcm &&) noexcept = default;
    lcm &operator=(lcm &&) noexcept = default;

    /* As tahr_lcm_open. The log of desc is called beside this binding's own, by the telemetry's thread too. */
    static result<lcm> open(const tahr_lcm_desc &desc) noexcept
    {
        lcm opened;
        opened.block_ = detail::make<detail::lcm_block>(desc.allocator);
        if (!opened.block_) return detail::no_memory("tahr::lcm::open");
        if (desc.log) opened.block_->users = *desc.log;
        const tahr_log log = opened.block_->log();
        tahr_lcm_desc logged = desc;
        logged.log = &log;
        status s = detail::checked("tahr_lcm_open", tahr_lcm_open(&logged, &opened.block_->lcm));
        if (!s) return s;
        return {s, std::move(opened)};
    }
    /* "udpm://239.255.76.67:7667?ttl=0", "file://run.lcmlog"; NULL: LCM_DEFAULT_URL of the environment, or udpm://. */
    static result<lcm> open(const char *url = nullptr) noexcept
    {
        tahr_lcm_desc desc = make_lcm_desc();
        desc.url = url;
        return open(desc);
    }

    explicit operator bool() const noexcept
    {
        return static_cast<bool>(block_);
    }
    tahr_lcm *handle() const noexcept
    {
        return block_ ? block_->lcm : nullptr;
    }
    operator sink_ref() const noexcept
    {
        return {tahr_lcm_sink(handle()), block_};
    }

  private:
    detail::ref<detail::lcm_block> block_;
};

} // namespace TAHR_CPP_KIND
} // namespace tahr
#endif
