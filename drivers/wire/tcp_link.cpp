#include "drivers/wire/tcp_link.hpp"

#include "drivers/loop/deadline.hpp"
#include "drivers/wire/descriptor_link.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/use_awaitable.hpp>

namespace axiscal {
namespace {

using boost::asio::ip::tcp;

/// `socket` is owned by the awaiting frame.
Task<boost::system::error_code> connect(tcp::socket& socket, std::string host, std::string port) {
    constexpr auto token = boost::asio::as_tuple(boost::asio::use_awaitable);
    tcp::resolver resolver{socket.get_executor()};
    const auto [unresolved, places] = co_await resolver.async_resolve(host, port, token);
    if (unresolved) co_return unresolved;
    const auto [refused, reached] = co_await boost::asio::async_connect(socket, places, token);
    co_return refused;
}

} // namespace

Task<Result<std::unique_ptr<ByteLink>>>
open_tcp(Scheduler& scheduler, LinkSettings settings, MonotonicTime deadline) {
    DescriptorKind kind;
    kind.name = settings.describe();
    kind.is_socket = true;
    tcp::socket socket{scheduler.executor()};
    const auto error = co_await before(
        scheduler, connect(socket, settings.host, std::to_string(settings.port)), deadline);
    if (!error) co_return fail(Fault::link_timeout, "no connection to " + kind.name);
    if (*error) co_return fail(Fault::link_closed, "no connection to " + kind.name, *error);
    boost::system::error_code failed;
    socket.set_option(tcp::no_delay{true}, failed);
    if (!failed) socket.native_non_blocking(true, failed);
    if (failed) co_return fail(Fault::link_closed, kind.name, failed);
    const int descriptor = socket.release(failed);
    if (failed) co_return fail(Fault::link_closed, kind.name, failed);
    co_return std::make_unique<DescriptorLink>(scheduler, descriptor, std::move(kind));
}

} // namespace axiscal
