#pragma once
// Readings that another program took with its own laser, as its file has them. Pure data.

#include "analysis/record/run_record.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace axiscal {

/// One way along the axis.
struct LaserPass {
    std::string name;                            ///< "run 2": as the file counts, from 1
    std::size_t line = 0;                        ///< of its first reading
    std::vector<std::size_t> order;              ///< of the targets, 0-based, as they were read
    std::vector<std::optional<double>> readings; ///< by target
    std::optional<bool> says_forward; ///< of the file itself; believed where no order tells
};

struct LaserReadings {
    AxisKind kind = AxisKind::linear;
    std::string target_unit = "mm", unit = "um"; ///< as in a case (docs/analysis.md)
    bool positions = false;                      ///< where the axis was; else deviations
    std::vector<double> targets;
    std::vector<LaserPass> passes;
    bool only_backward = false;        ///< as case_of_readings() found it
    bool order_tells = true;           ///< passes are listed in the order in which they were driven
    bool says_both_directions = false; ///< the file's own flag, believed where no order tells
    /// What the file says of machine, place and air: "Machine" and so on, in its order.
    std::vector<std::pair<std::string, std::string>> statements;
    std::vector<std::string> remarks; ///< what was taken although it is unusual
};

} // namespace axiscal
