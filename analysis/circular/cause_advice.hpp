#pragma once
// A cause of a circle's form for the person at the machine: its name, what its sign means, what to
// look at first. Pure.

#include "analysis/circular/circle_diagnosis.hpp"

#include <string>

namespace axiscal::circular {

/// "Backlash X" for CauseContribution::cause "backlash_x".
std::string title_of(const CauseContribution& contribution, const AxisNames& axes);

/// What a technician does first, by the sign found.
std::string advice_for(const CauseContribution& contribution,
                       const CircleDiagnosis& diagnosis,
                       const AxisNames& axes);

/// One unknown of the fit as the table of all causes prints it.
struct CauseOnPaper {
    std::string name, unit;
    double factor = 1; ///< from the unit of key_of() to `unit`
    std::string sign;  ///< what a value above 0 means
};
CauseOnPaper on_paper(Cause cause, const AxisNames& axes);

/// A sentence of the ranking with the names of causes in place of their keys.
std::string with_names(std::string words, const AxisNames& axes);

} // namespace axiscal::circular
