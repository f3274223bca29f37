#pragma once
// A Modbus slave, written from the protocol's tables: register banks, answers, RTU and TCP frames.
// Pure; the faces move the bytes.

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace axiscal::simulate {

using Bytes = std::vector<std::uint8_t>;

std::uint16_t crc16_modbus(std::span<const std::uint8_t> bytes);

/// The address spaces of one unit; an address that is absent answers exception 2.
struct RegisterBank {
    std::map<int, std::uint16_t> holding, input;
    std::map<int, bool> coils, discretes;
    std::set<int> functions{1, 2, 3, 4, 5, 6, 15, 16}; ///< others answer exception 1
};

/// The answer to one request PDU (function code and data), writes done.
Bytes answer_pdu(RegisterBank& bank, std::span<const std::uint8_t> request);

/// Length of the RTU request that starts here (address, function ... CRC), absent while too short
/// to tell; 0 for a function whose length is not known.
std::optional<std::size_t> rtu_request_length(std::span<const std::uint8_t> bytes);
/// address + pdu + CRC
Bytes rtu_frame(int unit, std::span<const std::uint8_t> pdu);
bool rtu_crc_right(std::span<const std::uint8_t> frame);

/// MBAP header + pdu
Bytes tcp_frame(std::uint16_t transaction, int unit, std::span<const std::uint8_t> pdu);

} // namespace axiscal::simulate
