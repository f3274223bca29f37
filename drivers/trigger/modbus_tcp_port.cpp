#include "drivers/trigger/modbus_tcp_port.hpp"

#include "drivers/trigger/mbap_framer.hpp"
#include "drivers/trigger/modbus_answer.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>

#include <algorithm>
#include <exception>
#include <utility>

namespace axiscal {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using namespace asio::experimental::awaitable_operators;

constexpr auto quietly = asio::as_tuple(asio::use_awaitable);
constexpr int unread_answers = 16 * 1024; // bytes the kernel keeps for a client that does not read
constexpr auto pause_after_failed_accept = std::chrono::milliseconds{100};

/// Unspecified of a client that has hung up already.
asio::ip::address remote_of(const tcp::socket& socket) {
    boost::system::error_code gone;
    const auto remote = socket.remote_endpoint(gone);
    return gone ? asio::ip::address{} : remote.address();
}

} // namespace

/// One connection; lives as long as its coroutine.
struct ModbusTcpPort::Client {
    Client(tcp::socket connected,
           std::shared_ptr<TriggerServer> served,
           std::shared_ptr<int> open_clients,
           Scheduler* its_scheduler,
           ClientPatience its_patience)
        : server{std::move(served)}
        , count{std::move(open_clients)}
        , scheduler{its_scheduler}
        , patience{its_patience}
        , socket{std::move(connected)}
        , from{remote_of(socket)}
        , heard{scheduler->now()} {
        ++*count;
    }
    ~Client() { --*count; }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;

    std::shared_ptr<TriggerServer> server; // kept while the last handlers run
    std::shared_ptr<int> count;
    Scheduler* scheduler;
    ClientPatience patience;
    MbapFramer framer;
    std::unique_ptr<ModbusAnswerer> answerer;
    MonotonicTime deadline;   ///< when patience ends
    bool frame_begun = false; ///< part of a frame was left over by the last read
    std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> buffer{};
    tcp::socket socket; // after its buffer
    asio::ip::address from;
    MonotonicTime heard; ///< when it last asked, or came
};

ModbusTcpPort::ModbusTcpPort(std::unique_ptr<RegisterMap> map,
                             TriggerConfig config,
                             ClientPatience patience)
    : MappedPort{std::move(map), std::move(config)}
    , patience_{patience} {}

Result<ModbusTcpPort::Acceptor> ModbusTcpPort::listen(const TriggerContext& context) const {
    boost::system::error_code error;
    const auto place = config_.host + ":" + std::to_string(config_.port);
    const auto address = asio::ip::make_address(config_.host, error);
    if (error) return fail(Fault::io, "The trigger port cannot listen on " + place + ".", error);
    const tcp::endpoint endpoint{address, static_cast<std::uint16_t>(config_.port)};
    Acceptor acceptor{context.scheduler->executor()};
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error)
        return fail(Fault::io,
                    "The trigger port cannot listen on " + place +
                        ": another program may hold it, or the address is not of this PC.",
                    error);
    return acceptor;
}

Task<Result<void>> ModbusTcpPort::run(TriggerContext context) {
    AXISCAL_CO_TRY(Acceptor acceptor, listen(context));
    bound_port_ = acceptor.local_endpoint().port();
    server_->attach(context);
    try {
        auto accepting = accept_clients(acceptor, context.scheduler);
        auto timing = server_->keep_time(context.scheduler);
        co_await (std::move(accepting) || std::move(timing));
    } catch (const std::exception&) { // cancelled: the way a port ends
    }
    server_->detach();
    hang_up_all();
    bound_port_ = 0;
    co_return fail(Fault::link_closed, describe() + " was stopped.");
}

Task<void> ModbusTcpPort::accept_clients(Acceptor& acceptor, Scheduler* scheduler) {
    for (;;) {
        auto [error, socket] = co_await acceptor.async_accept(quietly);
        if (!error)
            admit(std::move(socket), scheduler);
        else // out of descriptors, or cancelled: then the next line throws
            co_await scheduler->sleep_for(pause_after_failed_accept);
    }
}

/// Counted always, told now and then.
bool ModbusTcpPort::is_stranger(const tcp::socket& socket, MonotonicTime now) {
    if (config_.allowed_clients.empty()) return false;
    const auto remote = remote_of(socket);
    const std::string from = remote.is_unspecified() ? "" : remote.to_string();
    if (any_covers(config_.allowed_clients, from)) return false;
    ++server_->counters.strangers;
    if (const auto words = strangers_.take(from, now))
        server_->note(Fault::refused, describe() + " turned " + *words +
                                        ": trigger.allowed_clients does not name it.");
    return true;
}

