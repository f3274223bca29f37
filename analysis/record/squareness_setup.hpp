#pragma once
// How the squareness of two linear axes is measured. Pure data.

#include "analysis/quantity/quantity.hpp"
#include "analysis/record/limit_quantity.hpp"
#include "analysis/record/recorded_line.hpp"
#include "analysis/record/straightness_setup.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace axiscal {

/// How the optical square stands: as at first, or turned so that its own error counts with the
/// other sign.
enum class SquarePosition : std::uint8_t { normal, turned };
std::string_view name_of(SquarePosition position); ///< "normal" | "turned"

/// The two lines that were measured with the square in the other position.
struct OtherSquare {
    RecordedLine first, second;
};

/// What is known of the square and of the mount; an empty field is not stated.
struct SquareStatement {
    /// Error of the square, its angle minus 90 degrees as it counts in SquarePosition::normal.
    std::optional<Angle> error;
    std::optional<Angle> error_U;     ///< expanded uncertainty of it, or:
    std::optional<Angle> error_limit; ///< +- limit of what is left of it
    double error_k = 2;               ///< coverage of error_U
    /// +- by which mirror and square may have turned against each other between the two lines.
    std::optional<Angle> mount_limit;
};

/// Of one run: the second of two axes, across the first, seen through an optical square by the same
/// prism and mirror that saw the first.
struct SquarenessSetup {
    StraightnessSetup optics; ///< of this run, by Wollaston; its `reversal` has no part in it
    RecordedLine first;       ///< of the other axis, in the direction of this one
    SquarePosition square = SquarePosition::normal;
    SquareStatement stated;
    std::optional<OtherSquare> other; ///< where the square's error is parted by reversal

    /// Of the station file.
    static constexpr std::string_view section = "squareness";
    static constexpr LimitQuantity judged_in = LimitQuantity::slope;
    static constexpr std::array<std::string_view, 3> judged{
        "squareness_end_points", "squareness_least_squares", "squareness_minimum_zone"};
};

} // namespace axiscal
