#pragma once
// `target_rule`: of a positioning case's answer, and as a case of its own. Pure.

#include "analysis/positioning/target_rule.hpp"
#include "tools/axiscal/cases/positioning_input.hpp"

#include <nlohmann/json.hpp>

namespace axiscal {

/// The optional keys `travel` and `interval` of a case, in target_unit; the answer is in mm or
/// degrees.
Result<TargetQuestion> target_question_of(const nlohmann::json& object,
                                          const CaseAxis& axis,
                                          const std::vector<double>& targets,
                                          int approaches);

nlohmann::ordered_json target_rule_json(const TargetQuestion& question,
                                        const TargetFinding& finding);

} // namespace axiscal
