#include "acquisition/measurement/another_boot.hpp"

#include "acquisition/journal/journal.hpp"
#include "acquisition/measurement/measurement.hpp"
#include "analysis/record/run_clock.hpp"

#include <string>
#include <utility>

namespace axiscal {

void note_another_boot(const MeasurementContext& context, const BootId& of_run, const BootId& now) {
    if (is_same_boot(of_run, now)) return;
    const bool certain = of_run.known() && now.known();
    std::string sentence =
        certain ? "What follows was written after " : "What follows may count by another clock: ";
    sentence += restart_text(of_run, now) + ".";
    const Scheduler& scheduler = context.scheduler;
    context.journal.note(EventRecord{EventKind::note, scheduler.now(), scheduler.clock_tie().utc_ns,
                                     std::move(sentence), Fault::none, 0});
}

} // namespace axiscal
