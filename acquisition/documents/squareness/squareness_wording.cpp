#include "acquisition/documents/squareness/squareness_wording.hpp"

#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/straightness/straightness_wording.hpp"

#include <cmath>

namespace axiscal {
namespace {

std::string in_arcsec(double rad, int decimals) {
    return fixed(rad / arcsec.size, decimals) + "″";
}

std::string by_other_line(const SquarenessResult& result, LineReference reference) {
    return "by the " + reference_on_paper(reference) + " " +
           um_per_m_on_paper(squareness_against(result.found.squareness, reference),
                             squareness_decimals(result));
}

} // namespace

std::string squareness_name_on_paper(std::string_view key) {
    constexpr std::string_view prefix = "squareness_";
    if (key.starts_with(prefix)) key.remove_prefix(prefix.size());
    std::string name{key};
    for (char& letter : name)
        if (letter == '_') letter = ' ';
    return name;
}

int squareness_decimals(const SquarenessResult& result) {
    constexpr double many = 1e-4; // 100 um/m
    return std::fabs(result.found.squareness.least_squares) < many ? 2 : 1;
}

std::string um_per_m_on_paper(double rad, int decimals) {
    return fixed(rad * um_per_m_of_rad, decimals) + " µm/m";
}

std::string squareness_on_paper(const SquarenessResult& result) {
    const int decimals = squareness_decimals(result);
    const std::string value = um_per_m_on_paper(result.found.squareness.least_squares, decimals);
    const auto& expanded_rad = result.budget.expanded_rad;
    if (!expanded_rad) return value + ", U not evaluated";
    return value + " ± " + fixed_up(*expanded_rad * um_per_m_of_rad, decimals) + " µm/m";
}

std::string squareness_in_arcsec(const SquarenessResult& result) {
    const int decimals = squareness_decimals(result);
    const std::string value = in_arcsec(result.found.squareness.least_squares, decimals);
    const auto& expanded_rad = result.budget.expanded_rad;
    if (!expanded_rad) return value;
    return value + " ± " + fixed_up(*expanded_rad / arcsec.size, decimals) + "″";
}

std::string square_error_on_paper(const SquarenessResult& result) {
    const std::string_view by = square_error_by(result);
    if (by == "not taken out") return std::string{by};
    const int decimals = squareness_decimals(result);
    const double error_rad = result.found.square_error_rad;
    return (by == "reversal" ? "by reversal " : "as stated ") +
           um_per_m_on_paper(error_rad, decimals) + " (" + in_arcsec(error_rad, decimals) + ")";
}

std::string squareness_sentence(const SquarenessResult& result) {
    const bool known = result.budget.expanded_rad.has_value();
    return squareness_title(result) +
           ", ISO 230-1:2012, reference: " + reference_on_paper(main_reference) + ": " +
           squareness_on_paper(result) +
           (known ? " (k = " + fixed(result.budget.coverage, 0) + ")" : "") + ", as an angle " +
           squareness_in_arcsec(result) +
           ". By other lines, without U: " + by_other_line(result, LineReference::end_points) +
           ", " + by_other_line(result, LineReference::minimum_zone) + "; the three lie within " +
           um_per_m_on_paper(result.found.squareness.method_spread, squareness_decimals(result)) +
           ".";
}

} // namespace axiscal
