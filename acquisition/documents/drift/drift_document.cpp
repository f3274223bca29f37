#include "acquisition/documents/drift/drift_document.hpp"

#include "acquisition/documents/alignment_json.hpp"
#include "acquisition/documents/csv_text.hpp"
#include "acquisition/documents/conformity_json.hpp"
#include "acquisition/documents/document_parts.hpp"
#include "acquisition/documents/record_json.hpp"
#include "analysis/record/run_clock.hpp"

#include <array>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

std::string digest_of(const RunDrift& drift) {
    const std::array figures{drift.eve.range,
                             drift.eve.u_eve,
                             drift.window.range,
                             drift.window_min,
                             drift.as_read.range,
                             drift.end_change,
                             static_cast<double>(drift.axis.times.size())};
    return digest_of_figures("axiscal.drift/1", figures);
}

Json range_of(const DriftSeries& series, const DriftRange& found) {
    Json object;
    object["value"] = found.range;
    object["from_min"] = series.times[found.first];
    object["to_min"] = series.times[found.last];
    return object;
}

Json parameters_of(const RunDrift& drift) {
    Json object;
    object["E_VE"] = range_of(drift.axis, drift.eve);
    object["E_VE"]["u"] = drift.eve.u_eve;
    object["ETVE"] = range_of(drift.axis, drift.window);
    object["ETVE"]["window_min"] = drift.window_min;
    object["end_change"]["value"] = drift.end_change;
    if (!drift.of_bar) object["E_VE_as_read"]["value"] = drift.as_read.range;
    return object;
}

int refused_readings(const RunDrift& drift) {
    int count = 0;
    for (const RefusedReadings& refused : drift.refused)
        count += refused.count;
    return count;
}

/// A length has an E_VE; what is as warm or as moist as it is has a range alone.
bool has_eve(const ChannelDrift& channel) {
    return channel.kind == ChannelKind::displacement && channel.series.readings.size() > 1;
}

Json channel_of(const ChannelDrift& channel) {
    Json object;
    object["channel"] = channel.name;
    object["instrument"] = channel.instrument;
    object["place"] = stated_json(channel.place);
    object["quantity"] = name_of(channel.kind);
    object["medium"] = name_of(channel.medium);
    object["unit"] = channel.unit;
    const DriftSeries& series = channel.series;
    object["readings"] = series.readings.size();
    if (series.readings.empty()) return object;
    object["first"] = series.readings.front();
    object["last"] = series.readings.back();
    object["range"] = range_of(series, channel.total);
    object["window"] = range_of(series, channel.window);
    object["slope_per_h"] = stated_json(channel.slope_per_h);
    if (has_eve(channel))
        object["E_VE"] = {{"value", channel.total.range}, {"u", channel.total.u_eve}};
    return object;
}

/// What a later budget takes of the test: nothing where extremes may be left out.
Json budget_of(const DriftResult& document) {
    Json object;
    object["takes"] = document.drift.refused.empty() ? Json("E_VE") : Json();
    object["by"] = drift_budget_by(document);
    object["informative"] = {"ETVE", "end_change"};
    if (!document.drift.of_bar) object["informative"].push_back("E_VE_as_read");
    object["informative"].insert(object["informative"].end(), {"slope_per_h", "channels"});
    return object;
}

Json refused_of(const RunDrift& drift) {
    Json list = Json::array();
    for (const RefusedReadings& refused : drift.refused)
        list.push_back({{"fault", fault_name(refused.fault)},
                        {"readings", refused.count},
                        {"from_min", refused.first_min},
                        {"to_min", refused.last_min},
                        {"reason", refused.reason}});
    return list;
}

Json run_of(const DriftResult& document) {
    const RunRecord& run = document.run;
    const Statements& said = run.statements;
    Json object = test_run_json(run, document.run_file_sha256, document.result_digest);
    object["orders"] = orders_json(document.orders, run.opened);
    Json& statements = object["statements"];
    statements["certificate_number"] = stated_json(said.certificate_number);
    statements["laboratory"] = stated_json(said.laboratory);
    statements["place"] = stated_json(said.place);
    statements["machine"] = stated_json(said.machine);
    statements["machine_serial"] = stated_json(said.machine_serial);
    if (!document.drift.of_bar) statements["axis"] = stated_json(said.axis);
    statements["operator"] = stated_json(said.operator_name);
    statements["state"] = stated_json(said.state);
    statements["warm_up"] = stated_json(said.warm_up);
    statements["idle_axes"] = stated_json(said.idle_axes);
    if (document.drift.of_bar) { // which has no datum and no beam
        object["reference"] = "ballbar";
        object["ballbar"] = full_name_of(document.drift.reading);
        object["plane"] = stated_json(said.axis);
        return object;
    }
    if (run.rotary) {
        object["reference"] = "indexing table";
        object["laser"] = run.laser.instrument;
        object["arm_mm"] = run.rotary->arm.in(mm);
    } else if (run.scale) {
        object["reference"] = "linear scale";
        object["scale"] = run.laser.instrument;
    } else {
        object["laser"] = run.laser.instrument;
        object["dead_path_mm"] = run.laser.dead_path.in(mm);
    }
    object[run.rotary ? "datum_deg" : "datum_mm"] = run.plan.datum.in(mm);
    object["alignment"] = alignment_to_json(document.attachments.alignment);
    return object;
}

std::string quoted(const std::string& name) {
    std::string field = "\"";
    for (const char letter : name)
        field += letter == '"' ? std::string{"\"\""} : std::string{letter};
    return field + '"';
}

