#pragma once
// "0.5 mm" as text to a number in SI, and back, for one dimension at a time. Internal to config/.
// Pure, independent of the locale.

#include "analysis/quantity/result.hpp"

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// One way to write a unit. value_in_si = number * size + shift.
struct UnitName {
    std::string_view name;
    double size = 1;
    double shift = 0; ///< only absolute temperatures: kelvins to degrees Celsius
};

/// A dimension as a person writes it.
struct Measure {
    std::string_view what;                      ///< "a length"
    std::span<const UnitName> units;            ///< aliases follow their main name
    std::span<const std::string_view> examples; ///< the first one in range is shown
};

extern const Measure length_measure, rotary_measure, speed_measure, rotary_speed_measure,
    duration_measure, temperature_measure, temperature_difference_measure, pressure_measure,
    ratio_measure, expansion_measure, angle_measure;
/// A length, or a length for each metre ("0.7 um/m"): read_measure gives m or m/m.
extern const Measure device_limit_measure;
/// Additive corrections of a channel; read_measure gives stored units (degC, Pa, %, ppm), not SI.
extern const Measure correction_measure;
/// Values and expanded uncertainties of a channel, in stored units as well (m for lengths).
extern const Measure channel_reading_measure, channel_uncertainty_measure;

struct Measured {
    double si = 0;
    UnitName unit; ///< as written, to answer in the same unit
};

/// @errors Fault::bad_configuration; the detail says what is wrong and lists the units.
Result<Measured> read_measure(std::string_view text, const Measure& measure);
/// "0.5 mm": six digits, in `unit`.
std::string write_measure(double si, const UnitName& unit);
/// "mm, um, nm, m, in, cm"
std::string list_units(const Measure& measure);
/// An example inside [low, high]; `low` itself in the first unit when none fits.
std::string example_of(const Measure& measure, double low, double high);
/// Six digits, shortest, point as decimal sign.
std::string write_number(double value);

/// low <= value <= high, limits meant as written: a last binary digit lost in a unit's factor is no
/// refusal.
bool within(double value, double low, double high);

/// Edits (insert, delete, replace, swap of neighbours) from one word to the other.
std::size_t edit_distance(std::string_view word, std::string_view other);
/// The candidate that a slip of the finger explains (at most a third of its letters, or the rest
/// left out); else empty.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);
/// The end of a refusal: "; did you mean \"step\"?", or empty when no candidate is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

} // namespace axiscal
