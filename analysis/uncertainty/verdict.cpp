#include "analysis/uncertainty/verdict.hpp"

namespace axiscal {

Verdict verdict_of(double value, double limit, double expanded_uncertainty) {
    if (value <= limit - expanded_uncertainty) return Verdict::pass;
    if (value > limit + expanded_uncertainty) return Verdict::fail;
    return Verdict::not_provable;
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
