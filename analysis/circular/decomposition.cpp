#include "analysis/circular/decomposition.hpp"

#include "analysis/linear/length.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axiscal::circular {
namespace {

constexpr double masked_deg = 4 + 1e-6; ///< with readings on whole degrees, however rounded
constexpr double spiky = 2;             ///< scatter at a reversal over the scatter elsewhere
constexpr std::size_t columns_a_cyclic = 3;

struct Circle {
    double R = 0, F = 0;
};

std::vector<Cause> causes_of(const std::vector<SeenTrace>& traces) {
    const auto measured = [&](Sense sense) {
        return std::ranges::find(traces, sense, &SeenTrace::sense) != traces.end();
    };
    std::vector<Cause> causes;
    for (std::size_t i = 0; i < cause_count; ++i) {
        const auto cause = static_cast<Cause>(i);
        const bool of_ccw = cause == Cause::center_ccw_x || cause == Cause::center_ccw_y;
        const bool of_cw = cause == Cause::center_cw_x || cause == Cause::center_cw_y;
        if ((of_ccw && !measured(Sense::ccw)) || (of_cw && !measured(Sense::cw))) continue;
        causes.push_back(cause);
    }
    return causes;
}

/// Row of one point: the causes, then for each periodic error cosine, sine and the derivative after
/// its wave number k = 2 pi / p.
void make_row(const Decomposition& model,
              const Aspect& at,
              const Circle& circle,
              std::vector<double>& row) {
    const auto effects = effects_at(at, circle.R, circle.F);
    row.clear();
    for (const Cause cause : model.causes)
        row.push_back(effects[static_cast<std::size_t>(cause)]);
    for (const CyclicError& cyclic : model.cyclic) {
        const double w = cyclic.axis == 0 ? at.cosine : at.sine;
        const double position = circle.R * w;
        const double argument = 2 * std::numbers::pi * position / cyclic.pitch_mm;
        row.push_back(w * std::cos(argument));
        row.push_back(w * std::sin(argument));
        row.push_back(-w * position * cyclic.amplitude_mm * std::sin(argument + cyclic.phase_rad));
    }
}

double product(const std::vector<double>& row, const std::vector<double>& value) {
    double sum = 0;
    for (std::size_t i = 0; i < row.size(); ++i)
        sum += row[i] * value[i];
    return sum;
}

/// Scatter of the readings near one reversal about what the others say.
class Zones {
public:
    void add(const SeenPoint& point, double residual) {
        constexpr double exactly_there = 1e-6; // deg; which side it is on is rounding
        if (degrees_from_reversal(point) < exactly_there) return;
        const auto quarter =
            static_cast<std::size_t>(std::lround(point.angle_rad * 2 / std::numbers::pi)) % 4;
        auto& [count, squares] = zones_[quarter + (point.aspect.sense > 0 ? 0 : 4)];
        ++count;
        squares += residual * residual;
    }
    [[nodiscard]] double largest_rms() const {
        double largest = 0;
        for (const auto& [count, squares] : zones_)
            if (count >= 3) largest = std::max(largest, squares / static_cast<double>(count));
        return std::sqrt(largest);
    }

private:
    std::array<std::pair<std::size_t, double>, 8> zones_{};
};

double scatter_of(const LinearSolution& solution) {
    if (solution.rows <= solution.rank) return 0;
    return std::sqrt(solution.residual_sum_of_squares /
                     static_cast<double>(solution.rows - solution.rank));
}

/// Fits once for the pitches that stand in the model.
void fit_linear(Decomposition& model, const std::vector<SeenTrace>& traces, const Circle& circle) {
    const std::size_t width = model.causes.size() + columns_a_cyclic * model.cyclic.size();
    RowFit away{width}, near{width};
    std::vector<double> row;
    for (const SeenTrace& trace : traces)
        for (const SeenPoint& point : trace.points) {
            make_row(model, point.aspect, circle, row);
            const bool masked = degrees_from_reversal(point) <= masked_deg;
            (masked ? near : away).add(row, point.deviation_mm, point.weight);
        }
    RowFit all = away;
    all.add_all_of(near);
    model.solution = all.solve();
    model.masked = false;
    LinearSolution robust = away.solve();
    if (robust.rank == model.solution.rank && robust.rows > robust.rank) {
        Zones zones;
        for (const SeenTrace& trace : traces)
            for (const SeenPoint& point : trace.points) {
                if (degrees_from_reversal(point) > masked_deg) continue;
                make_row(model, point.aspect, circle, row);
                zones.add(point, point.weight * (point.deviation_mm - product(row, robust.value)));
            }
        const double negligible = 1e-12 * circle.R;
        model.masked = zones.largest_rms() > std::max(spiky * scatter_of(robust), negligible);
    }
    if (model.masked) model.solution = std::move(robust);
    model.rms_mm = scatter_of(model.solution);
}

/// Takes amplitude, phase and pitch of each periodic error from the solution.
/// @returns largest change of phase at the end of the travel, rad
double take_cyclic(Decomposition& model, const Circle& circle) {
    double change = 0;
    std::size_t column = model.causes.size();
    for (CyclicError& cyclic : model.cyclic) {
        const double a = model.solution.value[column], b = model.solution.value[column + 1];
        const double amplitude = length_in_plane(a, b);
        const double resolution = std::numbers::pi / (2 * circle.R);
        const double turn =
            std::clamp(model.solution.value[column + 2], -resolution / 2, resolution / 2);
        const double k = 2 * std::numbers::pi / cyclic.pitch_mm;
        const auto& covariance = model.solution.covariance;
        const double spread = covariance.empty() ? 0
                                                 : a * a * covariance[column][column] +
                                                       2 * a * b * covariance[column][column + 1] +
                                                       b * b * covariance[column + 1][column + 1];
        const double uk = model.solution.standard_uncertainty(column + 2);
        cyclic.amplitude_mm = amplitude;
        cyclic.phase_rad = std::atan2(-b, a);
        cyclic.pitch_mm = 2 * std::numbers::pi / (k + turn);
        cyclic.pitch_standard_uncertainty_mm = cyclic.pitch_mm * uk / k;
        cyclic.amplitude_standard_uncertainty_mm =
            amplitude > 0 ? std::sqrt(std::max(spread, 0.0)) / amplitude : 0;
        change = std::max(change, std::fabs(turn) * circle.R);
        column += columns_a_cyclic;
    }
    return change;
}

void refine(Decomposition& model, const std::vector<SeenTrace>& traces, const Circle& circle) {
    constexpr int most = 20; // quadratic from within a sixth of the resolution: five do
    for (int i = 0; i < most; ++i) {
        fit_linear(model, traces, circle);
        if (take_cyclic(model, circle) < 1e-9) break;
    }
    fit_linear(model, traces, circle);
    take_cyclic(model, circle);
}

std::optional<CyclicError>
strongest(const Decomposition& model, const std::vector<SeenTrace>& traces, const Circle& circle) {
    const auto left = residuals_of(model, traces, circle.R, circle.F);
    const ResidualScale scale = scale_of(left, circle.R);
    std::optional<CyclicError> best;
    for (const int axis : {0, 1}) {
        if (std::ranges::find(model.cyclic, axis, &CyclicError::axis) != model.cyclic.end())
            continue;
        const auto found = search_cyclic(left, axis, circle.R, scale);
        if (found && (!best || found->amplitude_mm > best->amplitude_mm)) best = found;
    }
    return best;
}

} // namespace

