#pragma once
// Everything that the run file of a circular test says, as plain values: it stands between the
// capture of circles and their certificate. Pure.

#include "analysis/circular/circle_diagnosis.hpp"
#include "analysis/circular/circular_parameters.hpp"
#include "analysis/record/circular_setup.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/tolerance_record.hpp"
#include "analysis/record/run_revisions.hpp"
#include "analysis/record/synchronisation.hpp"

namespace axiscal {

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
    /// Where |dr/dt| * u(t) is largest on the evaluated arc, by steps of 1 ms at least (noise
    /// included); empty unless each sample there has its u(t).
    std::optional<Synchronisation> synchronisation;
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
    std::vector<ChannelCalibration> calibrations; ///< at most one a channel
    CircularTemperature bar_temperature, machine_temperature, air_temperature;
    std::optional<double> machine_alpha_per_K;
    CircularUncertaintyStatement uncertainty;
    std::optional<ToleranceRecord> tolerances; ///< in um
    std::string eve_source; ///< drift test that its E_VE is of; empty: somebody stated it
    std::uint64_t gaps = 0, missing = 0; ///< of the whole stream
    std::uint64_t dropped_blocks = 0;    ///< lost because the disk did not keep up
    std::vector<CircleCapture> circles;  ///< in the order driven, warm-up included
    std::vector<EventRecord> events;
    std::vector<PreflightRecord> preflight; ///< what was checked before it
    std::vector<OrderRecord> orders;        ///< who armed it, overrode a check, aborted it
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
