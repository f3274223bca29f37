#pragma once
// Holds an answer against the expectations of a case. Pure.

#include "tools/axiscal/conformance/conformance_case.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

struct FigureVerdict { // NOLINT(bugprone-exception-escape): as Expectation
    Expectation wanted;
    bool agrees = false;
    double digits = 0;     ///< of a number; `most_digits` where it is equal bit by bit
    nlohmann::json got;    ///< null where nothing stands there
    std::string complaint; ///< empty where it agrees
};

struct CaseVerdict {
    ConformanceCase asked;
    std::string failure; ///< there was no answer at all, and why
    std::vector<FigureVerdict> figures;
    [[nodiscard]] bool passed() const;
    [[nodiscard]] std::size_t agreeing() const;
};

/// A double has no more; it also stands for "equal bit by bit".
inline constexpr double most_digits = 17;

/// -log10(|got - want| / max(|want|, scale)), from 0 to most_digits. Where want and scale are both
/// 0, one unit of the figure counts as the whole.
double digits_of_agreement(double got, double want, double scale);

/// The verdict over a program's answer (its standard output). An answer that is no JSON is a
/// failure of the case; a figure that is missing, NaN or no number is one of that figure.
CaseVerdict judge_answer(const ConformanceCase& asked, std::string_view answer);

/// There was no answer: every figure disagrees.
CaseVerdict judge_silence(const ConformanceCase& asked, std::string reason);

} // namespace axiscal
