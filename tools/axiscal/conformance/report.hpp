#pragma once
// What the conformance kit says, for people and for programs. Pure.

#include "tools/axiscal/conformance/judge.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace axiscal {

struct Tally {
    std::map<std::string, std::size_t> cases_by_origin;
    std::size_t passed = 0, failed = 0;    ///< cases
    std::size_t figures = 0, agreeing = 0; ///< over all cases
    [[nodiscard]] bool all_agree() const { return failed == 0; }
};

Tally tally_of(const std::vector<CaseVerdict>& verdicts);

/// A line for the case and one a figure, agreement in digits first. `brief`: only what disagrees,
/// and nothing for a case that passed.
std::string text_of_verdict(const CaseVerdict& verdict, bool brief);

/// The last line: cases by origin, figures, passed and failed.
std::string text_of_tally(const Tally& tally);

/// The document "axiscal.conformance/1".
nlohmann::ordered_json json_of_verdicts(const std::vector<CaseVerdict>& verdicts,
                                        const std::string& program);

} // namespace axiscal
