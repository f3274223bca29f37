#pragma once
// What ASCII length gauges, read-outs and autocollimators answer, one row a model: the request, the
// shape of the answer, its unit, its error answers. Pure. Documents of the rows: see
// ascii_gauge.cpp.

#include "analysis/quantity/quantity.hpp"
#include "analysis/quantity/result.hpp"
#include "drivers/wire/byte_link.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace axiscal {

enum class GaugeUnit : std::uint8_t { millimetres, inches, arcseconds };

/// An answer that begins so is an error of the gauge and no value.
struct GaugeError {
    std::string_view begins;
    Fault fault = Fault::signal_error;
    std::string_view sentence;
};

/// One model of gauge. `shapes` are the answers it may give, letter by letter:
///   +  the sign, '+' or '-'          #  one place of the number: blank, digit or point
///   _  a blank in the place of '+'
///   9  a digit of the number         .  its point
///   m  a tolerance mark: < = > ? or blank    M  the same, or nothing
///   s  what is shown: A, 1 or blank the value itself, S G D 2 another figure
///   c  the input, a digit            u  the unit: blank mm, '"' inch, '?' a fault, G M R m i U
///   any other: itself                   none of length
///   N  the number with as many places as it has: its sign, '-' or nothing, digits, point, digits
///   V  another number like this, which is not taken
/// Without N and V a shape has one length: a record that lost a letter is refused, since -5.23
/// without its point is a number as well. With them it is refused without its point, too; a lost
/// digit passes.
struct GaugeModel {
    std::string_view name; ///< in the station file
    std::string_view maker, model;
    LinkSettings line; ///< baud, parity, bits and modem lines as the maker delivers it
    std::string_view request;
    char line_end = '\n';
    std::span<const std::string_view> shapes;
    std::span<const GaugeError> errors;
    std::string_view unit_request; ///< asked once at the beginning; empty: the gauge cannot tell
    Duration poll_period{};
    std::optional<GaugeUnit> only_unit = {}; ///< it has no other one
    int longest_answer = 18;                 ///< characters, its end included
    bool decimals_tell_unit = false;         ///< up to three in mm, four or five in inches
    [[nodiscard]] bool tells_unit() const;
    /// It reads an angle, no length.
    [[nodiscard]] bool angular() const { return only_unit == GaugeUnit::arcseconds; }
    [[nodiscard]] bool has_inputs() const;
};

std::span<const GaugeModel> gauge_models();
/// Null when there is none of this name.
const GaugeModel* find_gauge_model(std::string_view name);

struct GaugeAnswer {
    double number = 0;             ///< with its sign, in the gauge's unit
    int decimals = 0;              ///< places behind its point
    std::optional<GaugeUnit> unit; ///< empty: the answer does not tell
    int input = 1;                 ///< of a multiplexer; 1 where there is only one
};

/// One line without its end. A blank where a digit may stand counts only before the first digit:
/// "-      5.23" is -5.23; "5 23" is none.
/// @errors Fault::signal_error with the gauge's own complaint, and where it shows another figure or
/// unit; Fault::beam_lost where it sees no light; Fault::bad_frame for any other text.
Result<GaugeAnswer> decode_gauge_answer(std::string_view line, const GaugeModel& model);

/// The unit in the answer to `unit_request`: a word "MM" or "IN". Empty when it holds neither.
std::optional<GaugeUnit> unit_in_settings(std::string_view line);

/// The word of the answer to `unit_request` by which the gauge holds an extreme instead of its
/// value: "MAX", "MIN" or "DEL" (their difference). Empty: it shows its value.
std::string_view held_in_settings(std::string_view line);

/// Whether a number with so many decimals may be in this unit, where decimals tell it.
bool decimals_fit(int decimals, GaugeUnit unit);

/// Of a gauge that reads lengths; `unit` is no angle.
Length length_of(double number, GaugeUnit unit);

} // namespace axiscal
