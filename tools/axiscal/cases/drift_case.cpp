#include "analysis/checked_numbers.hpp"
#include "analysis/drift/drift.hpp"
#include "analysis/drift/settling.hpp"
#include "tools/axiscal/cases/case_reader.hpp"
#include "tools/axiscal/cases/cases.hpp"
#include "tools/axiscal/cases/plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

struct Channel {
    std::string name;
    DriftSeries series;
};

struct DriftCase {
    std::vector<Channel> channels, temperatures;
    double window_min = 60;
    std::vector<double> at_min{60};
    std::optional<double> allowed_change; ///< of the last reading against the first
};

Result<Channel> channel_of(const json& object,
                           const std::string& field,
                           const std::vector<double>* common,
                           const Words& keys) {
    AXISCAL_CHECK(check_object(object, field, keys));
    Channel channel;
    AXISCAL_TRY(channel.name, text_of(object, "name", field + ".name"));
    if (object.contains("time_min") || !common) {
        AXISCAL_TRY(channel.series.times, numbers_at(object, "time_min", field + ".time_min"));
    } else {
        channel.series.times = *common;
    }
    AXISCAL_TRY(channel.series.readings, numbers_at(object, "readings", field + ".readings"));
    AXISCAL_CHECK(check_series(channel.series, field, 2));
    return channel;
}

Result<std::vector<Channel>> channels_of(const json& object,
                                         const std::string& key,
                                         const std::vector<double>* common,
                                         const Words& keys) {
    std::vector<Channel> channels;
    if (!object.contains(key)) return channels;
    const json& array = object.at(key);
    if (!array.is_array()) return refuse(Fault::bad_case, key, "must be an array of channels");
    for (std::size_t i = 0; i < array.size(); ++i) {
        AXISCAL_TRY(Channel channel, channel_of(array[i], indexed(key, i), common, keys));
        for (const Channel& other : channels)
            if (other.name == channel.name)
                return refuse(Fault::bad_case, indexed(key, i) + ".name", "stands twice");
        channels.push_back(std::move(channel));
    }
    return channels;
}

/// Positive number under `key`, or `missing`.
Result<double>
span_of(const json& object, const std::string& key, const std::string& field, double missing) {
    AXISCAL_TRY(const double span, number_or(object, key, field, missing));
    AXISCAL_CHECK(check_positive(span, field));
    return span;
}

Result<DriftCase> stated_drift(const json& object) {
    const Words of_temperature{"name",
                               "time_min",
                               "readings",
                               "settled_band_K",
                               "settled_slope_K_per_h",
                               "slope_window_min",
                               "gradient_limit_K_per_h"};
    std::vector<double> times;
    const std::vector<double>* common = nullptr;
    if (object.contains("time_min")) {
        AXISCAL_TRY(times, numbers_at(object, "time_min", "time_min"));
        common = &times;
    }
    DriftCase out;
    AXISCAL_TRY(out.channels,
                channels_of(object, "channels", common, {"name", "time_min", "readings"}));
    AXISCAL_TRY(out.temperatures, channels_of(object, "temperatures", common, of_temperature));
    if (out.channels.empty() && out.temperatures.empty())
        return refuse(Fault::bad_case, "channels", "is missing; so are temperatures");
    AXISCAL_TRY(out.window_min, span_of(object, "window_min", "window_min", 60));
    if (object.contains("at_min")) {
        AXISCAL_TRY(out.at_min, numbers_at(object, "at_min", "at_min"));
    }
    if (object.contains("allowed_change")) {
        AXISCAL_TRY(out.allowed_change, span_of(object, "allowed_change", "allowed_change", 0));
    }
    return out;
}

ordered_json range_json(const DriftSeries& series, const DriftRange& found) {
    return {{"range", found.range},
            {"from_min", series.times[found.first]},
            {"to_min", series.times[found.last]},
            {"u_EVE", found.u_eve}};
}

ordered_json changes_json(const DriftSeries& series, const std::vector<double>& at_min) {
    ordered_json changes = ordered_json::array();
    for (const double minute : at_min) {
        const auto change = change_at(series, minute);
        changes.push_back({{"at_min", minute}});
        if (change)
            changes.back()["change"] = *change;
        else
            changes.back()["reason"] = "outside the record";
    }
    return changes;
}

ordered_json drift_json(const DriftSeries& series, const DriftCase& stated) {
    ordered_json object;
    const double end = series.readings.back() - series.readings.front();
    object["total"] = range_json(series, total_range(series));
    object["window"] = range_json(series, largest_window_range(series, stated.window_min));
    object["end"] = {{"at_min", series.times.back()}, {"change", end}};
    object["changes"] = changes_json(series, stated.at_min);
    return object;
}

Result<const Channel*>
channel_named(const std::vector<Channel>& channels, const json& name, const std::string& field) {
    for (const Channel& channel : channels)
        if (name == json(channel.name)) return &channel;
    return refuse(Fault::bad_case, field, "must be the name of a channel");
}

/// (d1 - d2) / l in rad; readings in `unit`, l in mm.
Result<ordered_json>
tilt_json(const json& tilt, const std::string& field, const DriftCase& stated, double unit_mm) {
    AXISCAL_CHECK(check_object(tilt, field, {"name", "channels", "distance_mm"}));
    AXISCAL_TRY(const std::string name, text_of(tilt, "name", field + ".name"));
    AXISCAL_TRY(const json* pair, member(tilt, "channels", field + ".channels"));
    if (!pair->is_array() || pair->size() != 2)
        return refuse(Fault::bad_case, field + ".channels", "must be two names of channels");
    AXISCAL_TRY(const Channel* first,
                channel_named(stated.channels, (*pair)[0], field + ".channels[0]"));
    AXISCAL_TRY(const Channel* second,
                channel_named(stated.channels, (*pair)[1], field + ".channels[1]"));
    AXISCAL_TRY(const double distance, number_at(tilt, "distance_mm", field + ".distance_mm"));
    AXISCAL_CHECK(check_positive(distance, field + ".distance_mm"));
    const auto series = tilt_between(first->series, second->series, distance / unit_mm);
    if (!series) return refuse(Fault::bad_case, field + ".channels", series.error().detail);
    ordered_json object{{"name", name}, {"unit", "rad"}};
    object.update(drift_json(*series, stated));
    return object;
}

