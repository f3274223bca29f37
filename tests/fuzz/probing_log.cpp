// A probing program's first line, then the log that it left: both come back from a control by hand.

#include "acquisition/program/probing_program.hpp"
#include "tests/fuzz/judge.hpp"

#include <cmath>

using namespace axiscal;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text{fuzz::as_text(data, size)};
    const auto end = text.find('\n');
    const auto plan = read_probing_id(text.substr(0, end));
    if (!plan) {
        fuzz::require(!plan.error().detail.empty(), "a refused program has a reason");
        return 0;
    }
    fuzz::require(write_probing_linuxcnc(*plan, "log.txt").has_value(),
                  "what is read can be driven");
    const auto record = read_probing_log(*plan, end == text.npos ? "" : text.substr(end + 1));
    if (!record) {
        fuzz::require(!record.error().detail.empty(), "a refused log has a reason");
        return 0;
    }
    fuzz::require(static_cast<int>(record->touches.size()) ==
                      3 * (plan->references + plan->touches),
                  "every planned touch is there");
    for (const ProbingTouch& touch : record->touches)
        for (const Length& coordinate : touch.latched)
            fuzz::require(std::isfinite(coordinate.si()), "no NaN leaves the reader");
    return 0;
}
