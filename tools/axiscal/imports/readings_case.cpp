#include "tools/axiscal/imports/readings_case.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace axiscal {
namespace {

using Json = nlohmann::json;

tl::unexpected<Error> refuse_pass(const LaserPass& pass, const std::string& reason) {
    return refuse(Fault::bad_case, "line " + std::to_string(pass.line), pass.name + " " + reason);
}

/// By place, whatever order the list of targets has.
Result<bool> rises(const LaserPass& pass, const std::vector<double>& targets) {
    bool up = false, down = false;
    for (std::size_t k = 1; k < pass.order.size(); ++k)
        (targets[pass.order[k]] > targets[pass.order[k - 1]] ? up : down) = true;
    if (up && down) return refuse_pass(pass, "turns within: its targets neither rise nor fall");
    return !down;
}

Result<void> check_whole(const LaserPass& pass) {
    for (std::size_t i = 0; i < pass.readings.size(); ++i)
        if (!pass.readings[i])
            return refuse(Fault::bad_case, "file",
                          pass.name + " has no reading of target " + std::to_string(i + 1));
    return {};
}

/// What the file says of its passes, where their order cannot be that in which they were driven.
std::vector<bool> directions_as_said(LaserReadings& readings) {
    std::vector<bool> forward;
    bool named = true;
    for (const LaserPass& pass : readings.passes) {
        named = named && pass.says_forward.has_value();
        forward.push_back(pass.says_forward.value_or(forward.size() % 2 == 0));
    }
    readings.remarks.push_back(
        std::string{"The file lists every run in the same order of targets, and says that it holds "
                    "both directions. "} +
        (named ? "Each run is taken as it says."
               : "Odd runs are taken as forward, even ones as backward."));
    return forward;
}

void remark_on_other_directions(LaserReadings& readings, const std::vector<bool>& forward) {
    std::string names;
    for (std::size_t i = 0; i < forward.size(); ++i)
        if (const auto said = readings.passes[i].says_forward; said && *said != forward[i])
            names += (names.empty() ? "" : ", ") + readings.passes[i].name;
    if (!names.empty())
        readings.remarks.push_back("The file calls the directions of " + names +
                                   " the other way round than their targets follow each other; the "
                                   "order of the targets counts.");
}

bool says_both(const LaserReadings& readings) {
    bool up = false, down = false;
    for (const LaserPass& pass : readings.passes)
        if (pass.says_forward) (*pass.says_forward ? up : down) = true;
    return readings.says_both_directions || (up && down);
}

/// Whether each pass is forward.
Result<std::vector<bool>> directions_of(LaserReadings& readings) {
    std::vector<bool> forward;
    for (const LaserPass& pass : readings.passes) {
        AXISCAL_CHECK(check_whole(pass));
        if (!readings.order_tells) {
            forward.push_back(pass.says_forward.value_or(true));
            continue;
        }
        AXISCAL_TRY(const bool up, rises(pass, readings.targets));
        forward.push_back(up);
    }
    if (!readings.order_tells) return forward;
    const bool sorted = std::ranges::all_of(forward, [&](bool up) { return up == forward[0]; });
    if (sorted && forward.size() > 1 && says_both(readings)) return directions_as_said(readings);
    remark_on_other_directions(readings, forward);
    if (sorted && forward.size() > 1 && forward[0])
        readings.remarks.emplace_back("All runs go the same way: a test from one side.");
    return forward;
}

/// [target][approach] of the passes of one direction.
Json rows_of(const LaserReadings& readings, const std::vector<bool>& forward, bool wanted) {
    Json rows = Json::array();
    for (std::size_t i = 0; i < readings.targets.size(); ++i) {
        Json row = Json::array();
        for (std::size_t k = 0; k < readings.passes.size(); ++k)
            if (forward[k] == wanted) row.push_back(*readings.passes[k].readings[i]);
        rows.push_back(std::move(row));
    }
    return rows;
}

std::string stated(const LaserReadings& readings, std::string_view key) {
    for (const auto& [name, value] : readings.statements)
        if (name == key) return value;
    return {};
}

} // namespace

Result<Json> case_of_readings(LaserReadings& readings) {
    if (readings.passes.empty() || readings.targets.empty())
        return refuse(Fault::bad_case, "file", "holds no reading");
    AXISCAL_TRY(const std::vector<bool> forward, directions_of(readings));
    const auto up = std::ranges::count(forward, true), down = std::ranges::count(forward, false);
    if (up != down && up > 0 && down > 0)
        return refuse(Fault::bad_case, "file",
                      "has " + std::to_string(up) + " runs forward and " + std::to_string(down) +
                          " backward; a bidirectional test has as many each way");
    const bool linear = readings.kind == AxisKind::linear;
    const std::string axis = stated(readings, "Axis");
    Json out{{"analysis", "positioning"},
             {"standard", "ISO 230-2:2014"},
             {"axis",
              {{"name", axis.empty() ? "unnamed" : axis}, {"kind", linear ? "linear" : "rotary"}}},
             {"unit", readings.unit},
             {"target_unit", readings.target_unit},
             {"readings", readings.positions ? "positions" : "deviations"},
             {"targets", readings.targets}};
    out["forward"] = rows_of(readings, forward, up > 0);
    if (up > 0 && down > 0) out["backward"] = rows_of(readings, forward, false);
    readings.only_backward = up == 0;
    if (up == 0)
        readings.remarks.emplace_back(
            "All runs go backward; they are taken as those of one direction.");
    const std::array<std::pair<const char*, const char*>, 4> kept{
        {{"Machine", "machine"}, {"Date", "date"}, {"By", "operator"}, {"Location", "place"}}};
    for (const auto& [from, to] : kept)
        if (auto words = stated(readings, from); !words.empty()) out[to] = std::move(words);
    std::string note = "imported, readings by others";
    for (const std::string& remark : readings.remarks)
        note += (note.ends_with('.') ? " " : ". ") + remark;
    out["note"] = note;
    return out;
}

} // namespace axiscal
