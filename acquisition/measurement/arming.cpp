#include "acquisition/measurement/arming.hpp"

#include "acquisition/journal/journal.hpp"
#include "acquisition/live/notices.hpp"
#include "acquisition/measurement/measurement.hpp"

namespace axiscal {

void note_arming(const MeasurementContext& context,
                 const std::string& run_id,
                 const Orderer& by,
                 const std::vector<PreflightRecord>& checks) {
    context.journal.note(order_now(context.scheduler, "arm", by));
    std::string overridden;
    for (const PreflightRecord& check : checks) {
        if (check.override_reason.empty()) continue;
        context.journal.note(order_now(context.scheduler, "override", by, check.name));
        overridden += (overridden.empty() ? ", overriding " : ", ") + check.name;
    }
    context.notices.note("Run " + run_id + " was armed by " + name_of(by) + overridden + ".");
}

} // namespace axiscal
