#include "drivers/wire/serial_opener.hpp"

#include "drivers/loop/deadline.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <unistd.h>

namespace axiscal {

/// One opening on its way. Lives and dies on the loop: the thread knows it weakly. What nobody took
/// is closed.
struct SerialOpener::Request {
    Request(const boost::asio::any_io_executor& loop, std::shared_ptr<SerialOpener> of)
        : done{loop, boost::asio::steady_timer::time_point::max()}
        , serial_opener{std::move(of)} {}
    ~Request() {
        if (opened && *opened) serial_opener->close(**opened);
    }
    Request(const Request&) = delete;
    Request& operator=(const Request&) = delete;

    std::optional<Result<int>> opened;
    boost::asio::steady_timer done;
    std::shared_ptr<SerialOpener> serial_opener;
};

SerialOpener::SerialOpener(std::string name, boost::asio::any_io_executor loop)
    : name_{std::move(name)}
    , loop_{std::move(loop)} {}

void SerialOpener::forget_loop() {
    const std::lock_guard lock{mutex_};
    loop_ = {};
}

void SerialOpener::close(int descriptor) {
    thread_.post([descriptor] { ::close(descriptor); });
}

void SerialOpener::hand_over(const std::weak_ptr<Request>& request, Result<int> opened) {
    const std::lock_guard lock{mutex_};
    if (!loop_) {
        if (opened) ::close(*opened);
        return;
    }
    auto arrive = [self = shared_from_this(), request, opened = std::move(opened)] {
        const auto waiting = request.lock();
        if (!waiting) {
            if (opened) self->close(*opened);
            return;
        }
        waiting->opened = opened;
        waiting->done.cancel();
    };
    boost::asio::post(loop_, std::move(arrive));
}

Task<bool> SerialOpener::answered(std::shared_ptr<Request> request) {
    co_await request->done.async_wait(boost::asio::as_tuple(boost::asio::use_awaitable));
    co_return request->opened.has_value();
}

Task<Result<int>>
SerialOpener::open(Scheduler& scheduler, TtyOpener opener, MonotonicTime deadline) {
    const auto request = std::make_shared<Request>(scheduler.executor(), shared_from_this());
    thread_.post([self = shared_from_this(), asked = std::weak_ptr{request},
                  opener = std::move(opener)] { self->hand_over(asked, opener()); });
    const auto in_time = co_await before(scheduler, answered(request), deadline);
    if (!in_time || !*in_time)
        co_return fail(Fault::link_timeout,
                       name_ + ": the adapter does not answer while it is opened or closed");
    co_return *std::exchange(request->opened, std::nullopt);
}

} // namespace axiscal
