#pragma once
// ISO 230-2: accuracy and repeatability of positioning of one axis. Pure.

#include "analysis/quantity/result.hpp"
#include "analysis/record/run_record.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// A table of deviations that stands for 20 degC: what every metric requires. Only
/// compensate_to_20C() (thermal_compensation.hpp) and declare_at_20C() can make one, so that
/// compensation happens exactly once.
class RunAt20C {
public:
    /// targets: m coordinates. deviations: m rows of n, x_ij = actual - target, sign as measured.
    /// All in the same unit (`unit`), which the metrics keep. `backward` empty: unidirectional.
    [[nodiscard]] const std::vector<double>& targets() const { return targets_; }
    [[nodiscard]] const std::vector<std::vector<double>>& forward() const { return forward_; }
    [[nodiscard]] const std::vector<std::vector<double>>& backward() const { return backward_; }
    [[nodiscard]] const std::string& unit() const { return unit_; }
    /// "already_at_20C: <reason>" or "compensated_to_20C".
    [[nodiscard]] const std::string& provenance() const { return provenance_; }

private:
    friend class RunAt20CMaker;
    RunAt20C() = default;
    std::vector<double> targets_;
    std::vector<std::vector<double>> forward_, backward_;
    std::string unit_, provenance_;
};

/// Deviation table as it came; checked by declare_at_20C.
struct DeviationTable {
    std::vector<double> targets;
    std::vector<std::vector<double>> forward, backward;
    std::string unit = "mm";
};

enum class RowLengths : std::uint8_t { equal, any };
/// Data that came corrected (or were measured at 20 degC): the reason is kept and printed.
/// @errors Fault::bad_case with the field ("forward[2][1]") for shape errors, NaN or infinities.
/// @param readings  whether all rows have the same number, or each at least one
Result<RunAt20C> declare_at_20C(DeviationTable table,
                                const std::string& reason,
                                RowLengths readings = RowLengths::equal);
/// Of any target and direction; 0 without any.
int fewest_readings(const RunAt20C& run);

struct PositionRow {
    double target = 0;
    double mean_forward = 0;
    std::optional<double> mean_backward, mean, reversal; ///< xm-down, xm, B_i
    std::optional<double> s_forward, s_backward;         ///< n >= 2
    std::optional<double> repeatability_forward, repeatability_backward, repeatability; ///< R_i
};

/// Axis results by their standard symbols; a parameter that the data do not allow is absent and
/// its reason stands in `not_evaluated` under the contract's key ("R", "A_forward", ...).
struct PositioningParameters {
    std::optional<double> A, A_forward, A_backward;
    std::optional<double> E, E_forward, E_backward;
    std::optional<double> M;
    std::optional<double> R, R_forward, R_backward;
    std::optional<double> B, B_mean;
};

struct PositioningResult {
    std::string standard, unit, provenance;
    double cover_factor = 2; ///< k
    int approaches = 0;      ///< n
    PositioningParameters parameters;
    std::vector<PositionRow> positions;
    std::map<std::string, std::string> not_evaluated;
};

/// ISO 230-2:2014 (k = 2) over the table. n = 1: no s, R, A; no backward: no B, M, bidirectional
/// figures. Formulas: docs of each helper in the .cpp (standards clause 1.1 there, marked [C]).
PositioningResult evaluate_positioning(const RunAt20C& run,
                                       std::string standard = "ISO 230-2:2014",
                                       double cover_factor = 2);

} // namespace axiscal
