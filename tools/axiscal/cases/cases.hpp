#pragma once
// Every analysis that a case can ask for: one function in a file of its own, one line here and one
// in the table of analyze_case.cpp. Pure: a JSON object in, the document "axiscal.result/1" out.

#include "analysis/quantity/result.hpp"

#include <nlohmann/json.hpp>

namespace axiscal {

Result<nlohmann::ordered_json> positioning_case(const nlohmann::json& object);
Result<nlohmann::ordered_json> air_index_case(const nlohmann::json& object);
Result<nlohmann::ordered_json> expansion_case(const nlohmann::json& object);
Result<nlohmann::ordered_json> drift_case(const nlohmann::json& object);
Result<nlohmann::ordered_json> straightness_case(const nlohmann::json& object);
Result<nlohmann::ordered_json> squareness_case(const nlohmann::json& object);
Result<nlohmann::ordered_json> angular_case(const nlohmann::json& object);
Result<nlohmann::ordered_json> diagonals_case(const nlohmann::json& object);
Result<nlohmann::ordered_json> target_rule_case(const nlohmann::json& object);
Result<nlohmann::ordered_json> periodic_error_case(const nlohmann::json& object);
Result<nlohmann::ordered_json> separation_case(const nlohmann::json& object);
Result<nlohmann::ordered_json> probing_delay_case(const nlohmann::json& object);
Result<nlohmann::ordered_json> chebyshev_fit_case(const nlohmann::json& object);
Result<nlohmann::ordered_json> circular_case(const nlohmann::json& object);
Result<nlohmann::ordered_json> circle_fit_case(const nlohmann::json& object);

} // namespace axiscal
