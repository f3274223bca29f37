#include "drivers/gauge/gauge_answer.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace axiscal {
namespace {

using namespace std::chrono_literals;

constexpr std::string_view tolerance_marks = "<=>? ", shown_marks = "A1 SGD2";
/// Degrees, minutes, radians and the scaled units of the read-out.
constexpr std::string_view units_of_no_length = "GMRmiU";

/// ND 281B, "Data format": the sign, then ten places.
constexpr std::array<std::string_view, 1> heidenhain_shapes{"+########## ums"};
constexpr std::array<std::string_view, 1> mitutoyo_shapes{"0cA+########"};
// RES2 and RES3 in mm, RES4 and RES5 in inches. A positive value may have a blank for its sign.
constexpr std::array<std::string_view, 8> sylvac_shapes{"M+999.999M", "M+999.99M", "M+99.9999M",
                                                        "M+9.99999M", "_999.999M", "_999.99M",
                                                        "_99.9999M",  "_9.99999M"};

// 003: both axes are valid, 001 and 002: the first or the second alone.
constexpr std::array<std::string_view, 2> elcomat_x_shapes{"4 003 N V", "4 001 N V"};
constexpr std::array<std::string_view, 2> elcomat_y_shapes{"4 003 V N", "4 002 V N"};

constexpr std::span<const GaugeError> no_errors{};
constexpr std::array mitutoyo_errors{
    GaugeError{"91", Fault::signal_error, "the gauge sends an error code instead of a value"}};
constexpr std::array sylvac_errors{
    GaugeError{"ERR", Fault::signal_error, "the gauge answers with an error"}};
constexpr std::string_view no_mirror = "the autocollimator sees no mirror before this axis";
constexpr std::array elcomat_x_errors{GaugeError{"4 000 ", Fault::beam_lost, no_mirror},
                                      GaugeError{"4 002 ", Fault::beam_lost, no_mirror}};
constexpr std::array elcomat_y_errors{GaugeError{"4 000 ", Fault::beam_lost, no_mirror},
                                      GaugeError{"4 001 ", Fault::beam_lost, no_mirror}};

LinkSettings serial(int baud, char parity, int data_bits, int stop_bits) {
    LinkSettings line;
    line.baud = baud;
    line.parity = parity;
    line.data_bits = data_bits;
    line.stop_bits = stop_bits;
    return line;
}

/// The opto head lives on the modem lines: DTR high and RTS low in duplex.
LinkSettings opto_powered(LinkSettings line) {
    line.dtr = true;
    line.rts = false;
    return line;
}

constexpr std::string_view moeller_wedel = "MÖLLER-WEDEL", elcomat = "ELCOMAT 3000";
/// "4 003 -1000.00 -1000.00" and its CR.
constexpr int usual_characters = 18, elcomat_characters = 24;

const std::array<GaugeModel, 5>& models() {
    static const std::array<GaugeModel, 5> rows{
        GaugeModel{"nd-28x", "HEIDENHAIN", "ND 28x", serial(9600, 'E', 7, 2), "\x02", '\n',
                   heidenhain_shapes, no_errors, "", 200ms},
        GaugeModel{"mitutoyo",
                   "Mitutoyo",
                   "ASCII output",
                   serial(9600, 'N', 8, 1),
                   "1",
                   '\r',
                   mitutoyo_shapes,
                   mitutoyo_errors,
                   "",
                   200ms,
                   {},
                   usual_characters,
                   true},
        GaugeModel{"sylvac",
                   "Sylvac",
                   "opto RS duplex",
                   opto_powered(serial(4800, 'E', 7, 2)),
                   "?\r",
                   '\r',
                   sylvac_shapes,
                   sylvac_errors,
                   "SET?\r",
                   200ms,
                   {},
                   usual_characters,
                   true},
        GaugeModel{"elcomat-x", moeller_wedel, elcomat, serial(19200, 'N', 8, 1), "a\r\n", '\r',
                   elcomat_x_shapes, elcomat_x_errors, "", 100ms, GaugeUnit::arcseconds,
                   elcomat_characters},
        GaugeModel{"elcomat-y", moeller_wedel, elcomat, serial(19200, 'N', 8, 1), "a\r\n", '\r',
                   elcomat_y_shapes, elcomat_y_errors, "", 100ms, GaugeUnit::arcseconds,
                   elcomat_characters},
    };
    return rows;
}

/// The number's text without leading blanks: digits with at most one point.
std::optional<double> plain_number(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    const bool clean = text.find_first_not_of("0123456789.") == std::string_view::npos &&
                       text.find_first_of("0123456789") != std::string_view::npos &&
                       std::ranges::count(text, '.') <= 1;
    if (!clean) return std::nullopt;
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc{} && end == text.data() + text.size();
    return whole ? std::optional{value} : std::nullopt;
}

bool in_number(char letter) {
    return letter == ' ' || letter == '.' || (letter >= '0' && letter <= '9');
}

/// What one shape finds in one line.
struct Match {
    std::string number;
    char sign = '+', unit = '\0', input = '1', shown = 'A';
};

/// Takes one letter of the line at a letter of the shape; false: it does not fit.
bool take(char shape, char letter, Match& match) {
    switch (shape) {
    case '+': match.sign = letter; return letter == '+' || letter == '-';
    case '_': return letter == ' ';
    case '#': match.number += letter; return in_number(letter);
    case '9': match.number += letter; return letter >= '0' && letter <= '9';
    case '.': match.number += letter; return letter == '.';
    case 'u':
        match.unit = letter;
        return letter == ' ' || letter == '"' || letter == '?' ||
               units_of_no_length.find(letter) != std::string_view::npos;
    case 'm': return tolerance_marks.find(letter) != std::string_view::npos;
    case 's': match.shown = letter; return shown_marks.find(letter) != std::string_view::npos;
    case 'c': match.input = letter; return letter >= '1' && letter <= '9';
    default: return shape == letter;
    }
}

bool is_digit(char letter) {
    return letter >= '0' && letter <= '9';
}

/// Takes "-12.34" at the begin of `rest`, with at most six places before the point and as many
/// behind it; its sign and places stand in `match` if it is the number.
bool take_free_number(std::string_view& rest, bool taken, Match& match) {
    constexpr std::size_t most_places = 6;
    std::string_view text = rest;
    const bool negative = text.starts_with('-');
    if (negative) text.remove_prefix(1);
    const auto places = [](std::string_view digits) {
        const auto end = std::ranges::find_if_not(digits, is_digit);
        return static_cast<std::size_t>(end - digits.begin());
    };
    const std::size_t whole = places(text);
    if (whole == 0 || whole > most_places || whole == text.size() || text[whole] != '.')
        return false;
    const std::size_t fraction = places(text.substr(whole + 1));
    if (fraction == 0 || fraction > most_places) return false;
    if (taken) {
        match.sign = negative ? '-' : '+';
        match.number = text.substr(0, whole + 1 + fraction);
    }
    rest = text.substr(whole + 1 + fraction);
    return true;
}

std::optional<Match> match_shape(std::string_view line, std::string_view shape) {
    Match match;
    std::size_t at = 0;
    for (const char letter : shape) {
        if (letter == 'M') {
            const bool marked = at < line.size() && tolerance_marks.find(line[at]) != line.npos;
            at += marked ? 1 : 0;
            continue;
        }
        if (letter == 'N' || letter == 'V') {
            std::string_view rest = line.substr(at);
            if (!take_free_number(rest, letter == 'N', match)) return std::nullopt;
            at = line.size() - rest.size();
            continue;
        }
        if (at == line.size() || !take(letter, line[at], match)) return std::nullopt;
        ++at;
    }
    return at == line.size() ? std::optional{match} : std::nullopt;
}

/// Why a record of the right form is no value of the gauge; empty where it is one.
std::string complaint_of(const Match& match) {
    if (match.unit == '?') return "the read-out marks its value as faulty";
    if (units_of_no_length.find(match.unit) != std::string_view::npos)
        return std::string{"the read-out shows no length (unit '"} + match.unit +
               "'): set it to mm or inches";
    switch (match.shown) {
    case 'S': return "the read-out shows MIN of a series, or X1-X2 of two axes: set it to ACTL, X1";
    case 'G': return "the read-out shows MAX of a series: set it to ACTL";
    case 'D': return "the read-out shows DIFF of a series: set it to ACTL";
    case '2': return "the read-out shows its second axis: set it to X1";
    default: return "";
    }
}

int decimals_of(std::string_view number) {
    const auto point = number.find('.');
    return point == number.npos ? 0 : static_cast<int>(number.size() - point - 1);
}

bool mentions(std::span<const std::string_view> shapes, char letter) {
    return std::ranges::any_of(
        shapes, [&](std::string_view shape) { return shape.find(letter) != shape.npos; });
}

} // namespace

