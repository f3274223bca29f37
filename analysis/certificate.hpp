#pragma once
// Everything a certificate prints, computed once from a closed run. Rendering only formats it.
// Pure.

#include "analysis/positioning_accuracy.hpp"
#include "analysis/run_record.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

struct EnvironmentSummary {
    std::string channel, place;
    ChannelKind kind = ChannelKind::temperature;
    Medium medium = Medium::none;
    int readings = 0;
    double first = 0, last = 0, minimum = 0, maximum = 0; ///< in stored_unit_of(kind)
};

struct EnvironmentTrace { ///< for the plot: seconds since the first point, value
    std::string channel;
    ChannelKind kind = ChannelKind::temperature;
    Medium medium = Medium::none;
    std::vector<double> seconds, values;
};

/// What compensation did to the readings; deviations in the result's unit before and after.
struct CompensationSummary {
    std::string air_formula, expansion_form;
    double refractive_index_minus_1_first = 0, refractive_index_minus_1_last = 0;
    double material_first_degC = 0, material_last_degC = 0;
    double expansion_per_K = 0;
    std::optional<double> expansion_standard_uncertainty_per_K;
    double dead_path_mm = 0, cosine_factor = 1, vacuum_wavelength_nm = 0;
    /// per plan order: deviation with nominal vacuum->air (air corrected) but not to 20 degC, and
    /// after.
    std::vector<double> before, after;
    double largest_air_correction = 0, largest_material_correction = 0; ///< result unit
};

struct Certificate {
    RunRecord run; ///< as read from the file (samples may be dropped)
    PositioningResult result;
    RunAt20C deviations;
    CompensationSummary compensation;
    std::vector<EnvironmentSummary> environment;
    std::vector<EnvironmentTrace> traces;
    std::string run_file_sha256; ///< of the closed file
    std::string result_digest;   ///< SHA-256 over the canonical bytes of parameters and positions
    std::string started_utc, finished_utc, issued_on,
        next_due;            ///< from the run, never from the clock
    bool preliminary = true; ///< no uncertainty budget yet: "U not evaluated", "preliminary"
    std::vector<std::string> remarks;
};

/// The whole road from a closed run to its certificate.
/// @errors Fault::incomplete_run, environment_stale, datum_lost, bad_run_file.
Result<Certificate> make_certificate(RunRecord run, std::string run_file_sha256);

} // namespace axiscal
