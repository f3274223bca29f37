#include "analysis/positioning/figures_so_far.hpp"

#include "analysis/conformity/conformity.hpp"
#include "analysis/positioning/chosen_standards.hpp"
#include "analysis/positioning/sums.hpp"
#include "analysis/quantity/counted.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <utility>

namespace axiscal {
namespace {

constexpr double um_per_mm = 1000; // and 0.001 deg in a degree
constexpr double bounds_cover = 2; // what is drawn: mean - 2 s to mean + 2 s
constexpr const char* as_shown = "as shown at the machine";

/// Deviations in mm, by target and direction.
using Rows = std::vector<std::vector<double>>;
struct Sides {
    Rows positive, negative;
};

Sides sides_of(const RunPlan& plan, const std::vector<ShownReading>& readings) {
    Sides sides{Rows(plan.targets.size()), Rows(plan.targets.size())};
    for (const ShownReading& reading : readings) {
        Rows& rows =
            reading.planned.direction == Direction::positive ? sides.positive : sides.negative;
        rows[static_cast<std::size_t>(reading.planned.target_index)].push_back(
            reading.deviation.in(mm));
    }
    return sides;
}

int fewest_of(const Rows& rows) {
    const auto least = std::ranges::min_element(rows, {}, &Rows::value_type::size);
    return least == rows.end() ? 0 : static_cast<int>(least->size());
}

int fewest_of(const Sides& sides, const RunPlan& plan) {
    const int fewest = fewest_of(sides.positive);
    return plan.bidirectional ? std::min(fewest, fewest_of(sides.negative)) : fewest;
}

/// A standard deviation needs two; where one was planned, one.
int points_needed(const RunPlan& plan) {
    return std::min(plan.approaches, 2);
}

std::string_view unit_of(const RunPlan& plan) {
    return plan.axis_kind == AxisKind::rotary ? "deg" : "mm";
}

SideSoFar side_of(const PositionRow& row, std::size_t points) {
    SideSoFar side;
    side.points = static_cast<int>(points);
    side.mean_um = row.mean_forward * um_per_mm;
    if (!row.s_forward) return side;
    const double reach = bounds_cover * *row.s_forward;
    side.low_um = (row.mean_forward - reach) * um_per_mm;
    side.high_um = (row.mean_forward + reach) * um_per_mm;
    return side;
}

/// Evaluated as a run in one direction over the targets that have points there: its means and s are
/// those of the figures.
std::vector<SideSoFar> sides_so_far(const RunPlan& plan, const Rows& rows) {
    std::vector<SideSoFar> sides(rows.size());
    DeviationTable table;
    std::vector<std::size_t> measured;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].empty()) continue;
        measured.push_back(i);
        table.targets.push_back(plan.targets[i].in(mm));
        table.forward.push_back(rows[i]);
    }
    const auto run = declare_at_20C(std::move(table), as_shown, RowLengths::any);
    if (!run) return sides; // nothing measured yet
    const PositioningResult result = evaluate_positioning(*run);
    for (std::size_t k = 0; k < measured.size(); ++k)
        sides[measured[k]] = side_of(result.positions[k], rows[measured[k]].size());
    return sides;
}

std::vector<TargetSoFar> targets_of(const RunPlan& plan, const Sides& sides) {
    const std::vector<SideSoFar> positive = sides_so_far(plan, sides.positive);
    const std::vector<SideSoFar> negative = sides_so_far(plan, sides.negative);
    std::vector<TargetSoFar> targets;
    for (std::size_t i = 0; i < plan.targets.size(); ++i)
        targets.push_back({plan.targets[i].in(mm), positive[i], negative[i]});
    return targets;
}

std::optional<double> range_of(const std::vector<ShownReading>& readings) {
    Span span;
    for (const ShownReading& reading : readings)
        span.include(reading.deviation.in(um));
    return span.empty() ? std::nullopt : std::optional{span.width()};
}

std::optional<double> largest_reversal(const std::vector<TargetSoFar>& targets) {
    std::optional<double> largest;
    for (const TargetSoFar& target : targets)
        if (target.positive.mean_um && target.negative.mean_um)
            largest = std::max(largest.value_or(0),
                               std::fabs(*target.positive.mean_um - *target.negative.mean_um));
    return largest;
}

// ---- figures and limits ---------------------------------------------------------

/// In mm or degrees; of names that stand in several standards the first.
NamedFigures figures_of(const RunAt20C& run, const ChosenStandards& chosen) {
    const PositioningStandard& own = *chosen.own;
    NamedFigures figures = named_figures(
        evaluate_positioning(run, std::string{own.name}, own.cover_factor).parameters);
    for (const PositioningStandard* other : chosen.others)
        for (NamedFigure& figure : evaluate_other(*other, run).parameters)
            if (std::ranges::find(figures, figure.name, &NamedFigure::name) == figures.end())
                figures.push_back(std::move(figure));
    return figures;
}

NamedFigures evaluated(const RunPlan& plan, Sides sides, const ChosenStandards& chosen) {
    if (fewest_of(sides, plan) < points_needed(plan)) return {};
    DeviationTable table;
    for (const Length target : plan.targets)
        table.targets.push_back(target.in(mm));
    table.forward = std::move(sides.positive);
    if (plan.bidirectional) table.backward = std::move(sides.negative);
    table.unit = unit_of(plan);
    const auto run = declare_at_20C(std::move(table), as_shown, RowLengths::any);
    return run ? figures_of(*run, chosen) : NamedFigures{};
}

/// Travel of the band that a limit holds for, as a certificate takes it.
double travel_of(const RunPlan& plan) {
    const auto [low, high] = std::ranges::minmax(plan.targets);
    return (high - low).in(mm);
}

