#include "straightness_truth.hpp"

#include "lines_across.hpp"
#include "straightness_optics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace axiscal::simulate {
namespace {

/// By how much the line of least squares can enlarge what is wrong by 1 at every target.
double enlargement(const LineAcross& x) {
    const SpreadOfPlaces spread = spread_of(x);
    return 2 + (x.back() - x.front()) * spread.distances / spread.squares;
}

/// Furthest from its own line of least squares: a slope of the mirror is one of the set-up.
double form_of_mirror_um(const ErrorScenario& mirror, const LineAcross& x) {
    const LineAcross form = form_of_mirror(mirror, x);
    const double slope = slope_of_least_squares(x, form), mean_x = mean_of_line(x),
                 mean = mean_of_line(form);
    double furthest = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        furthest = std::max(furthest, std::abs(form[i] - mean - slope * (x[i] - mean_x)));
    return furthest;
}

const char* const straightness_bounds =
    "straightness: bound = k sigma/sqrt(N) z + c (count + drift + mirror) + 1e-4 of it, with N "
    "readings in each mean; k and c: end points 2 and 4; least squares sqrt 2 and 2 + L sum|x - "
    "xm| / sum (x - xm)^2; minimum zone sqrt 2 and 2. count: of the laser times the factor; "
    "mirror: its form at the targets, furthest from its own line of least squares, the whole of "
    "which may stand in one run. B: sqrt 2 and 2 without the mirror; B_mean: sqrt(2/m) and 2 "
    "without it. z and sigma as of a positioning run, of the motion across. 1e-4: air.";

class StraightnessParameters {
public:
    StraightnessParameters(const TruthPlan& plan, const AcrossTerms& terms)
        : plan_{plan}
        , terms_{terms} {}

    void add_line(const std::string& side, const LineAcross& line, double readings) {
        const TrueStraightness found = straightness_of(plan_.targets_mm, line);
        const double noise = terms_.noise(readings), everywhere = terms_.everywhere();
        add("straightness_end_points" + side, found.end_points_um, 2 * noise + 4 * everywhere);
        add("straightness_least_squares" + side, found.least_squares_um,
            std::numbers::sqrt2 * noise + enlargement(plan_.targets_mm) * everywhere);
        add("straightness_minimum_zone" + side, found.minimum_zone_um,
            std::numbers::sqrt2 * noise + 2 * everywhere);
    }
    void add_reversal(const LineAcross& forward, const LineAcross& backward) {
        double largest = 0, sum = 0;
        for (std::size_t i = 0; i < forward.size(); ++i) {
            largest = std::max(largest, std::abs(forward[i] - backward[i]));
            sum += forward[i] - backward[i];
        }
        const auto m = static_cast<double>(forward.size());
        const double noise = std::numbers::sqrt2 * terms_.noise(plan_.approaches);
        const double moves = 2 * (terms_.count + terms_.drift);
        add("B", largest, noise + moves);
        add("B_mean", sum / m, noise / std::sqrt(m) + moves);
    }
    nlohmann::json parameters;

private:
    void add(const std::string& key, double um, double bound_um) {
        constexpr double air = 1e-4;
        parameters[key] = {{"value", um * 1e-3}, {"bound", (bound_um + air * std::abs(um)) * 1e-3}};
    }
    const TruthPlan& plan_;
    const AcrossTerms& terms_;
};

} // namespace

TrueStraightness straightness_of(const std::vector<double>& positions_mm,
                                 const std::vector<double>& deviations_um) {
    const LineAcross &x = positions_mm, &y = deviations_um;
    TrueStraightness found;
    found.end_points_um = width_along(x, y, slope_of_end_points(x, y));
    found.least_squares_um = width_along(x, y, slope_of_least_squares(x, y));
    found.minimum_zone_um = width_along(x, y, slope_of_least_zone(x, y));
    return found;
}

nlohmann::json straightness_truth_of(const Scenario& scenario, const TruthPlan& plan) {
    const Scenario across = scenario_across(scenario);
    AcrossTerms terms = terms_across(scenario, across, plan);
    terms.mirror = form_of_mirror_um(scenario.straightness->mirror, plan.targets_mm);
    StraightnessParameters all{plan, terms};
    const LineAcross forward = motion_across(across, plan.targets_mm, +1);
    all.add_line("_forward", forward, plan.approaches);
    if (plan.bidirectional) {
        const LineAcross backward = motion_across(across, plan.targets_mm, -1);
        all.add_line("_backward", backward, plan.approaches);
        all.add_line("", motion_across(across, plan.targets_mm, 0), 2.0 * plan.approaches);
        all.add_reversal(forward, backward);
    } else {
        all.add_line("", forward, plan.approaches);
    }
    return {{"format", "axiscal.truth/1"},
            {"unit", "mm"},
            {"targets", plan.targets_mm},
            {"approaches", plan.approaches},
            {"parameters", all.parameters},
            {"formula", straightness_bounds},
            {"terms_um",
             {{"sigma", terms.sigma},
              {"z", terms.z},
              {"count", terms.count},
              {"drift", terms.drift},
              {"mirror", terms.mirror}}}};
}

} // namespace axiscal::simulate
