// Bodies of the requests that change state.

#include "acquisition/console/api_json.hpp"
#include "tests/fuzz/judge.hpp"

#include <cmath>

using namespace axiscal;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string body{fuzz::as_text(data, size)};
    if (const auto request = arm_request_from_json(body)) {
        if (request->datum_mm)
            fuzz::require(std::isfinite(*request->datum_mm), "a datum is finite");
    } else {
        fuzz::require(!request.error().detail.empty(), "a refusal has a reason");
    }
    if (const auto reason = abort_reason_from_json(body); !reason)
        fuzz::require(!reason.error().detail.empty(), "a refusal has a reason");
    return 0;
}
