#include "squareness_truth.hpp"

#include "lines_across.hpp"
#include "straightness_optics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace axiscal::simulate {
namespace {

constexpr double um_per_m_of_slope = 1e3; ///< of 1 um/mm

/// Furthest from its mean: a slope of the mirror, too, turns the line.
double tilt_of_mirror_um(const ErrorScenario& mirror, const LineAcross& x) {
    const LineAcross form = form_of_mirror(mirror, x);
    const double mean = mean_of_line(form);
    double furthest = 0;
    for (const double point : form)
        furthest = std::max(furthest, std::abs(point - mean));
    return furthest;
}

/// How far the slope of the least zone goes where each point moves by `wrong_um` at most: every
/// width then changes by twice of it, so the new best slope has an old width of at most four times
/// more than the least. The width is convex in the slope, and grows by the length at last.
double reach_of_least_zone(const LineAcross& x, const LineAcross& y, double wrong_um) {
    const double best = slope_of_least_zone(x, y), least = width_along(x, y, best);
    const double allowed = least + 4 * wrong_um;
    double reach = 0;
    for (const int side : {-1, +1}) {
        double inside = 0, outside = (least + allowed) / (x.back() - x.front());
        for (int halving = 0; halving < 60; ++halving) {
            const double middle = (inside + outside) / 2;
            (width_along(x, y, best + side * middle) <= allowed ? inside : outside) = middle;
        }
        reach = std::max(reach, outside);
    }
    return reach;
}

const char* const squareness_bounds =
    "squareness: values and bounds in um/m, 1e-6 rad. bound = 2 r + 1e-4 (|a1| + |a2|): r is how "
    "far the slope of the second line can go, and the first line is taken to be alike. With w = "
    "count + drift + mirror, v = z sigma/sqrt(N), N readings in each mean, L = length, Q = sum (x "
    "- xm)^2: end points (sqrt 2 v + 2 w)/L; least squares v/sqrt Q + w sum|x - xm|/Q; minimum "
    "zone: the slopes by which the zone is at most 4 (v + w) wider than the least. count: of the "
    "laser times the factor; mirror: its form at the targets, furthest from its mean. z and sigma "
    "as of a straightness run. 1e-4: air. square_error: by reversal; bound of least squares.";

class SquarenessParameters {
public:
    SquarenessParameters(const SquarenessScenario& hidden, const LineAcross& x, LineAcross second)
        : hidden_{hidden}
        , x_{x}
        , second_{std::move(second)} {}

    /// @param slope, reach  of the second line, um/mm
    void add(const std::string& reference, double slope, double reach) {
        constexpr double rad = 1e-6, air = 1e-4;
        const double a1 = hidden_.first_um_per_m, a2 = slope * um_per_m_of_slope;
        const double error =
            hidden_.square_turned ? -hidden_.square_um_per_m : hidden_.square_um_per_m;
        const double value = error - (std::atan(a1 * rad) + std::atan(a2 * rad)) / rad;
        const double bound = 2 * reach * um_per_m_of_slope + air * (std::abs(a1) + std::abs(a2));
        parameters["squareness_" + reference] = {{"value", value}, {"bound", bound}};
    }
    void add_all(double noise_um, double everywhere_um) {
        const SpreadOfPlaces spread = spread_of(x_);
        add("end_points", slope_of_end_points(x_, second_),
            (std::numbers::sqrt2 * noise_um + 2 * everywhere_um) / (x_.back() - x_.front()));
        add("least_squares", slope_of_least_squares(x_, second_),
            noise_um / std::sqrt(spread.squares) +
                everywhere_um * spread.distances / spread.squares);
        add("minimum_zone", slope_of_least_zone(x_, second_),
            reach_of_least_zone(x_, second_, noise_um + everywhere_um));
        parameters["square_error"] = {{"value", hidden_.square_um_per_m},
                                      {"bound", parameters["squareness_least_squares"]["bound"]}};
    }
    nlohmann::json parameters;

private:
    SquarenessScenario hidden_;
    LineAcross x_, second_;
};

} // namespace

nlohmann::json squareness_truth_of(const Scenario& scenario, const TruthPlan& plan) {
    const Scenario across = scenario_across(scenario);
    AcrossTerms terms = terms_across(scenario, across, plan);
    terms.mirror = tilt_of_mirror_um(scenario.straightness->mirror, plan.targets_mm);
    const int direction = plan.bidirectional ? 0 : +1;
    const double readings = (plan.bidirectional ? 2.0 : 1.0) * plan.approaches;
    SquarenessParameters all{*scenario.squareness, plan.targets_mm,
                             motion_across(across, plan.targets_mm, direction)};
    all.add_all(terms.noise(readings), terms.everywhere());
    return {{"format", "axiscal.truth/1"},
            {"unit", "um/m"},
            {"targets", plan.targets_mm},
            {"approaches", plan.approaches},
            {"parameters", all.parameters},
            {"formula", squareness_bounds},
            {"terms_um",
             {{"sigma", terms.sigma},
              {"z", terms.z},
              {"count", terms.count},
              {"drift", terms.drift},
              {"mirror", terms.mirror}}}};
}

} // namespace axiscal::simulate
