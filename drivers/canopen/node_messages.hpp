#pragma once
// What a CANopen node says unasked, and what the master says to its state. Pure.

#include "drivers/wire/can_frame.hpp"

#include <optional>
#include <string>

namespace axiscal {

enum class NmtCommand : std::uint8_t {
    start = 0x01,
    stop = 0x02,
    pre_operational = 0x80,
    reset_node = 0x81,
    reset_communication = 0x82,
};
CanFrame nmt_frame(NmtCommand command, int node);

/// As the node tells it on 0x700 + node: the boot-up message, then its heartbeat.
enum class NodeState : std::uint8_t {
    boot_up = 0x00,
    stopped = 0x04,
    operational = 0x05,
    pre_operational = 0x7F,
};
/// Empty for any other frame. The answer to `guard_request` has the same form, with a toggle bit.
std::optional<NodeState> decode_heartbeat(const CanFrame& frame, int node);
std::string_view name_of(NodeState state);

/// Asks a node for its state: a remote frame for one byte on 0x700 + node (node guarding).
CanFrame guard_request(int node);
/// The bit that alternates from answer to answer; of a heartbeat it is 0.
bool toggle_of(const CanFrame& state_frame);

/// Whether the error register (object 0x1001) tells of a fault of the device, and not of the bus
/// alone: bit 4, with which bit 0 (any error) is set.
constexpr bool tells_a_fault(unsigned error_register) {
    constexpr unsigned any_error = 0x01, communication = 0x10;
    return error_register != 0 && error_register != communication &&
           error_register != (any_error | communication);
}

/// An emergency message, on 0x080 + node.
struct Emergency {
    std::uint16_t code = 0; ///< 0x00xx: one fault is over; another may last
    std::uint8_t error_register = 0;
    std::array<std::byte, 5> maker{}; ///< the maker's own
    /// No fault is left: 7.2.7.1, code 0000h, and none in the register.
    [[nodiscard]] bool is_over() const { return code >> 8U == 0 && !tells_a_fault(error_register); }
    /// About the bus, not about what is measured.
    [[nodiscard]] bool is_of_communication() const { return code >> 8U == 0x81; }
    [[nodiscard]] std::string describe() const; ///< "0x5030 (device hardware), 00 01 00 00 00"
};
/// Empty for any other frame. One that is shorter than eight bytes tells of a generic error.
std::optional<Emergency> decode_emergency(const CanFrame& frame, int node);

} // namespace axiscal