/// The longest idle connection gives way (MODBUS Messaging on TCP/IP V1.0b, 4.2): a CNC that was
/// switched off leaves its own behind. One of the newcomer's address goes first, so that whoever
/// never closes his connections loses those, and not the CNC's.
void ModbusTcpPort::make_room(const asio::ip::address& newcomer) {
    std::erase_if(clients_, [](const auto& client) { return client.expired(); });
    if (std::ssize(clients_) < config_.client_limit) return;
    const auto first_to_go = [&](const auto& client, const auto& other) {
        const auto a = client.lock(), b = other.lock();
        const bool a_own = a->from == newcomer, b_own = b->from == newcomer;
        return a_own != b_own ? a_own : a->heard < b->heard;
    };
    const auto leaves = std::ranges::min_element(clients_, first_to_go);
    boost::system::error_code ignored; // closing cannot be refused
    leaves->lock()->socket.close(ignored);
    clients_.erase(leaves);
    ++server_->counters.refused;
}

void ModbusTcpPort::admit(tcp::socket socket, Scheduler* scheduler) {
    if (is_stranger(socket, scheduler->now())) return; // the socket closes here
    make_room(remote_of(socket));
    auto answerer = ModbusAnswerer::open();
    if (!answerer) {
        server_->note(Fault::io, axiscal::describe(answerer.error()));
        return;
    }
    boost::system::error_code ignored; // a client gone already shows at the first read
    socket.set_option(tcp::no_delay(true), ignored);
    socket.set_option(asio::socket_base::send_buffer_size(unread_answers), ignored);
    auto client =
        std::make_shared<Client>(std::move(socket), server_, open_clients_, scheduler, patience_);
    client->answerer = std::move(*answerer);
    clients_.push_back(client);
    asio::co_spawn(scheduler->executor(), attend(std::move(client)), asio::detached);
}

Task<void> ModbusTcpPort::attend(std::shared_ptr<Client> client) {
    client->deadline = client->scheduler->now() + client->patience.idle;
    auto serving = serve(*client);
    auto watching = watch(*client);
    const auto ended = co_await (std::move(serving) || std::move(watching));
    if (ended.index() == 1) ++client->server->counters.hung_up;
}

Task<void> ModbusTcpPort::serve(Client& client) {
    for (;;) {
        const auto [error, length] =
            co_await client.socket.async_read_some(asio::buffer(client.buffer), quietly);
        if (error) co_return;
        client.heard = client.scheduler->now();
        client.framer.feed({client.buffer.data(), length});
        if (!co_await answer_frames(client)) co_return;
        if (client.framer.broken()) {
            ++client.server->counters.hung_up;
            co_return;
        }
    }
}

// Frames go one by one: an answer must be taken before the next request is looked at, so that a
// client that never reads fills the kernel's buffers and not ours.
Task<bool> ModbusTcpPort::answer_frames(Client& client) {
    const MonotonicTime at = client.scheduler->now();
    bool answered = false;
    while (const auto frame = client.framer.next()) {
        answered = true;
        if (!client.server->attached()) co_return false;
        const std::span<const std::uint8_t> pdu{frame->data() + mbap_header,
                                                frame->size() - mbap_header};
        const auto request = parse_modbus_request(pdu);
        const auto verdict = request ? client.server->space().check(*request) : request.error();
        if (verdict == ModbusException::none && !request->values.empty())
            client.server->write(*request, at);
        ++client.server->counters.requests;
        if (verdict != ModbusException::none) ++client.server->counters.exceptions;
        const RegisterImage image = client.server->image(client.scheduler->now());
        const auto at_once = client.answerer->answer_at_once(client.socket.native_handle(), *frame,
                                                             verdict, image);
        if (!at_once) co_return false;
        if (*at_once) continue;
        const auto reply = client.answerer->answer(*frame, verdict, image);
        if (!reply) co_return false;
        client.deadline = client.scheduler->now() + client.patience.answer;
        const auto [error, sent] =
            co_await asio::async_write(client.socket, asio::buffer(*reply), quietly);
        if (error) co_return false;
    }
    if (!client.framer.in_frame())
        client.deadline = client.scheduler->now() + client.patience.idle;
    else if (answered || !client.frame_begun)
        client.deadline = client.scheduler->now() + client.patience.frame;
    client.frame_begun = client.framer.in_frame();
    co_return true;
}

// A deadline may come nearer while this sleeps, but never nearer than the shortest patience.
Task<void> ModbusTcpPort::watch(Client& client) {
    const Duration shortest =
        std::min({client.patience.frame, client.patience.answer, client.patience.idle});
    for (MonotonicTime now = client.scheduler->now(); now < client.deadline;
         now = client.scheduler->now())
        co_await client.scheduler->sleep_until(std::min(client.deadline, now + shortest));
}

void ModbusTcpPort::hang_up_all() {
    boost::system::error_code ignored; // closing cannot be refused
    for (const auto& held : clients_)
        if (const auto client = held.lock()) client->socket.close(ignored);
    clients_.clear();
}

std::string ModbusTcpPort::describe() const {
    const int port = bound_port_ != 0 ? bound_port_ : config_.port;
    return std::string{shape_name(config_.shape)} + ", Modbus TCP " + config_.host + ":" +
           std::to_string(port);
}

} // namespace axiscal
