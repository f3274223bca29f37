#include "tools/axiscal/status_text.hpp"

#include "analysis/quantity/counted.hpp"
#include "tools/axiscal/doctor/to_do_list.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <iterator>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...) {
    char text[512];
    va_list arguments;
    va_start(arguments, pattern);
    std::vsnprintf(text, sizeof text, pattern, arguments);
    va_end(arguments);
    return text;
}

/// A value that is not there is shown as dashes, never as 0.
std::string number_or_dashes(const Json& value, const char* pattern, const std::string& unit) {
    if (!value.is_number()) return "- - - " + unit;
    char text[64];
    std::snprintf(text, sizeof text, pattern, value.get<double>());
    return std::string{text} + " " + unit;
}

/// Of what the interface tells in micrometres.
struct ShownUnit {
    std::string sign = "µm";
    double factor = 1;
    [[nodiscard]] std::string of(const Json& value, const char* pattern) const {
        if (!value.is_number()) return number_or_dashes(value, pattern, sign);
        return number_or_dashes(value.get<double>() * factor, pattern, sign);
    }
};

/// Of a rotary axis the interface's millimetres are degrees, on paper with seconds of arc; what the
/// instrument reads is a length all the same, but of an autocollimator.
struct ShownUnits {
    std::string coordinate = "mm";
    ShownUnit deviation, reading;
};

ShownUnits units_of(const Json& status) {
    const ShownUnit arcsec_of_millidegrees{"″", 3.6};
    const Json& axis = status.at("axis");
    ShownUnits units;
    if (axis.value("kind", "linear") == "rotary")
        units.coordinate = "°", units.deviation = arcsec_of_millidegrees;
    // A daemon of before the autocollimator does not tell.
    if (axis.value("reading", "length") == "angle") units.reading = arcsec_of_millidegrees;
    return units;
}

std::string clock_text(double seconds) {
    const int whole = static_cast<int>(std::lround(seconds));
    return format("%d:%02d", whole / 60, whole % 60);
}

constexpr const char* margin = "             "; // under the words before each value

std::string next_text(const Json& run, const ShownUnits& units) {
    const Json& next = run.at("next");
    if (next.is_null()) return "none";
    const std::string arrow = next.at("direction") == "positive" ? "↑ from below" : "↓ from above";
    return format("P%d = ", next.at("target").get<int>() + 1) +
           number_or_dashes(next.at("nominal_mm"), "%.3f", units.coordinate) + "  " + arrow +
           format("  approach %d", next.at("approach").get<int>() + 1);
}

bool is_circular(const Json& run) {
    return !run.is_null() && run.value("pass", std::string{}) == "circular";
}

/// "circle 2 of 6, counterclockwise, run 1"; a daemon of before does not tell.
std::string circle_text(const Json& run) {
    const auto circle = run.find("circle");
    if (circle == run.end() || circle->is_null()) return "";
    return format("circle %d of %d, ", circle->at("number").get<int>(),
                  run.at("steps").get<int>()) +
           circle->at("sense").get<std::string>() +
           (circle->at("warm_up") == true ? ", warm-up " : ", run ") +
           std::to_string(circle->at("repeat").get<int>());
}

/// "Next" until it is begun; empty of a run that is closed.
std::string next_line(const Json& status) {
    const Json& run = status.at("run");
    if (run.is_null() || status.at("run_open") != true) return "";
    if (!is_circular(run)) return "Next         " + next_text(run, units_of(status));
    const std::string circle = circle_text(run);
    if (circle.empty()) return "";
    return (run.at("circle").at("begun") == true ? "Now          " : "Next         ") + circle;
}

std::string run_line(const Json& status) {
    const Json& run = status.at("run");
    if (run.is_null()) return "Run          none since the daemon started; 'axiscal arm' opens one";
    const int steps = run.at("steps").get<int>();
    const std::string thing = is_circular(run) ? "circle" : "point";
    std::string text = "Run          " + run.at("id").get<std::string>() + ", " +
                       run.at("state").get<std::string>() +
                       format(", %d of ", run.at("step").get<int>()) + counted(steps, thing);
    if (run.at("seconds_left").is_number())
        text += ", " + clock_text(run.at("seconds_left")) + " left";
    if (run.value("retakes_asked", 0) > 0)
        text += format(", %d of ", run.value("retakes_left", 0)) +
                counted(run.value("retakes_asked", 0), "retake") + " left";
    if (run.value("excluded", 0) > 0) text += format(", %d left out", run.value("excluded", 0));
    return text;
}