Result<SettlingRule> settling_rule(const json& object, const std::string& field) {
    SettlingRule rule;
    AXISCAL_TRY(rule.window, span_of(object, "slope_window_min", field + ".slope_window_min", 60));
    if (object.contains("settled_band_K")) {
        AXISCAL_TRY(rule.band, span_of(object, "settled_band_K", field + ".settled_band_K", 0));
    }
    if (object.contains("settled_slope_K_per_h")) {
        AXISCAL_TRY(const double limit,
                    span_of(object, "settled_slope_K_per_h", field + ".settled_slope_K_per_h", 0));
        rule.slope = limit / 60;
    }
    return rule;
}

void add_settling(const DriftSeries& series, const SettlingRule& rule, ordered_json& object) {
    if (!rule.band && !rule.slope) return;
    const auto settled = settled_from(series, rule);
    object["settled"] = settled.has_value();
    if (settled) object["settled_from_min"] = series.times[*settled];
}

Result<void> add_gradient(const json& channel,
                          const std::string& field,
                          const DriftSeries& series,
                          double window_min,
                          ordered_json& object) {
    const auto steepest = steepest_window(series, window_min);
    if (!steepest) {
        object["not_evaluated"]["gradient"] = "the record is shorter than slope_window_min";
        return {};
    }
    const double per_hour = steepest->slope * 60;
    object["gradient"] = {{"K_per_h", per_hour},
                          {"from_min", series.times[steepest->first]},
                          {"to_min", series.times[steepest->last]}};
    if (!channel.contains("gradient_limit_K_per_h")) return {};
    AXISCAL_TRY(const double limit,
                span_of(channel, "gradient_limit_K_per_h", field + ".gradient_limit_K_per_h", 0));
    object["gradient"]["limit_K_per_h"] = limit;
    object["gradient"]["exceeded"] = std::abs(per_hour) > limit;
    return {};
}

Result<ordered_json>
temperature_json(const json& channel, const std::string& field, const Channel& read) {
    ordered_json object{{"name", read.name}, {"unit", "K"}};
    const DriftRange total = total_range(read.series);
    object["range"] = total.range;
    AXISCAL_TRY(const SettlingRule rule, settling_rule(channel, field));
    add_settling(read.series, rule, object);
    AXISCAL_CHECK(add_gradient(channel, field, read.series, rule.window, object));
    return object;
}

Result<void>
add_tilts(const json& object, const DriftCase& stated, double unit_mm, ordered_json& answer) {
    if (!object.contains("tilts")) return {};
    const json& tilts = object.at("tilts");
    if (!tilts.is_array()) return refuse(Fault::bad_case, "tilts", "must be an array of tilts");
    answer["tilts"] = ordered_json::array();
    for (std::size_t i = 0; i < tilts.size(); ++i) {
        AXISCAL_TRY(auto tilt, tilt_json(tilts[i], indexed("tilts", i), stated, unit_mm));
        answer["tilts"].push_back(std::move(tilt));
    }
    return {};
}

/// A range "within any window" of a record that has no whole one is that of the record.
std::vector<std::string> short_records(const DriftCase& stated) {
    std::vector<std::string> remarks;
    for (const Channel& channel : stated.channels) {
        const double length_min = channel.series.times.back() - channel.series.times.front();
        if (length_min < stated.window_min)
            remarks.push_back("the record of " + channel.name + " lasts " + six_digits(length_min) +
                              " min, less than the window of " + six_digits(stated.window_min) +
                              " min: its range is that of the record");
    }
    return remarks;
}

} // namespace

Result<ordered_json> drift_case(const json& object) {
    AXISCAL_CHECK(check_object(object, "",
                               {"analysis", "unit", "time_min", "window_min", "at_min",
                                "allowed_change", "channels", "tilts", "temperatures"}));
    std::string unit = "um";
    if (object.contains("unit") || object.contains("channels")) {
        AXISCAL_TRY(unit, one_of(object, "unit", "unit", {"um", "mm", "nm"}));
    }
    AXISCAL_TRY(const DriftCase stated, stated_drift(object));
    ordered_json answer;
    answer["format"] = "axiscal.result/1";
    answer["unit"] = unit;
    answer["window_min"] = stated.window_min;
    answer["channels"] = ordered_json::array();
    for (const Channel& channel : stated.channels) {
        ordered_json figures{{"name", channel.name}};
        figures.update(drift_json(channel.series, stated));
        if (stated.allowed_change)
            figures["end"]["within_allowed_change"] =
                std::abs(figures["end"]["change"].get<double>()) <= *stated.allowed_change;
        answer["channels"].push_back(std::move(figures));
    }
    const double unit_mm = unit == "mm" ? 1 : unit == "um" ? 1e-3 : 1e-6;
    AXISCAL_CHECK(add_tilts(object, stated, unit_mm, answer));
    add_remarks(short_records(stated), answer);
    for (std::size_t i = 0; i < stated.temperatures.size(); ++i) {
        AXISCAL_TRY(auto figures,
                    temperature_json(object.at("temperatures")[i], indexed("temperatures", i),
                                     stated.temperatures[i]));
        answer["temperatures"].push_back(std::move(figures));
    }
    return answer;
}

} // namespace axiscal
