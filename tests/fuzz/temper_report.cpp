// Reports of a TEMPer stick: the first byte tells how many of the rest are the firmware's answer.

#include "drivers/environment/temper_report.hpp"
#include "tests/fuzz/judge.hpp"

#include <algorithm>
#include <span>

using namespace axiscal;

namespace {

void judge(const std::optional<double>& value, double low, double high) {
    fuzz::require(!value || (*value >= low && *value <= high), "no value that cannot be");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const auto rest = std::as_bytes(std::span{data, size}).subspan(1);
    const std::size_t told = std::min<std::size_t>(data[0] % 33, rest.size());
    const std::string firmware = temper_firmware(rest.first(told));
    fuzz::require(std::ranges::all_of(firmware, [](char c) { return c >= ' ' && c <= '~'; }),
                  "a firmware's name is text");
    const auto family = temper_family(firmware);
    if (!family) {
        fuzz::require(!family.error().detail.empty(), "a refusal has a reason");
        return 0;
    }
    const auto reading = decode_temper_reading(rest.subspan(told), *family);
    judge(reading.stick_temperature, -55, 125);
    judge(reading.probe_temperature, -55, 125);
    judge(reading.stick_humidity, 0, 100);
    judge(reading.probe_humidity, 0, 100);
    return 0;
}