/// Why it stands or ended; empty when all is well.
std::vector<ScreenLine> sentence_lines(const Json& run) {
    if (run.is_null() || run.at("sentence").get<std::string>().empty()) return {};
    const std::string_view label = sentence_label(run);
    std::string text{label};
    text.resize(std::string_view{margin}.size(), ' ');
    return {{label == "FAULT" ? Rank::fault : Rank::warning,
             text + run.at("sentence").get<std::string>()}};
}

/// A daemon of before the drift test sends none.
std::vector<ScreenLine> drift_lines(const Json& status) {
    if (!status.contains("drift") || status.at("drift").is_null()) return {};
    const Json& drift = status.at("drift");
    std::string text = "Drift        " + drift.at("id").get<std::string>() + ", " +
                       drift.at("state").get<std::string>() +
                       (drift.value("of", "axis") == "ballbar" ? ", of the ballbar" : "") +
                       format(", %d of ", drift.at("taken").get<int>()) +
                       counted(drift.at("planned").get<int>(), "reading");
    if (drift.at("missing") != 0) text += format(", %d missing", drift.at("missing").get<int>());
    text += ", range as read " + number_or_dashes(drift.at("range_um"), "%.2f", "µm");
    if (drift.at("seconds_left").is_number())
        text += ", " + clock_text(drift.at("seconds_left")) + " left";
    std::vector<ScreenLine> lines{{Rank::plain, text}};
    if (!drift.at("sentence").get<std::string>().empty())
        lines.push_back({Rank::warning, margin + drift.at("sentence").get<std::string>()});
    return lines;
}

/// A channel that nobody needs and that never said a number (a sensor the instrument was built
/// without) only takes up a line.
bool worth_showing(const Json& channel) {
    return channel.at("used") == true || channel.at("value").is_number();
}

/// In the units of the shop floor.
std::string value_text(const Json& channel) {
    const std::string unit = channel.at("unit");
    Json value = channel.at("value");
    const auto scaled = [&value](double factor) {
        return value.is_number() ? Json(value.get<double>() * factor) : value;
    };
    if (unit == "m") return number_or_dashes(scaled(1e3), "%.4f", "mm");
    if (unit == "Pa") return number_or_dashes(scaled(1e-2), "%.1f", "hPa");
    return number_or_dashes(value, unit == "%" ? "%.1f" : "%.2f", unit == "degC" ? "°C" : unit);
}

/// "beam_lost" as people say it.
std::string spoken(std::string word) {
    std::ranges::replace(word, '_', ' ');
    return word;
}

std::string age_text(double seconds) {
    constexpr double minute = 60, hour = 3600;
    if (seconds < 2 * minute) return format("%.0f s", seconds);
    if (seconds < 2 * hour) return format("%.0f min", seconds / minute);
    return format("%.0f h", seconds / hour);
}

std::string channel_text(const Json& channel) {
    const std::string age = channel.at("age_s").is_number()
                                ? format("%.1f s", channel.at("age_s").get<double>())
                                : "never";
    const std::string place = channel.at("place").get<std::string>();
    return format("  %-10s %-24s ", channel.at("instrument").get<std::string>().c_str(),
                  channel.at("name").get<std::string>().c_str()) +
           value_text(channel) + "  (" + channel.at("quality").get<std::string>() + ", " + age +
           (place.empty() ? "" : ", " + place) + ")";
}

/// What the axis is read by, or the ballbar; null when nobody tells. Which of two readings it is a
/// daemon of before does not say.
const Json* reading_channel(const Json& status, const std::string& role) {
    for (const Json& channel : status.at("channels")) {
        const std::string kind = channel.at("kind");
        const bool reads =
            channel.at("used") == true && (kind == "displacement" || kind == "angle");
        if (reads && channel.value("role", role) == role) return &channel;
    }
    return nullptr;
}

