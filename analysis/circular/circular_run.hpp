#pragma once
// Everything that the run file of a circular test says, as plain values: it stands between the
// capture of circles and their certificate. Pure.

#include "analysis/circular/circle_diagnosis.hpp"
#include "analysis/circular/circular_parameters.hpp"
#include "analysis/circular/circular_uncertainty.hpp"
#include "analysis/run_record.hpp"

namespace axiscal {

enum class CircularPlane : std::uint8_t { xy, yz, zx };
std::string_view name_of(CircularPlane plane); ///< "XY" | "YZ" | "ZX"
AxisNames axes_of(CircularPlane plane);        ///< first and second axis: "Z" and "X" for ZX

/// How the begin of a circle was found in the stream.
enum class StartMethod : std::uint8_t {
    feed_step, ///< the radial step of feed-in and feed-out; the angle is the constant-feed share
    trigger    ///< the controller's word at the begin of the sense; the angle is feed times time
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
};

/// What was done to the readings before they were stored; all of it changes G.
struct CircularCapture {
    double sample_rate_hz = 0;         ///< nominal
    std::optional<double> low_pass_hz; ///< cut-off of a filter; absent: none
    int averaged = 1;                  ///< readings averaged into one; 1: none
};

/// Temperature while circles were driven; absent where nothing measures it.
struct CircularTemperature {
    std::optional<double> mean_degC;
    double low_degC = 0, high_degC = 0;
    std::string channel; ///< its name for people
};

/// The bar as its certificate states it.
struct CircularBar {
    InstrumentRecord instrument;
    double length_mm = 0; ///< calibrated at 20 degC, that the readings are relative to; 0: unknown
    std::optional<double> alpha_per_K;
    std::optional<double> calibration_U_um, calibration_k;
    int sign = 1; ///< +1: the reading rises with the radius
};

/// One circle of one sense, cut out of the stream.
struct CircleCapture {
    CircularTrace trace; ///< evaluated arc, about the set-up centre, as read, without overshoot
    int repeat = 1;      ///< 1-based
    bool warm_up = false;
    MonotonicTime begin, end; ///< of the evaluated arc
    StartMethod start = StartMethod::feed_step;
    /// Found time from feed-in to feed-out minus the programmed one, as path at the feed. Of
    /// `trigger`: time between the words minus the programmed one.
    double residual_mm = 0;
    double speed_residual = 0;           ///< the same as share of the programmed path
    std::uint64_t gaps = 0, missing = 0; ///< places where samples are missing, and how many
};

struct CircularRun {
    std::string run_id, software_version, station, config_hash;
    ClockTie opened, closed;
    bool complete = false;
    std::string closing_reason;
    CircularPlan plan;
    CircularCapture capture;
    CircularBar bar;
    Statements statements;
    std::vector<InstrumentRecord> instruments;
    std::vector<ChannelRecord> channels;
    CircularTemperature bar_temperature, machine_temperature, air_temperature;
    std::optional<double> machine_alpha_per_K;
    CircularUncertaintyStatement uncertainty;
    std::uint64_t gaps = 0, missing = 0; ///< of the whole stream
    std::uint64_t dropped_blocks = 0;    ///< lost because the disk did not keep up
    std::vector<CircleCapture> circles;  ///< in the order driven, warm-up included
    std::vector<EventRecord> events;
};

/// One trace of each sense: readings of all repeats averaged at the angles of the first, linearly
/// between neighbours. Where a repeat has no readings within 0.5 deg to both sides the angle is
/// left out. Warm-up circles do not count.
/// @errors Fault::incomplete_run when a planned sense has fewer circles than planned repeats.
Result<CircularTest> mean_test(const CircularRun& run);

/// Repeat `repeat` (1-based) of each sense alone: what the repeatability is taken from.
/// @errors Fault::incomplete_run
Result<CircularTest> test_of_repeat(const CircularRun& run, int repeat);

/// What F and D at 20 degC need; absent unless both temperatures, both expansions and the bar's
/// length are known.
std::optional<BarExpansion> expansion_of(const CircularRun& run);

/// The trace about the centre (a, b) instead of the set-up's: radius there - nominal radius, at the
/// same angles. For drawing.
CircularTrace
centred(const CircularTrace& trace, double nominal_radius_mm, double a_mm, double b_mm);

} // namespace axiscal
