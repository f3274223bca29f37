#pragma once
// Reads a measured line out of a case: readings at targets, or angles to be integrated. Pure.

#include "analysis/geometry/straightness.hpp"
#include "analysis/positioning/positioning_accuracy.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace axiscal {

/// Size of a unit in its SI unit; the word was checked by one_of.
double length_unit_m(std::string_view unit);  ///< "um", "mm", "m"
double angle_unit_rad(std::string_view unit); ///< "rad", "urad", "um/m", "arcsec", "deg"

/// Keys that read_line understands in its object.
extern const std::vector<std::string> line_keys;

struct LineCase {
    MeasuredLine line; ///< positions and deviations in the case's deviation unit
    std::optional<PositioningResult> repetition; ///< of readings by rows: means and spread
};

/// "targets" with "deviations" or "forward" (and "backward") rows: the mean of both directions
/// counts. Or "angles" (or rows) in "angle_unit" with "base" and "start". `prefix` is "" or
/// "first."; target_to_unit turns a target into the unit of the deviations.
Result<LineCase>
read_line(const nlohmann::json& object, const std::string& prefix, double target_to_unit);

/// A table of readings: "forward" and maybe "backward" rows at the targets, or one row `single`.
Result<DeviationTable> read_table(const nlohmann::json& object,
                                  const std::string& prefix,
                                  const std::string& single,
                                  std::vector<double> targets);

/// The same error under `prefix`, for objects that stand inside a case.
tl::unexpected<Error> under(const std::string& prefix, Error error);

} // namespace axiscal