/// Why a channel shows no value: "no reading since 3 s"; empty while it shows one.
std::string silence_of(const Json& channel) {
    const auto quality = channel.at("quality").get<std::string>();
    if (!channel.at("age_s").is_number()) return "no reading yet";
    if (quality == "stale") return "no reading since " + age_text(channel.at("age_s"));
    return channel.at("value").is_number() ? "" : "no good reading: " + spoken(quality);
}

std::vector<ScreenLine> axis_lines(const Json& status) {
    const Json& axis = status.at("axis");
    const ShownUnits units = units_of(status);
    const Json* channel = reading_channel(status, "axis");
    const std::string silence = channel ? silence_of(*channel) : "";
    const std::string state = !silence.empty()           ? silence
                              : axis.at("still") == true ? "still"
                                                         : "moving";
    std::vector<ScreenLine> lines{
        {silence.empty() ? Rank::main : Rank::warning,
         "Axis " + axis.at("name").get<std::string>() + "       " +
             number_or_dashes(axis.at("position_mm"), "%.4f", units.coordinate) + "   deviation " +
             units.deviation.of(axis.at("deviation_um"), "%+.2f") + "   spread " +
             units.reading.of(axis.at("spread_um"), "%.2f") + "   " + state}};
    if (axis.at("strength_percent").is_number())
        lines.push_back(
            {Rank::plain,
             "Strength     " + number_or_dashes(axis.at("strength_percent"), "%.0f", "%")});
    return lines;
}

/// Circles are read by the ballbar: the axis has no place then that could be told.
std::vector<ScreenLine> reading_lines(const Json& status) {
    const Json* bar = is_circular(status.at("run")) ? reading_channel(status, "ballbar") : nullptr;
    if (!bar) return axis_lines(status);
    const std::string silence = silence_of(*bar);
    return {{silence.empty() ? Rank::main : Rank::warning,
             "Ballbar      " + value_text(*bar) + (silence.empty() ? "" : "   " + silence)}};
}

std::vector<ScreenLine> trigger_lines(const Json& trigger) {
    const bool silent = trigger.at("cnc_silent") == true;
    std::vector<ScreenLine> lines{{silent ? Rank::warning : Rank::plain,
                                   "Trigger      " + trigger.at("port").get<std::string>() +
                                       (silent ? "   CNC SILENT" : "")}};
    if (!trigger.at("note").get<std::string>().empty())
        lines.push_back({Rank::warning, margin + trigger.at("note").get<std::string>()});
    return lines;
}

std::vector<ScreenLine> outbox_lines(const Json& outbox) {
    std::string text = format("Outbox       %d waiting", outbox.at("waiting").get<int>());
    if (outbox.at("oldest_s").is_number())
        text += ", the oldest since " + age_text(outbox.at("oldest_s").get<double>());
    const Json& publisher = outbox.at("publisher");
    const auto destination = publisher.at("destination").get<std::string>();
    if (!destination.empty()) text += ", to " + destination;
    const bool stands = publisher.at("runs") == false;
    if (stands) text += "   PUBLISHER NOT RUNNING";
    std::vector<ScreenLine> lines{{stands ? Rank::warning : Rank::plain, text}};
    const auto alarm = outbox.at("alarm").get<std::string>();
    const auto reason = publisher.at("reason").get<std::string>();
    if (!alarm.empty())
        lines.push_back({Rank::fault, margin + ("ALARM: " + alarm)});
    else if (outbox.at("waiting") != 0 && !reason.empty())
        lines.push_back({Rank::warning, margin + reason});
    return lines;
}

/// No reading of any of its channels is young enough, although the instrument was not given up yet:
/// "no reading since 3 s"; empty otherwise.
std::string silence_of_instrument(const Json& instrument, const Json& channels) {
    if (instrument.at("state") != "available") return "";
    const Json* youngest = nullptr;
    for (const Json& channel : channels) {
        if (channel.at("instrument") != instrument.at("name") || !channel.at("age_s").is_number())
            continue;
        if (channel.at("quality") != "stale") return "";
        if (!youngest || channel.at("age_s") < youngest->at("age_s")) youngest = &channel;
    }
    return youngest ? silence_of(*youngest) : "";
}

