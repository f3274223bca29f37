// Source: CiA 301 V4.2: 7.2.8 (network management, node guarding, heartbeat, boot-up), 7.2.7
// (emergency, error code classes of table 26).
#include "drivers/canopen/node_messages.hpp"

#include "drivers/framing/byte_order.hpp"

#include <cstdio>

namespace axiscal {
namespace {

constexpr std::uint32_t emergency_base = 0x080, heartbeat_base = 0x700;
constexpr unsigned toggle_of_guarding = 0x80;

std::string_view class_of(std::uint16_t code) {
    switch (code >> 12U) {
    case 0x1: return "generic error";
    case 0x2: return "current";
    case 0x3: return "voltage";
    case 0x4: return "temperature of the device";
    case 0x5: return "hardware of the device";
    case 0x6: return "software of the device";
    case 0x7: return "additional modules";
    case 0x8: return "monitoring";
    case 0x9: return "external error";
    case 0xF: return "of its maker";
    default: return "unknown class";
    }
}

} // namespace

CanFrame nmt_frame(NmtCommand command, int node) {
    return plain_frame(0, {static_cast<unsigned>(command), static_cast<unsigned>(node)});
}

std::optional<NodeState> decode_heartbeat(const CanFrame& frame, int node) {
    const bool is_one = frame.is_plain() && frame.length == 1 &&
                        frame.id == heartbeat_base + static_cast<std::uint32_t>(node);
    if (!is_one) return std::nullopt;
    if (byte_at(frame.bytes(), 0) == 0) return NodeState::boot_up; // with a toggle bit it is none
    switch (byte_at(frame.bytes(), 0) & ~toggle_of_guarding) {
    case 0x04: return NodeState::stopped;
    case 0x05: return NodeState::operational;
    case 0x7F: return NodeState::pre_operational;
    default: return std::nullopt;
    }
}

CanFrame guard_request(int node) {
    CanFrame frame;
    frame.id = heartbeat_base + static_cast<std::uint32_t>(node);
    frame.remote = true;
    frame.length = 1;
    return frame;
}

bool toggle_of(const CanFrame& state_frame) {
    return state_frame.length > 0 && (byte_at(state_frame.bytes(), 0) & toggle_of_guarding) != 0;
}

std::string_view name_of(NodeState state) {
    switch (state) {
    case NodeState::boot_up: return "booting";
    case NodeState::stopped: return "stopped";
    case NodeState::operational: return "operational";
    case NodeState::pre_operational: return "pre-operational";
    }
    return "?";
}

std::optional<Emergency> decode_emergency(const CanFrame& frame, int node) {
    const bool is_one =
        frame.is_plain() && frame.id == emergency_base + static_cast<std::uint32_t>(node);
    if (!is_one) return std::nullopt;
    constexpr std::uint16_t generic = 0x1000;
    if (frame.length < 8) return Emergency{generic, 1, {}};
    Emergency emergency;
    emergency.code = static_cast<std::uint16_t>(little16(frame.bytes(), 0));
    emergency.error_register = static_cast<std::uint8_t>(byte_at(frame.bytes(), 2));
    std::ranges::copy(frame.bytes().subspan(3), emergency.maker.begin());
    return emergency;
}

std::string Emergency::describe() const {
    char word[16];
    std::snprintf(word, sizeof word, "0x%04X", unsigned{code});
    std::string text = word;
    text += " (" + std::string{class_of(code)} + "),";
    for (const std::byte byte : maker) {
        std::snprintf(word, sizeof word, " %02X", std::to_integer<unsigned>(byte));
        text += word;
    }
    return text;
}

} // namespace axiscal
