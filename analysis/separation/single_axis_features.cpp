#include "analysis/separation/single_axis_features.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace axiscal {
namespace {

std::string name_of(std::size_t direction, std::size_t axis) {
    return {static_cast<char>('x' + direction), static_cast<char>('x' + axis)};
}

Result<void>
check_list(const std::vector<double>& list, std::size_t count, const std::string& field) {
    if (list.size() != count)
        return refuse(Fault::bad_case, field,
                      "must have as many numbers as nominal_mm, " + std::to_string(count));
    for (std::size_t i = 0; i < count; ++i)
        AXISCAL_CHECK(check_number(list[i], field + "[" + std::to_string(i) + "]"));
    return {};
}

/// Positions of the moving axis; empty where they are not known.
const std::vector<double>& travel_of(const SingleAxisFeature& feature) {
    const auto& stated = feature.positions_mm[feature.axis];
    return stated.empty() && feature.axis == feature.direction ? feature.nominal_mm : stated;
}

bool moves(const std::vector<double>& positions) {
    return !positions.empty() &&
           std::ranges::any_of(positions, [&](double q) { return q != positions.front(); });
}

class Solver {
public:
    Solver(const std::vector<SingleAxisFeature>& features,
           const std::vector<std::vector<double>>& deviations_um,
           const SeparationModel& model)
        : features_{features}
        , deviations_um_{deviations_um}
        , model_{model} {}

    void solve(std::size_t direction, std::size_t axis) {
        std::vector<std::size_t> chosen;
        for (std::size_t i = 0; i < features_.size(); ++i)
            if (features_[i].direction == direction && features_[i].axis == axis)
                chosen.push_back(i);
        if (chosen.empty()) return;
        std::string reason = obstacle(chosen);
        if (reason.empty()) reason = fit(chosen, direction, axis);
        if (!reason.empty()) found_.not_evaluated[name_of(direction, axis)] = std::move(reason);
    }
    [[nodiscard]] FeatureCurves& found() { return found_; }

private:
    [[nodiscard]] std::string obstacle(const std::vector<std::size_t>& chosen) const {
        for (const std::size_t i : chosen) {
            const auto& feature = features_[i];
            if (travel_of(feature).empty())
                return "positions of the moving axis are not stated (positions_mm)";
            for (std::size_t other = 0; other < 3; ++other)
                if (other != feature.axis && moves(feature.positions_mm[other]) &&
                    !found_.curves[feature.direction][other])
                    return "another axis moved too, and " + name_of(feature.direction, other) +
                           " is not solved before";
        }
        return {};
    }

    /// The reading without what the other axes that moved contributed.
    [[nodiscard]] double own_share(std::size_t feature_index, std::size_t reading) const {
        const auto& feature = features_[feature_index];
        double value = deviations_um_[feature_index][reading];
        for (std::size_t other = 0; other < 3; ++other) {
            if (other == feature.axis || !moves(feature.positions_mm[other])) continue;
            value -= model_.signs[feature.direction][other] *
                     curve_at(found_.curves[feature.direction][other]->coefficients_um,
                              model_.ranges_mm[other], model_.reference_mm[other],
                              feature.positions_mm[other][reading]);
        }
        return value;
    }

    /// Calls use(row, value) for each reading; the row has `order` terms and a constant a feature.
    template <class Use>
    void each_reading(const std::vector<std::size_t>& chosen,
                      std::size_t direction,
                      std::size_t axis,
                      Use use) const {
        const std::size_t order = model_.orders[direction][axis];
        std::vector<double> here(order + 1), there(order + 1), row(order + chosen.size());
        second_kind(model_.ranges_mm[axis].normalised(model_.reference_mm[axis]), there);
        for (std::size_t c = 0; c < chosen.size(); ++c) {
            std::ranges::fill(row, 0.0);
            row[order + c] = 1;
            const auto& travel = travel_of(features_[chosen[c]]);
            for (std::size_t i = 0; i < travel.size(); ++i) {
                second_kind(model_.ranges_mm[axis].normalised(travel[i]), here);
                for (std::size_t k = 0; k < order; ++k)
                    row[k] = model_.signs[direction][axis] * (here[k + 1] - there[k + 1]);
                use(std::span<const double>{row}, own_share(chosen[c], i));
            }
        }
    }

