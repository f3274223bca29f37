#pragma once
// Circular traces made from a truth, and the truths of tests/reference/ballbar_synthetic.json.

#include "analysis/circular/circle_diagnosis.hpp"
#include "reference_data.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace axiscal::test {

/// Names as in the reference file: "square", "servo", "backlash_x", "off_x_ccw", ...
using CircleTruth = std::map<std::string, double>;

inline constexpr double one_degree = std::numbers::pi / 180;

/// Radial deviation at `theta`, written from the table of effects.
inline double true_deviation(CircleTruth truth, double theta, Sense sense, double R, double F) {
    const auto sign = [](double v) { return v > 0 ? 1.0 : v < 0 ? -1.0 : 0.0; };
    const double c = std::cos(theta), s = std::sin(theta), sg = sense == Sense::ccw ? 1 : -1;
    const double sx = -sg * sign(s), sy = sg * sign(c);
    const std::string of = sense == Sense::ccw ? "_ccw" : "_cw";
    double dr = truth["off_x" + of] * c + truth["off_y" + of] * s;
    dr += R * (truth["scale_x"] * c * c + truth["scale_y"] * s * s);
    dr += -truth["square"] * R * s * c + sg * F * truth["servo"] * s * c;
    dr += -truth["backlash_x"] / 2 * sx * c - truth["backlash_y"] / 2 * sy * s;
    dr += -truth["lateral_x"] / 2 * sx * s - truth["lateral_y"] / 2 * sy * c;
    dr += truth["straight_x"] * std::pow(s, 3) + truth["straight_y"] * std::pow(c, 3);
    return dr;
}

inline std::vector<double> even_angles(double from_deg, double to_deg, double step_deg) {
    std::vector<double> angles;
    for (double angle = from_deg; angle <= to_deg + 1e-9; angle += step_deg)
        angles.push_back(angle * one_degree);
    return angles;
}

inline CircularTrace
made_trace(const CircleTruth& truth, std::vector<double> angles, Sense sense, double R, double F) {
    CircularTrace trace{sense, std::move(angles), {}};
    for (const double theta : trace.angle_rad)
        trace.radial_deviation_mm.push_back(true_deviation(truth, theta, sense, R, F));
    return trace;
}

/// Both senses over the same angles.
inline CircularTest made_test(const CircleTruth& truth,
                              const std::vector<double>& angles,
                              double R = 150,
                              double F = 1000.0 / 60) {
    CircularTest test{R, F, SignalSource::external, {}};
    test.traces.push_back(made_trace(truth, angles, Sense::ccw, R, F));
    test.traces.push_back(made_trace(truth, {angles.rbegin(), angles.rend()}, Sense::cw, R, F));
    return test;
}

/// As the reference file rebuilds its full circles: (i + 0.5) deg.
inline CircularTest reference_test(const nlohmann::json& set) {
    const double R = set.at("R"), F = set.at("feed_mm_s");
    if (set.at("request").is_null())
        return made_test(set.at("truth").get<CircleTruth>(), even_angles(0.5, 359.5, 1), R, F);
    CircularTest test{R, F, SignalSource::external, {}};
    for (const Sense sense : {Sense::ccw, Sense::cw}) {
        const auto& trace = set.at("request").at(std::string{name_of(sense)});
        test.traces.push_back({sense, trace.at("theta"), trace.at("dr")});
    }
    return test;
}

/// The reference file's name of a cause.
inline std::string reference_name(circular::Cause cause) {
    static const std::vector<std::string> names{
        "off_x_ccw", "off_y_ccw", "off_x_cw",   "off_y_cw",   "scale_x",
        "scale_y",   "square",    "servo",      "backlash_x", "backlash_y",
        "lateral_x", "lateral_y", "straight_x", "straight_y"};
    return names.at(static_cast<std::size_t>(cause));
}

/// mm that a unit of the cause makes: scale and angle count by R, time by F.
inline double leverage_of(circular::Cause cause, double R, double F) {
    using circular::Cause;
    if (cause == Cause::servo_lag_difference) return F;
    if (cause == Cause::scale_x || cause == Cause::scale_y || cause == Cause::squareness) return R;
    return 1;
}

} // namespace axiscal::test
