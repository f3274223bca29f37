#include "tools/axiscal/conformance/judge.hpp"

#include "config/json_text.hpp"
#include "tools/axiscal/case_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;

/// nullptr where the pointer leads nowhere, also through an index that is none.
const json* value_at(const json& document, const std::string& at) {
    try {
        const json::json_pointer pointer{at};
        return document.contains(pointer) ? &document.at(pointer) : nullptr;
    } catch (const json::exception&) {
        return nullptr;
    }
}

std::string shown(double number) {
    return json_text(json(number));
}

void judge_number(FigureVerdict& verdict) {
    const Expectation& wanted = verdict.wanted;
    if (!verdict.got.is_number()) {
        const std::string token = not_finite_token(verdict.got);
        verdict.complaint = token.empty()
                                ? std::string{"is no number but "} + verdict.got.type_name()
                                : "is " + token;
        return;
    }
    const auto got = verdict.got.get<double>();
    const double off = std::fabs(got - wanted.value);
    verdict.digits = digits_of_agreement(got, wanted.value, wanted.scale);
    verdict.agrees = off <= wanted.tolerance;
    if (!verdict.agrees)
        verdict.complaint = "got " + shown(got) + ", expected " + shown(wanted.value) +
                            ", off by " + shown(off) + ", tolerance " + shown(wanted.tolerance) +
                            " (" + wanted.reason + ")";
}

void judge_equal(FigureVerdict& verdict) {
    verdict.agrees = verdict.got == verdict.wanted.equals;
    if (!verdict.agrees)
        verdict.complaint =
            "got " + json_text(verdict.got) + ", expected " + json_text(verdict.wanted.equals);
}

FigureVerdict judge_figure(const Expectation& wanted, const json& document) {
    FigureVerdict verdict;
    verdict.wanted = wanted;
    const json* got = value_at(document, wanted.at);
    if (got) verdict.got = *got;
    if (wanted.kind == Expectation::Kind::absent) {
        verdict.agrees = got == nullptr;
        if (got) verdict.complaint = "stands there, but the data do not allow it";
    } else if (!got) {
        verdict.complaint = "is not in the answer";
    } else if (wanted.kind == Expectation::Kind::equal) {
        judge_equal(verdict);
    } else {
        judge_number(verdict);
    }
    return verdict;
}

} // namespace

bool CaseVerdict::passed() const {
    return failure.empty() && agreeing() == figures.size();
}

std::size_t CaseVerdict::agreeing() const {
    return static_cast<std::size_t>(std::ranges::count(figures, true, &FigureVerdict::agrees));
}

double digits_of_agreement(double got, double want, double scale) {
    const double off = std::fabs(got - want);
    const double largest = std::max(std::fabs(want), scale);
    const double whole = largest > 0 ? largest : 1;
    if (off == 0) return most_digits;
    return std::clamp(-std::log10(off / whole), 0.0, most_digits);
}

CaseVerdict judge_answer(const ConformanceCase& asked, std::string_view answer) {
    const auto read = read_case_text(answer);
    if (!read)
        return judge_silence(asked, "its answer is no result: " + read.error().field + ": " +
                                        read.error().detail);
    CaseVerdict verdict{asked, {}, {}};
    for (const Expectation& wanted : asked.expect)
        verdict.figures.push_back(judge_figure(wanted, read->document));
    return verdict;
}

CaseVerdict judge_silence(const ConformanceCase& asked, std::string reason) {
    CaseVerdict verdict{asked, std::move(reason), {}};
    for (const Expectation& wanted : asked.expect) {
        FigureVerdict figure;
        figure.wanted = wanted;
        figure.complaint = "there is no answer";
        verdict.figures.push_back(std::move(figure));
    }
    return verdict;
}

} // namespace axiscal