/// Instruments that are not what they should be, each with its reason; at most `most`.
std::vector<ScreenLine> trouble_lines(const Json& status, std::size_t most) {
    std::vector<ScreenLine> lines;
    std::size_t left_out = 0;
    for (const Json& instrument : status.at("instruments")) {
        const auto state = instrument.at("state").get<std::string>();
        const auto silence = silence_of_instrument(instrument, status.at("channels"));
        if ((state == "available" || state == "tape") && silence.empty()) continue;
        if (lines.size() == most && ++left_out > 0) continue;
        const auto note = instrument.at("note").get<std::string>();
        lines.push_back({Rank::warning, "  " + instrument.at("name").get<std::string>() + ": " +
                                            (silence.empty() ? state : silence) +
                                            (note.empty() ? "" : ", " + note)});
    }
    if (left_out > 0)
        lines.push_back(
            {Rank::warning, "  … " + counted(static_cast<long>(left_out), "more instrument") +
                                " in trouble: axiscal status"});
    return lines;
}

void append(std::vector<ScreenLine>& lines, std::vector<ScreenLine> more) {
    std::ranges::move(more, std::back_inserter(lines));
}

/// Those that the run needs first: of the others there may be many.
std::vector<ScreenLine> channel_lines(const Json& status) {
    std::vector<ScreenLine> needed, others;
    for (const Json& channel : status.at("channels"))
        if (channel.at("used") == true)
            needed.push_back(
                {silence_of(channel).empty() ? Rank::plain : Rank::warning, channel_text(channel)});
        else if (worth_showing(channel))
            others.push_back({Rank::minor, channel_text(channel)});
    append(needed, std::move(others));
    return needed;
}

std::string joined(const std::vector<ScreenLine>& lines) {
    std::string text;
    for (const ScreenLine& line : lines)
        text += line.text + "\n";
    return text;
}

std::string instruments_table(const Json& instruments, const Json& channels) {
    std::string text;
    for (const Json& instrument : instruments) {
        const std::string silence = silence_of_instrument(instrument, channels);
        const std::string state =
            silence.empty() ? instrument.at("state").get<std::string>() : silence;
        text += format("  %-10s %-12s %-11s", instrument.at("name").get<std::string>().c_str(),
                       instrument.at("driver").get<std::string>().c_str(), state.c_str());
        const std::string who = instrument.at("model").get<std::string>() +
                                (instrument.at("serial").get<std::string>().empty()
                                     ? ""
                                     : " serial " + instrument.at("serial").get<std::string>());
        text +=
            " " + who +
            format(
                "  samples %llu, gaps %llu, bad frames %llu, checksum errors %llu, restarts %llu\n",
                instrument.at("samples").get<unsigned long long>(),
                instrument.at("gaps").get<unsigned long long>(),
                instrument.at("bad_frames").get<unsigned long long>(),
                instrument.at("checksum_errors").get<unsigned long long>(),
                instrument.at("restarts").get<unsigned long long>());
        if (const auto tape = instrument.value("tape", std::string{}); !tape.empty())
            text += margin + ("no instrument: plays " + tape + "\n");
        if (!instrument.at("note").get<std::string>().empty())
            text += margin + instrument.at("note").get<std::string>() + "\n";
    }
    return text.empty() ? "  none configured\n" : text;
}

/// The last one where the name is of a later daemon.
template <class Name> Name named(const std::string& word, Name last) {
    for (int nth = 0; nth < static_cast<int>(last); ++nth)
        if (name_of(static_cast<Name>(nth)) == word) return static_cast<Name>(nth);
    return last;
}

ToDo to_do_from(const Json& entry) {
    const auto text = [&entry](const char* key) { return entry.value(key, std::string{}); };
    return {text("id"),
            named(text("rank"), ToDoRank::note),
            named(text("source"), ToDoSource::doctor),
            text("seen"),
            text("since_utc"),
            text("next"),
            text("command"),
            text("undo")};
}

} // namespace

std::vector<ToDo> to_do_of(const Json& status) {
    std::vector<ToDo> list;
    if (!status.is_object() || !status.contains("to_do")) return list;
    for (const Json& entry : status.at("to_do"))
        list.push_back(to_do_from(entry));
    return list;
}

std::string_view sentence_label(const Json& run) {
    if (!run.value("fault", std::string{}).empty()) return "FAULT";
    return run.at("state") == "incomplete" ? "Ended" : "Note";
}

