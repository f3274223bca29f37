#pragma once
// The pre-flight checks of what a person orders, and where the budget takes its E_VE from.

#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/drift/environmental_variation.hpp"
#include "acquisition/measurement/order_context.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/run_revisions.hpp"
#include "drivers/loop/scheduler.hpp"

#include <optional>
#include <vector>

namespace axiscal {

struct Admitted {
    std::optional<FoundEve> eve;         ///< of the drift test that the station file points to
    std::vector<PreflightRecord> checks; ///< as they were judged
};

/// @param request  the caller keeps it
/// @errors those of find_eve(); Fault::bad_request for an override that is none; Fault::refused
/// with the sentence of each check that failed and has no reason.
Task<Result<Admitted>> admit(OrderContext context, const ArmRequest& request);

/// As StationInterface::preflight.
Task<Result<std::vector<PreflightRecord>>> preflight_of(OrderContext context, ArmRequest request);

} // namespace axiscal
