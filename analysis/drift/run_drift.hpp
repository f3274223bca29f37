#pragma once
// A recorded drift test: what the measuring system shows of an axis that rests. Pure.

#include "analysis/drift/drift.hpp"
#include "analysis/run_attachments.hpp"
#include "analysis/run_record.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// One channel against time: minutes since the test began, in `unit`.
struct ChannelDrift {
    std::string name, place, unit;
    ChannelKind kind = ChannelKind::temperature;
    Medium medium = Medium::none;
    double correction = 0; ///< already in every value, in stored_unit_of(kind)
    DriftSeries series;
    DriftRange total, window;
};

struct RunDrift {
    DriftSetup setup;
    double window_min = 60; ///< the shift of interest, one hour (ISO 230-3)
    /// Change of the axis coordinate as a run would give it, um: in air, at 20 degC.
    DriftSeries axis;
    DriftRange eve;        ///< over the whole test: E_VE and u_EVE = E_VE / (2 sqrt 3)
    DriftRange window;     ///< largest within any window: ETVE
    DriftRange as_read;    ///< E_VE of the bare readings, in vacuum wavelengths or by the scale
    double end_change = 0; ///< last against first
    int missing = 0;       ///< intervals without a good reading of the laser
    int without_air = 0;   ///< readings of the laser that no fresh air or material belongs to
    std::vector<ChannelDrift> channels; ///< all but the laser that measures the axis
};

/// The reading of the laser is carried to 20 degC as every point of a run is
/// (thermal_compensation.hpp), as if the counter had been zeroed at the datum of the plan when the
/// test began: with D_0 the distance of the place of rest from the datum and n_0 the index then,
/// V* = n_0 D_0 + (V - V_0),   D = (V* - (n - n_0) L_d) / n / cos,   D_20 by material,
/// drift = sign (D_20 - D_20 of the first reading). So air and material act on the whole path, as
/// they do while the axis is measured there. By a linear scale with its strain s and that of the
/// begin s_0: D = (D_0 / (1 + s_0) + V - V_0) (1 + s).
/// @errors Fault::incomplete_run for a test that was not closed as complete, or with fewer than
/// two usable readings; Fault::refused for a rotary axis; Fault::bad_run_file.
Result<RunDrift> evaluate_drift(const RunRecord& run, const DriftSetup& setup);

} // namespace axiscal
