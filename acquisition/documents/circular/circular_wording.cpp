#include "acquisition/documents/circular/circular_wording.hpp"

#include "acquisition/documents/circular/circular_units.hpp"
#include "analysis/circular/circular_trials.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>

namespace axiscal {
namespace {

Sense sense_of(std::string_view key) {
    return key.ends_with("_ccw") ? Sense::ccw : Sense::cw;
}

/// "G", "G(b)", "F", "D"; of feedback signals "Gf".
std::string symbol_of(const std::string& key, SignalSource source) {
    if (!key.starts_with('G')) return key.substr(0, 1);
    const std::string letter = source == SignalSource::feedback ? "Gf" : "G";
    return key == "G_b" ? letter + "(b)" : letter;
}

CircularFigureLine
line_of(const CircularCertificate& certificate, const std::string& key, double value_mm) {
    const AxisNames& axes = certificate.measured.axes;
    const std::string both = axes[0] + axes[1];
    CircularFigureLine line{
        key, symbol_of(key, certificate.measured.test.source), both, {}, value_mm};
    if (key == "G_b") line.words = "Circular deviation, both senses";
    if (key == "D") line.words = "Mean bidirectional radial deviation";
    if (key == "G_b" || key == "D") return line;
    const Sense sense = sense_of(key);
    const std::string plane = plane_of(axes, sense);
    if (key.starts_with('G')) {
        line.index = plane;
        line.words = "Circular deviation, " + sense_name(sense);
        return line;
    }
    const bool greatest = key.starts_with("F_max");
    line.index = (greatest ? "max " : "min ") + plane;
    line.words =
        std::string{greatest ? "Largest" : "Smallest"} + " radial deviation, " + sense_name(sense);
    return line;
}

constexpr std::array<const char*, 8> order{"G_ccw",     "G_cw",     "G_b",      "F_max_ccw",
                                           "F_min_ccw", "F_max_cw", "F_min_cw", "D"};

std::string symbol_with_index(const std::string& key, const CircularCertificate& certificate) {
    const AxisNames& axes = certificate.measured.axes;
    std::string symbol = symbol_of(key, certificate.measured.test.source);
    if (key == "G_b" || key == "D") return symbol;
    const std::string extreme = key.starts_with("F_max")   ? " max"
                                : key.starts_with("F_min") ? " min"
                                                           : "";
    return symbol + extreme + " " + plane_of(axes, sense_of(key));
}

std::string angle_text(double angle_rad) {
    const double hundredths = std::round(folded_angle(angle_rad) * degrees_per_radian * 100);
    return fixed(hundredths < 36000 ? hundredths / 100 : 0, 2) + "°"; // a whole turn less a bit
}

int quadrant_at(double angle_rad) {
    return 1 + static_cast<int>(folded_angle(angle_rad) / (whole_turn_rad / 4));
}

} // namespace

std::function<std::string(std::string_view)>
circular_symbols(const CircularCertificate& certificate) {
    return [&certificate](std::string_view key) {
        return symbol_with_index(std::string{key}, certificate);
    };
}

std::vector<CircularFigureLine> figure_lines(const CircularCertificate& certificate) {
    const auto figures = circular::figures_by_key(certificate.parameters);
    std::vector<CircularFigureLine> lines;
    for (const char* key : order)
        if (const auto found = figures.find(key); found != figures.end())
            lines.push_back(line_of(certificate, found->first, found->second));
    return lines;
}

std::string radial_centre_text(const CircularCertificate& certificate) {
    std::string words;
    for (const CircularTrace& trace : certificate.measured.test.traces) {
        const RadialCentre centre = certificate.parameters.of(trace.sense)->F.centre;
        const std::string name =
            centre == RadialCentre::set_up ? "set-up centre" : "least squares centre";
        if (words.empty())
            words = "F about the " + name;
        else if (words.find(name) == std::string::npos)
            words += " (" + sense_name(trace.sense) + ": " + name + ")";
    }
    return words;
}

std::vector<std::string> reasons_not_evaluated(const CircularCertificate& certificate) {
    const auto& absent = certificate.parameters.not_evaluated;
    std::vector<std::pair<std::string, std::string>> groups; // reason, symbols
    for (const char* key : order) {
        const auto found = absent.find(key);
        if (found == absent.end()) continue;
        const std::string symbol = symbol_with_index(key, certificate);
        const auto group =
            std::ranges::find(groups, found->second, &std::pair<std::string, std::string>::first);
        if (group == groups.end())
            groups.emplace_back(found->second, symbol);
        else
            group->second += ", " + symbol;
    }
    std::vector<std::string> sentences;
    sentences.reserve(groups.size());
    for (const auto& [reason, symbols] : groups)
        sentences.push_back("Not evaluated: " + symbols + ": " + sentence_on_paper(reason) + ".");
    return sentences;
}

int deviation_decimals(const CircularCertificate& certificate) {
    constexpr double small_mm = 2e-3;
    double widest = 0;
    for (const auto& [key, value] : circular::figures_by_key(certificate.parameters))
        if (key.starts_with('G')) widest = std::max(widest, value);
    return widest < small_mm ? 2 : 1;
}

std::string micrometres(double length_mm, int decimals, bool plus) {
    const std::string digits = fixed(length_mm * um_per_mm, decimals);
    const bool unsigned_zero = digits.find_first_of("123456789") == std::string::npos;
    return (plus && length_mm > 0 && !unsigned_zero ? "+" : "") + digits;
}

std::string uncertainty_text(const CircularCertificate& certificate, const std::string& key) {
    const CircularFigureUncertainty* known = certificate.uncertainty_of(key);
    if (!known) return "U not evaluated";
    return "± " + fixed_up(known->expanded_mm * um_per_mm, deviation_decimals(certificate));
}

std::string compact_number(double value, int digits) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.*g", digits, std::fabs(value));
    return (value < 0 ? "\u2212" : "") + std::string{text.data()};
}

