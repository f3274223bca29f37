#pragma once
// How a squareness is written on paper. Pure.

#include "acquisition/documents/squareness/squareness_document.hpp"

#include <string>
#include <string_view>

namespace axiscal {

/// "least squares" of "squareness_least_squares".
std::string squareness_name_on_paper(std::string_view key);

/// How many decimals angles of this test are printed with, in um/m and in seconds of arc alike.
int squareness_decimals(const SquarenessResult& result);

/// "−10.49 µm/m" of an angle in rad.
std::string um_per_m_on_paper(double rad, int decimals);

/// The main figure: "−10.49 µm/m ± 1.26 µm/m"; ", U not evaluated" where the budget lacks a term.
std::string squareness_on_paper(const SquarenessResult& result);

/// The same as an angle: "−2.16″ ± 0.26″", or without U.
std::string squareness_in_arcsec(const SquarenessResult& result);

/// "by reversal 9.70 µm/m (2.00″)", "as stated 9.70 µm/m (2.00″)", "not taken out".
std::string square_error_on_paper(const SquarenessResult& result);

/// The whole answer in one paragraph: by which lines, sign, the other two, how far they are apart.
std::string squareness_sentence(const SquarenessResult& result);

} // namespace axiscal
