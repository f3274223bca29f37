#pragma once
// Runs a real loop until something is seen; the limit only bounds a failing test.

#include <boost/asio/io_context.hpp>

#include <chrono>

namespace axiscal::testing {

template <class Condition>
bool loop_until(boost::asio::io_context& loop,
                Condition condition,
                std::chrono::seconds limit = std::chrono::seconds{20}) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        loop.restart();
        loop.run_one_for(std::chrono::milliseconds{50});
    }
    return true;
}

} // namespace axiscal::testing