double Decomposition::value_of(Cause cause) const {
    const auto found = std::ranges::find(causes, cause);
    return found == causes.end() ? 0
                                 : solution.value[static_cast<std::size_t>(found - causes.begin())];
}

double effect_of(const CyclicError& cyclic, const Aspect& at, double nominal_radius_mm) {
    const double w = cyclic.axis == 0 ? at.cosine : at.sine;
    return cyclic.amplitude_mm * w *
           std::cos(2 * std::numbers::pi * nominal_radius_mm * w / cyclic.pitch_mm +
                    cyclic.phase_rad);
}

Decomposition
decompose(const std::vector<SeenTrace>& traces, double nominal_radius_mm, double feed_mm_per_s) {
    const Circle circle{nominal_radius_mm, feed_mm_per_s};
    Decomposition model;
    model.causes = causes_of(traces);
    fit_linear(model, traces, circle);
    for (int axis = 0; axis < 2; ++axis) {
        const auto found = strongest(model, traces, circle);
        if (!found) break;
        model.cyclic.push_back(*found);
        refine(model, traces, circle);
    }
    return model;
}

std::vector<ResidualTrace> residuals_of(const Decomposition& fitted,
                                        const std::vector<SeenTrace>& traces,
                                        double nominal_radius_mm,
                                        double feed_mm_per_s) {
    const double backlash_x = fitted.value_of(Cause::backlash_x);
    const double backlash_y = fitted.value_of(Cause::backlash_y);
    std::vector<ResidualTrace> out;
    for (const SeenTrace& trace : traces) {
        ResidualTrace left;
        left.trace = &trace;
        left.backlash_mm = {backlash_x, backlash_y};
        for (const SeenPoint& point : trace.points) {
            const auto effects = effects_at(point.aspect, nominal_radius_mm, feed_mm_per_s);
            double residual = point.deviation_mm;
            for (std::size_t i = 0; i < fitted.causes.size(); ++i)
                residual -=
                    fitted.solution.value[i] * effects[static_cast<std::size_t>(fitted.causes[i])];
            for (const CyclicError& cyclic : fitted.cyclic)
                residual -= effect_of(cyclic, point.aspect, nominal_radius_mm);
            left.residual_mm.push_back(residual);
        }
        out.push_back(std::move(left));
    }
    return out;
}

} // namespace axiscal::circular
