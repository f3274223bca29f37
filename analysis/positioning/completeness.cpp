#include "analysis/positioning/completeness.hpp"

#include "analysis/record/skipped_step.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

namespace axiscal {
namespace {

constexpr std::array both_directions{Direction::positive, Direction::negative};

/// One planned reading: what became of it.
struct Cell {
    std::optional<double> deviation;
    std::string why; ///< where there is no deviation that a figure may use
};

/// [direction: 0 positive, 1 negative][target][approach]
using Cells = std::array<std::vector<std::vector<Cell>>, 2>;

std::size_t side_of(Direction direction) {
    return direction == Direction::positive ? 0 : 1;
}

std::set<int> skipped_steps_of(const RunRecord& run) {
    std::set<int> steps;
    for (const EventRecord& event : run.events)
        if (const auto step = skipped_step(event)) steps.insert(*step);
    return steps;
}

/// Of readings that nobody asked to skip.
std::string why_missing(const RunRecord& run) {
    std::string reason = run.closing_reason;
    if (reason.ends_with('.')) reason.pop_back();
    return reason.empty() ? "not measured" : "not measured: " + reason;
}

const ExclusionRecord* exclusion_of(const RunRevisions& revisions, const PointRecord& point) {
    const auto found = std::ranges::find(revisions.exclusions, point.step, &ExclusionRecord::step);
    return found == revisions.exclusions.end() ? nullptr : &*found;
}

Cell& cell_of(Cells& cells, const PlannedPoint& point) {
    return cells[side_of(point.direction)][static_cast<std::size_t>(point.target_index)]
                [static_cast<std::size_t>(point.approach)];
}

Cells cells_of(const RunRecord& run,
               const RunRevisions& revisions,
               const std::vector<double>& deviations) {
    Cells cells;
    for (auto& side : cells)
        side.assign(run.plan.targets.size(),
                    std::vector<Cell>(static_cast<std::size_t>(run.plan.approaches)));
    const std::set<int> skipped = skipped_steps_of(run);
    const std::string missing = why_missing(run);
    for (const PlannedPoint& planned : run.plan.points)
        cell_of(cells, planned).why =
            skipped.contains(planned.step) ? "skipped by the CNC" : missing;
    for (std::size_t k = 0; k < run.points.size(); ++k) {
        const PointRecord& point = run.points[k];
        Cell& cell = cell_of(cells, point.planned);
        if (const ExclusionRecord* exclusion = exclusion_of(revisions, point))
            cell.why = "excluded: " + exclusion->reason;
        else
            cell.deviation = deviations[k];
    }
    return cells;
}

int count_of(const std::vector<Cell>& row) {
    return static_cast<int>(
        std::ranges::count_if(row, [](const Cell& cell) { return cell.deviation.has_value(); }));
}

bool has_readings(const Cells& cells, Direction direction, std::size_t target) {
    return count_of(cells[side_of(direction)][target]) > 0;
}

std::vector<int> targets_with(const Cells& cells, const std::vector<Direction>& directions) {
    std::vector<int> found;
    for (std::size_t i = 0; i < cells[0].size(); ++i)
        if (std::ranges::all_of(directions,
                                [&](Direction way) { return has_readings(cells, way, i); }))
            found.push_back(static_cast<int>(i));
    return found;
}

std::vector<double> readings_of(const std::vector<Cell>& row) {
    std::vector<double> readings;
    for (const Cell& cell : row)
        if (cell.deviation) readings.push_back(*cell.deviation);
    return readings;
}

/// Where the target is in no figure, what its other readings lack.
std::string why_unused(Direction lacking) {
    return "its target has no reading in the " + std::string{name_of(lacking)} + " direction";
}

void note_left_out(std::vector<LeftOut>& list,
                   const PlannedPoint& at,
                   const std::string& why,
                   bool target_omitted) {
    auto same = std::ranges::find_if(list.begin(), list.end(), [&](const LeftOut& entry) {
        return entry.target_index == at.target_index && entry.direction == at.direction &&
               entry.why == why;
    });
    if (same == list.end())
        same = list.insert(list.end(), {at.target_index, at.direction, {}, why, target_omitted});
    same->approaches.push_back(at.approach);
}

/// `used_ways`: the directions that figures are made of.
std::vector<LeftOut> left_out_of(const Cells& cells,
                                 const RunPlan& plan,
                                 const std::vector<int>& targets,
                                 const std::vector<Direction>& used_ways) {
    std::vector<LeftOut> list;
    for (int i = 0; i < static_cast<int>(plan.targets.size()); ++i) {
        const bool omitted = !std::ranges::binary_search(targets, i);
        for (const Direction way : both_directions) {
            if (way == Direction::negative && !plan.bidirectional) continue;
            const bool used = !omitted && std::ranges::find(used_ways, way) != used_ways.end();
            const Direction other =
                way == Direction::positive ? Direction::negative : Direction::positive;
            const auto& row = cells[side_of(way)][static_cast<std::size_t>(i)];
            for (int j = 0; j < static_cast<int>(row.size()); ++j) {
                const Cell& cell = row[static_cast<std::size_t>(j)];
                if (cell.deviation && used) continue;
                note_left_out(list, {0, i, way, j}, cell.deviation ? why_unused(other) : cell.why,
                              omitted);
            }
        }
    }
    return list;
}

tl::unexpected<Error> nothing_to_evaluate(const RunRecord& run) {
    return fail(Fault::incomplete_run,
                "no target has a reading" +
                    std::string{run.plan.bidirectional ? " in both directions, and none" : ""} +
                    " in the positive direction: there is nothing to evaluate");
}

/// A run that was closed as complete holds every cell, unless every reading of one is excluded.
Result<void> check_nothing_omitted(const Completeness& completeness) {
    for (const LeftOut& entry : completeness.left_out)
        if (entry.target_omitted)
            return fail(Fault::incomplete_run,
                        "every reading of target " + std::to_string(entry.target_index + 1) + ", " +
                            std::string{name_of(entry.direction)} + " direction, is excluded");
    return {};
}

Result<void> check_point(const RunRecord& run, const PointRecord& point, std::vector<bool>& seen) {
    const std::string step = "step " + std::to_string(point.planned.step + 1);
    const auto place = static_cast<std::size_t>(point.planned.step);
    if (point.planned.step < 0 || place >= run.plan.points.size() ||
        run.plan.points[place] != point.planned)
        return fail(Fault::bad_run_file, step + " is none of the plan");
    if (seen[place]) return fail(Fault::bad_run_file, step + " has two points");
    seen[place] = true;
    if (point.datum_id != run.points.front().datum_id)
        return fail(Fault::datum_lost, step + " was captured under another datum than step " +
                                           std::to_string(run.points.front().planned.step + 1));
    return {};
}

void withhold(PositioningResult& result, const std::vector<const char*>& keys, const char* reason) {
    PositioningParameters& p = result.parameters;
    const std::array<std::optional<double>*, 12> figures{
        &p.A, &p.A_forward, &p.A_backward, &p.E,          &p.E_forward, &p.E_backward,
        &p.M, &p.R,         &p.R_forward,  &p.R_backward, &p.B,         &p.B_mean};
    for (const char* key : keys) {
        const auto at = std::ranges::find(positioning_parameters, std::string_view{key});
        auto& figure = *figures[static_cast<std::size_t>(at - positioning_parameters.begin())];
        if (!figure) continue;
        figure.reset();
        result.not_evaluated[key] = reason;
    }
}

/// "P3 ↓" of the first target and direction with one reading; empty without such.
std::string place_of_single(const RunAt20C& deviations, const Completeness& completeness) {
    for (const Direction way : both_directions) {
        const auto& rows =
            way == Direction::positive ? deviations.forward() : deviations.backward();
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (rows[i].size() == 1) return place_of(completeness.targets[i], way);
    }
    return {};
}

std::string list_of_targets(const std::vector<int>& targets) {
    std::string text;
    for (const int target : targets)
        text += (text.empty() ? "P" : ", P") + std::to_string(target + 1);
    return text;
}

/// "12 not measured: aborted by the operator; 1 excluded: coolant".
std::string reasons_with_counts(const Completeness& completeness) {
    std::vector<std::pair<std::string, std::size_t>> counts;
    for (const LeftOut& entry : completeness.left_out) {
        auto same =
            std::ranges::find(counts, entry.why, &std::pair<std::string, std::size_t>::first);
        if (same == counts.end()) same = counts.insert(counts.end(), {entry.why, 0});
        same->second += entry.approaches.size();
    }
    std::string text;
    for (const auto& [why, count] : counts)
        text += (text.empty() ? "" : "; ") + std::to_string(count) + " " + why;
    return text;
}

} // namespace

Result<UsableReadings> usable_readings(const RunRecord& run,
                                       const RunRevisions& revisions,
                                       const std::vector<double>& deviations,
                                       std::vector<double> targets,
                                       std::string unit) {
    const Cells cells = cells_of(run, revisions, deviations);
    std::vector<Direction> ways{Direction::positive};
    if (run.plan.bidirectional) ways.push_back(Direction::negative);
    std::vector<int> used = targets_with(cells, ways);
    if (used.empty() && !run.complete) {
        ways = {Direction::positive};
        used = targets_with(cells, ways);
    }
    UsableReadings out;
    out.table.unit = std::move(unit);
    for (const int target : used) {
        const auto i = static_cast<std::size_t>(target);
        out.table.targets.push_back(targets[i]);
        out.table.forward.push_back(readings_of(cells[0][i]));
        if (ways.size() > 1) out.table.backward.push_back(readings_of(cells[1][i]));
    }
    Completeness& completeness = out.completeness;
    completeness.complete = run.complete;
    completeness.expected = completeness.used = static_cast<int>(run.plan.points.size());
    completeness.left_out = left_out_of(cells, run.plan, used, ways);
    for (const LeftOut& entry : completeness.left_out)
        completeness.used -= static_cast<int>(entry.approaches.size());
    completeness.targets = std::move(used);
    if (run.complete) AXISCAL_CHECK(check_nothing_omitted(completeness));
    if (completeness.targets.empty()) return nothing_to_evaluate(run);
    return out;
}

Result<void> check_points(const RunRecord& run) {
    if (run.points.empty())
        return fail(Fault::incomplete_run,
                    "the run holds no reading" +
                        (run.closing_reason.empty() ? std::string{} : ": " + run.closing_reason));
    std::vector<bool> seen(run.plan.points.size());
    for (const PointRecord& point : run.points)
        AXISCAL_CHECK(check_point(run, point, seen));
    return {};
}

void withhold_from_partial(PositioningResult& result,
                           const RunAt20C& deviations,
                           const RunPlan& plan,
                           const Completeness& completeness) {
    if (!completeness.partial()) return;
    auto& reasons = result.not_evaluated;
    if (plan.bidirectional && deviations.backward().empty())
        for (const char* key :
             {"A", "A_backward", "E", "E_backward", "M", "R", "R_backward", "B", "B_mean"})
            reasons[key] = "no target has a reading in both directions";
    const std::string single = place_of_single(deviations, completeness);
    if (!single.empty() && plan.approaches > 1)
        for (const char* key : {"A", "A_forward", "A_backward", "R", "R_forward", "R_backward"})
            if (deviations.backward().size() == deviations.forward().size() ||
                std::string_view{key}.ends_with("_forward"))
                reasons[key] = single + " has one reading: no standard deviation, hence no R and "
                                        "no A";
    if (completeness.targets.size() == 1)
        withhold(result, {"A", "A_forward", "A_backward", "E", "E_forward", "E_backward", "M"},
                 "readings of one target alone: there is no range over targets");
}

std::string place_of(int target_index, Direction direction) {
    return "P" + std::to_string(target_index + 1) +
           (direction == Direction::positive ? " ↑" : " ↓");
}

std::vector<std::string> remarks_on_completeness(const RunRecord& run,
                                                 const Completeness& completeness) {
    if (!completeness.partial()) return {};
    std::vector<std::string> remarks{
        "Partial result: " + std::to_string(completeness.used) + " of " +
        std::to_string(completeness.expected) +
        " planned readings. It is no calibration certificate: it bears no certificate number and "
        "no verdict."};
    if (!completeness.left_out.empty())
        remarks.push_back("In no figure: " + reasons_with_counts(completeness) + ".");
    std::vector<int> omitted;
    for (int i = 0; i < static_cast<int>(run.plan.targets.size()); ++i)
        if (!std::ranges::binary_search(completeness.targets, i)) omitted.push_back(i);
    if (!omitted.empty())
        remarks.push_back("Targets in no figure: " + list_of_targets(omitted) + ".");
    return remarks;
}

} // namespace axiscal
