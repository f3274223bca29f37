#pragma once
// What is known of a circular test before the first circle: what is driven, how it is captured, the
// bar, and what is stated for the uncertainty. Pure data.

#include "analysis/record/limit_quantity.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// Contouring sense: counter-clockwise turns the first + axis to the second + axis.
enum class Sense : std::uint8_t { ccw, cw };
std::string_view name_of(Sense sense); ///< "ccw" | "cw"
inline double sign_of(Sense sense) {
    return sense == Sense::ccw ? 1 : -1;
}

enum class CircularPlane : std::uint8_t { xy, yz, zx };
std::string_view name_of(CircularPlane plane); ///< "XY" | "YZ" | "ZX"
/// "Z" and "X" for ZX.
std::array<std::string, 2> axes_of(CircularPlane plane);

/// How begin and end of a circle are found in the stream. The angle is the programmed feed times
/// the time from the middle between them.
enum class StartMethod : std::uint8_t {
    feed_step, ///< the radial steps of feed-in and feed-out
    trigger    ///< the controller's words at the begin and at the end of the arc
};
std::string_view name_of(StartMethod method); ///< "feed_step" | "trigger"

/// What is driven. Angles as in CircularTrace: 0 on the first + axis, counter-clockwise positive.
struct CircularPlan {
    CircularPlane plane = CircularPlane::xy;
    double nominal_radius_mm = 0, feed_mm_per_s = 0;
    std::vector<Sense> senses{Sense::ccw, Sense::cw}; ///< in the order driven
    int repeats = 1;                                  ///< of each sense, evaluated
    int warm_up = 0;      ///< circles of each sense driven before them and not evaluated
    double start_deg = 0; ///< where the evaluated arc begins counter-clockwise
    double arc_deg = 360; ///< evaluated; clockwise it is driven from start + arc back to start
    double overshoot_deg = 180;           ///< driven before and after the evaluated arc
    double feed_in_mm = 1.5;              ///< radial way from rest onto the circle
    bool feed_in_outside = true;          ///< rest lies outside the circle
    std::array<double, 3> centre_mm{};    ///< X, Y, Z in machine coordinates
    std::string tool_offset, work_offset; ///< "offset to tool and workpiece reference"
    StartMethod start = StartMethod::feed_step;
    double trigger_delay_s = 0; ///< of `trigger`: how late the words reach the station, mean
};

/// Requests that the controller makes for each circle: one before it; of `trigger` also one at the
/// begin and one at the end of its arc. One more ends the test.
inline int requests_a_circle(const CircularPlan& plan) {
    return plan.start == StartMethod::trigger ? 3 : 1;
}

/// What was done to the readings before they were stored; all of it changes G.
struct CircularCapture {
    double sample_rate_hz = 0;         ///< nominal
    std::optional<double> low_pass_hz; ///< cut-off of a filter; absent: none
    int averaged = 1;                  ///< readings averaged into one; 1: none
};

/// What is known of the measurement; what is absent contributes nothing and is named in
/// `CircularBudget::not_stated`. Every `width` is the FULL width of a rectangular distribution,
/// u = width / (2 sqrt 3).
struct CircularUncertaintyStatement {
    /// Of the transducer over the range of one test, without zero error and scale: what G sees.
    std::optional<double> device_width_um;
    std::optional<double> calibration_U_um, calibration_k; ///< of the bar's length
    std::optional<double> repeatability_um; ///< standard deviation of one figure in repeated tests
    std::optional<double> eve_um;           ///< E_VE: range of the drift test
    std::optional<double> centre_width_um;  ///< of the set-up centre, in each coordinate
    std::optional<double> machine_temperature_width_K, bar_temperature_width_K;
    std::optional<double> machine_alpha_width_per_K, bar_alpha_width_per_K;
    int runs = 1; ///< n: tests whose mean the readings are
};

/// The bar as its certificate states it, and the machine that it is compared with.
struct CircularSetup {
    CircularPlan plan;
    CircularCapture capture;
    std::string bar_instrument; ///< name in the station file
    int bar_sign = 1;           ///< +1: the reading rises with the radius
    double bar_length_mm = 0; ///< calibrated at 20 degC, that readings are relative to; 0: unknown
    std::optional<double> bar_alpha_per_K, machine_alpha_per_K;
    std::optional<int> bar_temperature_channel; ///< ChannelRecord::id
    CircularUncertaintyStatement uncertainty;

    static constexpr LimitQuantity judged_in = LimitQuantity::length;
    static constexpr std::array<std::string_view, 8> judged{
        "G_ccw", "G_cw", "G_b", "F_max_ccw", "F_max_cw", "F_min_ccw", "F_min_cw", "D"};
};

/// One circle of the program.
struct PlannedCircle {
    int number = 1; ///< 1-based, in the order driven; the CNC's sequence number
    Sense sense = Sense::ccw;
    int repeat = 1; ///< 1-based among the warm-up circles or among the evaluated ones
    bool warm_up = false;
};
/// Warm-up first; of each repeat every sense in order.
std::vector<PlannedCircle> planned_circles(const CircularPlan& plan);

/// Angle driven on the circle, overshoot included.
inline double driven_deg(const CircularPlan& plan) {
    return plan.arc_deg + 2 * plan.overshoot_deg;
}
/// Where the circle of this sense is entered and left.
double entry_deg(const CircularPlan& plan, Sense sense);
double exit_deg(const CircularPlan& plan, Sense sense);

} // namespace axiscal
