#include "tools/axiscal/conformance/report.hpp"

#include "config/json_text.hpp"
#include <algorithm>
#include <array>
#include <cstdio>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

std::string digits_text(const FigureVerdict& figure) {
    if (figure.wanted.kind != Expectation::Kind::number) return "as told";
    if (figure.digits >= most_digits) return "exact";
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.1f", figure.digits);
    return text.data();
}

std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(text.size(), width), ' ');
    return text;
}

std::string line_of(const FigureVerdict& figure) {
    const std::string place = "  " + padded(figure.wanted.at, 36);
    if (!figure.agrees) return "  DISAGREES" + place + " " + figure.complaint + "\n";
    const std::string value = figure.got.is_null() ? "absent" : json_text(figure.got);
    return "  " + padded(digits_text(figure), 9) + place + " " + value + "\n";
}

Json json_of(const FigureVerdict& figure) {
    const bool number = figure.wanted.kind == Expectation::Kind::number;
    Json out;
    out["at"] = figure.wanted.at;
    out["agrees"] = figure.agrees;
    if (figure.wanted.kind != Expectation::Kind::absent)
        out["expected"] = number ? Json(figure.wanted.value) : Json(figure.wanted.equals);
    out["got"] = figure.got;
    if (number) {
        out["digits"] = figure.digits;
        out["tolerance"] = figure.wanted.tolerance;
    }
    if (!figure.wanted.reason.empty()) out["reason"] = figure.wanted.reason;
    if (!figure.agrees) out["complaint"] = figure.complaint;
    return out;
}

Json json_of(const CaseVerdict& verdict) {
    Json out;
    out["id"] = verdict.asked.id;
    out["title"] = verdict.asked.title;
    out["origin"] = verdict.asked.origin;
    out["source"] = verdict.asked.source;
    out["passed"] = verdict.passed();
    if (!verdict.failure.empty()) out["failure"] = verdict.failure;
    out["figures"] = Json::array();
    for (const FigureVerdict& figure : verdict.figures)
        out["figures"].push_back(json_of(figure));
    return out;
}

Json json_of(const Tally& tally) {
    Json out;
    for (const std::string_view origin : conformance_origins)
        out["cases_by_origin"][std::string{origin}] = tally.cases_by_origin.at(std::string{origin});
    out["passed"] = tally.passed;
    out["failed"] = tally.failed;
    out["figures"] = tally.figures;
    out["agreeing"] = tally.agreeing;
    return out;
}

} // namespace

Tally tally_of(const std::vector<CaseVerdict>& verdicts) {
    Tally tally;
    for (const std::string_view origin : conformance_origins)
        tally.cases_by_origin[std::string{origin}] = 0;
    for (const CaseVerdict& verdict : verdicts) {
        ++tally.cases_by_origin[verdict.asked.origin];
        ++(verdict.passed() ? tally.passed : tally.failed);
        tally.figures += verdict.figures.size();
        tally.agreeing += verdict.agreeing();
    }
    return tally;
}

std::string text_of_verdict(const CaseVerdict& verdict, bool brief) {
    if (brief && verdict.passed()) return {};
    std::string out = std::string{verdict.passed() ? "agrees" : "FAILED"} + "  " +
                      verdict.asked.id + " (" + verdict.asked.origin + "): " + verdict.asked.title +
                      "\n";
    if (!verdict.failure.empty()) return out + "  " + verdict.failure + "\n";
    for (const FigureVerdict& figure : verdict.figures)
        if (!brief || !figure.agrees) out += line_of(figure);
    return out;
}

std::string text_of_tally(const Tally& tally) {
    std::string out = std::to_string(tally.passed + tally.failed) + " cases (";
    for (const std::string_view origin : conformance_origins)
        out += std::to_string(tally.cases_by_origin.at(std::string{origin})) + " " +
               std::string{origin} + (origin == conformance_origins.back() ? "" : ", ");
    return out + "), " + std::to_string(tally.figures) +
           " figures: " + std::to_string(tally.agreeing) + " agree, " +
           std::to_string(tally.figures - tally.agreeing) + " disagree; " +
           std::to_string(tally.passed) + " cases passed, " + std::to_string(tally.failed) +
           " failed\n";
}

Json json_of_verdicts(const std::vector<CaseVerdict>& verdicts, const std::string& program) {
    Json out;
    out["format"] = "axiscal.conformance/1";
    out["program"] = program;
    out["cases"] = Json::array();
    for (const CaseVerdict& verdict : verdicts)
        out["cases"].push_back(json_of(verdict));
    out["summary"] = json_of(tally_of(verdicts));
    return out;
}

} // namespace axiscal
