#pragma once
// Hears what an instrument answers late before it is asked again.

#include "drivers/clock/open_requests.hpp"
#include "drivers/loop/scheduler.hpp"

#include <algorithm>

namespace axiscal {

/// Where an instrument answered while another request is open, an answer must not be taken for that
/// of a request that comes after it: ends when nothing more is to be waited for.
/// @param hear_until a call that reads the line up to the time that it is given
/// @param looks_every how long it is given at most: an answer may end the wait
/// @errors those of `hear_until`
template <class HearUntil>
Task<Result<void>> hear_late(OpenRequests& requests,
                             Scheduler& scheduler,
                             Duration looks_every,
                             HearUntil hear_until) {
    while (const auto end = requests.listen_until()) {
        const MonotonicTime now = scheduler.now();
        if (now >= *end) requests.forget();
        const auto heard = co_await hear_until(std::min(*end, now + looks_every));
        if (!heard) co_return heard;
    }
    co_return Result<void>{};
}

} // namespace axiscal
