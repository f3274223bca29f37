#include "tools/axiscal/budget_text.hpp"

#include "analysis/circular/circular_budget_inputs.hpp"
#include "analysis/positioning/budget_inputs.hpp"
#include "config/json_text.hpp"
#include "tools/axiscal/text_columns.hpp"

#include <array>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

Json text_or_null(const std::string& text) {
    return text.empty() ? Json{} : Json(text);
}

Json number_or_null(const std::optional<double>& number) {
    return number ? Json(*number) : Json{};
}

Json inputs_json(std::span<const BudgetInput> inputs) {
    Json list = Json::array();
    for (const BudgetInput& input : inputs)
        list.push_back({{"term", input.term},
                        {"quantity", input.quantity},
                        {"value", number_or_null(input.value)},
                        {"unit", input.unit},
                        {"origin", name_of(input.origin)},
                        {"where", text_or_null(input.where)},
                        {"seen", number_or_null(input.seen)},
                        {"seen_in", text_or_null(input.seen_in)},
                        {"exceeded", input.exceeded()}});
    return list;
}

Json head_of(const std::string& run, const char* unit) {
    Json summary;
    summary["run"] = run;
    summary["unit"] = unit;
    summary["k"] = nullptr;
    summary["inputs"] = Json::array();
    summary["terms"] = Json::array();
    summary["parameters"] = Json::object();
    summary["missing"] = Json::array();
    return summary;
}

void add_missing(Json& summary, std::span<const MissingTerm> missing) {
    for (const MissingTerm& term : missing)
        summary["missing"].push_back(term.words);
}

void add_true_values(Json& summary, const TrueFigures& found_in, double factor) {
    for (const TrueFigure& figure : found_in.figures)
        if (auto found = summary["parameters"].find(figure.key);
            found != summary["parameters"].end())
            (*found)["true_value_95"] = {figure.interval.low * factor,
                                         figure.interval.high * factor};
}

Json summary_of(const Certificate& certificate) {
    Json summary = head_of(certificate.run.run_id,
                           certificate.run.plan.axis_kind == AxisKind::rotary ? "arcsec" : "um");
    summary["inputs"] = inputs_json(budget_inputs_of(certificate));
    add_missing(summary, certificate.uncertainty.missing);
    const auto& budget = certificate.uncertainty.budget;
    if (!budget) return summary;
    summary["k"] = budget->coverage;
    for (const Contribution& term : budget->contributions)
        summary["terms"].push_back({{"term", name_of(term.term)},
                                    {"u", term.u},
                                    {"formula", term.formula},
                                    {"status", term.status}});
    for (const ParameterUncertainty& figure : budget->parameters)
        summary["parameters"][figure.key] = {{"u", figure.u}, {"U", figure.expanded}};
    if (const auto& found = certificate.uncertainty.true_figures)
        add_true_values(summary, *found, budget_units_per(certificate.result.unit));
    return summary;
}

Json summary_of(const CircularCertificate& certificate) {
    constexpr double um_per_mm = 1e3;
    Json summary = head_of(certificate.measured.run.run_id, "um");
    summary["inputs"] = inputs_json(budget_inputs_of(certificate));
    add_missing(summary, certificate.missing);
    if (!certificate.budget) return summary;
    summary["k"] = certificate.budget->coverage;
    for (const CircularContribution& term : certificate.budget->contributions)
        summary["terms"].push_back({{"term", term.term},
                                    {"u", term.u_mm * um_per_mm},
                                    {"formula", term.formula},
                                    {"status", term.status}});
    for (const CircularFigureUncertainty& figure : certificate.budget->figures)
        if (certificate.uncertainty_of(figure.key) != nullptr)
            summary["parameters"][figure.key] = {{"u", figure.u_mm * um_per_mm},
                                                 {"U", figure.expanded_mm * um_per_mm}};
    return summary;
}

std::string shown(double value) {
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "%.4g", value);
    return text.data();
}