/// A value and its limit in so many digits that they differ where the numbers do.
std::string value_of_limit(double value, double limit) {
    std::array<char, 64> text{};
    for (int digits = 1; digits <= 4; ++digits) {
        std::snprintf(text.data(), text.size(), "%.*f of %.*f", digits, value, digits, limit);
        const double step = std::pow(10, -digits);
        if (std::fabs(value - limit) >= step || value == limit) break;
    }
    return text.data();
}

double limits_per_unit(std::string_view of_limits, std::string_view unit) {
    if (of_limits == unit) return 1;
    return unit == "deg" ? 3600 : um_per_mm; // limits in "arcsec" or "um"
}

std::string points_are_needed(const RunPlan& plan) {
    return "each target needs " + counted(points_needed(plan), "point") +
           (plan.bidirectional ? " in each direction" : "");
}

LimitSoFar limit_so_far(const JudgedFigure& judged, const Conformity& agreed) {
    const double per_unit = limits_per_unit(agreed.agreed.unit, agreed.unit);
    LimitSoFar limit;
    limit.parameter = judged.parameter;
    if (judged.limit) limit.limit_um = *judged.limit * um_per_mm;
    if (judged.value) limit.value_um = *judged.value * um_per_mm;
    if (judged.comparison.empty()) {
        limit.sentence = judged.parameter + " not judged so far: " + judged.reason;
        return limit;
    }
    limit.standing = judged.comparison == "within_limit" ? Standing::inside : Standing::outside;
    limit.sentence = judged.parameter + " " +
                     value_of_limit(std::fabs(*judged.value) * per_unit, *judged.limit * per_unit) +
                     " " + agreed.agreed.unit + " so far";
    return limit;
}

/// `figures` in mm or degrees. No rule decides here, and no U is known: only which is larger.
std::vector<LimitSoFar> limits_of(const RunRecord& header, const NamedFigures& figures) {
    std::optional<ToleranceRecord> agreed = header.tolerances;
    if (!agreed || header.plan.targets.empty()) return {};
    agreed->rule = DecisionRule::none;
    std::vector<FigureToJudge> to_judge;
    for (const NamedFigure& figure : figures)
        to_judge.push_back({figure.name, figure.value, {}});
    auto judged =
        conformity_of(agreed, to_judge, std::string{unit_of(header.plan)}, travel_of(header.plan));
    std::vector<LimitSoFar> limits;
    for (JudgedFigure& figure : judged->figures) {
        if (figures.empty()) figure.reason = points_are_needed(header.plan);
        limits.push_back(limit_so_far(figure, *judged));
    }
    return limits;
}

// ---- what is said of the whole ------------------------------------------------------

std::string list_of(const std::vector<LimitSoFar>& limits, Standing standing) {
    constexpr std::string_view so_far = " so far";
    std::string text;
    for (const LimitSoFar& limit : limits) {
        if (limit.standing != standing) continue;
        const std::string& told = limit.sentence;
        text += (text.empty() ? "" : ", ") + told.substr(0, told.size() - so_far.size());
    }
    return text;
}

void judge_whole(FiguresSoFar& shown, const RunPlan& plan) {
    const auto& limits = shown.limits;
    const auto inside = std::ranges::count(limits, Standing::inside, &LimitSoFar::standing);
    const std::string outside = list_of(limits, Standing::outside);
    if (!outside.empty()) {
        shown.standing = Standing::outside;
        shown.sentence = "So far already outside: " + outside + ".";
    } else if (limits.empty()) {
        shown.sentence = "So far not judged: no limits were agreed on.";
    } else if (shown.figures.empty()) {
        shown.sentence = "So far not judged: " + points_are_needed(plan) + ".";
    } else if (inside == std::ssize(limits)) {
        shown.standing = Standing::inside;
        shown.sentence = "So far inside the limits.";
    } else {
        shown.sentence = "So far inside " + std::to_string(inside) + " of " +
                         counted(static_cast<long>(limits.size()), "limit") +
                         "; the others are not judged.";
    }
}

std::string what_was_measured(const RunRecord& header) {
    if (header.rotary && header.rotary->method == AngleMethod::polygon)
        return "angles as they were read before the polygon, not brought to 20 °C";
    if (header.rotary)
        return "angles by the index of air at the moment of each point, not brought to 20 °C";
    if (header.scale)
        return "lengths at 20 °C by the temperatures of machine and scale at the moment of each "
               "point";
    return "lengths at 20 °C by the air and the material temperature at the moment of each point, "
           "without dead path and cosine error";
}

} // namespace

std::string_view name_of(Standing standing) {
    switch (standing) {
    case Standing::inside: return "inside";
    case Standing::outside: return "outside";
    case Standing::not_judged: return "not judged";
    }
    return "not judged";
}

FiguresSoFar figures_so_far(const RunRecord& header, const std::vector<ShownReading>& readings) {
    const RunPlan& plan = header.plan;
    Sides sides = sides_of(plan, readings);
    FiguresSoFar shown;
    shown.targets = targets_of(plan, sides);
    shown.points_per_target = fewest_of(sides, plan);
    shown.deviation_range_um = range_of(readings);
    shown.reversal_max_um = largest_reversal(shown.targets);
    shown.basis = std::string{as_shown} + ": " + what_was_measured(header) +
                  ", without U; the certificate computes anew from the run file";
    NamedFigures figures;
    if (const auto chosen = chosen_standards(header.standards)) {
        shown.standard = chosen->own->name;
        figures = evaluated(plan, std::move(sides), *chosen);
    }
    shown.limits = limits_of(header, figures);
    for (NamedFigure& figure : figures)
        figure.value *= um_per_mm;
    shown.figures = std::move(figures);
    judge_whole(shown, plan);
    return shown;
}

} // namespace axiscal
