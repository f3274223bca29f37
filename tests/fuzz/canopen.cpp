// Frames of CANopen nodes. The first byte chooses how the rest is taken: as the answers to a
// question, as a mapping and the PDOs under it, or as what a node says unasked.

#include "drivers/ballbar/cia406_position.hpp"
#include "drivers/canopen/node_messages.hpp"
#include "drivers/canopen/pdo_layout.hpp"
#include "drivers/canopen/sdo.hpp"
#include "drivers/environment/cia404_input.hpp"
#include "drivers/framing/byte_order.hpp"
#include "tests/fuzz/judge.hpp"

#include <cmath>

using namespace axiscal;

namespace {

using Bytes = std::span<const std::byte>;
constexpr int node = 125;

/// A frame as long as the low four bits of the first byte say (0 to 8), its identifier one of those
/// that node 125 uses; what was used is taken away.
CanFrame take_frame(Bytes& rest, std::uint32_t id) {
    CanFrame frame;
    frame.id = id;
    frame.length = std::min<std::size_t>({byte_at(rest, 0) & 15U, 8, rest.size() - 1});
    std::ranges::copy(rest.subspan(1, frame.length), frame.data.begin());
    rest = rest.subspan(1 + frame.length);
    return frame;
}

void judge_answers(Bytes rest) {
    auto transfer = SdoTransfer::read(node, {0x1008, 0});
    while (!rest.empty()) {
        const auto step = transfer.take(take_frame(rest, 0x580 + node));
        fuzz::require(transfer.content().size() <= SdoTransfer::longest_content + 7,
                      "an object ends");
        if (!step) {
            fuzz::require(!step.error().detail.empty(), "a refusal has a reason");
            return;
        }
        if (*step == SdoTransfer::Step::more)
            fuzz::require(transfer.request().length == 8, "every question has eight bytes");
        if (*step == SdoTransfer::Step::done) return;
    }
}

void judge_pdos(Bytes rest) {
    if (rest.empty()) return;
    std::vector<std::uint32_t> words(
        std::min<std::size_t>(byte_at(rest, 0) & 15U, rest.size() / 5));
    rest = rest.subspan(1);
    for (std::uint32_t& word : words) {
        word = little32(rest, 0);
        rest = rest.subspan(4);
    }
    const auto layout = pdo_layout(1, 0x1FD, words);
    if (!layout) return;
    const auto input = find_cia404_input({*layout}, 1);
    const auto position = find_cia406_position({*layout});
    while (!rest.empty()) {
        const CanFrame frame = take_frame(rest, 0x1FD);
        for (const PdoEntry& entry : layout->entries) {
            const int bits = layout->bits_of(entry.object); // of its first place, where it has two
            if (const auto field = layout->field(frame, entry.object))
                fuzz::require(bits == 64 || *field >> bits == 0, "a field has its width");
        }
        if (input) {
            const auto reading = read_cia404_input(*input, *layout, frame);
            fuzz::require(reading.celsius.has_value() == (reading.why == Cia404Reading::Why::none),
                          "no number without a reason");
            if (reading.celsius)
                fuzz::require(*reading.celsius >= -273.15 && *reading.celsius <= 2000,
                              "no temperature that cannot be");
        }
        if (!position) continue;
        const auto reading = read_cia406_position(*position, *layout, frame);
        if (reading.metres)
            fuzz::require(std::isfinite(*reading.metres), "no NaN leaves the decoder");
    }
}

void judge_messages(Bytes rest) {
    while (!rest.empty()) {
        const CanFrame beat = take_frame(rest, 0x700 + node);
        if (decode_heartbeat(beat, node))
            fuzz::require(beat.length == 1, "a heartbeat has one byte");
        if (rest.empty()) return;
        const CanFrame word = take_frame(rest, 0x080 + node);
        if (const auto emergency = decode_emergency(word, node))
            fuzz::require(!emergency->describe().empty(), "an emergency has a sentence");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Bytes bytes = std::as_bytes(std::span{data, size});
    if (bytes.empty()) return 0;
    const Bytes rest = bytes.subspan(1);
    switch (byte_at(bytes, 0) % 3) {
    case 0: judge_answers(rest); break;
    case 1: judge_pdos(rest); break;
    default: judge_messages(rest); break;
    }
    return 0;
}
