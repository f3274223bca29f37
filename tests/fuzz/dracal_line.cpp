// Lines of a Dracal sensor. The checksum is no wall against this search: the fields are parsed with
// and without it.

#include "drivers/environment/dracal_line.hpp"
#include "tests/fuzz/judge.hpp"

#include <cmath>

using namespace axiscal;

namespace {

void judge(std::string_view verified) {
    const auto line = parse_dracal_line(verified);
    if (!line) return;
    fuzz::require(line->kind == 'D' || line->kind == 'I', "the kind is known");
    for (const auto& pair : line->pairs) {
        const auto reading = stored_reading(pair);
        if (reading && reading->value)
            fuzz::require(std::isfinite(*reading->value), "no NaN leaves the decoder");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto text = fuzz::as_text(data, size);
    if (const auto verified = verify_dracal_line(text)) judge(*verified);
    judge(text);
    return 0;
}
