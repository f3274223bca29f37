#include "drivers/loop/doorbell.hpp"

#include "drivers/loop/deadline.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/use_awaitable.hpp>

namespace axiscal {

Task<void> Doorbell::wait(Scheduler& scheduler, std::optional<MonotonicTime> latest) {
    if (latest)
        co_await before(scheduler, rung(), *latest);
    else
        co_await rung();
    rung_ = false;
}

Task<bool> Doorbell::rung() {
    if (!rung_) co_await sleep_.async_wait(boost::asio::as_tuple(boost::asio::use_awaitable));
    co_return rung_;
}

} // namespace axiscal
