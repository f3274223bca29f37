#pragma once
// What a positioning case says, read and checked; the evaluation is in positioning_case.cpp. Pure.

#include "analysis/positioning/positioning_accuracy.hpp"
#include "analysis/positioning/standards.hpp"
#include "tools/axiscal/cases/case_reader.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace axiscal {

struct CaseAxis {
    std::string name;
    AxisKind kind = AxisKind::linear;
    std::string unit;        ///< of the deviations and of every figure
    std::string target_unit; ///< of the targets
};

struct PositioningInput {
    CaseAxis axis;
    const PositioningStandard* standard = nullptr; ///< never null once read
    RunAt20C run;                                  ///< targets in target_unit, the rest in unit
    int expected = 0;                              ///< readings, those that are missing included
    std::vector<std::string> missing;              ///< `null`: "forward[2][1]"
    [[nodiscard]] RowLengths row_lengths() const {
        return missing.empty() ? RowLengths::equal : RowLengths::any;
    }
};

/// The key `standard`, one of positioning_standards(); the refusal shows the list.
Result<const PositioningStandard*> standard_of(const nlohmann::json& object);

/// `axis`, `unit` and the optional `target_unit` (linear mm, um, m; rotary deg, arcsec).
Result<CaseAxis> axis_of(const nlohmann::json& object);

/// A unit of `axis_of` in mm (linear) or degrees (rotary).
double base_units_in(const std::string& unit);

/// Every key that belongs to the test itself. Members that ask for more are read by their own
/// readers.
Result<PositioningInput> positioning_input_of(const nlohmann::json& object);

} // namespace axiscal