    /// Fits and keeps the curve, or says why it cannot be.
    std::string
    fit(const std::vector<std::size_t>& chosen, std::size_t direction, std::size_t axis) {
        const std::size_t order = model_.orders[direction][axis];
        if (order == 0) return "its order is 0";
        TriangleOfRows rows{order + chosen.size()};
        each_reading(chosen, direction, axis,
                     [&](std::span<const double> row, double value) { rows.add(row, value); });
        const Triangle triangle = rows.finish();
        const MinimumNormSolution solution = solve_minimum_norm(triangle);
        if (solution.rank < order + chosen.size())
            return "order " + std::to_string(order) + " needs more distinct positions";
        double squares = 0;
        each_reading(chosen, direction, axis, [&](std::span<const double> row, double value) {
            const double residual = value - dot(row, solution.coefficients);
            squares += residual * residual;
        });
        const std::size_t freedom = triangle.rows - solution.rank;
        FeatureCurve curve;
        curve.readings = triangle.rows;
        curve.residual_rms_um = std::sqrt(squares / static_cast<double>(triangle.rows));
        for (std::size_t k = 0; k < order; ++k) {
            curve.coefficients_um.push_back(solution.coefficients[k]);
            if (freedom > 0)
                curve.uncertainty_um.push_back(std::sqrt(squares / static_cast<double>(freedom) *
                                                         solution.inverse_normal(k, k)));
        }
        found_.curves[direction][axis] = std::move(curve);
        return {};
    }

    const std::vector<SingleAxisFeature>& features_;
    const std::vector<std::vector<double>>& deviations_um_;
    const SeparationModel& model_;
    FeatureCurves found_;
};

} // namespace

Result<FeatureDeviations> deviations_of(const SingleAxisFeature& feature,
                                        const std::string& field) {
    const std::size_t count = feature.nominal_mm.size();
    if (count == 0) return refuse(Fault::bad_case, field + ".nominal_mm", "is empty");
    AXISCAL_CHECK(check_list(feature.nominal_mm, count, field + ".nominal_mm"));
    AXISCAL_CHECK(check_list(feature.on_machine_mm, count, field + ".on_machine_mm"));
    AXISCAL_CHECK(check_list(feature.cmm_mm, count, field + ".cmm_mm"));
    for (const auto& positions : feature.positions_mm)
        if (!positions.empty())
            AXISCAL_CHECK(check_list(positions, count, field + ".positions_mm"));
    FeatureDeviations result;
    for (std::size_t i = 0; i < count; ++i) {
        const double dynamic = 1000 * (feature.on_machine_mm[i] - feature.nominal_mm[i]);
        const double total = 1000 * (feature.cmm_mm[i] - feature.nominal_mm[i]);
        result.dynamic_um.push_back(dynamic);
        result.total_um.push_back(total);
        result.quasi_static_um.push_back(total - dynamic);
    }
    return result;
}

Result<FeatureCurves> solve_features(const std::vector<SingleAxisFeature>& features,
                                     const std::vector<std::vector<double>>& deviations_um,
                                     const SeparationModel& model) {
    AXISCAL_CHECK(check_model(model));
    for (std::size_t i = 0; i < features.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto& positions =
                axis == features[i].axis ? travel_of(features[i]) : features[i].positions_mm[axis];
            for (const double q : positions)
                if (!model.ranges_mm[axis].holds(q))
                    return refuse(Fault::bad_case, "features[" + std::to_string(i) + "]",
                                  std::string{"has a position outside ranges_mm."} +
                                      static_cast<char>('x' + axis));
        }
    Solver solver{features, deviations_um, model};
    constexpr std::array<std::pair<std::size_t, std::size_t>, 9> order_of_solution{
        {{0, 0}, {1, 1}, {1, 0}, {0, 1}, {2, 0}, {2, 1}, {0, 2}, {1, 2}, {2, 2}}};
    for (const auto& [direction, axis] : order_of_solution)
        solver.solve(direction, axis);
    return std::move(solver.found());
}

} // namespace axiscal
