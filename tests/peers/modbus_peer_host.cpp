// A trigger port on its own, for foreign Modbus programs to talk to. Each request is finished at
// once, as by a run whose points all succeed.
//   modbus_peer_host SHAPE tcp             prints "port N" when it listens
//   modbus_peer_host SHAPE rtu TTY
//   modbus_peer_host SHAPE mirrored PORT   client of a CNC on 127.0.0.1:PORT
// Prints "request N standing 0|1" for each event. Ends with its standard input.

#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/trigger/mirrored_port.hpp"
#include "drivers/trigger/modbus_rtu_port.hpp"
#include "drivers/trigger/modbus_tcp_port.hpp"
#include "tests/support/cnc_map_bench.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <unistd.h>

namespace axiscal {
namespace {

class PrintingSink final : public TriggerSink {
public:
    void on_trigger(const TriggerEvent& event) override {
        std::cout << "request " << event.sequence << " standing " << event.standing << std::endl;
    }
    void on_cnc_silent(bool silent) override { std::cout << "silent " << silent << std::endl; }
    void on_port_note(Fault fault, std::string sentence) override {
        std::cout << "note " << fault_name(fault) << " " << sentence << std::endl;
    }
};

std::unique_ptr<RegisterMap> acknowledging_map(const std::string& shape) {
    using namespace testing;
    if (shape == "single-register") return std::make_unique<Acknowledging<SingleRegisterMap>>();
    if (shape == "coil-and-index")
        return std::make_unique<Acknowledging<CoilAndIndexMap>>(std::chrono::milliseconds{50});
    return std::make_unique<Acknowledging<SequenceBlockMap>>(false, false);
}

std::unique_ptr<TriggerPort>
make_port(const std::string& shape, const std::string& transport, const std::string& where) {
    TriggerConfig config;
    config.port = 0;
    auto map = acknowledging_map(shape);
    if (transport == "rtu") {
        config.serial_path = where;
        return std::make_unique<ModbusRtuPort>(std::move(map), config);
    }
    if (transport == "mirrored") {
        config.port = std::atoi(where.c_str());
        return std::make_unique<MirroredPort>(std::move(map), config);
    }
    return std::make_unique<ModbusTcpPort>(std::move(map), config, ClientPatience{});
}

Task<void> announce(TriggerPort* port, Scheduler* scheduler) {
    const auto* listening = dynamic_cast<ModbusTcpPort*>(port);
    while (listening && listening->bound_port() == 0)
        co_await scheduler->sleep_for(std::chrono::milliseconds{1});
    std::cout << "port " << (listening ? listening->bound_port() : 0) << std::endl;
}

int host(const std::string& shape, const std::string& transport, const std::string& where) {
    boost::asio::io_context loop{1};
    AsioScheduler scheduler{loop};
    PrintingSink sink;
    const auto port = make_port(shape, transport, where);
    port->publish_armed();
    const auto stop = [&loop](auto&&...) { loop.stop(); };
    boost::asio::co_spawn(loop, port->run(TriggerContext{&scheduler, &sink}), stop);
    boost::asio::co_spawn(loop, announce(port.get(), &scheduler), [](std::exception_ptr) {});
    boost::asio::posix::stream_descriptor input{loop, ::dup(STDIN_FILENO)};
    input.async_wait(boost::asio::posix::stream_descriptor::wait_read, stop);
    loop.run();
    return 0;
}

} // namespace
} // namespace axiscal

int main(int count, char** words) {
    if (count < 3) return 2;
    return axiscal::host(words[1], words[2], count > 3 ? words[3] : "");
}
