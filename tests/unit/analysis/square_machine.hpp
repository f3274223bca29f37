#pragma once
// A machine with two axes in a plane, looked at through an optical square: where its axes point is
// known, and each deviation comes from the places of the prism, by no formula of a squareness.

#include "analysis/record/recorded_line.hpp"
#include "analysis/record/squareness_setup.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace axiscal::testing {

struct SquareMachine {
    double squareness_rad = 0;   ///< angle between the + directions minus 90 degrees
    double square_error_rad = 0; ///< angle of the square minus 90 degrees, SquarePosition::normal
    double first_rad = 0;        ///< where the first axis points
    double mirror_rad = 0;       ///< where the line of the mirror points
};

/// Means of one approach, as seen from the line of the mirror; the first axis directly.
inline RecordedLine first_line(const SquareMachine& machine, const std::vector<double>& places_mm) {
    const double axis = machine.first_rad, line = machine.mirror_rad;
    RecordedLine seen{"first", "X", "Y", 1, {}, {}};
    for (const double place : places_mm) {
        const double x = place * std::cos(axis), y = place * std::sin(axis);
        seen.rows.push_back({mm(x * std::cos(line) + y * std::sin(line)),
                             mm(y * std::cos(line) - x * std::sin(line)),
                             {}});
    }
    return seen;
}

/// The second axis, across the first: the square turns the line of the mirror by its angle.
inline RecordedLine second_line(const SquareMachine& machine,
                                SquarePosition square,
                                const std::vector<double>& places_mm) {
    const double sign = square == SquarePosition::normal ? 1 : -1, right = std::numbers::pi / 2;
    const double axis = machine.first_rad + right + machine.squareness_rad;
    const double line = machine.mirror_rad + right + sign * machine.square_error_rad;
    RecordedLine seen{"second", "Y", "X", 1, {}, {}};
    for (const double place : places_mm) {
        const double x = place * std::cos(axis), y = place * std::sin(axis);
        seen.rows.push_back({mm(x * std::cos(line) + y * std::sin(line)),
                             mm(x * std::sin(line) - y * std::cos(line)), // + is towards +X
                             {}});
    }
    return seen;
}

inline std::vector<double> equal_steps(int count, double step_mm) {
    std::vector<double> places;
    for (int i = 0; i < count; ++i)
        places.push_back(i * step_mm);
    return places;
}

} // namespace axiscal::testing
