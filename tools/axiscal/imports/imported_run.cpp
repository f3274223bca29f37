#include "tools/axiscal/imports/imported_run.hpp"

#include "analysis/quantity/valid_text.hpp"
#include "config/version.hpp"
#include "tools/axiscal/imports/import_map.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace axiscal {
namespace {

using CaseJson = nlohmann::json;

constexpr const char* datum_id = "imported";

struct Cell {
    int target = 0, approach = 0;
    Direction direction = Direction::positive;
};

/// Forward along the targets, then backward, approach by approach.
std::vector<Cell> cells_of(int targets, int approaches, bool both) {
    std::vector<Cell> cells;
    for (int j = 0; j < approaches; ++j) {
        for (int i = 0; i < targets; ++i)
            cells.push_back({i, j, Direction::positive});
        for (int i = targets - 1; both && i >= 0; --i)
            cells.push_back({i, j, Direction::negative});
    }
    return cells;
}

std::string text_in(const CaseJson& document, const char* key) {
    const auto found = document.find(key);
    return found != document.end() && found->is_string() ? valid_text(found->get<std::string>())
                                                         : std::string{};
}

RunPlan plan_of(const CaseJson& document, const std::vector<Cell>& cells) {
    RunPlan plan;
    const CaseJson& axis = document.at("axis");
    plan.axis_kind = axis.at("kind") == "rotary" ? AxisKind::rotary : AxisKind::linear;
    const std::string unit = document.contains("target_unit")
                                 ? document.at("target_unit").get<std::string>()
                                 : document.at("unit").get<std::string>();
    for (const CaseJson& target : document.at("targets"))
        plan.targets.push_back(mm(target.get<double>() * millimetres_in(unit)));
    plan.approaches = static_cast<int>(document.at("forward").at(0).size());
    plan.bidirectional = document.contains("backward");
    int step = 0;
    for (const Cell& cell : cells)
        plan.points.push_back({step++, cell.target, cell.direction, cell.approach});
    return plan;
}

Statements statements_of(const CaseJson& document) {
    Statements said;
    said.axis = valid_text(document.at("axis").at("name").get<std::string>());
    said.customer = text_in(document, "customer");
    said.next_due = "none"; // nobody here knows when it was measured
    said.machine = text_in(document, "machine");
    said.operator_name = text_in(document, "operator");
    said.place = text_in(document, "place");
    return said;
}

/// In mm, or degrees.
double deviation_in(const CaseJson& document, const Cell& cell) {
    const CaseJson& rows =
        document.at(cell.direction == Direction::positive ? "forward" : "backward");
    const auto i = static_cast<std::size_t>(cell.target);
    const double reading = rows.at(i).at(static_cast<std::size_t>(cell.approach)).get<double>();
    const double scale = millimetres_in(document.at("unit").get<std::string>());
    if (document.at("readings") == "deviations") return reading * scale;
    return (reading - document.at("targets").at(i).get<double>()) * scale;
}

Result<void> check_positioning(const CaseJson& document) {
    if (document.value("analysis", "") != "positioning")
        return refuse(Fault::bad_case, "analysis", "is not of positioning: it becomes no run");
    for (const char* key :
         {"reference_angles", "uncertainty", "tolerances", "polygon", "indexing_table"})
        if (document.contains(key))
            return refuse(Fault::bad_case, key,
                          "is not taken into a run: axiscal analyze evaluates it");
    const std::size_t n = document.at("forward").at(0).size();
    for (const char* key : {"forward", "backward"}) {
        if (!document.contains(key)) continue;
        for (const CaseJson& row : document.at(key)) {
            const bool whole = row.size() == n && std::ranges::all_of(row, [](const CaseJson& one) {
                                   return one.is_number();
                               });
            if (!whole)
                return refuse(Fault::bad_case, key, "lacks a reading: a run holds each of them");
        }
    }
    return {};
}

DatumRecord datum_at(MonotonicTime at) {
    DatumRecord datum;
    datum.id = datum_id;
    datum.at = at;
    return datum;
}

} // namespace

Result<RunRecord>
imported_run(const nlohmann::json& document, ImportedReadings imported, const ClockTie& now) {
    AXISCAL_CHECK(check_positioning(document));
    const auto cells = cells_of(static_cast<int>(document.at("targets").size()),
                                static_cast<int>(document.at("forward").at(0).size()),
                                document.contains("backward"));
    RunRecord run;
    run.statements = statements_of(document);
    constexpr std::size_t digits = 12, longest_axis = 15;
    run.run_id = "imported-" + imported.sha256.substr(0, digits) + "-" +
                 id_of_name(run.statements.axis, "axis", longest_axis);
    run.software_version = software_version();
    run.station = "imported";
    run.opened = run.closed = now;
    run.complete = true;
    run.closing_reason = "Imported, readings by others.";
    run.plan = plan_of(document, cells);
    run.standards = {document.at("standard").get<std::string>()};
    imported.measured = text_in(document, "date");
    imported.remark = valid_text(imported.remark);
    run.imported = std::move(imported);
    run.datums.push_back(datum_at(now.after));
    for (std::size_t k = 0; k < cells.size(); ++k) {
        PointRecord point;
        point.step = static_cast<int>(k);
        point.planned = run.plan.points[k];
        point.origin = TriggerOrigin::manual;
        point.triggered_at = point.window_begin = point.window_end =
            now.after + std::chrono::seconds{static_cast<long>(k) + 1};
        point.reading = mm(deviation_in(document, cells[k]));
        point.n = 1;
        point.datum_id = datum_id;
        run.points.push_back(std::move(point));
    }
    return run;
}

} // namespace axiscal
