#include "analysis/straightness/straightness_figures.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

namespace axiscal {
namespace {

constexpr double um_a_mm = 1000;

/// A deviation across the axis does not grow with the axis, and its own growth is below 1e-4 of
/// itself.
Result<RunAt20C> declared(const StraightnessReadings& readings, RowLengths rows) {
    return declare_at_20C({readings.targets_mm, readings.forward_um, readings.backward_um, "um"},
                          "deviations across the axis do not expand with it", rows);
}

StraightnessRow row_of(const PositionRow& position) {
    StraightnessRow row;
    row.target_mm = position.target;
    row.mean_forward_um = position.mean_forward;
    row.mean_backward_um = position.mean_backward;
    row.mean_um = position.mean;
    row.reversal_um = position.reversal;
    row.s_forward_um = position.s_forward;
    row.s_backward_um = position.s_backward;
    return row;
}

template <class MeanOf>
Result<StraightnessLine> line_of(const std::vector<StraightnessRow>& rows, MeanOf mean_of_row) {
    MeasuredLine line;
    for (const StraightnessRow& row : rows) {
        line.positions.push_back(row.target_mm * um_a_mm);
        line.deviations.push_back(mean_of_row(row));
    }
    AXISCAL_TRY(Straightness against, straightness_of(line));
    return StraightnessLine{std::move(line), std::move(against)};
}

/// Sum over rows of (n - 1) s^2 and of n - 1.
struct Scatter {
    double squares = 0, degrees = 0;
    void add(const std::optional<double>& s, std::size_t readings) {
        if (!s) return;
        const auto free = static_cast<double>(readings) - 1;
        squares += free * *s * *s;
        degrees += free;
    }
};

std::optional<double> pooled_of(const std::vector<StraightnessRow>& rows,
                                const StraightnessReadings& readings) {
    Scatter scatter;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        scatter.add(rows[i].s_forward_um, readings.forward_um[i].size());
        if (!readings.backward_um.empty())
            scatter.add(rows[i].s_backward_um, readings.backward_um[i].size());
    }
    if (scatter.degrees <= 0) return std::nullopt;
    return std::sqrt(scatter.squares / scatter.degrees);
}

} // namespace

Result<void> draw_lines(StraightnessFigures& figures) {
    AXISCAL_TRY(figures.forward, line_of(figures.rows, [](const StraightnessRow& row) {
                    return row.mean_forward_um;
                }));
    figures.mean = figures.forward;
    if (!figures.rows.front().mean_backward_um) return {};
    AXISCAL_TRY(figures.backward, line_of(figures.rows, [](const StraightnessRow& row) {
                    return row.mean_backward_um.value_or(0);
                }));
    AXISCAL_TRY(figures.mean, line_of(figures.rows, [](const StraightnessRow& row) {
                    return row.mean_um.value_or(row.mean_forward_um);
                }));
    return {};
}

std::string_view name_of(LineReference reference) {
    switch (reference) {
    case LineReference::end_points: return "end_points";
    case LineReference::least_squares: return "least_squares";
    case LineReference::minimum_zone: return "minimum_zone";
    }
    return "?";
}

double StraightnessLine::straightness_um(LineReference reference) const {
    switch (reference) {
    case LineReference::end_points: return against.end_points.straightness;
    case LineReference::least_squares: return against.least_squares.straightness;
    case LineReference::minimum_zone: break;
    }
    return against.minimum_zone.line.straightness;
}

int StraightnessFigures::readings_a_mean() const {
    return backward ? 2 * readings_of_direction() : readings_of_direction();
}

Result<StraightnessFigures> evaluate_straightness(const StraightnessReadings& readings,
                                                  RowLengths rows) {
    AXISCAL_TRY(const RunAt20C run, declared(readings, rows));
    // The scheme of ISO 230-2 gives means, scatter and reversal at each target.
    const PositioningResult found = evaluate_positioning(run, "ISO 230-1:2012");
    StraightnessFigures figures;
    figures.approaches = fewest_readings(run);
    figures.rows.reserve(found.positions.size());
    for (const PositionRow& position : found.positions)
        figures.rows.push_back(row_of(position));
    AXISCAL_CHECK(draw_lines(figures));
    figures.reversal_um = found.parameters.B;
    figures.mean_reversal_um = found.parameters.B_mean;
    figures.repeatability_um = found.parameters.R;
    if (!figures.backward) figures.repeatability_um = found.parameters.R_forward;
    figures.pooled_s_um = pooled_of(figures.rows, readings);
    return figures;
}

} // namespace axiscal
