// A Modbus TCP request and its reply, client and server on one processor: what the trigger port
// adds to an echo of as many bytes. A client that spins on nothing: it waits in recv like a
// controller.
#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/trigger/modbus_tcp_port.hpp"
#include "drivers/trigger/sequence_block_map.hpp"
#include "tests/bench/loopback.hpp"
#include "tests/bench/row.hpp"
#include "tests/support/port_bench.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>

#include <modbus.h>

namespace axiscal::bench {
namespace {

constexpr int round_trips = 1000;
/// Ten words from 16: the daemon's block as a CNC polls it.
const testing::Bytes request{0, 1, 0, 0, 0, 6, 1, 3, 0, 16, 0, 10};
constexpr std::size_t reply_size = 7 + 2 + 20;

/// The limit: as many bytes in, as many out, nothing between.
void echo(int listener) {
    const int connection = ::accept(listener, nullptr, nullptr);
    send_at_once(connection);
    std::array<char, 256> in{}, out{};
    while (::recv(connection, in.data(), in.size(), 0) > 0)
        ::send(connection, out.data(), reply_size, MSG_NOSIGNAL);
}

/// The peer: libmodbus's own server, as its documentation writes one.
void libmodbus_server(int listener) {
    modbus_t* const context = modbus_new_tcp("127.0.0.1", 0);
    modbus_mapping_t* const mapping = modbus_mapping_new(0, 0, 64, 64);
    modbus_tcp_accept(context, &listener);
    std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> query{};
    for (;;) {
        const int length = modbus_receive(context, query.data());
        if (length > 0) modbus_reply(context, query.data(), length, mapping);
    }
}

/// The port on a loop and a thread of its own. It ends before what its loop uses: a thread that was
/// left behind would run on a loop that the end of the program has destroyed.
class TriggerDoor {
public:
    TriggerDoor()
        : port_{std::make_unique<SequenceBlockMap>(false, false), any_port(), ClientPatience{}}
        , running_{port_, scheduler_} {
        while (port_.bound_port() == 0)
            loop_.run_one();
        thread_ = std::thread{[this] { loop_.run(); }};
    }
    ~TriggerDoor() {
        boost::asio::post(loop_, [this] { running_.cancel(); });
        thread_.join(); // the loop has nothing left to do
    }
    TriggerDoor(const TriggerDoor&) = delete;
    TriggerDoor& operator=(const TriggerDoor&) = delete;
    [[nodiscard]] int bound_port() const { return port_.bound_port(); }

private:
    static TriggerConfig any_port() {
        TriggerConfig config;
        config.port = 0;
        return config;
    }

    boost::asio::io_context loop_;
    AsioScheduler scheduler_{loop_};
    ModbusTcpPort port_;
    testing::RunningPort running_;
    std::thread thread_;
};

int start_trigger_port() {
    static TriggerDoor door;
    return door.bound_port();
}

Work asking(int (*start_server)()) {
    return [start_server, client = std::shared_ptr<Client>{}]() mutable {
        if (!client) client = std::make_shared<Client>(start_server());
        for (int i = 0; i < round_trips; ++i)
            client->ask(request, reply_size);
    };
}

[[maybe_unused]] const bool added =
    add(Row{"Modbus, 1000 requests answered, one processor", asking(start_trigger_port),
            asking([] { return start(echo); }), 1.25, 0, "TCP echo of the same bytes", 0,
            "libmodbus's server", asking([] { return start(libmodbus_server); }), true});

} // namespace
} // namespace axiscal::bench
