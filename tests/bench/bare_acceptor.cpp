// The floor that an idle daemon is held against: Asio, one acceptor, nothing else. Says "ready" on
// its output when it accepts, and then waits for ever.
#include <utility> // Boost 1.74 wants it first in C++20

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <cstdio>

namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

void accept_for_ever(tcp::acceptor& acceptor) {
    acceptor.async_accept([&acceptor](boost::system::error_code, const tcp::socket&) {
        accept_for_ever(acceptor); // the socket closes here
    });
}

} // namespace

int main() {
    asio::io_context loop{1};
    tcp::acceptor acceptor{loop, tcp::endpoint{asio::ip::address_v4::loopback(), 0}};
    accept_for_ever(acceptor);
    std::puts("ready");
    std::fflush(stdout);
    loop.run();
}
