#pragma once
// Sole maker of RunAt20C. For declare_at_20C() and compensate_to_20C() only: whoever else includes
// this header breaks the law that compensation happens exactly once (tests/guards/arrows.py). Pure.

#include "analysis/positioning/positioning_accuracy.hpp"

#include <string>
#include <utility>

namespace axiscal {

class RunAt20CMaker {
public:
    /// The table is taken as checked.
    static RunAt20C make(DeviationTable table, std::string provenance) {
        RunAt20C run;
        run.targets_ = std::move(table.targets);
        run.forward_ = std::move(table.forward);
        run.backward_ = std::move(table.backward);
        run.unit_ = std::move(table.unit);
        run.provenance_ = std::move(provenance);
        return run;
    }
};

} // namespace axiscal
