// Lines of a Vaisala PTU300 or PTB330. The checksums are no wall against this search: the text is
// read with and without them.

#include "drivers/environment/vaisala_line.hpp"
#include "tests/fuzz/judge.hpp"

using namespace axiscal;

namespace {

void judge(std::string_view text) {
    const auto reading = parse_vaisala_line(text);
    if (!reading) {
        fuzz::require(!reading.error().detail.empty(), "a refusal has a reason");
        return;
    }
    const auto within = [](const std::optional<double>& value, double low, double high) {
        return !value || (*value >= low && *value <= high);
    };
    fuzz::require(within(reading->pressure_Pa, 30e3, 120e3), "no pressure that cannot be");
    fuzz::require(within(reading->temperature_degC, -60, 150), "no temperature that cannot be");
    fuzz::require(within(reading->humidity_percent, 0, 100), "no humidity that cannot be");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto text = fuzz::as_text(data, size);
    judge(text);
    for (const auto kind : {VaisalaChecksum::none, VaisalaChecksum::csx, VaisalaChecksum::cs4}) {
        const auto verified = verify_vaisala_line(text, kind);
        if (!verified) {
            fuzz::require(!verified.error().detail.empty(), "a refusal has a reason");
            continue;
        }
        fuzz::require(text.starts_with(*verified), "what was verified is the beginning");
        judge(*verified);
    }
    return 0;
}
