#include "tools/axiscal/cases/case_reader.hpp"
#include "tools/axiscal/cases/cases.hpp"
#include "tools/axiscal/cases/plausibility.hpp"
#include "tools/axiscal/cases/target_rule_member.hpp"

#include <cmath>

namespace axiscal {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

Result<std::optional<double>>
scaled_or_none(const json& object, const std::string& key, double scale) {
    if (!object.contains(key)) return std::optional<double>{};
    AXISCAL_TRY(const double number, positive_at(object, key, key));
    return std::optional<double>{number * scale};
}

Result<int> approaches_of(const json& object) {
    AXISCAL_TRY(const double stated, number_or(object, "approaches", "approaches", 5));
    if (stated < 1 || stated > 100 || stated != std::floor(stated))
        return refuse(Fault::bad_case, "approaches", "must be a whole number between 1 and 100");
    return static_cast<int>(stated);
}

/// The same checks as of any table: finite, sane, none twice.
Result<std::vector<double>> targets_of_case(const json& object) {
    DeviationTable table;
    AXISCAL_TRY(table.targets, numbers_at(object, "targets", "targets"));
    table.forward.assign(table.targets.size(), {0.0});
    AXISCAL_TRY(const RunAt20C checked, declare_at_20C(std::move(table), "targets alone"));
    return checked.targets();
}

} // namespace

Result<TargetQuestion> target_question_of(const json& object,
                                          const CaseAxis& axis,
                                          const std::vector<double>& targets,
                                          int approaches) {
    TargetQuestion question;
    const double scale = base_units_in(axis.target_unit);
    question.kind = axis.kind;
    question.approaches = approaches;
    for (const double target : targets)
        question.targets.push_back(target * scale);
    AXISCAL_TRY(question.travel, scaled_or_none(object, "travel", scale));
    AXISCAL_TRY(question.interval, scaled_or_none(object, "interval", scale));
    return question;
}

ordered_json target_rule_json(const TargetQuestion& question, const TargetFinding& finding) {
    ordered_json member;
    member["kept"] = finding.kept();
    member["unit"] = question.kind == AxisKind::linear ? "mm" : "deg";
    member["travel"] = finding.travel;
    member["travel_from"] = question.travel ? "stated" : "targets";
    member["long_axis"] = finding.rule.long_axis;
    member["targets"] = question.targets.size();
    member["least_targets"] = finding.rule.least_targets;
    member["approaches"] = question.approaches;
    member["least_approaches"] = finding.rule.approaches;
    if (question.targets.size() > 1) member["mean_interval"] = finding.mean_interval;
    if (finding.rule.largest_mean_interval)
        member["largest_mean_interval"] = *finding.rule.largest_mean_interval;
    if (finding.grid) {
        member["interval"] = finding.grid->interval;
        member["interval_from"] = question.interval ? "stated" : "targets";
        member["random_share"] = finding.grid->random_share;
    }
    member["breaches"] = finding.breaches;
    member["remarks"] = finding.remarks;
    return member;
}

Result<ordered_json> target_rule_case(const json& object) {
    AXISCAL_CHECK(check_object(
        object, "", {"analysis", "axis", "unit", "targets", "travel", "interval", "approaches"}));
    AXISCAL_TRY(const CaseAxis axis, axis_of(object));
    AXISCAL_TRY(const auto targets, targets_of_case(object));
    AXISCAL_TRY(const int approaches, approaches_of(object));
    AXISCAL_TRY(const TargetQuestion question,
                target_question_of(object, axis, targets, approaches));
    AXISCAL_TRY(const TargetFinding finding, judge_targets(question));
    ordered_json document;
    document["format"] = "axiscal.result/1";
    document["analysis"] = "target_rule";
    document["clause"] = "ISO 230-2:2014, 4.3";
    document["target_rule"] = target_rule_json(question, finding);
    add_remarks(unit_remarks(targets, axis.unit, "unit"), document);
    return document;
}

} // namespace axiscal
