#pragma once
// How the indexing table goes along with the axis: where the program halts for it. Pure.

#include "analysis/record/rotary_setup.hpp"

#include <vector>

namespace axiscal {

/// Here the axis halts and the table is turned to `position`, counted in steps from the datum.
struct TableHalt {
    double coordinate_deg = 0;
    int position = 0;
};

/// From `from_deg`, where the table stands at `position`, to `goal_deg`, where it is to stand at
/// `wanted`, in strides that keep the interferometer within 95 % of its range: the interferometer
/// counts, and a beam that is lost once has lost its zero. The last halt is at the goal; none where
/// nothing is to be turned.
std::vector<TableHalt> table_halts(const RotarySetup& setup,
                                   double datum_deg,
                                   double from_deg,
                                   int position,
                                   double goal_deg,
                                   int wanted);

} // namespace axiscal
