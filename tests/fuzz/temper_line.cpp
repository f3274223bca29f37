// Lines of a TEMPerX232: readings, calibrations, its name.

#include "drivers/environment/temper_line.hpp"
#include "tests/fuzz/judge.hpp"

#include <cmath>

using namespace axiscal;

namespace {

void judge(const std::optional<double>& value, double low, double high) {
    fuzz::require(!value || (*value >= low && *value <= high), "no value that cannot be");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto text = fuzz::as_text(data, size);
    const auto line = parse_temper_line(text);
    if (line) {
        judge(line->temperature_degC, -55, 125);
        judge(line->humidity_percent, 0, 100);
        fuzz::require(line->has_humidity || !line->humidity_percent, "no humidity of no sensor");
        fuzz::require(text.ends_with('<'), "a line that lost its end is none");
    } else {
        fuzz::require(!line.error().detail.empty(), "a refusal has a reason");
    }
    if (const auto own = parse_temper_calibration(text))
        fuzz::require(std::abs(own->temperature_K) < 1000 && std::abs(own->humidity_percent) < 1000,
                      "a calibration has at most three digits before the point");
    const std::string name = temper_version(text);
    fuzz::require(name.empty() || name.starts_with("TEMPer"), "a name is a TEMPer's");
    return 0;
}
