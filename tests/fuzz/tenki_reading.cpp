// Replies of a Dracal USBTenki: a chip, a command, twelve bytes of calibration, then the reply. The
// checksum is no wall against this search: its content is read with and without it.

#include "drivers/environment/tenki_reading.hpp"
#include "tests/fuzz/judge.hpp"

#include <cmath>
#include <span>

using namespace axiscal;

namespace {

constexpr std::size_t calibration_bytes = 12, head_bytes = 2 + calibration_bytes;

void judge(int chip, std::span<const std::byte> raw, const TenkiCalibration& calibration) {
    const auto value = tenki_value(chip, raw, calibration);
    if (!value) return;
    const auto measure = tenki_measure(chip);
    fuzz::require(measure.has_value(), "no value of an unknown chip");
    fuzz::require(std::isfinite(*value), "no NaN leaves the decoder");
    if (measure->kind == ChannelKind::temperature)
        fuzz::require(*value >= -200.1 && *value <= 850.1, "no temperature that cannot be");
    if (measure->kind == ChannelKind::pressure)
        fuzz::require(*value >= 30'000 && *value <= 120'000, "no pressure that cannot be");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = std::as_bytes(std::span{data, size});
    if (size < head_bytes) {
        (void)decode_ms5611_calibration(bytes);
        return 0;
    }
    const int chip = data[0], command = data[1];
    TenkiCalibration calibration;
    if (const auto found = decode_ms5611_calibration(bytes.subspan(2, calibration_bytes)))
        calibration.ms5611 = *found;
    const auto reply = bytes.subspan(head_bytes);
    judge(chip, reply, calibration);
    const auto content = decode_tenki_reply(reply, command);
    if (content) {
        fuzz::require(content->size() + 2 == reply.size(), "echo and checksum are taken off");
        judge(chip, *content, calibration);
    } else {
        fuzz::require(!content.error().detail.empty(), "a refusal has a reason");
    }
    return 0;
}
