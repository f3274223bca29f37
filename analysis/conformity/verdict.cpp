#include "analysis/conformity/verdict.hpp"

namespace axiscal {

Verdict verdict_of(double value, double limit, double guard_band) {
    if (value <= limit - guard_band) return Verdict::pass;
    if (value > limit + guard_band) return Verdict::fail;
    return Verdict::not_provable;
}

double guard_band_of(DecisionRule rule, double expanded_uncertainty, double coverage) {
    constexpr double one_sided_95_percent = 1.6448536269514722;
    switch (rule) {
    case DecisionRule::none:
    case DecisionRule::simple: return 0;
    case DecisionRule::guard_U: return expanded_uncertainty;
    case DecisionRule::iso_14253_1_2017:
        return one_sided_95_percent * expanded_uncertainty / coverage;
    }
    return expanded_uncertainty;
}

std::string_view name_of(Verdict verdict) {
    switch (verdict) {
    case Verdict::pass: return "pass";
    case Verdict::fail: return "fail";
    case Verdict::not_provable: return "not_provable";
    }
    return "not_provable";
}

} // namespace axiscal