std::string instruments_text(const Json& instruments) {
    return instruments_table(instruments, Json::array());
}

std::string status_text(const Json& status) {
    const Json& run = status.at("run");
    std::vector<ScreenLine> lines{{Rank::plain, "Station      " +
                                                    status.at("station").get<std::string>() +
                                                    "   " + status.at("utc").get<std::string>()},
                                  {Rank::plain, run_line(status)}};
    if (const std::string next = next_line(status); !next.empty())
        lines.push_back({Rank::main, next});
    append(lines, sentence_lines(run));
    if (!run.is_null() && !run.at("certificate").get<std::string>().empty())
        lines.push_back({Rank::plain, "Certificate  " + run.at("certificate").get<std::string>()});
    append(lines, drift_lines(status));
    append(lines, reading_lines(status));
    append(lines, trigger_lines(status.at("trigger")));
    lines.push_back({Rank::plain, "Channels"});
    append(lines, channel_lines(status));
    const std::string to_do = status.contains("to_do") ? to_do_text(to_do_of(status)) : "";
    std::string text = to_do + joined(lines) + "Instruments\n" +
                       instruments_table(status.at("instruments"), status.at("channels")) +
                       joined(outbox_lines(status.at("outbox")));
    for (const Json& note : status.at("notes"))
        text += "  " + note.get<std::string>() + "\n";
    return text;
}

ScreenParts status_parts(const Json& status) {
    constexpr std::size_t most_troubles = 4;
    const Json& run = status.at("run");
    ScreenParts parts;
    parts.head = sentence_lines(run);
    if (const std::string next = next_line(status); !next.empty())
        parts.head.push_back({Rank::main, next});
    append(parts.head, reading_lines(status));
    parts.head.push_back({Rank::plain, run_line(status)});
    append(parts.head, drift_lines(status));
    append(parts.head, trouble_lines(status, most_troubles));
    parts.body = channel_lines(status);
    append(parts.body, trigger_lines(status.at("trigger")));
    append(parts.body, outbox_lines(status.at("outbox")));
    parts.body.push_back({Rank::minor, "Station      " + status.at("station").get<std::string>() +
                                           "   " + status.at("utc").get<std::string>()});
    for (const Json& note : status.at("notes"))
        parts.notes.push_back({Rank::minor, "  " + note.get<std::string>()});
    return parts;
}

std::string progress_line(const Json& status) {
    const Json& run = status.at("run");
    if (run.is_null()) return "no run";
    std::string text = format("%3d/%d  ", run.at("step").get<int>(), run.at("steps").get<int>());
    const Json& next = run.at("next");
    if (const std::string circle = circle_text(run); !circle.empty()) text += circle + "  ";
    if (status.at("run_open") == true && !next.is_null())
        text += format("next P%02d %s %d  ", next.at("target").get<int>() + 1,
                       next.at("direction") == "positive" ? "↑" : "↓",
                       next.at("approach").get<int>() + 1);
    const ShownUnits units = units_of(status);
    if (const Json* bar = is_circular(run) ? reading_channel(status, "ballbar") : nullptr)
        text += "ballbar " + value_text(*bar);
    else
        text += "x " +
                number_or_dashes(status.at("axis").at("position_mm"), "%9.4f", units.coordinate) +
                "  last e " + units.deviation.of(run.at("last_deviation_um"), "%+7.2f");
    if (const auto time = run.find("last_synchronisation_um");
        time != run.end() && time->is_number())
        text += "  by time " + units.reading.of(*time, "%.4f");
    for (const Json& channel : status.at("channels"))
        if (channel.at("kind") == "temperature" && channel.at("used") == true)
            text += "  " + channel.at("name").get<std::string>() + " " +
                    number_or_dashes(channel.at("value"), "%.2f", "°C");
    const Json& strength = status.at("axis").at("strength_percent");
    if (strength.is_number()) text += "  strength " + number_or_dashes(strength, "%.0f", "%");
    if (run.at("seconds_left").is_number()) text += "  left " + clock_text(run.at("seconds_left"));
    if (!run.at("sentence").get<std::string>().empty())
        text += "  " + run.at("sentence").get<std::string>();
    return text;
}

} // namespace axiscal
