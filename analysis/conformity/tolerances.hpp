#pragma once
// Figures of a test against a user's set of limits by travel band (the scheme of ISO 10791-4 and
// its kind; which numbers stand in it is the user's contract). Pure.

#include "analysis/record/tolerance_record.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// One figure as it was evaluated; `value` absent where the data did not allow it.
struct FigureToJudge {
    std::string parameter;
    std::optional<double> value;
    std::optional<double> expanded_uncertainty; ///< U; absent: U was not evaluated
    double coverage = 2;                        ///< k of U
};

struct JudgedFigure {
    std::string parameter;
    std::optional<double> value, limit, travel_up_to, expanded_uncertainty, guard_band;
    /// "pass", "fail", "not_provable" by the rule; "not_evaluated" without rule, value, band or U.
    std::string_view verdict = "not_evaluated";
    /// "within_limit" | "beyond_limit" of the bare numbers, where there are value and limit.
    std::string_view comparison;
    std::string reason; ///< of "not_evaluated"
};

/// The band of the smallest `travel_up_to` that holds the travel; a limit without band where no
/// band does; nullptr where there is neither.
const ToleranceLimit*
limit_for(const std::vector<ToleranceLimit>& limits, std::string_view parameter, double travel);

/// One verdict a parameter of `limits`, in the order they stand. A figure with a sign (B_mean) is
/// judged by its magnitude. All in one unit, travels in one unit.
std::vector<JudgedFigure> judge_figures(const std::vector<ToleranceLimit>& limits,
                                        const std::vector<FigureToJudge>& figures,
                                        double travel,
                                        DecisionRule rule);

/// Of the whole set: "fail" where one fails, else "not_provable" or "not_evaluated" where one is,
/// else "pass". Empty of no figure.
std::string_view overall_verdict(std::span<const JudgedFigure> judged);

} // namespace axiscal
