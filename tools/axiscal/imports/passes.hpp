#pragma once
// Readings one after the other as passes along the axis. Pure.

#include "analysis/quantity/result.hpp"
#include "tools/axiscal/imports/laser_readings.hpp"

#include <optional>
#include <span>
#include <string>

namespace axiscal {

struct Captured {
    double target = 0, reading = 0;
    std::string pass;  ///< its name, as the file says; empty: the order of the targets tells
    std::string group; ///< where the order tells: no pass goes on into another group
    std::optional<bool> says_forward;
    std::size_t line = 0;
};

/// Targets by their first appearance, then sorted; a pass for each name, in the order of their
/// first readings. Without names a pass ends where the targets turn, or where one comes again.
/// @errors Fault::bad_case, "line N": a target twice in a named pass.
Result<void> add_passes(std::span<const Captured> captured, LaserReadings& out);

} // namespace axiscal
