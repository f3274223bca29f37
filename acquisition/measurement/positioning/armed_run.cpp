#include "acquisition/measurement/positioning/armed_run.hpp"

#include "acquisition/run/cycle_plan.hpp"
#include "acquisition/runfile/certificate_numbers.hpp"

#include <cstdint>
#include <random>
#include <string>
#include <utility>

namespace axiscal {

Result<RunPlan> plan_for(const StationConfig& config, const ArmRequest& request) {
    CycleConfig cycle = config.cycle;
    if (request.seed) cycle.seed = request.seed;
    std::random_device entropy;
    const std::uint64_t fresh = (static_cast<std::uint64_t>(entropy()) << 32U) | entropy();
    AXISCAL_TRY(const std::vector<RunPlan> passes, plan_passes(cycle, fresh));
    std::string known;
    for (const RunPlan& plan : passes) {
        if (plan.pass == request.pass) {
            RunPlan chosen = plan;
            if (request.datum_mm) chosen.datum = mm(*request.datum_mm);
            return chosen;
        }
        known += (known.empty() ? "" : ", ") + plan.pass;
    }
    return refuse(Fault::bad_request, "pass",
                  "'" + request.pass + "' is not planned; there is " + known);
}

Result<ArmedRun> armed_run(const RunHeaderParts& parts,
                           const ArmRequest& request,
                           const std::optional<FoundEve>& eve) {
    ArmedRun armed;
    AXISCAL_TRY(armed.header, make_run_header(parts, request));
    AXISCAL_CHECK(check_number_is_free(parts.config.state_directory,
                                       armed.header.statements.certificate_number));
    armed.reading = positions_of(armed.header);
    armed.datum_by_cnc = request.datum_by_cnc;
    if (!eve) return armed;
    if (!armed.header.uncertainty) armed.header.uncertainty.emplace();
    armed.header.uncertainty->eve = eve->eve;
    armed.attachments.eve_source = eve->run_id;
    return armed;
}

} // namespace axiscal
