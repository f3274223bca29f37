// Bodies of the requests that change state.

#include "acquisition/console/alignment_json.hpp"
#include "acquisition/console/api_json.hpp"
#include "acquisition/console/drift_json.hpp"
#include "acquisition/console/pairing_json.hpp"
#include "tests/fuzz/judge.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

using namespace axiscal;

namespace {

template <class T> void told(const Result<T>& request) {
    if (!request) fuzz::require(!request.error().detail.empty(), "a refusal has a reason");
}

void judge_alignment(const std::string& body) {
    const auto order = alignment_order_from_json(body);
    told(order);
    if (order && order->spot_offset_mm)
        fuzz::require(std::fabs(*order->spot_offset_mm) <= 100, "a spot is on its screen");
}

void judge_drift(const std::string& body) {
    const auto request = drift_request_from_json(body);
    told(request);
    if (request && request->place_mm)
        fuzz::require(std::fabs(*request->place_mm) <= 1e5, "a place lies on an axis");
}

void judge_revision(const std::string& body) {
    const auto request = revision_request_from_json(body);
    told(request);
    if (request) fuzz::require(!request->reason.empty(), "an order of a person has its reason");
}

void judge_answer(const std::string& body) {
    const auto request = answer_request_from_json(body);
    told(request);
    if (request)
        fuzz::require(!request->finding.empty() && !request->text.empty(),
                      "an answer says to what, and what");
}

void judge_pairing(const std::string& body) {
    const auto name = pair_request_from_json(body);
    told(name);
    if (name) fuzz::require(name->size() <= 80, "a page's name fits into a line");
    const auto code = session_request_from_json(body);
    told(code);
    if (code)
        fuzz::require(code->size() == 8 &&
                          code->find_first_not_of("0123456789") == std::string::npos,
                      "a code is eight digits");
    const auto end = end_request_from_json(body);
    told(end);
    if (end && end->name) fuzz::require(!end->name->empty(), "who is ended is named");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string body{fuzz::as_text(data, size)};
    if (const auto request = arm_request_from_json(body)) {
        if (request->datum_mm)
            fuzz::require(std::isfinite(*request->datum_mm), "a datum is finite");
    } else {
        fuzz::require(!request.error().detail.empty(), "a refusal has a reason");
    }
    told(abort_request_from_json(body));
    told(typed_reading_from_json(body));
    judge_alignment(body);
    judge_answer(body);
    judge_drift(body);
    judge_revision(body);
    judge_pairing(body);
    return 0;
}
