// Source: CiA 301 (CANopen application layer) V4.2, 7.2.4: SDO upload and download, expedited and
// segmented, abort codes of table 22.
#include "drivers/canopen/sdo.hpp"

#include "drivers/framing/byte_order.hpp"

#include <cstdio>

namespace axiscal {
namespace {

constexpr std::uint32_t request_base = 0x600, answer_base = 0x580;
constexpr std::size_t sdo_length = 8;
enum Command : unsigned {
    read_begins = 0x40,
    write_expedited = 0x23, ///< expedited, with its size told
    segment_asked = 0x60,
    write_done = 0x60,
    abort = 0x80,
    kind_mask = 0xE0,
    segment_kind = 0x00,
    toggle_bit = 0x10,
};

CanFrame begin_frame(int node, ObjectKey key, unsigned command) {
    return plain_frame(
        request_base + static_cast<std::uint32_t>(node),
        {command, key.index & 0xFFU, unsigned{key.index} >> 8U, key.sub, 0, 0, 0, 0});
}

} // namespace

std::string name_of(ObjectKey key) {
    char name[16];
    std::snprintf(name, sizeof name, "0x%04X:%02X", unsigned{key.index}, unsigned{key.sub});
    return name;
}

std::string_view sdo_abort_reason(std::uint32_t code) {
    switch (code) {
    case 0x05030000: return "toggle bit not alternated";
    case 0x05040000: return "time-out of the protocol";
    case 0x05040001: return "command unknown";
    case 0x05040005: return "out of memory";
    case 0x06010000: return "no access";
    case 0x06010001: return "cannot be read";
    case 0x06010002: return "cannot be written";
    case 0x06020000: return "no such object";
    case 0x06040041: return "cannot be mapped into a PDO";
    case 0x06040042: return "more than fits into a PDO";
    case 0x06040043: return "parameters do not go together";
    case 0x06060000: return "failure of the hardware";
    case 0x06070010: return "wrong length";
    case 0x06070012: return "too long";
    case 0x06070013: return "too short";
    case 0x06090011: return "no such sub-index";
    case 0x06090030: return "value out of range";
    case 0x06090031: return "value too high";
    case 0x06090032: return "value too low";
    case 0x08000000: return "general error";
    case 0x08000020: return "cannot be stored";
    case 0x08000021: return "under local control";
    case 0x08000022: return "not in this state of the device";
    default: return "no reason that is known";
    }
}

SdoTransfer::SdoTransfer(int node, ObjectKey key)
    : node_{node}
    , key_{key} {}

SdoTransfer SdoTransfer::read(int node, ObjectKey key) {
    SdoTransfer transfer{node, key};
    transfer.request_ = begin_frame(node, key, read_begins);
    return transfer;
}

SdoTransfer SdoTransfer::write(int node, ObjectKey key, std::uint32_t value, int bytes) {
    SdoTransfer transfer{node, key};
    transfer.stage_ = Stage::writing;
    const auto unused = static_cast<unsigned>(4 - bytes);
    transfer.request_ = begin_frame(node, key, write_expedited | unused << 2U);
    for (std::size_t at = 0; at < static_cast<std::size_t>(bytes); ++at)
        transfer.request_.data[4 + at] = static_cast<std::byte>(value >> (8 * at) & 0xFFU);
    return transfer;
}

bool SdoTransfer::about_it(const CanFrame& frame) const {
    return little16(frame.bytes(), 1) == key_.index && byte_at(frame.bytes(), 3) == key_.sub;
}

tl::unexpected<Error> SdoTransfer::broken(const char* how) const {
    return fail(Fault::bad_frame,
                "node " + std::to_string(node_) + " answers for " + name_of(key_) + " " + how);
}

tl::unexpected<Error> SdoTransfer::aborted(const CanFrame& frame) const {
    const std::uint32_t code = little32(frame.bytes(), 4);
    char number[16];
    std::snprintf(number, sizeof number, "0x%08X", code);
    return fail(Fault::refused, "node " + std::to_string(node_) + " refuses " + name_of(key_) +
                                    ": " + std::string{sdo_abort_reason(code)} + " (" + number +
                                    ")");
}

Result<SdoTransfer::Step> SdoTransfer::take(const CanFrame& frame) {
    if (!frame.is_plain() || frame.id != answer_base + static_cast<std::uint32_t>(node_))
        return Step::ignored;
    if (frame.length != sdo_length) return broken("with a frame that has not 8 bytes");
    const std::uint32_t command = byte_at(frame.bytes(), 0);
    if (command == abort) return about_it(frame) ? Result<Step>{aborted(frame)} : Step::ignored;
    if (stage_ == Stage::segments) return take_segment(frame, command);
    if (!about_it(frame)) return Step::ignored;
    if (stage_ == Stage::beginning) return take_beginning(frame, command);
    return command == write_done ? Result<Step>{Step::done}
                                 : broken("with what is no word to a write");
}

Result<SdoTransfer::Step> SdoTransfer::take_beginning(const CanFrame& frame, unsigned command) {
    if ((command & kind_mask) != read_begins) return broken("with what is no word to a read");
    const bool expedited = (command & 2U) != 0, sized = (command & 1U) != 0;
    if (expedited) {
        const std::size_t size = sized ? 4 - (command >> 2U & 3U) : 4;
        const auto bytes = frame.bytes().subspan(4, size);
        content_.assign(bytes.begin(), bytes.end());
        return Step::done;
    }
    announced_ = sized ? little32(frame.bytes(), 4) : 0;
    if (announced_ > longest_content) return broken("with more bytes than any object here has");
    stage_ = Stage::segments;
    ask_segment();
    return Step::more;
}

void SdoTransfer::ask_segment() {
    request_ = plain_frame(request_base + static_cast<std::uint32_t>(node_),
                           {segment_asked | toggle_, 0, 0, 0, 0, 0, 0, 0});
}

Result<SdoTransfer::Step> SdoTransfer::take_segment(const CanFrame& frame, unsigned command) {
    if ((command & kind_mask) != segment_kind) return broken("with what is no segment");
    if ((command & toggle_bit) != toggle_) return broken("with a segment out of order");
    const std::size_t size = 7 - (command >> 1U & 7U);
    const auto bytes = frame.bytes().subspan(1, size);
    content_.insert(content_.end(), bytes.begin(), bytes.end());
    if (content_.size() > longest_content)
        return broken("with more bytes than any object here has");
    if ((command & 1U) != 0) {
        if (announced_ != 0 && content_.size() != announced_)
            return broken("with another length than it announced");
        return Step::done;
    }
    toggle_ ^= toggle_bit;
    ask_segment();
    return Step::more;
}

} // namespace axiscal
