#include "acquisition/documents/conformity_json.hpp"

#include "acquisition/documents/csv_text.hpp"

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(const std::optional<double>& number) {
    return number ? Json(*number) : Json{};
}

} // namespace

Json verdict_row(const JudgedFigure& figure, const Conformity& conformity) {
    Json row;
    row["parameter"] = figure.parameter;
    row["value"] = number_or_null(figure.value);
    row["U"] = number_or_null(figure.expanded_uncertainty);
    row["limit"] = number_or_null(figure.limit);
    row["rule"] = name_of(conformity.agreed.rule);
    row["verdict"] = figure.verdict;
    row["unit"] = conformity.unit;
    row["guard_band"] = number_or_null(figure.guard_band);
    row["travel_up_to"] = number_or_null(figure.travel_up_to);
    row["comparison"] = figure.comparison.empty() ? Json{} : Json(figure.comparison);
    row["reason"] = figure.reason.empty() ? Json{} : Json(figure.reason);
    return row;
}

void add_conformity(Json& document, const std::optional<Conformity>& conformity) {
    if (!conformity) return;
    const ToleranceRecord& agreed = conformity->agreed;
    document["verdict"] = conformity->verdict;
    Json rows = Json::array();
    for (const JudgedFigure& figure : conformity->figures)
        rows.push_back(verdict_row(figure, *conformity));
    document["verdicts"] = std::move(rows);
    document["tolerances"] = {{"name", agreed.name},
                              {"source", agreed.source},
                              {"rule", name_of(agreed.rule)},
                              {"unit", agreed.unit},
                              {"to_be_checked", agreed.to_be_checked}};
}

void append_conformity(std::string& csv, const std::optional<Conformity>& conformity) {
    if (!conformity) return;
    const ToleranceRecord& agreed = conformity->agreed;
    append_csv_line(csv, {"# tolerances", csv_field(agreed.name), csv_field(agreed.source),
                          "rule " + std::string{name_of(agreed.rule)},
                          agreed.to_be_checked ? "to be checked" : ""});
    append_csv_line(csv, {"# verdict", "all", std::string{conformity->verdict}});
    for (const JudgedFigure& figure : conformity->figures)
        append_csv_line(csv, {"# verdict", csv_field(figure.parameter), std::string{figure.verdict},
                              csv_number(figure.value), csv_number(figure.expanded_uncertainty),
                              csv_number(figure.limit), csv_number(figure.guard_band),
                              csv_field(conformity->unit), csv_field(figure.reason)});
}

} // namespace axiscal
