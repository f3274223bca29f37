// The two files in which the kernel shows a 1-Wire thermometer.

#include "drivers/environment/w1_text.hpp"
#include "tests/fuzz/judge.hpp"

using namespace axiscal;

namespace {

void judge(const Result<double>& degC) {
    if (degC)
        fuzz::require(*degC >= -55 && *degC <= 125 && *degC != 85, "no value that it cannot have");
    else
        fuzz::require(!degC.error().detail.empty(), "a refusal has a reason");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    judge(parse_w1_slave(fuzz::as_text(data, size)));
    judge(parse_w1_temperature(fuzz::as_text(data, size)));
    return 0;
}
