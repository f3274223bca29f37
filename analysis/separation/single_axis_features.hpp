#pragma once
// Workpiece 1: features cut while one axis moved, measured twice. Pure.
//
//   dynamic      = on-machine reading - nominal     (the machine repeats its quasi-static error
//   when total        = CMM reading - nominal             it probes what it has just cut, so that
//   error quasi-static = total - dynamic                   is not seen)
//
// The sign of the on-machine reading is to be proved once with a block of known error.

#include "analysis/separation/error_separation.hpp"

#include <map>
#include <string>

namespace axiscal {

struct SingleAxisFeature {
    std::size_t axis = 0, direction = 0;                   ///< 0, 1, 2: x, y, z
    std::vector<double> nominal_mm, on_machine_mm, cmm_mm; ///< coordinate along `direction`
    /// Where the axes stood at each reading; an empty list: stood still somewhere. For the moving
    /// axis an empty list means nominal_mm where direction = axis, else not known.
    PerAxis<std::vector<double>> positions_mm;
};

struct FeatureDeviations {
    std::vector<double> dynamic_um, quasi_static_um, total_um;
};

/// @errors Fault::bad_case with `field`.nominal_mm, .on_machine_mm, .cmm_mm or .positions_mm:
/// empty, of different length, not finite, above 1e12.
Result<FeatureDeviations> deviations_of(const SingleAxisFeature& feature, const std::string& field);

struct FeatureCurve {
    std::vector<double> coefficients_um,
        uncertainty_um; ///< of U_1..; uncertainty without freedom: empty
    double residual_rms_um = 0;
    std::size_t readings = 0;
};

struct FeatureCurves {
    PerCurve<std::optional<FeatureCurve>> curves;
    std::map<std::string, std::string>
        not_evaluated; ///< by "xy"; only of curves that have features
};

/// Curves of one kind of deviation (one list a feature) in the order of the source: xx, yy; then
/// yx, xy, zx, zy; then xz, yz, zz. Each reading gives
///   s_ab d_ab(q) + constant of the feature = D_a - sum over axes c that moved too: s_ac d_ac(p_c)
/// fitted by U_k - U_k(ref), k >= 1, with one free constant a feature. So a curve is zero at the
/// reference whatever the other axes, standing still, contributed. A curve whose order exceeds what
/// its readings carry, or that needs another one not solved before, stands in not_evaluated.
/// @errors as check_model; positions outside the ranges.
Result<FeatureCurves> solve_features(const std::vector<SingleAxisFeature>& features,
                                     const std::vector<std::vector<double>>& deviations_um,
                                     const SeparationModel& model);

} // namespace axiscal
