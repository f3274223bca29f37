#pragma once
// libmodbus puts the answers into bytes; it never waits at a client's socket. Owned by one connection.

#include "analysis/quantity/result.hpp"
#include "drivers/trigger/register_map.hpp"

#include <memory>
#include <modbus.h>
#include <span>
#include <vector>

namespace axiscal {

struct ModbusDeleter {
    void operator()(modbus_t* context) const { modbus_free(context); }
};
using ModbusContext = std::unique_ptr<modbus_t, ModbusDeleter>;

/// One request answered on `context` from a copy of the registers: writes touch only the copy.
/// `pdu` lies within `frame`. The request must have been written to the map before.
/// @returns false when libmodbus could not send.
bool answer_request(modbus_t* context,
                    std::span<const std::uint8_t> frame,
                    ModbusException verdict,
                    RegisterImage image);

/// Answers of one TCP connection. Where there is room for certain libmodbus writes into the socket
/// itself; else into one end of a socket pair, and we read the other. The pair is empty before each
/// answer, so neither end ever waits. Loop-bound.
class ModbusAnswerer {
public:
    static Result<std::unique_ptr<ModbusAnswerer>> open();
    ~ModbusAnswerer();
    ModbusAnswerer(const ModbusAnswerer&) = delete;
    ModbusAnswerer& operator=(const ModbusAnswerer&) = delete;

    /// Two system calls and a copy through the kernel less than answer() and a write.
    /// @returns false, with nothing written, while the client has not taken all earlier answers.
    /// @errors Fault::io: the connection is done for.
    Result<bool> answer_at_once(int socket,
                                std::span<const std::uint8_t> frame,
                                ModbusException verdict,
                                const RegisterImage& image);
    /// @param frame  whole, with MBAP header
    /// @errors Fault::io when libmodbus gave no answer.
    Result<std::vector<std::uint8_t>> answer(std::span<const std::uint8_t> frame,
                                             ModbusException verdict,
                                             const RegisterImage& image);

private:
    ModbusAnswerer(int library_end, int our_end, ModbusContext context);
    int library_end_, our_end_;
    ModbusContext context_;
};

} // namespace axiscal
