#include "acquisition/documents/positioning/result_json.hpp"
#include "analysis/positioning/positioning_accuracy.hpp"
#include "analysis/positioning/styles.hpp"
#include "tools/axiscal/cases/case_reader.hpp"
#include "tools/axiscal/cases/cases.hpp"
#include "tools/axiscal/cases/plausibility.hpp"
#include "tools/axiscal/cases/positioning_input.hpp"
#include "tools/axiscal/cases/positioning_words.hpp"
#include "tools/axiscal/cases/reference_angles_member.hpp"
#include "tools/axiscal/cases/target_rule_member.hpp"
#include "tools/axiscal/cases/tolerances_member.hpp"
#include "tools/axiscal/cases/uncertainty_member.hpp"

#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

const Words& known_keys() {
    static const Words known{"analysis",    "standard",     "axis",        "unit",
                             "target_unit", "readings",     "targets",     "forward",
                             "backward",    "compensation", "polygon",     "indexing_table",
                             "travel",      "interval",     "uncertainty", "tolerances"};
    return known;
}

/// As on the certificate of a run that was not finished.
void add_completeness(const PositioningInput& input, ordered_json& document) {
    if (input.missing.empty()) return;
    ordered_json& known = document["completeness"];
    known["status"] = "partial";
    known["expected"] = input.expected;
    known["used"] = input.expected - static_cast<int>(input.missing.size());
    known["left_out"] = input.missing;
}

void add_artefact(const json& object, ordered_json& document) {
    const std::string key = artefact_key(object);
    if (key.empty()) return;
    document["artefact"]["kind"] = key;
    document["artefact"]["certificate_sense"] = object.at(key).at("certificate_sense");
    document["artefact"]["reading_sense"] = object.at(key).value("reading_sense", "with_axis");
}

/// The rule is of ISO 230-2 alone; `travel` and `interval` are checked for every standard.
Result<TargetFinding>
add_target_rule(const json& object, const PositioningInput& input, ordered_json& document) {
    AXISCAL_TRY(
        const TargetQuestion question,
        target_question_of(object, input.axis, input.run.targets(), fewest_readings(input.run)));
    AXISCAL_TRY(TargetFinding finding, judge_targets(question));
    if (input.standard->is_iso()) document["target_rule"] = target_rule_json(question, finding);
    return finding;
}

/// The run with its targets in the unit of the deviations, as a budget reads its length from them.
Result<RunAt20C> in_one_unit(const PositioningInput& input) {
    DeviationTable table{input.run.targets(), input.run.forward(), input.run.backward(),
                         input.run.unit()};
    const double scale = base_units_in(input.axis.target_unit) / base_units_in(input.axis.unit);
    for (double& target : table.targets)
        target *= scale;
    return declare_at_20C(std::move(table), "targets in the unit of the deviations",
                          input.row_lengths());
}

Result<void> add_budget(const json& object,
                        const PositioningInput& input,
                        const PositioningResult& result,
                        ordered_json& document) {
    if (!object.contains("uncertainty")) return {};
    if (!input.standard->is_iso())
        return refuse(Fault::bad_case, "uncertainty",
                      "is known for the figures of ISO 230-2 alone, not for this standard");
    AXISCAL_TRY(auto asked, uncertainty_member(object.at("uncertainty"), input.axis.kind));
    AXISCAL_TRY(const RunAt20C run, in_one_unit(input));
    return add_uncertainty(document, std::move(asked), run, result);
}

/// Last of all: the verdicts read parameters and uncertainties from the document.
Result<void> add_limits(const json& object,
                        const PositioningInput& input,
                        double travel,
                        ordered_json& document) {
    if (!object.contains("tolerances")) return {};
    if (!input.missing.empty()) { // a partial result has no verdict
        add_remarks({"no verdict on the tolerances: readings are missing"}, document);
        return {};
    }
    AXISCAL_TRY(const ToleranceSet set, tolerance_set_of(object.at("tolerances"), input.axis));
    add_verdicts(set, travel, document);
    return {};
}

} // namespace

Result<ordered_json> positioning_case(const json& object) {
    AXISCAL_CHECK(check_object(object, "", known_keys()));
    AXISCAL_TRY(const PositioningInput input, positioning_input_of(object));
    const PositioningStandard& standard = *input.standard;
    const auto result = evaluate_positioning(input.run, std::string{standard.name},
                                             standard.is_iso() ? standard.cover_factor : 2);
    ordered_json document = standard.is_iso()
                                ? result_to_json(result)
                                : style_to_json(evaluate_style(standard.figures, input.run), input);
    add_completeness(input, document);
    AXISCAL_CHECK(add_budget(object, input, result, document));
    add_words(input, result.positions, document);
    add_artefact(object, document);
    AXISCAL_TRY(const TargetFinding finding, add_target_rule(object, input, document));
    AXISCAL_CHECK(add_limits(object, input, finding.travel, document));
    add_remarks(positioning_remarks(object, input), document);
    return document;
}

} // namespace axiscal
