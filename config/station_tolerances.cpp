// [tolerances]: the limits that were agreed on, and the rule by which a figure is held against
// them.
#include "config/station_readers.hpp"
#include "config/tolerance_file.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

/// 20 um are no binary fraction of a metre: what was written comes back to a billionth.
double as_written(double value) {
    return std::round(value * 1e9) / 1e9;
}

std::vector<std::string> all_parameters() {
    std::vector<std::string> names;
    for (const TestKind kind : all_test_kinds)
        for (const std::string_view name : judged_figures(kind).names)
            names.emplace_back(name);
    return names;
}

double read_length_limit(Settings& table) {
    return as_written(table.length("limit", nm(1), metre(1)).in(um));
}

double read_axis_limit(Settings& table, AxisKind kind) {
    if (kind == AxisKind::linear) return read_length_limit(table);
    constexpr double arcsec_per_degree = 3600;
    return as_written(table.rotary_length("limit", nm(1), metre(1)).in(mm)*arcsec_per_degree);
}

double read_slope_limit(Settings& table) {
    constexpr double um_per_m = 1e6;
    return as_written(table.angle("limit", arcsec(1e-6), degree(1)).in(radian)*um_per_m);
}

/// In the unit of unit_of_limits(). A figure that is none was refused; its limit is read as a
/// length.
double read_limit(Settings& table, const std::string& parameter, AxisKind kind) {
    const JudgedFigures* const figures = judged_with(parameter);
    switch (figures == nullptr ? LimitQuantity::length : figures->limit) {
    case LimitQuantity::of_axis: return read_axis_limit(table, kind);
    case LimitQuantity::length: break;
    case LimitQuantity::slope: return read_slope_limit(table);
    }
    return read_length_limit(table);
}

void read_band(Settings& table, AxisUnits units, ToleranceLimit& limit) {
    const auto band = units.optional_coordinate(table, "travel_up_to", mm(0.001), farthest);
    if (!band) return;
    limit.travel_up_to = as_written(band->in(mm));
    const JudgedFigures* const figures = judged_with(limit.parameter);
    if (figures != nullptr && !figures->by_travel)
        table.refuse("travel_up_to",
                     limit.parameter + " has no travel: only figures of positioning have bands");
}

ToleranceLimit read_one(Settings table, AxisKind kind) {
    ToleranceLimit limit;
    limit.parameter = table.choice("parameter", all_parameters());
    if (table.refused("parameter")) limit.parameter.clear();
    limit.limit = read_limit(table, limit.parameter, kind);
    read_band(table, AxisUnits{kind}, limit);
    return limit;
}

void read_limits(Settings& table, bool stated, AxisKind kind, ToleranceRecord& set) {
    for (Settings& one : table.tables("limits")) {
        ToleranceLimit limit = read_one(one, kind);
        const bool twice = std::ranges::any_of(set.limits, [&](const ToleranceLimit& other) {
            return other.parameter == limit.parameter && other.travel_up_to == limit.travel_up_to;
        });
        if (twice && !limit.parameter.empty())
            one.refuse("parameter", limit.parameter + " stands there twice for the same travel: "
                                                      "keep one");
        set.limits.push_back(std::move(limit));
    }
    if (stated && set.limits.empty() && !table.refused("limits"))
        table.refuse("limits",
                     "is empty: write limits = [{ parameter = \"A\", limit = \"20 um\" }]");
}

DecisionRule read_rule(Settings& table) {
    std::vector<std::string> names;
    for (const DecisionRule rule : stated_rules)
        names.emplace_back(name_of(rule));
    const std::string stated =
        table.choice("rule", names, std::string{name_of(DecisionRule::none)});
    const auto* found = std::ranges::find_if(
        stated_rules, [&](DecisionRule rule) { return name_of(rule) == stated; });
    return found == stated_rules.end() ? DecisionRule::none : *found;
}

void warn_without_rule(const Settings& table, StationConfig& config) {
    config.warnings.push_back(
        {config.file, table.line(), "tolerances.rule",
         "no decision rule: certificates compare with the limits and state no verdict; agree on "
         "\"14253-1:2017\", \"guard-U\" or \"simple\" and write it here"});
}

/// `usual_name`: of a set without one.
ToleranceRecord
read_set(Settings& table, bool stated, AxisKind kind, const std::string& usual_name) {
    ToleranceRecord set;
    set.name = table.text("name", usual_name);
    set.source = table.text("source", "");
    set.to_be_checked = table.flag("to_be_checked", false);
    set.rule = read_rule(table);
    read_limits(table, stated, kind, set);
    if (stated && set.source.empty() && !table.refused("source"))
        table.refuse("source", "is missing: where are these limits from? An order, a data sheet, a "
                               "standard with its table; it is printed");
    return set;
}

/// The file's set, with the rule of the station file where the file has none.
void take_file(Settings& table, AxisKind kind, ToleranceRecord& set) {
    const std::string path = read_absolute_path(table, "file");
    for (const char* key : {"name", "source", "to_be_checked", "limits"})
        refuse_beside(table, "file", key);
    if (table.refused("file")) return;
    auto loaded = load_tolerances(path, kind);
    if (!loaded) return table.refuse("file", loaded.error().detail);
    if (table.has("rule") && loaded->rule != DecisionRule::none && loaded->rule != set.rule)
        table.refuse("rule", "is another one in " + path + ": keep one of them");
    if (loaded->rule == DecisionRule::none) loaded->rule = set.rule;
    set = *std::move(loaded);
}

} // namespace

Result<ToleranceRecord> load_tolerances(const std::string& path, AxisKind kind) {
    AXISCAL_TRY(SettingsDocument document, SettingsDocument::load(path));
    Settings root = document.root();
    ToleranceRecord set = read_set(root, true, kind, "limits of " + path);
    if (const auto refusals = document.finish(); !refusals.empty())
        return fail(Fault::bad_configuration, refusals.front().describe());
    return set;
}

void read_tolerances(Settings root, StationConfig& config) {
    const bool stated = root.has("tolerances");
    Settings table = root.table("tolerances");
    const bool in_file = table.has("file");
    const AxisKind kind = config.cycle.axis_kind;
    ToleranceRecord set = read_set(table, stated && !in_file, kind, "limits of the station file");
    if (!stated) {
        table.text("file", "");
        return;
    }
    if (in_file) take_file(table, kind, set);
    if (set.rule == DecisionRule::none && !table.has("rule")) warn_without_rule(table, config);
    config.tolerances = std::move(set);
}

} // namespace axiscal
