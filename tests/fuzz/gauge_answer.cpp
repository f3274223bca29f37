// What a length gauge answers: lines, cut as each model ends its own.

#include "drivers/gauge/gauge_answer.hpp"
#include "drivers/framing/line_framer.hpp"
#include "tests/fuzz/judge.hpp"

#include <cmath>
#include <span>

using namespace axiscal;

namespace {

void judge(std::string_view line, const GaugeModel& model) {
    const auto answer = decode_gauge_answer(line, model);
    if (!answer) {
        fuzz::require(!answer.error().detail.empty(), "a refusal has a reason");
        return;
    }
    fuzz::require(std::isfinite(answer->number) && std::abs(answer->number) < 1e10,
                  "a number has no more places than its shape");
    fuzz::require(answer->input >= 1 && answer->input <= 9, "an input is a digit");
    const auto unit = answer->unit.value_or(GaugeUnit::inches);
    fuzz::require(std::isfinite(length_of(answer->number, unit).in(mm)), "a length is finite");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = std::as_bytes(std::span{data, size});
    for (const GaugeModel& model : gauge_models()) {
        judge(fuzz::as_text(data, size), model);
        LineFramer framer{100, false, model.line_end};
        const auto oversized = framer.feed(bytes, [&](std::string_view line) {
            judge(line, model);
            (void)unit_in_settings(line);
        });
        fuzz::require(oversized <= size / 100, "a line that is too long has over 100 bytes");
    }
    return 0;
}
