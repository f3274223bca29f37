#include "analysis/circular/circular_test.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace axiscal {
namespace {

constexpr double smallest_length = 1e-6; ///< mm or mm/s; below, squares of deviations underflow
constexpr double largest_length = 1e12;  ///< mm; of everything in a case
constexpr double largest_angle = 1e4;    ///< rad; 1600 turns, beyond which an angle is a mistake

std::string field_of(std::size_t trace, const char* list) {
    return "traces[" + std::to_string(trace) + "]." + list;
}

Result<void> check_positive(double value, const char* field) {
    if (!(value >= smallest_length && value <= largest_length)) // also refuses NaN
        return refuse(Fault::bad_case, field, "must lie within 1e-6 ... 1e12");
    return {};
}

Result<void>
check_list(const std::vector<double>& values, double limit, bool open, const std::string& field) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double magnitude = std::fabs(values[i]);
        if (magnitude < limit || (!open && magnitude == limit)) continue;
        return refuse(Fault::bad_case, field + "[" + std::to_string(i) + "]",
                      open ? "must be smaller than the nominal radius"
                           : "must be finite and not beyond 10000 rad");
    }
    return {};
}

Result<void> check_trace(const CircularTrace& trace, std::size_t index, double radius) {
    const std::string angles = field_of(index, "angle_rad");
    const std::string deviations = field_of(index, "radial_deviation_mm");
    if (trace.angle_rad.size() < 3)
        return refuse(Fault::bad_case, angles, "needs at least three readings");
    if (trace.angle_rad.size() != trace.radial_deviation_mm.size())
        return refuse(Fault::bad_case, deviations, "must have as many numbers as angle_rad");
    AXISCAL_CHECK(check_list(trace.angle_rad, largest_angle, false, angles));
    return check_list(trace.radial_deviation_mm, radius, true, deviations);
}

} // namespace

const CircularTrace* CircularTest::find(Sense sense) const {
    const auto found = std::ranges::find(traces, sense, &CircularTrace::sense);
    return found == traces.end() ? nullptr : &*found;
}

Result<void> check_circular_test(const CircularTest& test) {
    AXISCAL_CHECK(check_positive(test.nominal_radius_mm, "nominal_radius_mm"));
    AXISCAL_CHECK(check_positive(test.feed_mm_per_s, "feed_mm_per_min"));
    if (test.traces.empty()) return refuse(Fault::bad_case, "traces", "must hold at least one");
    for (std::size_t i = 0; i < test.traces.size(); ++i) {
        AXISCAL_CHECK(check_trace(test.traces[i], i, test.nominal_radius_mm));
        if (test.find(test.traces[i].sense) != &test.traces[i])
            return refuse(Fault::bad_case, field_of(i, "sense"), "stands twice");
    }
    return {};
}

double folded_angle(double angle_rad) {
    constexpr double turn = 2 * std::numbers::pi;
    const double rest = std::fmod(angle_rad, turn);
    const double folded = rest < 0 ? rest + turn : rest;
    return folded < turn ? folded : 0; // a tiny negative rest rounds up to the whole turn
}

ArcCover cover_of(std::span<const double> angle_rad) {
    constexpr double degree = std::numbers::pi / 180;
    std::vector<double> angles;
    angles.reserve(angle_rad.size());
    for (const double angle : angle_rad)
        angles.push_back(folded_angle(angle));
    std::ranges::sort(angles);
    std::vector<double> steps{angles.front() + 2 * std::numbers::pi - angles.back()};
    for (std::size_t i = 1; i < angles.size(); ++i)
        steps.push_back(angles[i] - angles[i - 1]);
    const double widest = std::ranges::max(steps);
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::ranges::nth_element(steps, middle);
    // even steps of 45 deg are a full circle; the slack takes up the rounding of their sums
    constexpr double slack = 1 + 1e-9;
    return {360 - widest / degree, widest <= slack * std::max(5 * degree, 2 * *middle)};
}

} // namespace axiscal
