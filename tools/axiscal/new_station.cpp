#include "tools/axiscal/new_station.hpp"

#include "config/station_config.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

namespace axiscal {
namespace {

using Form = StationQuestion::Form;

constexpr std::array questions{
    StationQuestion{"axis", "axis", "name", "name of the axis", "X"},
    StationQuestion{"travel-low", "axis", "travel_low",
                    "lowest coordinate that the axis may be sent to, overrun included", "0 mm"},
    StationQuestion{"travel-high", "axis", "travel_high", "highest coordinate, overrun included",
                    "1000 mm"},
    StationQuestion{
        "sign", "axis", "sign",
        "1: the laser's reading rises when the axis moves to higher coordinates; -1: it "
        "falls",
        "1", Form::number},
    StationQuestion{"dead-path", "axis", "dead_path",
                    "distance from interferometer to reflector when the axis stands at its datum",
                    "120 mm"},
    StationQuestion{"expansion", "axis", "material.coefficient",
                    "expansion of what measures the axis inside the machine: scale or ball screw",
                    "11.5 um/(m*K)"},
    StationQuestion{"expansion-uncertainty", "axis", "material.standard_uncertainty",
                    "its standard uncertainty (k = 1), from the same data sheet", "0.5 um/(m*K)"},
    StationQuestion{"overrun", "cycle", "overrun",
                    "how far the axis goes beyond the outer targets before it turns", "2 mm"},
    StationQuestion{"feed", "cycle", "feed", "feed between the targets", "1000 mm/min"},
    StationQuestion{"shape", "trigger", "shape",
                    "what the CNC can do: sequence-block, single-register, coil-and-index, or "
                    "dwell, which needs no wire (docs/trigger.md)",
                    "sequence-block"},
    StationQuestion{
        "transport", "trigger", "transport",
        "how it speaks: tcp, rtu (serial), or tcp-mirrored, where the CNC is the server", "tcp"},
    StationQuestion{"client", "trigger", "allowed_clients",
                    "address of the CNC, or of its network; \"none\" where it runs on this PC",
                    "192.168.10.20", Form::list, "trigger.transport", "tcp"},
    StationQuestion{"serial-port", "trigger", "serial_port", "serial port to the CNC",
                    "/dev/ttyUSB0", Form::text, "trigger.transport", "rtu"},
    StationQuestion{"cnc-host", "trigger", "host", "address of the CNC", "192.168.10.20",
                    Form::text, "trigger.transport", "tcp-mirrored"},
    StationQuestion{"cnc-port", "trigger", "port", "TCP port of the CNC's Modbus server", "502",
                    Form::number, "trigger.transport", "tcp-mirrored"},
    StationQuestion{"window", "trigger", "window",
                    "how near the axis must be to a target to stand at it", "0.5 mm", Form::text,
                    "trigger.shape", "dwell"},
    StationQuestion{"stability-range", "trigger", "stability_range",
                    "by how much its reading may spread while it stands there", "2 um", Form::text,
                    "trigger.shape", "dwell"},
    StationQuestion{"hysteresis", "trigger", "hysteresis",
                    "how far beyond the window it must go to have left", "0.2 mm", Form::text,
                    "trigger.shape", "dwell"}};

std::string quoted_text(const std::string& text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
    return quoted + '"';
}

/// A number, true or false. An address or a date of digits and dots is a text.
bool is_bare(const std::string& value) {
    double number = 0;
    const char* const end = value.data() + value.size();
    const auto [rest, error] = std::from_chars(value.data(), end, number);
    const bool is_number = error == std::errc{} && rest == end && std::isfinite(number);
    return is_number || value == "true" || value == "false";
}

/// Numbers on a label or a certificate are texts.
std::string instrument_value(const std::string& key, const std::string& value) {
    constexpr std::array texts{"serial", "certificate_number", "name", "driver", "link"};
    const bool is_text = std::ranges::find(texts, key) != texts.end();
    return is_bare(value) && !is_text ? value : quoted_text(value);
}

std::string toml_value(const StationQuestion& question, const std::string& answer) {
    if (question.form == Form::number) return is_bare(answer) ? answer : quoted_text(answer);
    if (question.form == Form::text) return quoted_text(answer);
    std::string list;
    std::istringstream words{answer};
    for (std::string word; std::getline(words, word, ',');) {
        const auto begin = word.find_first_not_of(' ');
        if (begin == std::string::npos) continue;
        word = word.substr(begin, word.find_last_not_of(' ') + 1 - begin);
        list += (list.empty() ? "" : ", ") + quoted_text(word);
    }
    return "[" + list + "]";
}

} // namespace

std::span<const StationQuestion> station_questions() {
    return questions;
}

bool is_asked(const StationQuestion& question, const StationAnswers& answers) {
    const auto answer_to = [&](std::string_view name) {
        const auto found = answers.find(std::string{name});
        return found == answers.end() ? std::string{} : found->second;
    };
    if (question.name() == "trigger.transport" && answer_to("trigger.shape") == "dwell")
        return false; // it watches the axis and has no wire
    return question.when_key.empty() || answer_to(question.when_key) == question.when_answer;
}

std::string station_text(const StationAnswers& answers) {
    std::string text, table;
    for (const StationQuestion& question : questions) {
        const auto answer = answers.find(question.name());
        if (answer == answers.end() || !is_asked(question, answers)) continue;
        if (question.form == Form::list && answer->second == "none") continue;
        if (table != question.table) text += "\n[" + std::string{question.table} + "]\n";
        table = question.table;
        text += std::string{question.key} + " = " + toml_value(question, answer->second) + "\n";
    }
    return text;
}

std::string complaint_about(const StationQuestion& question, const StationAnswers& answers) {
    auto document = SettingsDocument::parse(station_text(answers), "the answers");
    if (!document) return document.error().detail;
    read_station(*document);
    for (const Refusal& refusal : document->finish())
        if (refusal.key == question.name()) return refusal.reason;
    return "";
}

std::string block_with(const std::string& block,
                       const std::vector<std::pair<std::string, std::string>>& settings) {
    std::string text = block;
    for (const auto& [key, value] : settings) {
        const std::string line = key + " = " + instrument_value(key, value) + "\n";
        const auto at = text.find("\n" + key + " = ");
        if (at == std::string::npos)
            text += line;
        else
            text.replace(at + 1, text.find('\n', at + 1) - at, line);
    }
    return text;
}

std::vector<std::string> examples_in(const std::string& block) {
    std::vector<std::string> lines;
    std::istringstream text{block};
    for (std::string line; std::getline(text, line);)
        if (line.find(" # ") != std::string::npos) lines.push_back(line);
    return lines;
}

} // namespace axiscal
