#pragma once
// How numbers and empty fields are written on the certificate. Pure.

#include "analysis/positioning/positioning_certificate.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// Fixed decimals, true minus U+2212, never "−0.0".
std::string fixed(double value, int decimals);
/// The same, rounded away from zero: an uncertainty is never printed smaller than it is.
std::string fixed_up(double value, int decimals);
/// How many decimals lengths are printed with whose range is this: nanometres below 1 um.
int length_decimals(double range_um);
/// The text, or "not stated" when a person left it empty.
std::string stated(const std::string& text);
/// A stated number with the digits that were stated, six at most.
std::string as_stated(double value);
/// A term or a result of a budget in micrometres, or in seconds of arc: three decimals.
std::string uncertainty_on_paper(double uncertainty);
/// "2026-01-02T08:15:03Z" becomes "2026-01-02 08:15:03 UTC"; other texts stay as they are.
std::string readable_instant(const std::string& iso8601);

/// Units of paper: lengths in mm with deviations in µm, angles in ° with deviations in ″.
struct PaperUnits {
    std::string position = "mm", deviation = "µm";
    double deviation_factor = 1000; ///< result unit to deviation unit
    int deviation_decimals = 1;     ///< 2 where the whole span is below 2 deviation units
    int position_decimals = 3;      ///< as many as the targets need, 3 to 6

    [[nodiscard]] std::string of_deviation(double in_result_unit) const;
    [[nodiscard]] std::string of_deviation(const std::optional<double>& in_result_unit) const;
    /// Standard deviations: one decimal more, they are a few times smaller than what they describe.
    [[nodiscard]] std::string of_spread(const std::optional<double>& in_result_unit) const;
    [[nodiscard]] std::string of_position(double in_result_unit) const;
};
PaperUnits paper_units_of(const Certificate& certificate);

/// One line of the parameter table. `key` is the contract's name.
struct ParameterLine {
    std::string_view key, symbol, words;
    std::optional<double> value; ///< result unit
};
/// In the order in which they print: both directions first, then one way.
std::vector<ParameterLine> parameters_of_both_directions(const PositioningParameters& parameters);
std::vector<ParameterLine> parameters_of_one_direction(const PositioningParameters& parameters);

/// "A↑" of "A_forward"; what is no figure of ISO 230-2 as it stands.
std::string positioning_symbol(std::string_view key);

/// "A, A↑: reason" for each reason of `not_evaluated`, symbols in printing order.
std::vector<std::string> reasons_not_evaluated(const PositioningResult& result);

/// Behind a formula of a budget that stands in no source document (status "R"): a sign that
/// `footnote_of_derived` explains; empty for one that does.
std::string footnote_sign(const std::string& status);
/// Whether one of the lines of a budget has that sign.
template <class Lines> bool has_footnote_sign(const Lines& lines) {
    return std::ranges::any_of(
        lines, [](const auto& line) { return !footnote_sign(line.status).empty(); });
}
constexpr std::string_view footnote_of_derived = "¹ Derived by these rules from the terms that the "
                                                 "standard names; not compared with its printed "
                                                 "example.";
/// Without what is inside the computer: the file of a serial port and its settings are "its line".
std::string without_device_paths(const std::string& words);

/// "u_EVE sqrt(2/n)" in the signs of paper: alpha, delta, theta as letters, roots, squares.
std::string formula_on_paper(std::string formula);

/// Paper name, unit and decimals of an environment channel: Pa prints as hPa.
struct ChannelPaper {
    std::string quantity, unit;
    double factor = 1;
    int decimals = 1;
    double least_span = 1; ///< the plot never magnifies beyond this span, paper unit
};
ChannelPaper paper_of(ChannelKind kind, Medium medium);

/// What the uncertain time of the samples adds at most, in one or two sentences; "not stated" where
/// nothing tells.
std::string synchronisation_text(const Certificate& certificate);

/// "271.375 → 271.402 ×10⁻⁶": n − 1 at the first and at the last point.
std::string refractivity_text(const CompensationSummary& done);
std::string air_formula_text(const std::string& name);
std::string expansion_form_text(const std::string& name);
/// "11.50 µm/(m·K), standard uncertainty 0.60", or ", uncertainty not stated".
std::string coefficient_text(double per_K, const std::optional<double>& standard_uncertainty_per_K);

} // namespace axiscal
