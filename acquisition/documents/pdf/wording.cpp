#include "acquisition/documents/pdf/wording.hpp"

#include "analysis/positioning/standards.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <regex>

namespace axiscal {
namespace {

/// Largest minus smallest deviation; 0 without data.
double span_of(const RunAt20C& run) {
    double low = 0, high = 0;
    bool any = false;
    for (const auto* table : {&run.forward(), &run.backward()})
        for (const auto& row : *table)
            for (const double value : row) {
                low = any ? std::min(low, value) : value;
                high = any ? std::max(high, value) : value;
                any = true;
            }
    return high - low;
}

int decimals_for(const std::vector<double>& positions) {
    constexpr int fewest = 3, most = 6;
    const auto exact_with = [&](int decimals) {
        const double scale = std::pow(10.0, decimals);
        return std::ranges::all_of(positions, [&](double position) {
            return std::abs(position * scale - std::round(position * scale)) < 1e-3;
        });
    };
    int decimals = fewest;
    while (decimals < most && !exact_with(decimals))
        ++decimals;
    return decimals;
}

} // namespace

std::string fixed(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, std::abs(value));
    const std::string digits{text};
    const bool negative = value < 0 && digits.find_first_of("123456789") != std::string::npos;
    return (negative ? "\u2212" : "") + digits;
}

std::string fixed_up(double value, int decimals) {
    constexpr double noise = 1e-6; // of the last digit: what arithmetic adds to a round number
    const double scale = std::pow(10.0, decimals);
    const double digits = std::ceil(std::abs(value) * scale - noise) / scale;
    return fixed(value < 0 ? -digits : digits, decimals);
}

int length_decimals(double range_um) {
    if (range_um < 1) return 3;
    return range_um < 100 ? 2 : 1;
}

std::string stated(const std::string& text) {
    const bool empty = text.find_first_not_of(" \t\r\n") == std::string::npos;
    return empty ? "not stated" : text;
}

