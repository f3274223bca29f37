#pragma once
// The little of Modbus TCP that a client needs here: FC3 and FC16, nothing else (some controllers
// have no more). Loop-bound.

#include "analysis/quantity/result.hpp"
#include "drivers/loop/scheduler.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace axiscal {

/// One connection, one request at a time. After an error the connection is out of step: drop it.
/// @errors of all calls: Fault::link_timeout after a second, Fault::link_closed, Fault::bad_frame
/// for an answer that is not one, Fault::refused with the exception in words.
class ModbusClient {
public:
    ModbusClient(Scheduler* scheduler, std::string host, int port, int unit_id);
    Task<Result<void>> connect();
    Task<Result<std::vector<std::uint16_t>>> read_holding(int address, int count);
    Task<Result<void>> write_registers(int address, std::vector<std::uint16_t> words);

private:
    using Bytes = std::vector<std::uint8_t>;
    Task<Result<void>> reach();
    Task<Result<Bytes>> talk(Bytes pdu);
    Task<Result<Bytes>> ask(Bytes pdu); ///< talk() with its deadline
    [[nodiscard]] std::string place() const;

    Scheduler* scheduler_;
    std::string host_;
    int port_, unit_id_;
    std::uint16_t transaction_ = 0;
    Bytes out_, in_; // before the socket that works on them
    boost::asio::ip::tcp::socket socket_;
};

} // namespace axiscal
