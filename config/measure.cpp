#include "config/measure.hpp"

#include "analysis/quantity/quantity.hpp"
#include "analysis/quantity/temperature.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace axiscal {
namespace {

using Names = std::string_view;

constexpr std::array length_units{UnitName{"mm", 1e-3}, UnitName{"um", 1e-6},
                                  UnitName{"nm", 1e-9}, UnitName{"cm", 1e-2},
                                  UnitName{"m", 1},     UnitName{"in", 25.4e-3}};
constexpr std::array<Names, 4> length_examples{"2 mm", "500 mm", "5 um", "632.991 nm"};

// On a rotary axis one millimetre stands for one degree (RunPlan).
constexpr std::array rotary_units{UnitName{"deg", 1e-3}, UnitName{"arcmin", 1e-3 / 60},
                                  UnitName{"arcsec", 1e-3 / 3600}};
constexpr std::array<Names, 3> rotary_examples{"2 deg", "180 deg", "2 arcsec"};

constexpr std::array speed_units{UnitName{"mm/min", 1e-3 / 60}, UnitName{"m/min", 1.0 / 60},
                                 UnitName{"mm/s", 1e-3}, UnitName{"m/s", 1},
                                 UnitName{"um/s", 1e-6}};
constexpr std::array<Names, 3> speed_examples{"1000 mm/min", "1 um/s", "30 m/min"};

constexpr std::array rotary_speed_units{UnitName{"deg/min", 1e-3 / 60}, UnitName{"deg/s", 1e-3},
                                        UnitName{"arcsec/s", 1e-3 / 3600}};
constexpr std::array<Names, 2> rotary_speed_examples{"360 deg/min", "1 arcsec/s"};

constexpr std::array duration_units{UnitName{"s", 1}, UnitName{"ms", 1e-3}, UnitName{"us", 1e-6},
                                    UnitName{"min", 60}, UnitName{"h", 3600}};
constexpr std::array<Names, 3> duration_examples{"4 s", "500 ms", "5 min"};

constexpr std::array temperature_units{UnitName{"degC", 1}, UnitName{"°C", 1},
                                       UnitName{"K", 1, -273.15}};
constexpr std::array<Names, 1> temperature_examples{"20 degC"};

constexpr std::array difference_units{UnitName{"K", 1}, UnitName{"degC", 1}, UnitName{"°C", 1}};
constexpr std::array<Names, 2> difference_examples{"0.5 K", "-0.05 K"};

constexpr std::array pressure_units{UnitName{"hPa", 100}, UnitName{"Pa", 1}, UnitName{"kPa", 1000},
                                    UnitName{"mbar", 100}};
constexpr std::array<Names, 2> pressure_examples{"1013.25 hPa", "0.3 hPa"};

constexpr std::array ratio_units{UnitName{"%", 1e-2}, UnitName{"ppm", 1e-6}};
constexpr std::array<Names, 2> ratio_examples{"50 %", "450 ppm"};

constexpr std::array expansion_units{UnitName{"um/(m*K)", 1e-6}, UnitName{"um/m/K", 1e-6},
                                     UnitName{"ppm/K", 1e-6}, UnitName{"1/K", 1}};
constexpr std::array<Names, 2> expansion_examples{"11.5 um/(m*K)", "0.5 um/(m*K)"};

constexpr std::array angle_units{
    UnitName{"mrad", 1e-3},         UnitName{"urad", 1e-6},
    UnitName{"um/m", 1e-6},         UnitName{"rad", 1},
    UnitName{"deg", degree.size},   UnitName{"arcmin", degree.size / 60},
    UnitName{"arcsec", arcsec.size}};
constexpr std::array<Names, 1> angle_examples{"1 mrad"};

constexpr std::array device_limit_units{UnitName{"um", 1e-6},   UnitName{"nm", 1e-9},
                                        UnitName{"mm", 1e-3},   UnitName{"um/m", 1e-6},
                                        UnitName{"nm/m", 1e-9}, UnitName{"ppm", 1e-6}};
constexpr std::array<Names, 1> device_limit_examples{"0.7 um/m"};

constexpr std::array correction_units{
    UnitName{"K", 1},     UnitName{"degC", 1},   UnitName{"°C", 1},   UnitName{"Pa", 1},
    UnitName{"hPa", 100}, UnitName{"mbar", 100}, UnitName{"%", 1},    UnitName{"ppm", 1},
    UnitName{"um", 1e-6}, UnitName{"nm", 1e-9},  UnitName{"mm", 1e-3}};
constexpr std::array<Names, 1> correction_examples{"-0.05 K"};

constexpr std::array channel_reading_units{
    UnitName{"degC", 1},   UnitName{"°C", 1},     UnitName{"Pa", 1}, UnitName{"hPa", 100},
    UnitName{"kPa", 1000}, UnitName{"mbar", 100}, UnitName{"%", 1},  UnitName{"ppm", 1},
    UnitName{"mm", 1e-3},  UnitName{"um", 1e-6}};
constexpr std::array<Names, 1> channel_reading_examples{"15 degC"};

constexpr std::array channel_uncertainty_units{
    UnitName{"K", 1},      UnitName{"degC", 1},   UnitName{"°C", 1},    UnitName{"Pa", 1},
    UnitName{"hPa", 100},  UnitName{"mbar", 100}, UnitName{"%", 1},     UnitName{"ppm", 1},
    UnitName{"um", 1e-6},  UnitName{"nm", 1e-9},  UnitName{"mm", 1e-3}, UnitName{"um/m", 1e-6},
    UnitName{"nm/m", 1e-9}};
constexpr std::array<Names, 1> channel_uncertainty_examples{"0.05 K"};

/// One spelling of each sign: both micro signs, middle dot, degree sign; blanks away.
std::string plain_unit(std::string_view text) {
    static constexpr std::pair<Names, Names> signs[] = {{"\u00B5", "u"}, {"\u03BC", "u"},
                                                        {"\u00B7", "*"}, {"\u00B0", "deg"},
                                                        {" ", ""},       {"\t", ""}};
    std::string plain;
    while (!text.empty()) {
        const auto* sign = std::find_if(std::begin(signs), std::end(signs), [&](const auto& row) {
            return text.substr(0, row.first.size()) == row.first;
        });
        const bool known = sign != std::end(signs);
        plain += known ? sign->second : text.substr(0, 1);
        text.remove_prefix(known ? sign->first.size() : 1);
    }
    return plain;
}

std::string lower(std::string_view text) {
    std::string result{text};
    for (char& letter : result)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    return result;
}

const UnitName* find_unit(std::string_view written, const Measure& measure) {
    const std::string plain = plain_unit(written);
    for (const UnitName& unit : measure.units)
        if (plain_unit(unit.name) == plain) return &unit;
    return nullptr;
}

std::string unit_hint(std::string_view written, const Measure& measure) {
    for (const UnitName& unit : measure.units)
        if (lower(plain_unit(unit.name)) == lower(plain_unit(written)))
            return "; did you mean " + std::string{unit.name} + "?";
    return "";
}

tl::unexpected<Error> refused(std::string text) {
    return fail(Fault::bad_configuration, std::move(text));
}

} // namespace