void put_series(std::string& text,
                const std::string& name,
                const std::string& unit,
                const DriftSeries& series) {
    const std::string head = quoted(name) + "," + unit + ",";
    for (std::size_t i = 0; i < series.times.size(); ++i) {
        text += head;
        text += csv_number(series.times[i]);
        text += ',';
        text += csv_number(series.readings[i]);
        text += "\r\n";
    }
}

void put_figure(std::string& text,
                const char* figure,
                const std::string& name,
                const std::string& unit,
                std::optional<double> value) {
    if (value)
        append_csv_line(text, {std::string{"# "} + figure, quoted(name), unit, csv_number(*value)});
}

void put_figures(std::string& text, const ChannelDrift& channel) {
    if (channel.series.readings.empty()) return;
    const std::string name = full_name_of(channel);
    put_figure(text, "range", name, channel.unit, channel.total.range);
    put_figure(text, "slope_per_h", name, channel.unit, channel.slope_per_h);
    if (has_eve(channel)) put_figure(text, "E_VE", name, channel.unit, channel.total.range);
}

std::string axis_name(const RunDrift& drift) {
    if (drift.of_bar) return "ballbar";
    return drift.unit == "um" ? "axis at 20 degC" : "axis";
}

/// The channel that measures the axis, then the others.
std::vector<const ChannelDrift*> every_channel_of(const RunDrift& drift) {
    std::vector<const ChannelDrift*> channels{&drift.reading};
    for (const ChannelDrift& channel : drift.channels)
        channels.push_back(&channel);
    return channels;
}

/// In the unit of the axis. Where readings were refused the ranges may be too small: no figure.
std::vector<FigureToJudge> figures_to_judge(const RunDrift& drift) {
    if (!drift.refused.empty()) return {};
    return {{"E_VE", drift.eve.range, {}}, {"ETVE", drift.window.range, {}}};
}

} // namespace

Result<DriftResult> drift_result_of(const std::string& path, RunFileContents contents) {
    if (!contents.closed)
        return fail(Fault::incomplete_run, path + " is still open: close the run first");
    const auto* setup = std::get_if<DriftSetup>(&contents.attachments.setup);
    if (setup == nullptr) return fail(Fault::bad_run_file, path + " has no row drift");
    DriftResult result;
    AXISCAL_TRY(result.drift, evaluate_drift(contents.run, *setup));
    tell_times_by_one_clock(contents.run.opened, contents.run.events, contents.revisions.retakes,
                            contents.run.closed);
    tell_orders_by_one_clock(contents.run.opened, contents.run.events, contents.revisions.orders);
    result.conformity =
        conformity_of(contents.run.tolerances, figures_to_judge(result.drift), result.drift.unit);
    result.run = std::move(contents.run);
    result.attachments = std::move(contents.attachments);
    result.orders = std::move(contents.revisions.orders);
    result.result_digest = digest_of(result.drift);
    return result;
}

Json drift_figures(const RunDrift& drift) {
    Json figures;
    figures["format"] = "axiscal.drift/1";
    figures["unit"] = drift.unit;
    figures["parameters"] = parameters_of(drift);
    figures["refused_readings"] = refused_readings(drift);
    return figures;
}

std::string drift_standards(const RunDrift& drift) {
    return drift.of_bar ? "ISO/TR 230-9 E_VE, ISO 230-3 ETVE" : "ISO 230-2 E_VE, ISO 230-3 ETVE";
}

std::string drift_budget_by(const DriftResult& document) {
    if (document.drift.of_bar) return "ISO/TR 230-9";
    return document.run.rotary ? "after ISO 230-2 annex A" : "ISO 230-2 annex A";
}

Json drift_to_json(const DriftResult& document) {
    const RunDrift& drift = document.drift;
    Json object;
    object["format"] = "axiscal.drift/1";
    object["standard"] = drift_standards(drift);
    object["unit"] = drift.unit;
    add_conformity(object, document.conformity);
    object["parameters"] = parameters_of(drift);
    object["slope_per_h"] = stated_json(drift.slope_per_h);
    object["budget"] = budget_of(document);
    if (!drift.of_bar)
        object["test"][document.run.rotary ? "place_deg" : "place_mm"] = drift.setup.place.in(mm);
    object["test"]["duration_s"] = seconds_of(drift.setup.duration);
    object["test"]["interval_s"] = seconds_of(drift.setup.interval);
    object["test"]["readings"] = drift.axis.times.size();
    object["test"]["missing"] = drift.missing;
    object["test"]["without_air"] = drift.without_air;
    object["test"]["refused"] = refused_of(drift);
    object["channels"] = Json::array();
    for (const ChannelDrift* channel : every_channel_of(drift))
        object["channels"].push_back(channel_of(*channel));
    object["run"] = run_of(document);
    return object;
}

std::string drift_csv(const DriftResult& document) {
    const RunDrift& drift = document.drift;
    const std::string axis = axis_name(drift);
    std::string text = "channel,unit,minute,value\r\n";
    put_series(text, axis, drift.unit, drift.axis);
    for (const ChannelDrift* channel : every_channel_of(drift))
        put_series(text, full_name_of(*channel), channel->unit, channel->series);
    if (const int refused = refused_readings(drift); refused > 0)
        put_figure(text, "refused", axis, "readings", refused);
    put_figure(text, "range", axis, drift.unit, drift.eve.range);
    put_figure(text, "slope_per_h", axis, drift.unit, drift.slope_per_h);
    put_figure(text, "E_VE", axis, drift.unit, drift.eve.range);
    for (const ChannelDrift* channel : every_channel_of(drift))
        put_figures(text, *channel);
    append_conformity(text, document.conformity);
    return text;
}

} // namespace axiscal
