#include "acquisition/console/certificate_facts.hpp"

#include "analysis/quantity/valid_text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace axiscal {
namespace {

using Document = nlohmann::ordered_json;

constexpr std::size_t longest_fact = 300, most_figures = 40;

/// A certificate of circles holds long lists: what is not needed is dropped while it is read.
class NeededMembers {
public:
    bool operator()(int depth, Document::parse_event_t event, const Document& key) {
        if (event != Document::parse_event_t::key || !key.is_string()) return true;
        const auto& name = key.get_ref<const std::string&>();
        if (depth == 1) top_ = name;
        if (depth == 1) return is_one_of(name, whole);
        if (depth == 2 && top_ == "run") return is_one_of(name, of_run);
        if (depth == 3 && top_ == "parameters")
            return name == "value" || name == "expanded_uncertainty";
        return true;
    }

private:
    static constexpr std::array<std::string_view, 8> whole{
        "standard",   "unit",       "verdict",      "verdicts",
        "tolerances", "parameters", "completeness", "certificate"};
    static constexpr std::array<std::string_view, 4> of_run{"id", "started", "result_digest",
                                                            "set_aside"};
    template <std::size_t Count>
    static bool is_one_of(std::string_view name, const std::array<std::string_view, Count>& names) {
        return name == "run" || std::ranges::find(names, name) != names.end();
    }
    std::string top_;
};

const Document& member(const Document& object, const char* key) {
    static const Document none;
    if (!object.is_object()) return none;
    const auto found = object.find(key);
    return found == object.end() ? none : *found;
}

std::string fact_text(const Document& object, const char* key) {
    const Document& value = member(object, key);
    if (!value.is_string()) return {};
    return valid_text(
        std::string_view{value.get_ref<const std::string&>()}.substr(0, longest_fact));
}

std::optional<double> fact_number(const Document& object, const char* key) {
    const Document& value = member(object, key);
    if (!value.is_number()) return std::nullopt;
    const auto number = value.get<double>();
    return std::isfinite(number) ? std::optional{number} : std::nullopt;
}

void take_judged(CertificateFacts& facts, const Document& document) {
    const Document& rows = member(document, "verdicts");
    if (!rows.is_array()) return;
    for (const Document& row : rows) {
        if (facts.figures.size() >= most_figures) return;
        CertifiedFigure figure;
        figure.parameter = fact_text(row, "parameter");
        figure.value = fact_number(row, "value");
        figure.expanded_uncertainty = fact_number(row, "U");
        figure.limit = fact_number(row, "limit");
        figure.verdict = fact_text(row, "verdict");
        figure.reason = fact_text(row, "reason");
        facts.figures.push_back(std::move(figure));
    }
}

/// Those that no limit names.
void take_others(CertificateFacts& facts, const Document& document) {
    const Document& parameters = member(document, "parameters");
    if (!parameters.is_object()) return;
    const std::size_t judged = facts.figures.size();
    for (const auto& [key, parameter] : parameters.items()) {
        if (facts.figures.size() >= most_figures) return;
        const auto value = fact_number(parameter, "value");
        const auto end = facts.figures.begin() + static_cast<std::ptrdiff_t>(judged);
        const std::string name = valid_text(std::string_view{key}.substr(0, longest_fact));
        const bool told = std::any_of(facts.figures.begin(), end,
                                      [&](const auto& one) { return one.parameter == name; });
        if (told || !value) continue;
        const Document& expanded = member(parameter, "expanded_uncertainty");
        facts.figures.push_back({name, value, fact_number(expanded, "value"), {}, {}, {}});
    }
}

std::size_t left_out_in(const Document& run) {
    const Document& rows = member(run, "set_aside");
    if (!rows.is_array()) return 0;
    return static_cast<std::size_t>(std::ranges::count_if(
        rows, [](const Document& row) { return fact_text(row, "why") == "excluded"; }));
}

} // namespace

Result<CertificateFacts> facts_of_certificate(std::string_view text) {
    const Document document = Document::parse(text, NeededMembers{}, false);
    if (!document.is_object()) return fail(Fault::bad_case, "it is no JSON object");
    const Document& run = member(document, "run");
    CertificateFacts facts;
    facts.run_id = fact_text(run, "id");
    if (facts.run_id.empty()) return fail(Fault::bad_case, "it names no run");
    facts.started_utc = fact_text(run, "started");
    facts.result_digest = fact_text(run, "result_digest");
    facts.left_out = left_out_in(run);
    facts.number = fact_text(member(document, "certificate"), "number");
    facts.standard = fact_text(document, "standard");
    facts.unit = fact_text(document, "unit");
    facts.partial = fact_text(member(document, "completeness"), "status") == "partial";
    take_judged(facts, document);
    take_others(facts, document);
    if (facts.partial) return facts;
    facts.verdict = fact_text(document, "verdict");
    facts.limits = fact_text(member(document, "tolerances"), "name");
    facts.rule = fact_text(member(document, "tolerances"), "rule");
    return facts;
}

} // namespace axiscal