const Measure length_measure{"a length", length_units, length_examples},
    rotary_measure{"an angle (this axis is rotary)", rotary_units, rotary_examples},
    speed_measure{"a speed", speed_units, speed_examples},
    rotary_speed_measure{"an angular speed (this axis is rotary)", rotary_speed_units,
                         rotary_speed_examples},
    duration_measure{"a time", duration_units, duration_examples},
    temperature_measure{"a temperature", temperature_units, temperature_examples},
    temperature_difference_measure{"a temperature difference", difference_units,
                                   difference_examples},
    pressure_measure{"a pressure", pressure_units, pressure_examples},
    ratio_measure{"a share", ratio_units, ratio_examples},
    expansion_measure{"a coefficient of expansion", expansion_units, expansion_examples},
    angle_measure{"an angle", angle_units, angle_examples},
    device_limit_measure{"a length or a length for each metre", device_limit_units,
                         device_limit_examples},
    correction_measure{"a correction", correction_units, correction_examples},
    channel_reading_measure{"a reading of the channel", channel_reading_units,
                            channel_reading_examples},
    channel_uncertainty_measure{"an expanded uncertainty", channel_uncertainty_units,
                                channel_uncertainty_examples};

Result<Measured> read_measure(std::string_view text, const Measure& measure) {
    const auto begin = text.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return refused("is empty");
    std::string_view rest = text.substr(begin);
    if (rest.front() == '+') rest.remove_prefix(1);
    double number = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    const std::string quoted = "\"" + std::string{text} + "\"";
    if (error != std::errc{} || !std::isfinite(number))
        return refused(quoted + " does not begin with a number");
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    if (!rest.empty() && rest.front() == ',')
        return refused(quoted + " has a comma: write a point as decimal sign");
    if (plain_unit(rest).empty()) return refused(quoted + " has no unit");
    const UnitName* unit = find_unit(rest, measure);
    const auto word = rest.substr(std::min(rest.find_first_not_of(" \t"), rest.size()));
    if (!unit)
        return refused("\"" + std::string{word} + "\" is no unit of " + std::string{measure.what} +
                       unit_hint(word, measure));
    const double si = number * unit->size + unit->shift;
    if (!std::isfinite(si)) return refused(quoted + " is too large a number");
    return Measured{si, *unit};
}

