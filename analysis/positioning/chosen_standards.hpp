#pragma once
// By which standards a live run is evaluated and its figures are named. Pure.

#include "analysis/positioning/styles.hpp"

#include <map>
#include <string>
#include <vector>

namespace axiscal {

/// The figures of one more standard from the same readings, in the unit of the result.
struct OtherResult {
    std::string standard;
    std::string confidence, note; ///< as PositioningStandard has them
    NamedFigures parameters;      ///< in the order in which they print
    std::map<std::string, std::string> not_evaluated;
    std::vector<std::string> notes;
};

struct ChosenStandards {
    /// What the certificate's own figures are: the first of ISO 230-2 and its editions; ISO
    /// 230-2:2014 where none of these is chosen.
    const PositioningStandard* own = nullptr;
    std::vector<const PositioningStandard*> others; ///< in the order in which they were chosen
};

/// @errors Fault::refused naming a standard that is not known here, and the nearest that is.
Result<ChosenStandards> chosen_standards(const std::vector<std::string>& names);

OtherResult evaluate_other(const PositioningStandard& standard, const RunAt20C& run);

/// Contract keys and values of ISO 230-2, those that were evaluated.
NamedFigures named_figures(const PositioningParameters& parameters);

} // namespace axiscal
