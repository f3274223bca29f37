#include "analysis/circular/residual_features.hpp"

#include "analysis/quantity/result.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axiscal::circular {
namespace {

constexpr double localized_deg = 10; ///< how far after a crossing a spike is looked for
constexpr double line_from_deg = 2, line_to_deg = 12;
constexpr double on_the_border =
    1e-6; ///< deg; readings on whole degrees lie within, however rounded

/// Straight line through points, by their value at 0.
class Line {
public:
    void add(double u, double value) {
        ++count_;
        const double n = static_cast<double>(count_);
        const double du = u - mean_u_, dv = value - mean_v_;
        mean_u_ += du / n;
        mean_v_ += dv / n;
        uu_ += du * (u - mean_u_);
        uv_ += du * (value - mean_v_);
        vv_ += dv * (value - mean_v_);
    }
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] bool usable() const { return count_ >= 3 && uu_ > 0; }
    [[nodiscard]] double at_zero() const { return mean_v_ - uv_ / uu_ * mean_u_; }
    [[nodiscard]] double scatter() const { return std::max(vv_ - uv_ * uv_ / uu_, 0.0); }
    /// Variance of at_zero() per variance of a reading.
    [[nodiscard]] double leverage() const {
        return 1 / static_cast<double>(count_) + mean_u_ * mean_u_ / uu_;
    }

private:
    std::size_t count_ = 0;
    double mean_u_ = 0, mean_v_ = 0, uu_ = 0, uv_ = 0, vv_ = 0;
};

struct Step {
    double height = 0, standard_uncertainty = 0;
};

/// Height of the step at `at_deg` between the lines before and after it.
std::optional<Step>
step_at(const SeenTrace& trace, const std::vector<double>& values, double at_deg) {
    Line before, after;
    for (std::size_t i = 0; i < trace.points.size(); ++i) {
        const double past = degrees_past(trace.points[i], at_deg);
        if (std::fabs(past) < line_from_deg - on_the_border ||
            std::fabs(past) > line_to_deg + on_the_border)
            continue;
        (past < 0 ? before : after).add(past, values[i]);
    }
    if (!before.usable() || !after.usable()) return {};
    const auto freedom = static_cast<double>(before.count() + after.count() - 4);
    const double variance = (before.scatter() + after.scatter()) / freedom;
    return Step{after.at_zero() - before.at_zero(),
                std::sqrt(variance * (before.leverage() + after.leverage()))};
}

struct Spike {
    double height = 0, width_deg = 0;
};

/// What a step that is taken out at the crossing leaves of lost motion. The slide stands still
/// until the drive has come back from where it turned by the whole of it: R (1 - cos u) at u past
/// the crossing. Half of it is left at acos(1 - lost / (2 R)).
double left_by_play(double past_deg, double lost_mm, double radius_mm) {
    const double come_back_mm = radius_mm * (1 - std::cos(past_deg * std::numbers::pi / 180));
    return std::min(come_back_mm - lost_mm, 0.0);
}

using Past = std::vector<std::pair<double, double>>; ///< degrees past the crossing, residual

/// Takes lost motion out of the residual where it explains more of it than a step does: a control
/// that makes up for the play moves the drive at once.
void take_out_play(Past& after, double lost_mm, double radius_mm) {
    double as_step = 0, as_play = 0;
    for (const auto& [past, residual] : after) {
        const double left = left_by_play(past, lost_mm, radius_mm);
        if (left == 0) continue;
        as_step += residual * residual;
        as_play += (residual - left) * (residual - left);
    }
    if (as_play >= as_step) return;
    for (auto& [past, residual] : after)
        residual -= left_by_play(past, lost_mm, radius_mm);
}

/// Largest residual after the crossing beside the play of the axis, and how far its half height
/// reaches.
Spike spike_after(const ResidualTrace& seen,
                  double at_deg,
                  double lost_mm,
                  double nominal_radius_mm) {
    Past after;
    for (std::size_t i = 0; i < seen.residual_mm.size(); ++i) {
        const double past = degrees_past(seen.trace->points[i], at_deg);
        if (past > on_the_border && past <= localized_deg + on_the_border)
            after.emplace_back(past, seen.residual_mm[i]);
    }
    if (after.empty()) return {};
    std::ranges::sort(after);
    take_out_play(after, lost_mm, nominal_radius_mm);
    const auto peak = std::ranges::max_element(
        after, {}, [](const auto& point) { return std::fabs(point.second); });
    const double height = peak->second;
    const auto holds = [&](const auto& point) { return point.second / height > 0.5; };
    if (height == 0) return {};
    auto first = peak, last = peak;
    while (first != after.begin() && holds(*(first - 1)))
        --first;
    while (last + 1 != after.end() && holds(*(last + 1)))
        ++last;
    // each reading stands for one step of the angle
    return {height, last->first - first->first + seen.trace->step_rad * 180 / std::numbers::pi};
}

