#include "tools/axiscal/status_text.hpp"

#include <nlohmann/json.hpp>

#include <cstdarg>
#include <cstdio>

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

std::string next_text(const Json& run, const ShownUnits& units) {
    const Json& next = run.at("next");
    if (next.is_null()) return "none";
    const std::string arrow = next.at("direction") == "positive" ? "↑ from below" : "↓ from above";
    return format("P%d = ", next.at("target").get<int>() + 1) +
           number_or_dashes(next.at("nominal_mm"), "%.3f", units.coordinate) + "  " + arrow +
           format("  approach %d", next.at("approach").get<int>() + 1);
}

std::string run_text(const Json& status) {
    const Json& run = status.at("run");
    if (run.is_null())
        return "Run          none since the daemon started; 'axiscal arm' opens one\n";
    std::string text =
        "Run          " + run.at("id").get<std::string>() + ", " +
        run.at("state").get<std::string>() +
        format(", %d of %d points", run.at("step").get<int>(), run.at("steps").get<int>());
    if (run.at("seconds_left").is_number())
        text += ", " + clock_text(run.at("seconds_left")) + " left";
    if (run.value("retakes_asked", 0) > 0)
        text += format(", %d of %d retakes left", run.value("retakes_left", 0),
                       run.value("retakes_asked", 0));
    if (run.value("excluded", 0) > 0) text += format(", %d left out", run.value("excluded", 0));
    text += "\n";
    if (status.at("run_open") == true)
        text += "Next         " + next_text(run, units_of(status)) + "\n";
    if (!run.at("sentence").get<std::string>().empty())
        text += "FAULT        " + run.at("sentence").get<std::string>() + "\n";
    if (!run.at("certificate").get<std::string>().empty())
        text += "Certificate  " + run.at("certificate").get<std::string>() + "\n";
    return text;
}

std::string drift_text(const Json& drift) {
    std::string text =
        "Drift        " + drift.at("id").get<std::string>() + ", " +
        drift.at("state").get<std::string>() +
        (drift.value("of", "axis") == "ballbar" ? ", of the ballbar" : "") +
        format(", %d of %d readings", drift.at("taken").get<int>(), drift.at("planned").get<int>());
    if (drift.at("missing") != 0) text += format(", %d missing", drift.at("missing").get<int>());
    text += ", range as read " + number_or_dashes(drift.at("range_um"), "%.2f", "µm");
    if (drift.at("seconds_left").is_number())
        text += ", " + clock_text(drift.at("seconds_left")) + " left";
    text += "\n";
    if (!drift.at("sentence").get<std::string>().empty())
        text += "             " + drift.at("sentence").get<std::string>() + "\n";
    return text;
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

std::string channel_text(const Json& channel) {
    const std::string age = channel.at("age_s").is_number()
                                ? format("%.1f s", channel.at("age_s").get<double>())
                                : "never";
    const std::string place = channel.at("place").get<std::string>();
    return format("  %-10s %-24s ", channel.at("instrument").get<std::string>().c_str(),
                  channel.at("name").get<std::string>().c_str()) +
           value_text(channel) + "  (" + channel.at("quality").get<std::string>() + ", " + age +
           (place.empty() ? "" : ", " + place) + ")\n";
}

std::string age_text(double seconds) {
    constexpr double minute = 60, hour = 3600;
    if (seconds < 2 * minute) return format("%.0f s", seconds);
    if (seconds < 2 * hour) return format("%.0f min", seconds / minute);
    return format("%.0f h", seconds / hour);
}

std::string outbox_text(const Json& outbox) {
    std::string text = format("Outbox       %d waiting", outbox.at("waiting").get<int>());
    if (outbox.at("oldest_s").is_number())
        text += ", the oldest since " + age_text(outbox.at("oldest_s").get<double>());
    const Json& publisher = outbox.at("publisher");
    const auto destination = publisher.at("destination").get<std::string>();
    if (!destination.empty()) text += ", to " + destination;
    if (publisher.at("runs") == false) text += "   PUBLISHER NOT RUNNING";
    text += "\n";
    const auto alarm = outbox.at("alarm").get<std::string>();
    const auto reason = publisher.at("reason").get<std::string>();
    if (!alarm.empty())
        text += "             ALARM: " + alarm + "\n";
    else if (outbox.at("waiting") != 0 && !reason.empty())
        text += "             " + reason + "\n";
    return text;
}

} // namespace

std::string instruments_text(const Json& instruments) {
    std::string text;
    for (const Json& instrument : instruments) {
        text += format("  %-10s %-12s %-11s", instrument.at("name").get<std::string>().c_str(),
                       instrument.at("driver").get<std::string>().c_str(),
                       instrument.at("state").get<std::string>().c_str());
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
            text += "             no instrument: plays " + tape + "\n";
        if (!instrument.at("note").get<std::string>().empty())
            text += "             " + instrument.at("note").get<std::string>() + "\n";
    }
    return text.empty() ? "  none configured\n" : text;
}

std::string status_text(const Json& status) {
    const Json& axis = status.at("axis");
    const ShownUnits units = units_of(status);
    std::string text = "Station      " + status.at("station").get<std::string>() + "   " +
                       status.at("utc").get<std::string>() + "\n";
    text += run_text(status);
    // A daemon of before the drift test sends none.
    if (status.contains("drift") && !status.at("drift").is_null())
        text += drift_text(status.at("drift"));
    text += "Axis " + axis.at("name").get<std::string>() + "       " +
            number_or_dashes(axis.at("position_mm"), "%.4f", units.coordinate) + "   deviation " +
            units.deviation.of(axis.at("deviation_um"), "%+.2f") + "   spread " +
            units.reading.of(axis.at("spread_um"), "%.2f") +
            (axis.at("still") == true ? "   still" : "   moving") + "\n";
    if (axis.at("strength_percent").is_number())
        text += "Strength     " + number_or_dashes(axis.at("strength_percent"), "%.0f", "%") + "\n";
    const Json& trigger = status.at("trigger");
    text += "Trigger      " + trigger.at("port").get<std::string>() +
            (trigger.at("cnc_silent") == true ? "   CNC SILENT" : "") + "\n";
    if (!trigger.at("note").get<std::string>().empty())
        text += "             " + trigger.at("note").get<std::string>() + "\n";
    text += "Channels\n";
    for (const Json& channel : status.at("channels"))
        if (worth_showing(channel)) text += channel_text(channel);
    text += "Instruments\n" + instruments_text(status.at("instruments"));
    text += outbox_text(status.at("outbox"));
    for (const Json& note : status.at("notes"))
        text += "  " + note.get<std::string>() + "\n";
    return text;
}

std::string progress_line(const Json& status) {
    const Json& run = status.at("run");
    if (run.is_null()) return "no run";
    std::string text = format("%3d/%d  ", run.at("step").get<int>(), run.at("steps").get<int>());
    const Json& next = run.at("next");
    if (status.at("run_open") == true && !next.is_null())
        text += format("next P%02d %s %d  ", next.at("target").get<int>() + 1,
                       next.at("direction") == "positive" ? "↑" : "↓",
                       next.at("approach").get<int>() + 1);
    const ShownUnits units = units_of(status);
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
