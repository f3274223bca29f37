#pragma once
// The figures so far of the run that is shown, computed once for each durable point or exclusion:
// people and pages ask five times a second.

#include "analysis/positioning/figures_so_far.hpp"

#include <cstddef>
#include <memory>

namespace axiscal {

class RunMachine;
struct RunRecord;

/// Of one run. Loop-bound.
class ShownFigures {
public:
    /// Null of another kind of test, and before a datum and a point that counts.
    std::shared_ptr<const FiguresSoFar> of(const RunRecord& header, const RunMachine& machine);

private:
    std::size_t points_ = 0, left_out_ = 0; ///< that figures_ is of
    std::shared_ptr<const FiguresSoFar> figures_;
};

} // namespace axiscal
