#pragma once
// How the straightness of a linear axis is measured. Pure data.

#include "analysis/quantity/quantity.hpp"
#include "analysis/record/limit_quantity.hpp"
#include "analysis/record/recorded_line.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace axiscal {

enum class StraightnessMethod : std::uint8_t {
    wollaston,  ///< a Wollaston prism before a bisecting mirror: displacement across the axis
    angle_steps ///< a level or a mirror before an autocollimator, on a foot that steps by its base
};
std::string_view name_of(StraightnessMethod method); ///< "wollaston" | "angle-steps"

/// How the bisecting mirror stands in its mount: as at first, or turned by 180 degrees about the
/// beam.
enum class MirrorPosition : std::uint8_t { normal, reversed };
std::string_view name_of(MirrorPosition position); ///< "normal" | "reversed"

/// What is known of the measurement for its uncertainty; an empty field is not stated. Ratios are
/// relative to the figure that they multiply.
struct StraightnessStatement {
    std::optional<Ratio> factor_U;     ///< Wollaston: expanded uncertainty of the factor, or:
    std::optional<Ratio> factor_limit; ///< +- limit of its error
    double factor_k = 2;               ///< coverage of factor_U
    /// Wollaston: +- limit of what the mirror adds over a length M, times M^2, in um for M in m.
    std::optional<double> mirror_limit_um_per_m2;
    std::optional<Angle> angle_U; ///< angle steps: expanded uncertainty of one angle
    double angle_k = 2;
    std::optional<Length> base_U; ///< angle steps: expanded uncertainty of the base
    double base_k = 2;
    /// E_VE, largest minus smallest reading of a drift test with this set-up: a deviation, or an
    /// angle.
    std::optional<Length> eve;
    std::optional<Angle> eve_angle;
};

/// Of one run: one axis, one direction across it, one position of the mirror. The reading rises
/// with the deviation when `sign` is 1; a deviation is positive towards the + direction of
/// `across`.
struct StraightnessSetup {
    StraightnessMethod method = StraightnessMethod::wollaston;
    std::string across; ///< axis letter of the measured direction: "Y"
    int sign = 1;
    double factor = 36; ///< Wollaston: deviation for a displacement of 1 that the laser shows
    Length resolution;  ///< Wollaston: least step of the laser's own displacement
    MirrorPosition mirror = MirrorPosition::normal;
    std::string reversal_of; ///< id of the run with the mirror in the other position; or empty
    /// What that run gave, by which the form of the mirror is parted from the motion.
    std::optional<RecordedLine> reversal;
    Length base;            ///< angle steps: length of the foot, which is the step
    Angle angle_resolution; ///< angle steps: least step of the angle
    std::string place;      ///< where the optics stood, and which part moved; printed
    StraightnessStatement uncertainty;

    /// Of the station file.
    static constexpr std::string_view section = "straightness";
    static constexpr LimitQuantity judged_in = LimitQuantity::length;
    /// Named apart from R, B and B_mean of a positioning: a limit of one must not judge the other.
    static constexpr std::array<std::string_view, 12> judged{"straightness_end_points",
                                                             "straightness_end_points_forward",
                                                             "straightness_end_points_backward",
                                                             "straightness_least_squares",
                                                             "straightness_least_squares_forward",
                                                             "straightness_least_squares_backward",
                                                             "straightness_minimum_zone",
                                                             "straightness_minimum_zone_forward",
                                                             "straightness_minimum_zone_backward",
                                                             "straightness_B",
                                                             "straightness_B_mean",
                                                             "straightness_R"};
};

} // namespace axiscal
