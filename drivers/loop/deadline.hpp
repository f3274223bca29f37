#pragma once
// One bounded wait for every link: the operation, or the deadline, whichever is first. Loop-bound.

#include "drivers/loop/scheduler.hpp"

#include <boost/asio/experimental/awaitable_operators.hpp>
#include <optional>
#include <variant>

namespace axiscal {

/// The operation's value, or nothing when `deadline` came first (the operation is then cancelled).
template <class T>
Task<std::optional<T>> before(Scheduler& scheduler, Task<T> operation, MonotonicTime deadline) {
    using namespace boost::asio::experimental::awaitable_operators;
    Task<void> alarm = scheduler.sleep_until(deadline);
    auto first = co_await (std::move(operation) || std::move(alarm));
    if (auto* value = std::get_if<0>(&first)) co_return std::move(*value);
    co_return std::nullopt;
}

} // namespace axiscal