std::string origin_words(const std::string& origin, const Json& where) {
    const std::string place = where.is_null() ? "" : where.get<std::string>();
    if (origin == "typed") return "typed: " + place;
    if (origin == "certificate") return "from certificates: " + place;
    if (origin == "drift_test") return "from drift test " + place;
    if (origin == "readings") return "from this run: " + place;
    return "MISSING";
}

std::string input_text(const Json& input) {
    const auto text = [&](const char* key) { return input.at(key).get<std::string>(); };
    std::string line = text("term") + ": " + text("quantity");
    if (input.at("value").is_number())
        line += " " + shown(input.at("value").get<double>()) + " " + text("unit");
    line += ", " + origin_words(text("origin"), input.at("where"));
    if (input.at("seen").is_number())
        line += "; " + text("seen_in") + ": " + shown(input.at("seen").get<double>()) + " " +
                text("unit");
    if (input.at("exceeded").get<bool>()) line += ", MORE THAN THE BUDGET COUNTS";
    return wrapped(line, 2);
}

std::string term_text(const Json& term) {
    return "  " + padded(term.at("term").get<std::string>(), 22) +
           right(shown(term.at("u").get<double>()), 10) + "  " +
           term.at("formula").get<std::string>() + " (" + term.at("status").get<std::string>() +
           ")\n";
}

std::string parameters_text(const Json& summary) {
    std::string text;
    for (const auto& [key, figure] : summary.at("parameters").items()) {
        text += "  " + padded(key, 22) + right(shown(figure.at("u").get<double>()), 10) + "  ± " +
                shown(figure.at("U").get<double>());
        if (const auto lies_in = figure.find("true_value_95"); lies_in != figure.end())
            text += "   true value (95 %) from " + shown((*lies_in)[0].get<double>()) + " to " +
                    shown((*lies_in)[1].get<double>());
        text += "\n";
    }
    return text;
}

Result<Json> has_no_budget() {
    return fail(Fault::refused, "a drift or probing test has no uncertainty budget");
}

Result<Json> stands_in_certificate(TestKind kind) {
    return fail(Fault::refused, "the budget of a " + std::string{name_of(kind)} +
                                    " test stands in its certificate: 'axiscal export' writes it");
}

/// One for each kind that has a paper.
struct BudgetSummary {
    Result<Json> operator()(const Certificate& one) const { return summary_of(one); }
    Result<Json> operator()(const CircularCertificate& one) const { return summary_of(one); }
    Result<Json> operator()(const DriftResult& /*one*/) const { return has_no_budget(); }
    Result<Json> operator()(const ProbingResult& /*one*/) const { return has_no_budget(); }
    Result<Json> operator()(const StraightnessResult& /*one*/) const {
        return stands_in_certificate(TestKind::straightness);
    }
    Result<Json> operator()(const SquarenessResult& /*one*/) const {
        return stands_in_certificate(TestKind::squareness);
    }
};

} // namespace

Result<Json> budget_summary(const TestResult& result) {
    return std::visit(BudgetSummary{}, result);
}

std::string budget_text(const Json& summary) {
    const auto unit = summary.at("unit").get<std::string>();
    std::string text = wrapped("Budget of run " + summary.at("run").get<std::string>(), 0);
    text += "What it is made of:\n";
    for (const Json& input : summary.at("inputs"))
        text += input_text(input);
    for (const Json& words : summary.at("missing"))
        text += wrapped("MISSING: " + words.get<std::string>(), 2);
    if (summary.at("terms").empty()) return text;
    text += "Standard uncertainty u of each term, " + unit + ":\n";
    for (const Json& term : summary.at("terms"))
        text += term_text(term);
    if (summary.at("parameters").empty()) return text;
    text += "u and U (k = " + json_text(summary.at("k")) + ") of each figure, " + unit + ":\n";
    return text + parameters_text(summary);
}

} // namespace axiscal
