#pragma once
// A result against the limits of its run: what every paper of it says first. Pure.

#include "analysis/conformity/tolerances.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

struct Conformity {
    ToleranceRecord agreed;            ///< as the run file holds it
    std::string unit;                  ///< of the figures: that of the result
    std::vector<JudgedFigure> figures; ///< one a parameter of the limits
    std::string_view verdict;          ///< overall_verdict() of them

    /// The figure that the verdict rests on: the first that has it and, of those, the one that uses
    /// up most of its limit. Null of no figure.
    [[nodiscard]] const JudgedFigure* decisive() const;
};

/// Nothing where no limit was agreed on. `figures` in `unit`: that of the limits, or "mm" for
/// limits in "um", "deg" or "um/m" for limits in "arcsec". `travel` in mm or degrees, 0 where no
/// band is asked for.
std::optional<Conformity> conformity_of(const std::optional<ToleranceRecord>& agreed,
                                        const std::vector<FigureToJudge>& figures,
                                        std::string unit,
                                        double travel = 0);

} // namespace axiscal
