#include "acquisition/console/so_far_json.hpp"

#include "acquisition/console/optional_json.hpp"

#include <utility>

namespace axiscal {
namespace {

nlohmann::ordered_json side_json(const SideSoFar& side) {
    return {{"points", side.points},
            {"mean_um", or_null(side.mean_um)},
            {"low_um", or_null(side.low_um)},
            {"high_um", or_null(side.high_um)}};
}

} // namespace

nlohmann::ordered_json to_json(const FiguresSoFar& so_far) {
    auto figures = nlohmann::ordered_json::array(), limits = figures;
    for (const NamedFigure& figure : so_far.figures)
        figures.push_back({{"parameter", figure.name}, {"value_um", figure.value}});
    for (const LimitSoFar& limit : so_far.limits)
        limits.push_back({{"parameter", limit.parameter},
                          {"limit_um", or_null(limit.limit_um)},
                          {"value_um", or_null(limit.value_um)},
                          {"standing", name_of(limit.standing)},
                          {"sentence", limit.sentence}});
    return {{"standing", name_of(so_far.standing)},
            {"sentence", so_far.sentence},
            {"basis", so_far.basis},
            {"points_per_target", so_far.points_per_target},
            {"deviation_range_um", or_null(so_far.deviation_range_um)},
            {"reversal_max_um", or_null(so_far.reversal_max_um)},
            {"standard", so_far.standard},
            {"figures", so_far.figures.empty() ? nlohmann::ordered_json(nullptr)
                                               : nlohmann::ordered_json(std::move(figures))},
            {"limits", std::move(limits)}};
}

nlohmann::ordered_json target_json(int index, const TargetSoFar& target) {
    return {{"target", index},
            {"nominal_mm", target.nominal_mm},
            {"positive", side_json(target.positive)},
            {"negative", side_json(target.negative)}};
}

} // namespace axiscal
