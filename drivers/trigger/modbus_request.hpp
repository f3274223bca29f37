#pragma once
// Requests of the Modbus application protocol V1.1b3, sections 6.1-6.6, 6.11, 6.12, 6.17. Pure.

#include <cstdint>
#include <span>
#include <tl/expected.hpp>
#include <vector>

namespace axiscal {

enum class ModbusException : std::uint8_t {
    none = 0,
    illegal_function = 1,
    illegal_address = 2,
    illegal_value = 3,
    busy = 6
};

namespace modbus_function {
inline constexpr std::uint8_t read_coils = 1, read_discrete_inputs = 2, read_holding = 3,
                              read_input = 4, write_coil = 5, write_register = 6, write_coils = 15,
                              write_registers = 16, read_write_registers = 23;
}

/// One request with lengths and counts already checked against the protocol; addresses are not
/// yet checked against any map.
struct ModbusRequest {
    std::uint8_t function = 0;
    int read_address = 0, read_count = 0;
    int write_address = 0;
    std::vector<std::uint16_t>
        values; ///< registers, or coils as 0 and 1; empty: nothing is written

    [[nodiscard]] bool writes_coils() const;
};

/// @param pdu  function code and data, without address, header or checksum
/// @errors illegal_function for a function this program does not know, illegal_value for counts
/// and lengths the protocol forbids.
tl::expected<ModbusRequest, ModbusException>
parse_modbus_request(std::span<const std::uint8_t> pdu);

} // namespace axiscal
