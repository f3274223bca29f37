#pragma once
// `error_separation` with "workpiece":1, and the bare table of both measurements. Pure.

#include "analysis/quantity/result.hpp"

#include <nlohmann/json.hpp>
#include <string_view>

namespace axiscal {

Result<nlohmann::ordered_json> separation_features_case(const nlohmann::json& object);

/// The table alone, as workpiece 1 without a model: the three deviations of every feature.
Result<nlohmann::ordered_json> separation_table_case(std::string_view csv);

} // namespace axiscal
