#pragma once
// What another run gave, kept in the run file of the run that is evaluated with it: so one file
// says all that its certificate says. Pure data.

#include "analysis/quantity/quantity.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// Means of the deviations across the axis at one target.
struct RecordedLineRow {
    Length target;
    Length forward;
    std::optional<Length> backward; ///< of a run in both directions, in every row
};

/// The mean lines of a straightness test: E_`across``axis`, positive towards + of `across`.
struct RecordedLine {
    std::string run_id;
    std::string axis, across; ///< axis letters: "X", "Y"
    int readings = 1;         ///< in each mean of one direction, the fewest
    Length scatter;           ///< s of a single reading, pooled; 0 where each mean is of one
    std::vector<RecordedLineRow> rows; ///< rising targets
};

} // namespace axiscal
