#pragma once
// E_VE of a drift test, carried to the budget of later runs.

#include "analysis/quantity/quantity.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/quantity/time.hpp"
#include "analysis/record/run_record.hpp"
#include "drivers/loop/scheduler.hpp"

#include <string>

namespace axiscal {

class Journal;
struct WantedDrift;

struct FoundEve {
    Length eve; ///< one millimetre for one degree of a rotary axis
    std::string run_id;
    Duration lasted{};
    Length rest; ///< where the axis stood; 0 for a ballbar
};

/// Reads beside the loop.
/// @param kind  of the axis whose budget takes it; of a ballbar linear
/// @errors those of find_drift(); Fault::refused for a test that left readings out;
/// Fault::bad_run_file for one of the other kind.
Task<Result<FoundEve>>
find_eve(Journal& journal, std::string runs_folder, WantedDrift wanted, AxisKind kind);

} // namespace axiscal
