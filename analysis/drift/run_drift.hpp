#pragma once
// A recorded drift test: what the measuring system shows of an axis or a ballbar that rests. Pure.

#include "analysis/drift/drift.hpp"
#include "analysis/record/run_attachments.hpp"
#include "analysis/record/run_record.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// One channel against time: minutes since the test began, in `unit`.
struct ChannelDrift {
    std::string name, instrument, place, unit;
    ChannelKind kind = ChannelKind::temperature;
    Medium medium = Medium::none;
    double correction = 0;             ///< already in every value, in stored_unit_of(kind)
    DriftSeries series;                ///< of a length its change against the first reading, um
    DriftRange total, window;          ///< of a length `total` is its E_VE
    std::optional<double> slope_per_h; ///< least squares over the test; from two readings on
};

/// "laser/axis 1", as in the station file: the names of channels alone come from their drivers, and
/// two instruments of one kind share them. Pure.
std::string full_name_of(const ChannelDrift& channel);

/// Readings of the laser that the formulas refused for one and the same fault. The axis stood
/// somewhere meanwhile that no figure knows.
struct RefusedReadings {
    Fault fault = Fault::internal;
    std::string reason;                 ///< of the first: what was wrong with it
    int count = 0;                      ///< 1 or more
    double first_min = 0, last_min = 0; ///< minutes since the test began
};

/// Of a rotary axis every figure of the axis is in seconds of arc, of a linear one in um.
struct RunDrift {
    DriftSetup setup;
    bool of_bar = false;     ///< of the ballbar: `axis` is its reading, as it is, and so is `bare`
    double window_min = 60;  ///< the shift of interest, one hour (ISO 230-3)
    std::string unit = "um"; ///< of what follows, up to end_change: "um" | "arcsec"
    /// Change of the axis coordinate as a run would give it: in air, at 20 degC.
    DriftSeries axis;
    DriftSeries bare;   ///< change of the bare readings at the same times, towards plus as `axis`
    DriftRange eve;     ///< over the whole test: E_VE and u_EVE = E_VE / (2 sqrt 3)
    DriftRange window;  ///< largest within any window: ETVE
    DriftRange as_read; ///< E_VE of the bare readings, in vacuum wavelengths or by the scale
    std::optional<double> slope_per_h; ///< of the coordinate, least squares over the test
    double end_change = 0;             ///< last against first
    int missing = 0;                   ///< intervals without a good reading of the laser
    /// Readings of the laser that no fresh air or material, by a scale its temperature, belongs to.
    int without_air = 0;
    /// Left out for any other fault, in the order in which the faults came. While there is one the
    /// ranges may be too small: what was refused may have been the extremes.
    std::vector<RefusedReadings> refused;
    ChannelDrift reading; ///< the channel that measures the axis: every reading of it, as counted
    std::vector<ChannelDrift> channels; ///< all others; one that stayed silent has no reading
};

/// The reading of the laser is carried to 20 degC as every point of a run is
/// (thermal_compensation.hpp), as if the counter had been zeroed at the datum of the plan when the
/// test began: with D_0 the distance of the place of rest from the datum and n_0 the index then,
/// V* = n_0 D_0 + (V - V_0),   D = (V* - (n - n_0) L_d) / n / cos,   D_20 by material,
/// drift = sign (D_20 - D_20 of the first reading). So air and material act on the whole path, as
/// they do while the axis is measured there. By a linear scale with its strain s and that of the
/// begin s_0: D = (D_0 / (1 + s_0) + V - V_0) (1 + s).
/// Of a rotary axis with the indexing table at its position k nearest to the place of rest, the
/// rest beta_0 = place - datum - k step, and the arm S, V* = n_0 S sin(beta_0) + V - V_0 and
/// drift = asin(V* / (n S)) - beta_0 (rotary_position.hpp); nothing expands, and what the table
/// itself is wrong by stays where it is.
/// Air and material are the channels that bear that medium; every other one is told and acts on
/// nothing. The reading of a ballbar is taken as it is, as in a circular test: neither air nor the
/// bar's own expansion is taken out, for what the surroundings do to it is what is asked.
/// A reading without fresh surroundings is counted in `without_air`, one that the formulas
/// refuse for another reason (an angle beyond the range of the interferometer, air that cannot be)
/// in `refused`; no figure knows either.
/// @errors Fault::incomplete_run for a test that was not closed as complete, or with fewer than
/// two usable readings; Fault::refused for a rotary axis without an indexing table;
/// Fault::bad_run_file.
Result<RunDrift> evaluate_drift(const RunRecord& run, const DriftSetup& setup);

} // namespace axiscal
