#pragma once
// Everything that the certificate of a circular test prints, computed once. Rendering only formats
// it. Pure.

#include "analysis/circular/capture_effect.hpp"
#include "analysis/circular/circular_run.hpp"
#include "analysis/circular/circular_uncertainty.hpp"
#include "analysis/conformity/conformity.hpp"
#include "analysis/uncertainty/run_uncertainty.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// What ISO 230-4 wants told beside the figures. Absent or empty prints "not stated".
struct CircularConditions {
    std::optional<std::array<double, 3>> centre_mm; ///< X, Y, Z in machine coordinates
    std::string tool_offset, work_offset;           ///< to the tool's, the workpiece's reference
    std::optional<double> sample_rate_hz;
    std::string filter;       ///< "none", or what was done to the readings before
    std::string angle_origin; ///< how the angle of a reading is known
    std::optional<double> overshoot_deg;
    std::string feed_in;
    std::optional<int> repeats, warm_up; ///< circles of each sense
    CircularTemperature air, bar, machine;
};

/// A circular test with all that is known of it, not yet evaluated.
struct CircularMeasurement {
    CircularRun run; ///< of a case: its statements, instruments, radius and feed alone
    /// The readings came with a case: no run file of this station holds them.
    bool taken_elsewhere = false;
    CircularTest test; ///< what is evaluated: of repeats the mean
    AxisNames axes{"X", "Y"};
    RadialCentre f_centre = RadialCentre::automatic;
    std::vector<CircularTest> repeats; ///< each by itself; empty for one
    CircularConditions conditions;
    std::optional<BarExpansion> expansion; ///< absent: F and D stand as measured
    std::optional<CircularUncertaintyStatement> stated;
    int trials = 1000; ///< of the Monte Carlo evaluation
    std::string started_utc, finished_utc, next_due;
    std::string clock_remark; ///< of a clock that was set in mid-run; empty: it was not
};

struct CircularCertificate {
    CircularMeasurement measured;
    CircularParameters parameters;
    CircleDiagnosis diagnosis;
    /// By contract key: the figure of each repeat, in their order; empty for one repeat.
    std::map<std::string, std::vector<double>> of_repeats;
    /// Of the readings that are evaluated; none of a case, which says only what it wants to.
    std::optional<CaptureEffect> capture_effect;
    std::optional<CircularBudget> budget; ///< none without a statement
    std::vector<MissingTerm> missing;     ///< empty: the certificate is final
    bool preliminary = true;              ///< `missing` is not empty: printed on each page
    std::string file_sha256;              ///< of the closed run file, or of the case
    std::string result_digest;            ///< of canonical_bytes(parameters); filled by the caller
    std::vector<std::string> remarks;
    std::string replaces; ///< the certificate that this one replaces; empty: it is the first
    std::optional<Conformity> conformity; ///< of a run with limits
    /// U of one figure, where every term that counts in it is stated: with one left out it would be
    /// too small. Null otherwise.
    [[nodiscard]] const CircularFigureUncertainty* uncertainty_of(std::string_view key) const;
    /// Whether a term of the budget ("centre") counts in any figure.
    [[nodiscard]] bool needs(std::string_view term) const;
};

/// The whole evaluation. Repeatability that nobody stated is the largest standard deviation of a
/// figure over the repeats, if there are some.
/// @errors those of evaluate_circular and circular_budget
Result<CircularCertificate> evaluate_measurement(CircularMeasurement measured,
                                                 std::string file_sha256);

/// What a closed run says. @errors Fault::incomplete_run; those of mean_test
Result<CircularMeasurement> measurement_of(CircularRun run);

/// Every figure of ISO 230-4 in one fixed order, so that equal figures give equal bytes anywhere:
/// the text "axiscal.canonical-circular/1", then G_ccw, G_cw, G_b by minimum zone and by least
/// squares, F_max_ccw, F_min_ccw, F_max_cw, F_min_cw, D. Each is a byte 1 and the figure in whole
/// units of 1e-8 mm as 64-bit integer, least significant byte first; an absent one is a byte 0. A
/// sine may change its last bit with a new C library: 1e-8 mm is a million times that.
std::vector<std::byte> canonical_bytes(const CircularParameters& parameters);

} // namespace axiscal