std::string as_stated(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::string uncertainty_on_paper(double uncertainty) {
    return fixed(uncertainty, 3);
}

std::string readable_instant(const std::string& iso8601) {
    const bool instant = iso8601.size() == 20 && iso8601[10] == 'T' && iso8601.back() == 'Z';
    if (!instant) return stated(iso8601);
    return iso8601.substr(0, 10) + " " + iso8601.substr(11, 8) + " UTC";
}

std::string PaperUnits::of_deviation(double in_result_unit) const {
    return fixed(in_result_unit * deviation_factor, deviation_decimals);
}
std::string PaperUnits::of_deviation(const std::optional<double>& in_result_unit) const {
    return in_result_unit ? of_deviation(*in_result_unit) : "–";
}
std::string PaperUnits::of_spread(const std::optional<double>& in_result_unit) const {
    if (!in_result_unit) return of_deviation(in_result_unit);
    return fixed(*in_result_unit * deviation_factor, deviation_decimals + 1);
}

std::string PaperUnits::of_position(double in_result_unit) const {
    return fixed(in_result_unit, position_decimals);
}

PaperUnits paper_units_of(const Certificate& certificate) {
    PaperUnits units;
    if (certificate.run.plan.axis_kind == AxisKind::rotary) {
        units.position = "°";
        units.deviation = "″";
        units.deviation_factor = 3600;
    }
    const double span = span_of(certificate.deviations) * units.deviation_factor;
    units.deviation_decimals = span < 2 ? 2 : 1;
    units.position_decimals = decimals_for(certificate.deviations.targets());
    return units;
}

std::vector<ParameterLine> parameters_of_both_directions(const PositioningParameters& p) {
    return {{"A", "A", "Accuracy, both directions", p.A},
            {"E", "E", "Systematic error, both directions", p.E},
            {"M", "M", "Range of the mean error", p.M},
            {"R", "R", "Repeatability, both directions", p.R},
            {"B", "B", "Largest reversal", p.B},
            {"B_mean", "B\u0304", "Mean reversal, signed", p.B_mean}};
}

std::vector<ParameterLine> parameters_of_one_direction(const PositioningParameters& p) {
    return {{"A_forward", "A↑", "Accuracy, forward", p.A_forward},
            {"A_backward", "A↓", "Accuracy, backward", p.A_backward},
            {"E_forward", "E↑", "Systematic error, forward", p.E_forward},
            {"E_backward", "E↓", "Systematic error, backward", p.E_backward},
            {"R_forward", "R↑", "Repeatability, forward", p.R_forward},
            {"R_backward", "R↓", "Repeatability, backward", p.R_backward}};
}

std::string positioning_symbol(std::string_view key) {
    const FigureLabel label = figure_label(key, "ISO 230-2:2014", {});
    return label.symbol.empty() ? std::string{key} : label.symbol;
}

std::vector<std::string> reasons_not_evaluated(const PositioningResult& result) {
    std::vector<ParameterLine> lines = parameters_of_both_directions(result.parameters);
    std::ranges::copy(parameters_of_one_direction(result.parameters), std::back_inserter(lines));
    std::vector<std::pair<std::string, std::string>> groups; // reason, symbols
    for (const ParameterLine& line : lines) {
        const auto reason = result.not_evaluated.find(std::string{line.key});
        if (reason == result.not_evaluated.end()) continue;
        const auto group =
            std::ranges::find(groups, reason->second, &std::pair<std::string, std::string>::first);
        if (group == groups.end())
            groups.emplace_back(reason->second, line.symbol);
        else
            group->second += ", " + std::string{line.symbol};
    }
    std::vector<std::string> sentences;
    std::ranges::transform(groups, std::back_inserter(sentences), [](const auto& group) {
        return "Not evaluated: " + group.second + ": " + group.first;
    });
    return sentences;
}

std::string footnote_sign(const std::string& status) {
    return status == "R" ? "¹" : "";
}

std::string without_device_paths(const std::string& words) {
    static const std::regex place{
        R"((serial |counter |files below )?/(dev|sys|run|tmp)/\S*[^\s.,;:)]( \d+ [5-8][NEO][12])?)"};
    return std::regex_replace(words, place, "its line");
}

std::string formula_on_paper(std::string formula) {
    static constexpr std::pair<std::string_view, std::string_view> signs[]{
        {"alpha", "α"}, {"theta", "θ"}, {"delta", "δ"}, {"sqrt ", "√"},
        {"sqrt", "√"},  {"dT", "ΔT"},   {"^2", "²"},    {"_forward", "↑"}};
    for (const auto& [letters, sign] : signs)
        for (auto at = formula.find(letters); at != std::string::npos;
             at = formula.find(letters, at + sign.size()))
            formula.replace(at, letters.size(), sign);
    return formula;
}

ChannelPaper paper_of(ChannelKind kind, Medium medium) {
    switch (kind) {
    case ChannelKind::temperature:
        return {medium == Medium::material ? "Material temperature" : "Air temperature", "°C", 1, 2,
                0.2};
    case ChannelKind::pressure: return {"Air pressure", "hPa", 0.01, 2, 1};
    case ChannelKind::humidity: return {"Relative humidity", "%", 1, 1, 2};
    case ChannelKind::carbon_dioxide: return {"Carbon dioxide", "ppm", 1, 0, 50};
    case ChannelKind::strength: return {"Beam strength", "%", 1, 0, 10};
    case ChannelKind::displacement: return {"Displacement", "mm", 1000, 4, 0.001};
    case ChannelKind::angle: return {"Angle", "″", 1, 2, 0.1};
    }
    return {};
}

namespace {

/// "at most 0.0124 µm": never smaller than it is, nor 0.
std::string synchronisation_amount(const RunRecord& run, double error_um) {
    const SynchronisationUnit unit = synchronisation_unit_of(run);
    const double error = error_um * unit.per_um;
    constexpr double least = 1e-4; // what four decimals can show
    const std::string amount = error < least ? "less than 0.0001" : "at most " + fixed_up(error, 4);
    if (unit.name == "arcsec") return amount + "″ of the autocollimator's reading";
    return amount + (run.rotary ? " µm of the interferometer's reading" : " µm");
}

} // namespace

std::string synchronisation_text(const Certificate& certificate) {
    const SynchronisationSummary over =
        summarize_synchronisation(certificate.run, certificate.attachments.synchronisation);
    if (!over.largest)
        return "Synchronisation error: not stated; no uncertainty of the samples' time is known.";
    const Synchronisation& most = *over.largest->stated;
    const std::string where =
        over.largest->step < 0 ? "the datum" : "point " + std::to_string(over.largest->step + 1);
    std::string words =
        "Synchronisation error: " + synchronisation_amount(certificate.run, most.error_um) +
        " (at " + where +
        "), the speed of the axis in the window of the "
        "capture times the standard uncertainty u(t) of its samples' time, there " +
        fixed_up(seconds_of(most.time_uncertainty) * 1e6, 1) + " µs.";
    if (over.stated < over.captures)
        words += " Not stated for " + std::to_string(over.captures - over.stated) + " of " +
                 std::to_string(over.captures) + " captures.";
    return words;
}

std::string refractivity_text(const CompensationSummary& done) {
    return fixed(done.refractive_index_minus_1_first * 1e6, 3) + " → " +
           fixed(done.refractive_index_minus_1_last * 1e6, 3) + " ×10\u207b\u2076";
}

std::string air_formula_text(const std::string& name) {
    if (name == "ciddor") return "Ciddor (1996)";
    if (name == "edlen") return "Edlén, modified by Birch and Downs (1994)";
    return stated(name);
}

std::string expansion_form_text(const std::string& name) {
    if (name == "first_order") return "first order";
    return stated(name);
}

std::string coefficient_text(double per_K,
                             const std::optional<double>& standard_uncertainty_per_K) {
    const std::string words = fixed(per_K * 1e6, 2) + " µm/(m·K)";
    if (!standard_uncertainty_per_K) return words + ", uncertainty not stated";
    return words + ", standard uncertainty " + fixed(*standard_uncertainty_per_K * 1e6, 2);
}

} // namespace axiscal
