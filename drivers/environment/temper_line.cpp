#include "drivers/environment/temper_line.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace axiscal {
namespace {

struct UnitRow {
    std::string_view text;
    double scale, offset; ///< stored = sent * scale + offset
    double lowest, highest;
};
/// The sensors' own range: the stick's is printed as -40 to +85 degC, a probe may reach further.
constexpr std::array temperature_units{UnitRow{" [C]", 1, 0, -55, 125},
                                       UnitRow{" [F]", 5.0 / 9, -160.0 / 9, -55, 125}};
constexpr std::array humidity_units{UnitRow{" [%RH]", 1, 0, 0, 100}};

constexpr std::size_t most_whole_digits = 3;

bool take(std::string_view& text, std::string_view what) {
    if (!text.starts_with(what)) return false;
    text.remove_prefix(what.size());
    return true;
}

bool is_digit(char letter) {
    return letter >= '0' && letter <= '9';
}

/// A sign or none, one to three digits, the point, so many decimals: 30.53. Empty otherwise.
std::optional<double> plain_number(std::string_view text, std::size_t decimals) {
    const std::string_view unsigned_text = text.substr(text.starts_with('-') ? 1 : 0);
    const auto point = unsigned_text.find('.');
    if (point == std::string_view::npos || point < 1 || point > most_whole_digits) return {};
    const std::string_view whole = unsigned_text.substr(0, point);
    const std::string_view part = unsigned_text.substr(point + 1);
    const bool digits = std::ranges::all_of(whole, is_digit) && std::ranges::all_of(part, is_digit);
    if (!digits || part.size() != decimals) return {};
    double value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

/// What stands in place of a number when there is none: "--.--".
bool is_dashes(std::string_view text) {
    return text.find('-') != text.npos && text.find_first_not_of("-. ") == text.npos;
}

/// One value with its unit, taken from the front.
struct Field {
    bool known = false; ///< a number or dashes, and a unit of the table
    std::optional<double> value;
};

template <class Units> Field take_field(std::string_view& text, const Units& units) {
    const auto end = text.find(' ');
    const std::string_view number = text.substr(0, end);
    text.remove_prefix(number.size());
    for (const UnitRow& unit : units) {
        if (!take(text, unit.text)) continue;
        const auto value = plain_number(number, 2);
        if (!value) return {is_dashes(number), std::nullopt};
        const double stored = *value * unit.scale + unit.offset;
        const bool possible = stored >= unit.lowest && stored <= unit.highest;
        return {true, possible ? std::optional{stored} : std::nullopt};
    }
    return {};
}

tl::unexpected<Error> no_line() {
    return fail(Fault::bad_frame, "no reading of a TEMPerX232");
}

} // namespace

Result<TemperLine> parse_temper_line(std::string_view line) {
    TemperLine reading;
    reading.probe = line.starts_with("Temp-Outer:");
    if (!take(line, "Temp-Outer:") && !take(line, "Temp-Inner:")) return no_line();
    const Field temperature = take_field(line, temperature_units);
    if (!temperature.known) return no_line();
    reading.temperature_degC = temperature.value;
    if (take(line, ",")) {
        take(line, " ");
        const Field humidity = take_field(line, humidity_units);
        if (!humidity.known) return no_line();
        reading.has_humidity = true;
        reading.humidity_percent = humidity.value;
    }
    if (line != "<") return no_line();
    return reading;
}

std::optional<TemperCalibration> parse_temper_calibration(std::string_view line) {
    TemperCalibration calibration;
    calibration.probe = line.starts_with("Outer-Calib:");
    if (!take(line, "Outer-Calib:") && !take(line, "Inner-Calib:")) return {};
    const auto kelvin = plain_number(line.substr(0, line.find(' ')), 1);
    const auto comma = line.find(" [C],");
    if (!kelvin || comma == std::string_view::npos) return {};
    line.remove_prefix(comma + std::string_view{" [C],"}.size());
    const auto percent = plain_number(line.substr(0, line.find(' ')), 1);
    if (!percent) return {};
    calibration.temperature_K = *kelvin;
    calibration.humidity_percent = *percent;
    return calibration;
}

std::string temper_version(std::string_view text) {
    const auto begin = text.rfind("TEMPer");
    if (begin == std::string_view::npos) return {};
    const std::string_view name = text.substr(begin);
    const auto end =
        std::ranges::find_if(name, [](char letter) { return letter <= ' ' || letter > '~'; });
    return {name.begin(), end};
}

} // namespace axiscal
