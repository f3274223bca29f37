#pragma once
// Sentences that the papers of a straightness and of a squareness share. Pure.

#include "acquisition/documents/straightness/across_run_file.hpp"

#include <string>
#include <vector>

namespace axiscal {

inline constexpr const char* positions_by_the_control =
    "Positions by the control of the machine: a reading across the axis shows neither where the "
    "axis stood nor from which side it came.";
inline constexpr const char* air_as_usual =
    "The refractive index of the air is taken as 1.000271: what it may be wrong by is far below "
    "the uncertainty of the factor.";
inline constexpr const char* no_expansion =
    "No reading is compensated for the expansion of the axis: a deviation across it does not grow "
    "with it, and its own expansion is below 1e-4 of itself.";

/// What the plan says, whose E_VE it is, a clock that was set, which readings were set aside, what
/// the checks warned of: the end of the remarks.
/// @param clock_off  how far the clock was set in mid-run
void remark_on_course(const AcrossRun& one, Duration clock_off, std::vector<std::string>& remarks);

/// Names of terms in words: "a limit of the mirror's form".
std::vector<std::string> terms_in_words(const std::vector<std::string>& not_stated);

} // namespace axiscal
