#include "analysis/uncertainty/session_model.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace axiscal {
namespace {

void add_rows(SessionModel& model,
              const std::vector<std::vector<double>>& rows,
              bool forward,
              const PositioningResult& result) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const PositionRow& row = result.positions[i];
        const double mean = forward ? row.mean_forward : row.mean_backward.value_or(0);
        model.mean.push_back(mean);
        for (const double reading : rows[i])
            model.residual.push_back(reading - mean);
    }
}

/// Share of the length at which each target lies, from the lowest one.
std::vector<double> shape_of(const std::vector<double>& targets, double length) {
    const auto [low, high] = std::ranges::minmax(targets);
    const double whole = length > 0 ? length : high - low;
    std::vector<double> shape;
    shape.reserve(targets.size());
    for (const double target : targets)
        shape.push_back(whole > 0 ? (target - low) / whole : 0);
    return shape;
}

} // namespace

std::size_t number_of_readings(const RunAt20C& run) {
    const std::size_t directions = run.backward().empty() ? 1 : 2;
    return directions * run.targets().size() * run.forward().front().size();
}

Result<void> check_equal_rows(const RunAt20C& run) {
    const std::size_t n = run.forward().front().size();
    for (const auto* side : {&run.forward(), &run.backward()})
        if (std::ranges::any_of(*side, [n](const auto& row) { return row.size() != n; }))
            return refuse(Fault::bad_case, "readings",
                          "differ in number between targets: a simulation draws the same n");
    return {};
}

SessionModel session_model_of(const RunAt20C& run, const PositioningResult& result, double length) {
    SessionModel model;
    model.targets = run.targets().size();
    model.approaches = run.forward().front().size();
    model.cover_factor = result.cover_factor;
    add_rows(model, run.forward(), true, result);
    if (run.backward().empty())
        add_rows(model, run.forward(), true, result);
    else
        add_rows(model, run.backward(), false, result);
    model.shape = shape_of(run.targets(), length);
    return model;
}

double factor_of_draw(double u, Distribution distribution) {
    return distribution == Distribution::normal ? u : u * std::sqrt(12.0);
}

EvaluatedFigures evaluated_figures(const PositioningParameters& p) {
    const std::array<std::optional<double>, figure_count> figures{
        p.A, p.A_forward, p.A_backward, p.E,          p.E_forward, p.E_backward,
        p.M, p.R,         p.R_forward,  p.R_backward, p.B,         p.B_mean};
    EvaluatedFigures evaluated;
    for (std::size_t f = 0; f < figure_count; ++f) {
        if (figures[f]) evaluated.present.push_back(f);
        evaluated.values[f] = figures[f].value_or(0);
    }
    return evaluated;
}

} // namespace axiscal