std::string write_number(double value) {
    std::array<char, 64> buffer{};
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                            std::chars_format::general, 6);
    return error == std::errc{} ? std::string(buffer.data(), end) : "?";
}

std::string write_measure(double si, const UnitName& unit) {
    return write_number((si - unit.shift) / unit.size) + " " + std::string{unit.name};
}

std::string list_units(const Measure& measure) {
    std::string list;
    for (const UnitName& unit : measure.units)
        list += (list.empty() ? "" : ", ") + std::string{unit.name};
    return list;
}

std::string example_of(const Measure& measure, double low, double high) {
    for (const auto& example : measure.examples) {
        const auto read = read_measure(example, measure);
        if (read && read->si >= low && read->si <= high) return std::string{example};
    }
    return write_measure(low, measure.units.front());
}

bool within(double value, double low, double high) {
    constexpr double slack = 1e-12;
    return value >= low - std::abs(low) * slack && value <= high + std::abs(high) * slack;
}

std::size_t edit_distance(std::string_view word, std::string_view other) {
    const std::size_t width = other.size() + 1;
    std::vector<std::size_t> cost((word.size() + 1) * width);
    const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& {
        return cost[i * width + j];
    };
    for (std::size_t i = 0; i <= word.size(); ++i) {
        for (std::size_t j = 0; j <= other.size(); ++j) {
            if (i == 0 || j == 0) {
                at(i, j) = i + j;
                continue;
            }
            const std::size_t replace = word[i - 1] == other[j - 1] ? 0 : 1;
            at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, at(i - 1, j - 1) + replace});
            if (i > 1 && j > 1 && word[i - 1] == other[j - 2] && word[i - 2] == other[j - 1])
                at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
        }
    }
    return cost.back();
}

std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates) {
    std::string best;
    std::size_t best_cost = std::max<std::size_t>(1, word.size() / 3) + 1;
    if (word.size() > 64) return best; // the table of edits stays small
    for (const std::string& candidate : candidates) {
        // A word broken off ("dracal" for "dracal-vcp") is one slip, however much is missing.
        const bool broken_off = word.size() >= 3 && lower(candidate).starts_with(lower(word));
        const std::size_t edits = broken_off ? 1 : edit_distance(lower(word), lower(candidate));
        if (edits < best_cost) {
            best = candidate;
            best_cost = edits;
        }
    }
    return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
    const std::string near = nearest_word(word, candidates);
    return near.empty() ? "" : "; did you mean \"" + near + "\"?";
}

} // namespace axiscal
