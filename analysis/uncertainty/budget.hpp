#pragma once
// Uncertainty budget of ISO 230-2, annex A. Pure.
//
// The annex is written for linear axes. A rotary axis has device and environment alone, combined in
// the same way, as a Chinese calibration specification after ISO 230-2:2006 and ISO/TR 230-9:2005
// does in an annex B of its own; annex B of ISO 230-2 is the step cycle.
// Lengths are micrometres; on a rotary axis the same fields are seconds of arc. Every `width` is
// the FULL width of a rectangular distribution, u = width / (2 sqrt 3). Marks: S stands in a source
// document, R is reconstructed from its structure (the printed tables are lost).

#include "analysis/quantity/result.hpp"
#include "analysis/record/run_record.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// What is known of the measurement; what is absent contributes nothing and is named in
/// `UncertaintyBudget::not_stated`.
struct UncertaintyStatement {
    AxisKind axis_kind = AxisKind::linear;
    std::optional<double> device_U, device_k; ///< expanded uncertainty over the length, and its k
    std::optional<double> device_width;       ///< instead: band of a limit (+-a: 2a)
    // linear alone
    std::optional<double> length_m;         ///< L
    std::optional<double> misalignment_mm;  ///< e: offset of the beam over L
    std::optional<double> misalignment_rad; ///< delta, instead of e
    std::optional<double> alpha_um_per_m_K, temperature_width_K;
    std::optional<double> alpha_width_um_per_m_K, temperature_offset_K; ///< largest |theta - 20|
    // a device that grows with its own temperature (a scale, a step gauge; none of a laser)
    std::optional<double> device_alpha_um_per_m_K, device_temperature_width_K;
    std::optional<double> device_alpha_width_um_per_m_K, device_temperature_offset_K;
    std::optional<double> eve; ///< E_VE: range of the drift test, largest - smallest reading
    EveModel eve_model = EveModel::mean;
};

/// What can stand in a budget. Also called by make_budget().
/// @errors Fault::bad_case with the contract's key ("device_U_um", rotary "device_U_arcsec") for
/// what is negative, not finite, stated twice, lacks its companion or belongs to the other kind of
/// axis.
Result<void> check_statement(const UncertaintyStatement& statement);

enum class UncertaintyTerm : std::uint8_t {
    device,
    misalignment,
    machine_temperature,
    machine_expansion,
    device_temperature,
    device_expansion,
    environment
};
std::string_view name_of(UncertaintyTerm term);

/// What is known of the size of an error; the simulation draws from it.
enum class Distribution : std::uint8_t { rectangular, normal };
std::string_view name_of(Distribution distribution);

struct Contribution {
    UncertaintyTerm term = UncertaintyTerm::device;
    double u = 0;        ///< standard uncertainty, um or arcsec
    std::string formula; ///< in the symbols of the annex
    std::string status;  ///< "S", "R", "S (text), R (formula)"
    Distribution distribution = Distribution::rectangular;
};

/// One parameter under its contract key ("A_forward"). Its square is the sum over the contributions
/// of (factor u)^2, with factor `systematic` for all but the environment.
struct ParameterUncertainty {
    std::string key;
    double u = 0;        ///< combined standard uncertainty, um or arcsec
    double expanded = 0; ///< U = 2 u
    double systematic =
        0; ///< 1: device, misalignment, temperature, expansion count; 0: they cancel
    double environment = 0; ///< factor of u_EVE
    std::string formula, status;
    /// R alone: strict propagation of k s + k s + |B|, which the source's formula exceeds.
    std::optional<double> strict_u;
};

struct UncertaintyBudget {
    AxisKind axis_kind = AxisKind::linear;
    EveModel eve_model = EveModel::mean;
    int approaches = 5;  ///< n
    double coverage = 2; ///< k of every U
    std::optional<double> length_m;
    std::vector<Contribution> contributions;
    std::vector<std::string> not_stated; ///< names of terms that a complete budget would hold
    std::vector<ParameterUncertainty> parameters;
    [[nodiscard]] const ParameterUncertainty* find(std::string_view key) const;
    [[nodiscard]] const Contribution* find(UncertaintyTerm term) const;
};

/// n approaches, m targets, k of the edition (2; 1988: 3). Combined as
///   u(R^) = 2 k u_EVE / sqrt(n - 1)             S for k = 2
///   u(B) = u_EVE sqrt(2 / n)                    R
///   u(R)  = sqrt(u(B)^2 + u(R^)^2)              S (structure); above strict propagation
///   u(E)  = sqrt(sum u_systematic^2 + c u_EVE^2), c = 1/n or 2/n      R
///   u(M)  = the same with c = 1/(2n) or 1/n     R
///   u(A)  = sqrt(u(E)^2 + u(R^)^2)              S
///   u(B_mean) = u_EVE sqrt(2 / (n m))           derived: mean of m independent B_i; not in the
///   source
/// n = 1: no R and no A. Accuracy: a few units in the last place.
/// @errors those of check_statement(); "n", "targets" below 1.
Result<UncertaintyBudget> make_budget(const UncertaintyStatement& statement,
                                      int approaches,
                                      int targets,
                                      double edition_k = 2);

/// How many of the budget's unit (um, arcsec) make one of a result's ("mm", "m", "deg").
double budget_units_per(std::string_view unit);

/// Every contract key of a parameter that can have an uncertainty, in the contract's order.
const std::vector<std::string>& uncertain_parameters();

} // namespace axiscal
