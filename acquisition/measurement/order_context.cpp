#include "acquisition/measurement/order_context.hpp"

#include "acquisition/live/notices.hpp"
#include "acquisition/measurement/disk_wait.hpp"
#include "acquisition/measurement/latest_tests.hpp"
#include "acquisition/measurement/recovery.hpp"

#include <utility>

namespace axiscal {

/// Whatever part the instrument has, a record beside its tape would read as one of instruments.
Result<void> plays_no_tape(const StationConfig& config) {
    for (const InstrumentConfig& instrument : config.instruments)
        if (!instrument.tape.empty())
            return fail(Fault::refused,
                        instrument.name + " plays the tape " + instrument.tape +
                            " and is no instrument: a station with a tape cannot measure; remove "
                            "the line `tape` from the station file and restart axiscald");
    return {};
}

/// The file of the last run may still have its closing row due, seen or not.
Result<void> disk_takes_records(const OrderContext& context) {
    const bool is_due = context.tests.is_unwritten() && !context.tests.run_open();
    if (context.disk.goes_on() || is_due)
        return fail(Fault::not_durable, "the disk cannot store the records of the last run yet; "
                                        "'axiscal status' shows why");
    return {};
}

Result<void> nothing_goes_on(const OrderContext& context) {
    if (context.under_way.arming)
        return fail(Fault::busy, "somebody else is arming a run just now");
    if (context.under_way.revising)
        return fail(Fault::busy,
                    "a retake, an exclusion or an answer is being written just now; ask again");
    if (context.tests.run_open())
        return fail(Fault::busy, "run " + context.tests.run()->run().run_id +
                                     " is open; finish it or 'axiscal abort' it first");
    if (context.tests.rest_goes_on())
        return fail(Fault::busy, "drift test " + context.tests.resting()->run().run_id +
                                     " is going on; let it end or 'axiscal abort' it first");
    return {};
}

RunHeaderParts header_parts(const OrderContext& context, TestKind kind, RunPlan plan) {
    RunHeaderParts parts{
        context.config,  context.instruments,           context.roles,   kind,
        std::move(plan), context.scheduler.clock_tie(), context.boot_id, context.config_hash};
    if (context.roles.autocollimator) parts.further_channels = {*context.roles.autocollimator};
    return parts;
}

void begin_before_cnc(const OrderContext& context,
                      const std::shared_ptr<Measurement>& test,
                      std::int64_t opened_utc_ns,
                      const Orderer& by) {
    context.tests.put_on(test, opened_utc_ns);
    context.recovery.forget_why_not();
    context.notices.nothing_refused();
    test->begin(by);
}

} // namespace axiscal