/// Residual of the points that stand more than 10 deg from every reversal, minus its mean over 2
/// deg.
void high_pass(const ResidualTrace& seen, std::vector<double>& out) {
    constexpr double half_window = (1 + on_the_border) * std::numbers::pi / 180;
    const auto& points = seen.trace->points;
    std::size_t first = 0, last = 0;
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        while (last < points.size() && points[last].angle_rad <= points[i].angle_rad + half_window)
            sum += seen.residual_mm[last++];
        while (points[first].angle_rad < points[i].angle_rad - half_window)
            sum -= seen.residual_mm[first++];
        const auto count = static_cast<double>(last - first);
        if (count < 4 || degrees_from_reversal(points[i]) <= localized_deg + on_the_border)
            continue;
        // the mean holds a share of the point itself, which it takes from its variance
        out.push_back((seen.residual_mm[i] - sum / count) / std::sqrt(1 - 1 / count));
    }
}

} // namespace

ResidualScale scale_of(const std::vector<ResidualTrace>& traces, double nominal_radius_mm) {
    double away = 0, all = 0;
    std::size_t away_count = 0, all_count = 0;
    for (const ResidualTrace& seen : traces)
        for (std::size_t i = 0; i < seen.residual_mm.size(); ++i) {
            const double square = seen.residual_mm[i] * seen.residual_mm[i];
            all += square;
            ++all_count;
            if (degrees_from_reversal(seen.trace->points[i]) <= localized_deg + on_the_border)
                continue;
            away += square;
            ++away_count;
        }
    const bool enough = away_count >= 3;
    const double mean_square =
        enough ? away / static_cast<double>(away_count) : all / static_cast<double>(all_count);
    return {std::sqrt(mean_square), 1e-12 * nominal_radius_mm};
}

std::vector<Reversal> find_reversals(const std::vector<ResidualTrace>& traces,
                                     const ResidualScale& scale,
                                     double nominal_radius_mm,
                                     double feed_mm_per_s) {
    std::vector<Reversal> found;
    for (const ResidualTrace& seen : traces) {
        for (const int quarter : {0, 1, 2, 3}) {
            const int axis = quarter % 2;
            const double backlash = seen.backlash_mm[axis == 0 ? 0 : 1];
            const double at = 90.0 * quarter;
            const auto step = step_at(*seen.trace, seen.residual_mm, at);
            if (!step) continue;
            const double lost = backlash + step->height;
            const Spike spike = spike_after(seen, at, lost, nominal_radius_mm);
            const double width_mm = spike.width_deg * std::numbers::pi / 180 * nominal_radius_mm;
            found.push_back(
                {seen.trace->sense, axis, at, lost, step->standard_uncertainty, spike.height,
                 spike.width_deg, 1000 * width_mm / feed_mm_per_s,
                 std::fabs(spike.height) > std::max(5 * scale.rms_mm, scale.negligible_mm)});
        }
    }
    return found;
}

std::vector<ChangeOver> find_change_overs(const std::vector<ResidualTrace>& traces,
                                          const ResidualScale& scale) {
    std::vector<ChangeOver> found;
    for (const ResidualTrace& seen : traces)
        for (const double at : {45.0, 135.0, 225.0, 315.0}) {
            const auto step = step_at(*seen.trace, seen.residual_mm, at);
            if (!step) continue;
            found.push_back({seen.trace->sense, at, step->height, step->standard_uncertainty,
                             std::fabs(step->height) >
                                 std::max(4 * step->standard_uncertainty, scale.negligible_mm)});
        }
    return found;
}

std::optional<Vibration> find_vibration(const std::vector<ResidualTrace>& traces) {
    std::vector<double> fast;
    for (const ResidualTrace& seen : traces)
        high_pass(seen, fast);
    if (fast.size() < 8) return {};
    double squares = 0;
    for (const double value : fast)
        squares += value * value;
    const auto [low, high] = std::ranges::minmax(fast);
    return Vibration{std::sqrt(squares / static_cast<double>(fast.size())), high - low};
}

} // namespace axiscal::circular