std::string feed_text(double mm_per_s) {
    constexpr double seconds_per_minute = 60;
    return compact_number(mm_per_s * seconds_per_minute) + " mm/min";
}

std::string sense_name(Sense sense) {
    return sense == Sense::ccw ? "counter-clockwise" : "clockwise";
}

std::string plane_of(const AxisNames& axes, Sense sense) {
    return sense == Sense::ccw ? axes[0] + axes[1] : axes[1] + axes[0];
}

std::string start_text(const CircularTrace& trace) {
    constexpr double slightly = 1e-6;
    const double first = trace.angle_rad.front();
    return angle_text(first) + ", into quadrant " +
           std::to_string(quadrant_at(first + sign_of(trace.sense) * slightly));
}

std::string end_text(const CircularTrace& trace) {
    constexpr double slightly = 1e-6;
    const double last = trace.angle_rad.back();
    return angle_text(last) + ", out of quadrant " +
           std::to_string(quadrant_at(last - sign_of(trace.sense) * slightly));
}

std::string temperature_text(const CircularTemperature& temperature) {
    if (!temperature.mean_degC) return "not stated";
    std::string words = fixed(*temperature.mean_degC, 2) + " °C";
    std::string range;
    if (temperature.high_degC > temperature.low_degC)
        range = fixed(temperature.low_degC, 2) + " to " + fixed(temperature.high_degC, 2);
    if (!temperature.channel.empty()) range += (range.empty() ? "" : "; ") + temperature.channel;
    return range.empty() ? words : words + " (" + range + ")";
}

std::string sentence_on_paper(std::string words) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 7> units{
        {{" um", " µm"},
         {" us", " µs"},
         {" urad", " µrad"},
         {" deg", "°"},
         {"in sense ccw", "counter-clockwise"},
         {"in sense cw", "clockwise"},
         {" arcsec", "″"}}};
    for (const auto& [letters, sign] : units)
        for (auto at = words.find(letters); at != std::string::npos;
             at = words.find(letters, at + 1)) {
            const std::size_t after = at + letters.size();
            const bool goes_on =
                after < words.size() && std::isalpha(static_cast<unsigned char>(words[after]));
            if (!goes_on) words.replace(at, letters.size(), sign);
        }
    for (auto at = words.find(" -"); at != std::string::npos; at = words.find(" -", at + 1))
        if (at + 2 < words.size() && std::isalnum(static_cast<unsigned char>(words[at + 2])))
            words.replace(at, 2, " \u2212");
    return words;
}

std::string iso_date_of(const CircularMeasurement& measured) {
    constexpr std::size_t letters = 10;
    std::string date = measured.started_utc.substr(0, letters);
    if (date.size() != letters) return {};
    for (std::size_t i = 0; i < letters; ++i) {
        const bool dash = i == 4 || i == 7;
        if (dash ? date[i] != '-' : !std::isdigit(static_cast<unsigned char>(date[i]))) return {};
    }
    return date;
}

} // namespace axiscal
