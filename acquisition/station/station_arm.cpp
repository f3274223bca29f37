// A positioning run is ordered: what speaks against it, and what it begins with.
#include "acquisition/station/station.hpp"

#include "acquisition/live/time_limits.hpp"
#include "acquisition/measurement/held.hpp"
#include "acquisition/measurement/order_checks.hpp"
#include "acquisition/measurement/positioning/armed_run.hpp"
#include "acquisition/measurement/positioning/positioning_measurement.hpp"

#include <utility>

namespace axiscal {

/// No reason overrides this: whatever part the instrument has, a record beside its tape would read
/// as one of instruments.
Result<void> Station::plays_no_tape() const {
    for (const InstrumentConfig& instrument : config_.instruments)
        if (!instrument.tape.empty())
            return fail(Fault::refused,
                        instrument.name + " plays the tape " + instrument.tape +
                            " and is no instrument: a station with a tape cannot measure; remove "
                            "the line `tape` from the station file and restart axiscald");
    return {};
}

/// The file of the last run may still have its closing row due, seen or not.
Result<void> Station::disk_takes_records() const {
    if (disk_.goes_on() || (is_unwritten() && !run_open()))
        return fail(Fault::not_durable, "the disk cannot store the records of the last run yet; "
                                        "'axiscal status' shows why");
    return {};
}

Result<void> Station::nothing_goes_on() const {
    if (under_way_.arming) return fail(Fault::busy, "somebody else is arming a run just now");
    if (under_way_.revising)
        return fail(Fault::busy,
                    "a retake, an exclusion or an answer is being written just now; ask again");
    if (run_open())
        return fail(Fault::busy, "run " + last_run()->run().run_id +
                                     " is open; finish it or 'axiscal abort' it first");
    if (drift_open())
        return fail(Fault::busy, "drift test " + tests_.resting()->run().run_id +
                                     " is going on; let it end or 'axiscal abort' it first");
    return {};
}

Result<void> Station::ready_to_measure() const {
    AXISCAL_CHECK(plays_no_tape());
    if (!roles_.laser && !reads_polygon())
        return refuse(Fault::bad_request, "pass",
                      "this station has a ballbar and no laser: 'axiscal arm --pass circular'");
    AXISCAL_CHECK(disk_takes_records());
    AXISCAL_CHECK(nothing_goes_on());
    const MonotonicTime now = scheduler_.now();
    AXISCAL_CHECK(readings_.environment_is_fresh(now));
    if (reads_faces()) return autocollimator_speaks(readings_, roles_, supervisor_, now);
    if (reads_polygon()) return {};
    const std::string word = reference_word(config_);
    const auto reading = readings_.reference().newest();
    if (!reading || now - reading->at > laser_limit)
        return fail(Fault::link_timeout, "the " + word + " (" + config_.axis.laser.instrument +
                                             ") sends nothing; see 'axiscal devices'");
    if (!reading->value())
        return fail(Fault::beam_lost, "the " + word + " shows no good signal now");
    return {};
}

RunHeaderParts Station::header_parts(TestKind kind, RunPlan plan) const {
    return {config_,  supervisor_, roles_, kind, std::move(plan), scheduler_.clock_tie(),
            boot_id_, config_hash_};
}

Task<Result<std::string>> Station::arm(ArmRequest request) {
    switch (request.kind) {
    case TestKind::positioning: co_return co_await arm_axis(std::move(request));
    case TestKind::circular: co_return co_await arm_circular(std::move(request));
    case TestKind::drift:
    case TestKind::probing: break;
    }
    co_return refuse(Fault::bad_request, "pass", "is of a test that is not armed");
}

Task<Result<std::string>> Station::arm_axis(ArmRequest request) {
    if (auto ready = ready_to_measure(); !ready) co_return tl::unexpected<Error>(ready.error());
    const Held arming{under_way_.arming};
    co_return co_await open_and_tie(std::move(request));
}

Task<Result<std::string>> Station::open_and_tie(ArmRequest request) {
    AXISCAL_CO_TRY(RunPlan plan, plan_for(config_, request));
    const OrderContext context = order_context();
    AXISCAL_CO_TRY(Admitted admitted, co_await admit(context, request));
    const RunHeaderParts parts = header_parts(TestKind::positioning, std::move(plan));
    AXISCAL_CO_TRY(ArmedRun armed, armed_run(parts, request, admitted.eve));
    armed.checks = std::move(admitted.checks);
    armed.attachments.alignment =
        beam_.for_run(); // ends one that is going on: not before all else fits
    if (!request.datum_by_cnc) armed.orderer_has_gone = std::move(request.has_gone);
    AXISCAL_CO_TRY(const std::shared_ptr<PositioningMeasurement> test,
                   co_await PositioningMeasurement::open(context, std::move(armed)));
    begin(test, test->header().opened.utc_ns, request.by);
    if (request.datum_by_cnc) co_return test->run().run_id;
    if (auto tied = co_await test->await_datum(); !tied)
        co_return tl::unexpected<Error>(tied.error());
    co_return test->run().run_id;
}

void Station::begin(const std::shared_ptr<Measurement>& test,
                    std::int64_t opened_utc_ns,
                    const Orderer& by) {
    tests_.put_on(test, opened_utc_ns);
    recovery_.forget_why_not();
    notices_.nothing_refused();
    test->begin(by);
}

Task<Result<std::vector<PreflightRecord>>> Station::preflight(ArmRequest request) {
    return preflight_of(order_context(), std::move(request));
}

Result<void> Station::align(AlignmentOrder order) {
    return beam_.carry_out(order);
}

Result<void> Station::trigger() {
    if (!last_run()) return fail(Fault::no_run_armed, "'axiscal arm' opens a run");
    return last_run()->trigger();
}

Result<void> Station::type_reading(double seconds_of_arc) {
    if (!reads_polygon() || reads_faces())
        return fail(Fault::bad_request,
                    std::string{"this station reads its "} +
                        (reads_faces() ? "autocollimator" : "length") +
                        " by itself: 'axiscal trigger' captures the next point");
    if (!last_run()) return fail(Fault::no_run_armed, "'axiscal arm' opens a run");
    return last_run()->type_reading(seconds_of_arc);
}

Task<Result<RunEnding>> Station::abort(std::string reason, Orderer by) {
    // The next one may take its place before this returns.
    const std::shared_ptr<Measurement> test = drift_open() ? tests_.resting() : last_run();
    if (!test) co_return fail(Fault::no_run_armed, "there is nothing to abort");
    co_return co_await test->abort(std::move(reason), std::move(by));
}

} // namespace axiscal
