#pragma once
// The members of a circular case as values. Pure.

#include "analysis/circular/circular_certificate.hpp"

#include <nlohmann/json.hpp>
#include <optional>

namespace axiscal {

struct StatedCircularUncertainty {
    CircularUncertaintyStatement stated;
    int trials = 1000;
};

/// What the case says for paper alone: it changes no figure.
struct CircularReportWords {
    std::string id, date; ///< ISO date of the measurement
    Statements statements;
    std::vector<InstrumentRecord> instruments;
    CircularConditions conditions; ///< temperatures of bar and machine stand in the case itself
};

struct CircularInput {
    CircularTest test;
    RadialCentre f_centre = RadialCentre::automatic;
    std::optional<BarExpansion> bar;
    AxisNames axes{"X", "Y"};
    std::optional<StatedCircularUncertainty> uncertainty;
    std::optional<ToleranceRecord> tolerances; ///< in um
    CircularReportWords report;
};

/// @errors Fault::bad_case with the field as the user wrote it
Result<CircularInput> read_circular_case(const nlohmann::json& object);

/// The same for its certificate: what the case states, to be evaluated.
CircularMeasurement measurement_of(CircularInput input);

} // namespace axiscal
