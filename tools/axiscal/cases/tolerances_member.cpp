#include "tools/axiscal/cases/tolerances_member.hpp"

#include <algorithm>

namespace axiscal {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// From one unit to another; the quotient of powers of ten is taken so that 22 um are 0.022 mm.
double converted(double value, const std::string& from, const std::string& to) {
    const double ratio = base_units_in(from) / base_units_in(to);
    return ratio >= 1 ? value * ratio : value / (base_units_in(to) / base_units_in(from));
}

struct LimitReader {
    const JudgedFigures& figures;
    const char* unknown;  ///< of a name that is none of them
    std::string band_key; ///< empty: the figures have no bands
    std::string from, to; ///< units
};

Result<ToleranceLimit>
limit_of(const json& object, const std::string& field, const LimitReader& reader) {
    const std::string& band_key = reader.band_key;
    Words keys{"parameter", "limit"};
    if (!band_key.empty()) keys.push_back(band_key);
    AXISCAL_CHECK(check_object(object, field, keys));
    ToleranceLimit limit;
    AXISCAL_TRY(limit.parameter, text_of(object, "parameter", field + ".parameter"));
    const auto known = reader.figures.names;
    if (std::ranges::find(known, limit.parameter) == known.end())
        return refuse(Fault::bad_case, field + ".parameter", reader.unknown);
    AXISCAL_TRY(const double stated, positive_at(object, "limit", field + ".limit"));
    limit.limit = converted(stated, reader.from, reader.to);
    if (!band_key.empty() && object.contains(band_key)) {
        AXISCAL_TRY(limit.travel_up_to, positive_at(object, band_key, field + "." + band_key));
    }
    return limit;
}

Result<std::vector<ToleranceLimit>> limits_of(const json& member, const LimitReader& reader) {
    const std::string field = "tolerances.limits";
    AXISCAL_TRY(const json* list, axiscal::member(member, "limits", field));
    if (!list->is_array() || list->empty())
        return refuse(Fault::bad_case, field, "must be an array of one limit or more");
    std::vector<ToleranceLimit> limits;
    for (std::size_t i = 0; i < list->size(); ++i) {
        AXISCAL_TRY(ToleranceLimit limit, limit_of((*list)[i], indexed(field, i), reader));
        for (const ToleranceLimit& other : limits)
            if (other.parameter == limit.parameter && other.travel_up_to == limit.travel_up_to)
                return refuse(Fault::bad_case, indexed(field, i),
                              "repeats parameter and band of another limit");
        limits.push_back(std::move(limit));
    }
    return limits;
}

Result<DecisionRule> rule_of(const json& member) {
    Words names;
    for (const DecisionRule rule : stated_rules)
        names.emplace_back(name_of(rule));
    AXISCAL_TRY(const std::string stated, one_of(member, "rule", "tolerances.rule", names));
    return *std::ranges::find_if(stated_rules,
                                 [&](DecisionRule rule) { return name_of(rule) == stated; });
}

ordered_json verdict_json(const JudgedFigure& judged, const char* band_key) {
    ordered_json verdict;
    verdict["verdict"] = judged.verdict;
    if (!judged.comparison.empty()) verdict["comparison"] = judged.comparison;
    if (!judged.reason.empty()) verdict["reason"] = judged.reason;
    if (judged.value) verdict["value"] = *judged.value;
    if (judged.expanded_uncertainty) verdict["expanded_uncertainty"] = *judged.expanded_uncertainty;
    if (judged.limit) verdict["limit"] = *judged.limit;
    if (judged.guard_band) verdict["guard_band"] = *judged.guard_band;
    if (judged.travel_up_to) verdict[band_key] = *judged.travel_up_to;
    return verdict;
}

std::vector<FigureToJudge> figures_of(const ordered_json& parameters) {
    std::vector<FigureToJudge> figures;
    for (const auto& [key, parameter] : parameters.items()) {
        FigureToJudge figure{key, parameter.at("value").get<double>(), {}};
        if (parameter.contains("expanded_uncertainty"))
            figure.expanded_uncertainty =
                parameter.at("expanded_uncertainty").at("value").get<double>();
        figures.push_back(std::move(figure));
    }
    return figures;
}

} // namespace

namespace {

Result<ToleranceRecord> record_of(const json& member, const Words& units, LimitReader reader) {
    AXISCAL_CHECK(check_object(member, "tolerances", {"unit", "limits", "to_be_checked", "rule"}));
    ToleranceRecord set;
    AXISCAL_TRY(set.name, text_of(member, "name", "tolerances.name"));
    AXISCAL_TRY(set.source, text_of(member, "source", "tolerances.source"));
    AXISCAL_TRY(reader.from, one_of(member, "unit", "tolerances.unit", units));
    if (member.contains("to_be_checked")) {
        if (!member.at("to_be_checked").is_boolean())
            return refuse(Fault::bad_case, "tolerances.to_be_checked", "must be true or false");
        set.to_be_checked = member.at("to_be_checked").get<bool>();
    }
    if (member.contains("rule")) {
        AXISCAL_TRY(set.rule, rule_of(member));
    }
    set.unit = reader.to;
    AXISCAL_TRY(set.limits, limits_of(member, reader));
    return set;
}

} // namespace

Result<ToleranceSet> tolerance_set_of(const json& member, const CaseAxis& axis) {
    const bool linear = axis.kind == AxisKind::linear;
    const char* const band_key = linear ? "travel_up_to_mm" : "travel_up_to_deg";
    const Words units = linear ? Words{"mm", "um", "m"} : Words{"deg", "arcsec"};
    AXISCAL_TRY(ToleranceRecord record,
                record_of(member, units,
                          {judged_figures(TestKind::positioning),
                           "is no parameter of any standard; see docs/analysis/positioning.md",
                           band_key, "", axis.unit}));
    return ToleranceSet{std::move(record), axis.kind};
}

Result<ToleranceRecord> circular_tolerances_of(const json& member) {
    return record_of(member, {"mm", "um", "m"},
                     {judged_figures(TestKind::circular),
                      "is no figure of a circular test; see docs/analysis/circular.md", "", "",
                      "um"});
}

void add_verdicts(const ToleranceSet& set, double travel, ordered_json& document) {
    document["tolerances"]["name"] = set.name;
    document["tolerances"]["source"] = set.source;
    document["tolerances"]["rule"] = name_of(set.rule);
    document["tolerances"]["to_be_checked"] = set.to_be_checked;
    const char* band_key = set.kind == AxisKind::linear ? "travel_up_to_mm" : "travel_up_to_deg";
    ordered_json& verdicts = document["verdicts"] = ordered_json::object();
    for (const JudgedFigure& judged :
         judge_figures(set.limits, figures_of(document.at("parameters")), travel, set.rule))
        verdicts[judged.parameter] = verdict_json(judged, band_key);
}

void add_verdicts(ToleranceRecord circular, ordered_json& document) {
    for (ToleranceLimit& limit : circular.limits)
        limit.limit /= 1000;
    circular.unit = "mm";
    add_verdicts(ToleranceSet{std::move(circular), AxisKind::linear}, 0, document);
}

} // namespace axiscal
