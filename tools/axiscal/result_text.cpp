#include "tools/axiscal/result_text.hpp"

#include "analysis/positioning/standards.hpp"
#include "config/json_text.hpp"
#include "tools/axiscal/text_columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

struct PaperUnit {
    const char* name;
    double factor; ///< from the unit of the result
};
PaperUnit paper_unit_of(const std::string& unit) {
    return unit == "deg" ? PaperUnit{"arcsec", 3600} : PaperUnit{"um", 1000};
}

std::string hundredths(double value) {
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "%.2f", value);
    return text.data();
}

/// Away from zero: no U is told smaller than it is.
std::string hundredths_up(double value) {
    return hundredths(std::ceil(value * 100 - 1e-9) / 100);
}

std::string line_of(const std::string& key, const Json& parameter, const PaperUnit& unit) {
    const FigureLabel label = figure_label(key, "ISO 230-2:2014", "");
    const std::string name = label.name.substr(0, label.name.find(','));
    const Json& u = parameter.at("U");
    return "  " + padded(label.symbol, 3) +
           right(hundredths(parameter.at("value").get<double>() * unit.factor), 10) + "  " +
           padded(u.is_null() ? "U not known" : "± " + hundredths_up(u.get<double>() * unit.factor),
                  12) +
           name + "\n";
}

std::string completeness_text(const Json& completeness) {
    const auto used = completeness.at("used").get<int>(),
               expected = completeness.at("expected").get<int>();
    const std::string count =
        std::to_string(used) + " of " + std::to_string(expected) + " planned readings";
    if (completeness.at("status") == "complete") return wrapped("Complete: " + count + ".", 0);
    std::string text =
        wrapped("PARTIAL: " + count + ". No certificate: no number, no verdict. In no figure:", 0);
    for (const Json& entry : completeness.at("left_out")) {
        std::ostringstream position;
        position << entry.at("position").get<double>();
        text += wrapped("P" + std::to_string(entry.at("target").get<int>() + 1) +
                            (entry.at("direction") == "positive" ? " ↑ (" : " ↓ (") +
                            position.str() + "): " + json_text(entry.at("count")) + " " +
                            entry.at("why").get<std::string>(),
                        2);
    }
    return text;
}

/// "R, A: reason", one paragraph a reason.
std::string not_evaluated_text(const Json& reasons) {
    std::map<std::string, std::string> symbols;
    for (const auto& [key, reason] : reasons.items()) {
        std::string& list = symbols[reason.get<std::string>()];
        list += (list.empty() ? "" : ", ") + figure_label(key, "ISO 230-2:2014", "").symbol;
    }
    std::string text;
    for (const auto& [reason, list] : symbols)
        text += wrapped("Not evaluated: " + list + ": " + reason + ".", 2);
    return text;
}

/// Null where no limit names the parameter.
Json verdict_on(const std::string& parameter, const Json& document) {
    if (!document.contains("verdicts")) return {};
    for (const Json& row : document.at("verdicts"))
        if (row.at("parameter") == parameter) return row.at("verdict");
    return {};
}

constexpr std::array<std::pair<std::string_view, std::string_view>, 4> verdict_words{
    {{"pass", "PASS: every limit is kept"},
     {"fail", "FAIL: a limit is not kept"},
     {"not_provable", "NOT PROVABLE: the uncertainty is too large for a decision"},
     {"not_evaluated", "NO VERDICT"}}};

/// What a person looks for first: does the axis keep its limits?
std::string verdict_text(const Json& summary, const PaperUnit& unit) {
    if (!summary.contains("verdict")) return {};
    const auto verdict = summary.at("verdict").get<std::string>();
    const auto* words = std::ranges::find(verdict_words, verdict,
                                          &std::pair<std::string_view, std::string_view>::first);
    const Json& agreed = summary.at("tolerances");
    std::string text =
        wrapped(std::string{words->second} + " (" + agreed.at("name").get<std::string>() +
                    "; rule " + agreed.at("rule").get<std::string>() + ")",
                0);
    for (const Json& row : summary.at("verdicts")) {
        std::string line =
            row.at("parameter").get<std::string>() + ": " + row.at("verdict").get<std::string>();
        if (row.at("limit").is_number())
            line += ", limit " + hundredths(row.at("limit").get<double>() * unit.factor) + " " +
                    unit.name;
        if (row.at("reason").is_string()) line += ", " + row.at("reason").get<std::string>();
        text += wrapped(line, 2);
    }
    return text;
}

/// What a person answered to a finding; what to do where nobody did.
std::string answer_text(const Json& found) {
    const Json answer = found.value("answer", Json{});
    if (!answer.is_object())
        return wrapped("No answer yet: axiscal answer " + found.at("error").get<std::string>() +
                           " \"what was looked at, and what it was\"",
                       2);
    return wrapped("Answer of " + answer.at("by").get<std::string>() + ": " +
                       answer.at("text").get<std::string>(),
                   2);
}

/// What is wrong with the set-up, one paragraph a finding.
std::string setup_text(const Json& summary) {
    std::string text;
    for (const Json& found : summary.value("setup_findings", Json::array())) {
        text += wrapped("Set-up: " + found.at("seen").get<std::string>() + " " +
                            found.at("probably").get<std::string>() + " " +
                            found.at("look_at").get<std::string>(),
                        0);
        text += answer_text(found);
    }
    return text;
}

} // namespace

Json result_summary(const Json& document) {
    Json summary;
    summary["run"] = document.at("run").at("id");
    summary["unit"] = document.at("unit");
    summary["k"] = nullptr;
    summary["completeness"] = document.at("completeness");
    summary["parameters"] = Json::object();
    if (document.contains("verdict")) { // no partial result has one
        summary["verdict"] = document.at("verdict");
        summary["verdicts"] = document.at("verdicts");
        summary["tolerances"] = document.at("tolerances");
    }
    if (document.contains("setup_findings"))
        summary["setup_findings"] = document.at("setup_findings");
    for (const auto& [key, parameter] : document.at("parameters").items()) {
        Json& figure = summary["parameters"][key];
        figure["value"] = parameter.at("value");
        figure["U"] = nullptr;
        figure["verdict"] = verdict_on(key, document);
        if (!parameter.contains("expanded_uncertainty")) continue;
        figure["U"] = parameter.at("expanded_uncertainty").at("value");
        summary["k"] = parameter.at("expanded_uncertainty").at("k");
    }
    summary["not_evaluated"] = document.value("not_evaluated", Json::object());
    return summary;
}

std::string result_text(const Json& summary, const std::string& about) {
    const PaperUnit unit = paper_unit_of(summary.at("unit").get<std::string>());
    std::string text = verdict_text(summary, unit);
    text += wrapped("Run " + summary.at("run").get<std::string>(), 0);
    text += wrapped(about, 0) + completeness_text(summary.at("completeness"));
    text += std::string{"Figures in "} + unit.name;
    text +=
        summary.at("k").is_null() ? ":\n" : ", with U (k = " + json_text(summary.at("k")) + "):\n";
    for (const auto& [key, parameter] : summary.at("parameters").items())
        text += line_of(key, parameter, unit);
    return text + not_evaluated_text(summary.at("not_evaluated")) + setup_text(summary);
}

} // namespace axiscal