bool GaugeModel::tells_unit() const {
    return mentions(shapes, 'u') || !unit_request.empty();
}

bool GaugeModel::has_inputs() const {
    return mentions(shapes, 'c');
}

std::span<const GaugeModel> gauge_models() {
    return models();
}

const GaugeModel* find_gauge_model(std::string_view name) {
    const auto found = std::ranges::find(models(), name, &GaugeModel::name);
    return found == models().end() ? nullptr : &*found;
}

Result<GaugeAnswer> decode_gauge_answer(std::string_view line, const GaugeModel& model) {
    for (const std::string_view shape : model.shapes) {
        const auto match = match_shape(line, shape);
        if (!match) continue;
        if (auto complaint = complaint_of(*match); !complaint.empty())
            return fail(Fault::signal_error, std::move(complaint));
        const auto number = plain_number(match->number);
        if (!number) continue;
        GaugeAnswer answer;
        answer.number = match->sign == '-' ? -*number : *number;
        answer.decimals = decimals_of(match->number);
        if (match->unit != '\0')
            answer.unit = match->unit == '"' ? GaugeUnit::inches : GaugeUnit::millimetres;
        answer.input = match->input - '0';
        return answer;
    }
    for (const GaugeError& error : model.errors)
        if (line.starts_with(error.begins))
            return fail(error.fault, std::string{error.sentence} + " (" + std::string{line} + ")");
    return fail(Fault::bad_frame, "no answer of this gauge");
}

std::optional<GaugeUnit> unit_in_settings(std::string_view line) {
    const std::string padded = " " + std::string{line} + " ";
    if (padded.find(" MM ") != std::string::npos) return GaugeUnit::millimetres;
    if (padded.find(" IN ") != std::string::npos) return GaugeUnit::inches;
    return std::nullopt;
}

std::string_view held_in_settings(std::string_view line) {
    const std::string padded = " " + std::string{line} + " ";
    for (const std::string_view word : {"MAX", "MIN", "DEL"})
        if (padded.find(" " + std::string{word} + " ") != std::string::npos) return word;
    return {};
}

bool decimals_fit(int decimals, GaugeUnit unit) {
    return unit == GaugeUnit::inches ? decimals >= 4 : decimals <= 3;
}

Length length_of(double number, GaugeUnit unit) {
    return unit == GaugeUnit::inches ? inch(number) : mm(number);
}

} // namespace axiscal
