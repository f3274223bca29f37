// `axiscal analyze CASE.json`: exit 0 with a document, or 3 with a reason; the document is JSON and
// never holds NaN or infinity.

#include "tests/fuzz/judge.hpp"
#include "tools/axiscal/analyze_case.hpp"

#include <nlohmann/json.hpp>

using namespace axiscal;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const CaseAnswer answer = analyze_cases(fuzz::as_text(data, size));
    fuzz::require(answer.exit_code == 0 || answer.exit_code == 3, "exit code 0 or 3");
    fuzz::require((answer.exit_code == 3) == !answer.error_line.empty(), "a refusal has a reason");
    fuzz::require(answer.error_line.find('\n') == std::string::npos, "one line on stderr");
    if (answer.output.empty()) return 0;
    const auto parsed = nlohmann::json::parse(answer.output, nullptr, false);
    fuzz::require(!parsed.is_discarded(), "the output is JSON");
    return 0;
}
