#include "straightness_truth.hpp"

#include "injected_process.hpp"
#include "laser_count.hpp"
#include "simulated_machine.hpp"
#include "straightness_optics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace axiscal::simulate {
namespace {

using Line = std::vector<double>;

/// Largest minus smallest of y - slope x.
double width_along(const Line& x, const Line& y, double slope) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (std::size_t i = 0; i < x.size(); ++i) {
        low = std::min(low, y[i] - slope * x[i]);
        high = std::max(high, y[i] - slope * x[i]);
    }
    return high - low;
}

double mean_of_line(const Line& values) {
    double sum = 0;
    for (const double value : values)
        sum += value;
    return sum / static_cast<double>(values.size());
}

double slope_of_least_squares(const Line& x, const Line& y) {
    const double mean_x = mean_of_line(x), mean_y = mean_of_line(y);
    double squares = 0, products = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        squares += (x[i] - mean_x) * (x[i] - mean_x);
        products += (x[i] - mean_x) * (y[i] - mean_y);
    }
    return products / squares;
}

/// By how much the line of least squares can enlarge what is wrong by 1 at every target.
double enlargement(const Line& x) {
    const double mean = mean_of_line(x);
    double squares = 0, distances = 0;
    for (const double position : x) {
        squares += (position - mean) * (position - mean);
        distances += std::abs(position - mean);
    }
    return 2 + (x.back() - x.front()) * distances / squares;
}

/// The motion after approaches from both sides, or from one: 0 is the mean of both.
Line motion_across(const Scenario& across, const Line& x, int direction) {
    const TrueErrors errors{across.errors};
    Line line;
    for (const double target : x)
        line.push_back(errors.deviation_um(target, direction));
    return line;
}

/// Furthest from its own line of least squares: a slope of the mirror is one of the set-up.
double form_of_mirror_um(const ErrorScenario& mirror, const Line& x) {
    const TrueErrors errors{mirror};
    Line form;
    for (const double target : x)
        form.push_back(errors.pitch_um(target));
    const double slope = slope_of_least_squares(x, form), mean_x = mean_of_line(x),
                 mean = mean_of_line(form);
    double furthest = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        furthest = std::max(furthest, std::abs(form[i] - mean - slope * (x[i] - mean_x)));
    return furthest;
}

/// What the bounds are made of, um.
struct StraightnessTerms {
    double sigma = 0, z = 0, count = 0, drift = 0, mirror = 0;
    /// Wrong by this much at every target, at most.
    [[nodiscard]] double everywhere() const { return count + drift + mirror; }
    /// @param readings  in each mean
    [[nodiscard]] double noise(double readings) const { return z * sigma / std::sqrt(readings); }
};

StraightnessTerms
straightness_terms(const Scenario& scenario, const Scenario& across, const TruthPlan& plan) {
    const StraightnessScenario& optics = *scenario.straightness;
    const ErrorScenario& errors = across.errors;
    StraightnessTerms terms;
    terms.sigma = std::hypot(
        capture_sigma_um(across),
        errors.vibration_um / (std::numbers::pi * scenario.truth.window_s * errors.vibration_hz));
    terms.z = std::sqrt(2.0 * std::log(2.0 * static_cast<double>(plan.targets_mm.size()) / 0.001));
    terms.count = count_um(scenario.laser) * optics.factor;
    terms.drift = std::abs(errors.drift_um_per_hour) * scenario.truth.duration_s / 3600.0;
    terms.mirror = form_of_mirror_um(optics.mirror, plan.targets_mm);
    return terms;
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
    StraightnessParameters(const TruthPlan& plan, const StraightnessTerms& terms)
        : plan_{plan}
        , terms_{terms} {}

    void add_line(const std::string& side, const Line& line, double readings) {
        const TrueStraightness found = straightness_of(plan_.targets_mm, line);
        const double noise = terms_.noise(readings), everywhere = terms_.everywhere();
        add("straightness_end_points" + side, found.end_points_um, 2 * noise + 4 * everywhere);
        add("straightness_least_squares" + side, found.least_squares_um,
            std::numbers::sqrt2 * noise + enlargement(plan_.targets_mm) * everywhere);
        add("straightness_minimum_zone" + side, found.minimum_zone_um,
            std::numbers::sqrt2 * noise + 2 * everywhere);
    }
    void add_reversal(const Line& forward, const Line& backward) {
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
    const StraightnessTerms& terms_;
};

} // namespace

TrueStraightness straightness_of(const std::vector<double>& positions_mm,
                                 const std::vector<double>& deviations_um) {
    const Line &x = positions_mm, &y = deviations_um;
    TrueStraightness found;
    found.end_points_um = width_along(x, y, (y.back() - y.front()) / (x.back() - x.front()));
    found.least_squares_um = width_along(x, y, slope_of_least_squares(x, y));
    found.minimum_zone_um = found.end_points_um;
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = i + 1; j < x.size(); ++j)
            found.minimum_zone_um =
                std::min(found.minimum_zone_um, width_along(x, y, (y[j] - y[i]) / (x[j] - x[i])));
    return found;
}

nlohmann::json straightness_truth_of(const Scenario& scenario, const TruthPlan& plan) {
    const Scenario across = scenario_across(scenario);
    const StraightnessTerms terms = straightness_terms(scenario, across, plan);
    StraightnessParameters all{plan, terms};
    const Line forward = motion_across(across, plan.targets_mm, +1);
    all.add_line("_forward", forward, plan.approaches);
    if (plan.bidirectional) {
        const Line backward = motion_across(across, plan.targets_mm, -1);
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
