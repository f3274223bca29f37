#pragma once
// Uncertainty of a straightness against each reference line (GUM, first order). Pure.
//
// No annex of ISO 230-1 gives a budget; the terms follow ISO/TR 230-9 in their distributions: every
// `limit` a is the half width of a rectangle, u = a / sqrt 3, every range a full width, u = range /
// (2 sqrt 3). All terms are derived here (status R). What does not count, and why: dead path and
// expansion (both beams go the same way, the deviation is small: below 1e-4 of it); the laser's own
// uncertainty per length (of a displacement of P / factor); the slope between optics and axis,
// which every reference takes out.

#include "analysis/quantity/result.hpp"
#include "analysis/straightness/straightness_figures.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

enum class StraightnessTerm : std::uint8_t {
    factor,     ///< Wollaston: of the displacement factor
    mirror,     ///< Wollaston: form of the bisecting mirror
    angle,      ///< angle steps: of each angle
    base,       ///< angle steps: of the foot
    resolution, ///< least step of a reading
    environment ///< E_VE, or the scatter of the readings where that is larger
};
std::string_view name_of(StraightnessTerm term);

/// What is known of one run, or of the mean of two with the mirror in both positions. Absent: not
/// stated. Of `wollaston` and of angle steps each takes its own fields alone.
struct StraightnessInputs {
    bool wollaston = true;
    std::optional<double> factor_u;               ///< relative standard uncertainty
    std::optional<double> mirror_limit_um_per_m2; ///< +-a M^2
    bool mirror_reversed = false; ///< the mean of both positions: the mirror's form is gone
    std::optional<double> angle_u_rad;
    std::optional<double> base_u; ///< relative
    double base_um = 0;           ///< angle steps: > 0
    /// Least step of one deviation in um, or of one angle in rad.
    std::optional<double> resolution;
    std::optional<double> eve;     ///< E_VE in um, or in rad
    std::optional<double> scatter; ///< s of a single reading, pooled; um, or rad
    int readings_a_mean = 1;       ///< of both mirror positions together
};

struct StraightnessContribution {
    StraightnessTerm term = StraightnessTerm::factor;
    double u_um = 0; ///< of the straightness
    std::string formula;
};

struct StraightnessUncertainty {
    LineReference reference = LineReference::least_squares;
    double straightness_um = 0;
    std::vector<StraightnessContribution> contributions;
    /// Present where every term is: with one left out, U would be too small.
    std::optional<double> u_um, expanded_um; ///< U = 2 u
};

struct StraightnessBudget {
    double coverage = 2;
    std::array<StraightnessUncertainty, 3> by_reference; ///< in the order of LineReference
    std::vector<std::string> not_stated;                 ///< names of terms
    bool by_scatter = false; ///< the environment term is the readings' own scatter
};

/// With w and g of sensitivity.hpp, L the measured length, N the readings in each mean, b the base:
///   u_factor      = P u(f) / f
///   u_mirror      = a L^2 / sqrt 3; 0 for the mean of both positions
///   u_base        = P u(b) / b
///   u_angle       = b u(angle) sqrt(sum g^2): each angle errs by itself, the same in each run
///   u_resolution  = q / (2 sqrt 3) sqrt(sum w^2), of angles b q / (2 sqrt 3) sqrt(sum g^2)
///   u_environment = e / sqrt N sqrt(sum w^2), of angles b e / sqrt N sqrt(sum g^2), with
///                   e = max(E_VE / (2 sqrt 3), s)
/// Accuracy: a few units in the last place.
/// @errors Fault::bad_case with the field for what is negative or not finite, and for no readings.
Result<StraightnessBudget> make_straightness_budget(const StraightnessLine& line,
                                                    const StraightnessInputs& inputs);

} // namespace axiscal
