// Opening a run, and taking over one that was open when the daemon went down.
#include "acquisition/station/station.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/live/time_limits.hpp"
#include "acquisition/measurement/arming.hpp"
#include "acquisition/measurement/run_header.hpp"
#include "acquisition/preflight/environment_limits.hpp"
#include "acquisition/run/cycle_plan.hpp"
#include "acquisition/run/resume.hpp"
#include "acquisition/runfile/certificate_numbers.hpp"
#include "acquisition/runfile/durable_file.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "acquisition/station/held.hpp"
#include "analysis/record/run_clock.hpp"
#include "drivers/loop/spawn.hpp"

#include <algorithm>
#include <random>

namespace axiscal {
Result<RunPlan> Station::plan_for(const ArmRequest& request) const {
    CycleConfig cycle = config_.cycle;
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
    if (waiting_for_disk_ || (is_unwritten() && !run_open()))
        return fail(Fault::not_durable, "the disk cannot store the records of the last run yet; "
                                        "'axiscal status' shows why");
    return {};
}

Result<void> Station::nothing_goes_on() const {
    if (arming_) return fail(Fault::busy, "somebody else is arming a run just now");
    if (revising_)
        return fail(Fault::busy,
                    "a retake, an exclusion or an answer is being written just now; ask again");
    if (run_open())
        return fail(Fault::busy,
                    "run " + last_run_id() + " is open; finish it or 'axiscal abort' it first");
    if (drift_open())
        return fail(Fault::busy, "drift test " + resting_->run().run_id +
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
    if (reads_faces()) return autocollimator_speaks();
    if (reads_polygon()) return {};
    const auto reading = readings_.reference().newest();
    if (!reading || now - reading->at > laser_limit)
        return fail(Fault::link_timeout, "the " + reference_word() + " (" +
                                             config_.axis.laser.instrument +
                                             ") sends nothing; see 'axiscal devices'");
    if (!reading->value())
        return fail(Fault::beam_lost, "the " + reference_word() + " shows no good signal now");
    return {};
}

std::string Station::laser_serial() const {
    const std::optional<int> id = roles_.laser ? roles_.laser : roles_.autocollimator;
    if (!id) return reads_polygon() ? "autocollimator" : "";
    const int seat = channel_of(*id).instrument;
    const std::string& serial = supervisor_.identity(seat).serial;
    return serial.empty() ? config_.instruments[static_cast<std::size_t>(seat)].serial : serial;
}

RunSetup Station::setup_of(const RunRecord& header) const {
    return {header.plan,
            header.rotary ? against_artefact(*header.rotary, header.laser.sign)
                          : along_the_axis(header.laser),
            laser_serial(),
            config_.capture.timeout,
            {}};
}

RunHeaderParts Station::header_parts(TestKind kind, RunPlan plan) const {
    return {config_,         supervisor_,            roles_,   kind,
            std::move(plan), scheduler_.clock_tie(), boot_id_, config_hash_};
}

Task<Result<std::string>> Station::arm(ArmRequest request) {
    if (request.pass == circular_pass) co_return co_await arm_circular(std::move(request));
    if (auto ready = ready_to_measure(); !ready) co_return tl::unexpected<Error>(ready.error());
    const Held arming{arming_};
    co_return co_await open_and_tie(std::move(request));
}

Task<Result<std::string>> Station::open_and_tie(ArmRequest request) {
    AXISCAL_CO_TRY(RunPlan plan, plan_for(request));
    AXISCAL_CO_TRY(std::optional<FoundEve> eve, co_await eve_for(takes_circles(request)));
    AXISCAL_CO_TRY(std::vector<PreflightRecord> checks, judge(request, eve));
    if (const std::string objections = open_objections(checks); !objections.empty())
        co_return refuse(Fault::refused, "preflight", objections);
    const RunHeaderParts parts = header_parts(TestKind::positioning, std::move(plan));
    AXISCAL_CO_TRY(RunRecord header, make_run_header(parts, request));
    if (auto free =
            check_number_is_free(config_.state_directory, header.statements.certificate_number);
        !free)
        co_return tl::unexpected<Error>(free.error());
    RunAttachments attachments;
    if (eve) {
        if (!header.uncertainty) header.uncertainty.emplace();
        header.uncertainty->eve = eve->eve;
        attachments.eve_source = std::move(eve->run_id);
    }
    attachments.alignment =
        alignment_for_run(); // ends one that is going on: not before all else fits
    std::string path =
        config_.state_directory + "/runs/" + header.run_id + std::string{run_file_ending};
    RunRecord copy = header;
    if (auto opened = co_await journal_.open(path, std::move(copy), std::move(attachments));
        !opened) {
        Error why = opened.error();
        why.detail += " " + way_out(why.cause, config_.state_directory);
        co_return tl::unexpected<Error>(std::move(why));
    }
    RunMachine machine{setup_of(header)};
    begin_run(std::move(header), std::move(path), std::move(machine));
    run_->limits_waived = waives_limits(checks);
    note_arming(measurement_context(), run_->header.run_id, request.by, checks);
    journal_.note(std::move(checks));
    if (!request.datum_by_cnc) run_->orderer_has_gone = std::move(request.has_gone);
    feed_with_air(Arm{scheduler_.now(), !request.datum_by_cnc});
    if (request.datum_by_cnc) co_return run_->header.run_id;
    auto tied = co_await await_datum();
    run_->orderer_has_gone = nullptr; // the connection that it asks about ends with the answer
    if (!tied) co_return tl::unexpected<Error>(tied.error());
    co_return run_->header.run_id;
}

OrderRecord Station::order_of(std::string kind, const Orderer& by, std::string about) const {
    return order_now(scheduler_, std::move(kind), by, std::move(about));
}

void Station::begin_run(RunRecord header, std::string path, RunMachine machine) {
    newest_run_ = header.run_id;
    newest_run_utc_ns_ = header.opened.utc_ns;
    CurrentRun fresh;
    fresh.header = std::move(header);
    fresh.path = std::move(path);
    run_ = std::move(fresh);
    machine_.emplace(std::move(machine));
    circles_.reset();
    last_receipt_.reset();
    left_over_fault_.reset();
    notices_.nothing_refused();
    datum_.reset();
    interruption_.clear();
    revision_unknown_ = false;
    log_environment_anew();
}

void Station::log_environment_anew() {
    for (const int channel : roles_.environment()) {
        logged_[static_cast<std::size_t>(channel)].reset();
        if (const auto& sample = readings_.latest(channel)) log_environment(channel, *sample);
    }
}

/// A run whose datum cannot be tied is closed again: the technician mends the cause and arms anew.
Task<Result<void>> Station::await_datum() {
    const MonotonicTime deadline = scheduler_.now() + config_.capture.timeout + laser_limit;
    while (!datum_ && recording() && !run_->not_tied && scheduler_.now() < deadline)
        co_await scheduler_.sleep_for(look_every);
    if (datum_ && recording()) co_return Result<void>{};
    const Error why =
        run_->not_tied.value_or(Error{Fault::not_still, "no datum was tied in time", {}, {}});
    feed(Abort{"The datum could not be tied: " + describe(why), scheduler_.now()});
    (void)co_await await_closing(run_->path); // a reader of the file must not hold up the answer
    co_return tl::unexpected<Error>(why);
}

Result<void> Station::trigger() {
    if (circles_) return circles_->trigger();
    if (!recording()) return fail(Fault::no_run_armed, "'axiscal arm' opens a run");
    TriggerEvent event;
    event.at = scheduler_.now();
    event.origin = TriggerOrigin::manual;
    if (auto refusal = ask(event).refusal) return tl::unexpected<Error>(*std::move(refusal));
    return {};
}

Task<Result<RunEnding>> Station::abort(std::string reason, Orderer by) {
    if (drift_open()) {
        const auto test = resting_; // the next one may take its place before this returns
        co_return co_await test->abort(std::move(reason), std::move(by));
    }
    if (circles_) {
        const auto test = circles_; // as above
        co_return co_await test->abort(std::move(reason), std::move(by));
    }
    if (!recording()) co_return fail(Fault::no_run_armed, "there is nothing to abort");
    journal_.note(order_of("abort", by));
    note("Run " + run_->header.run_id + " was aborted by " + name_of(by) + ".");
    feed(Abort{std::move(reason), scheduler_.now()});
    co_return co_await await_closing(run_->path);
}

/// What did not close is told to the one who asked: 200 would be a lie. So would "aborted" of a run
/// whose last point was on its way.
Task<Result<RunEnding>> Station::await_closing(std::string path) {
    const MonotonicTime limit = scheduler_.now() + closing_limit;
    const auto same = [&] { return run_ && run_->path == path; };
    while (same() && !run_->closed && scheduler_.now() < limit && !stopping_)
        co_await scheduler_.sleep_for(look_every);
    if (!same()) co_return RunEnding{};
    if (run_->closed && run_->closing_row_durable)
        co_return RunEnding{run_->outcome->complete, run_->outcome->reason};
    if (!run_->closed) co_return files_.not_closed_yet();
    co_return file_not_closed(*run_->closing_error, config_.state_directory);
}

bool Station::instruments_returned() const {
    const auto reading = readings_.reference().newest();
    return reading && reading->value() && live_scale_now();
}

Task<Result<void>> Station::take_over_stored_runs() {
    Result<StoredRuns> stored = co_await journal_.stored_runs(runs_folder(), boot_id_);
    // On a full disk a run that was left open cannot be read: its index would have to grow.
    if (!stored || stored->unreadable != 0) {
        const std::optional<Error> trouble = co_await disk_trouble();
        if (trouble) co_return tl::unexpected<Error>(*trouble);
    }
    if (!stored) co_return tl::unexpected<Error>(stored.error());
    if (stored->newest) {
        newest_run_ = stored->newest->run_id;
        newest_run_utc_ns_ = stored->newest->opened_utc_ns;
    }
    for (RunSummary& run : stored->looked_into) {
        if (run.closed) continue;
        const Result<void> resumed = co_await resume_or_close(run.path);
        if (!resumed && !run_open()) {
            const std::optional<Error> trouble = co_await disk_trouble();
            if (trouble) co_return tl::unexpected<Error>(*trouble);
        }
        if (!resumed)
            note("The open run " + run.path +
                 " could not be continued: " + describe(resumed.error()));
        auto now = co_await journal_.summarize(run.path);
        if (now) run = *std::move(now);
    }
    // Of one that was not completed `done` stays 65535: it takes no requests.
    if (stored->newest && stored->newest->complete)
        co_await publish_done_of_closed(stored->newest->path);
    keep_hold_of_broken_off(*stored);
    spawn(scheduler_, certify_left_over(*std::move(stored)));
    co_return Result<void>{};
}

/// A program that stands at a request of it is to hold, also after a restart: no restart may
/// release an axis that nobody has answered.
void Station::keep_hold_of_broken_off(const StoredRuns& stored) {
    if (!stored.newest || run_open()) return;
    const auto now = std::ranges::find(stored.looked_into, stored.newest->path, &RunSummary::path);
    const RunSummary& last = now != stored.looked_into.end() ? *now : *stored.newest;
    left_broken_off_ = last.closed && !last.complete && last.kind != TestKind::drift &&
                       last.closing_reason != ended_by_cnc;
}

Task<Result<void>> Station::resume_or_close(std::string path) {
    AXISCAL_CO_TRY(RunFileContents contents, read_run_file_contents(path));
    if (const auto* drift = std::get_if<DriftSetup>(&contents.attachments.setup)) {
        const bool of_bar = drift->of_bar;
        std::string why = std::string{"Nobody watched the resting "} +
                          (of_bar ? "ballbar" : "axis") + " while the station was away.";
        auto closed = co_await close_left_over(path, std::move(why), Fault::datum_lost, false);
        left_over_fault_.reset(); // no CNC waits for it
        co_return closed;
    }
    RunRecord run = std::move(contents.run);
    // Reopened for points to be taken again: what was measured before still makes a whole run.
    const bool whole = contents.revisions.closings > 0 && check_complete(run);
    if (run_open())
        co_return co_await close_left_over(path, "Another run was open too; only one can go on.",
                                           Fault::busy, whole);
    if (run.kind == TestKind::circular) {
        contents.run = std::move(run);
        co_return co_await resume_or_close_circles(std::move(path), std::move(contents));
    }
    if (!roles_.laser) {
        const std::string why =
            reads_polygon() ? std::string{"What was "} + (reads_faces() ? "read" : "typed") +
                                  " before a restart is not gone on with: nobody knows whether "
                                  "autocollimator and polygon were touched meanwhile."
                            : "The station file names no laser any more.";
        co_await close_left_over(path, why, Fault::bad_configuration, whole);
        co_return Result<void>{};
    }
    // A request may stand in the CNC already: it must not meet sensors that have not spoken yet.
    const MonotonicTime limit = scheduler_.now() + return_limit;
    while (!instruments_returned() && scheduler_.now() < limit)
        co_await scheduler_.sleep_for(look_every);
    StationNow now;
    now.config_hash = config_hash_;
    now.boot_id = boot_id_;
    now.laser_serial = laser_serial_for(run);
    now.instruments = serials_of_axis();
    now.limits.fastest = config_.capture.fastest;
    now.limits.count_modulus =
        supervisor_.instrument(channel_of(*roles_.laser).instrument).count_modulus();
    if (!run.datums.empty() && !counting_rate_hz(run))
        now.limits.rate_hz = co_await laser_rate_hz(limit);
    if (readings_.reference().newest() && readings_.reference().newest()->value())
        now.laser = readings_.reference().newest();
    if (!waives_limits(contents.revisions.preflight))
        now.outside_limits =
            outside_limits(config_.environment, environment_facts(), scheduler_.now());
    const ResumeVerdict verdict = decide_resume(run, std::nullopt, now);
    if (verdict.decision != ResumeDecision::wait_for_request)
        co_return co_await close_left_over(path, verdict.sentence, verdict.fault, whole);
    co_return co_await resume(path, std::move(run), std::move(contents.revisions),
                              verdict.sentence);
}

/// For a run too young to tell. The first second may hold readings that waited in a buffer.
Task<double> Station::laser_rate_hz(MonotonicTime limit) {
    constexpr Duration second = std::chrono::seconds{1};
    while (scheduler_.now() < limit) {
        const auto newest = readings_.reference().newest();
        if (newest && readings_.reference().reaches_back_to(newest->at - 2 * second - look_every)) {
            const auto latest =
                readings_.reference().between(newest->at - second - look_every, newest->at);
            if (const auto rate_hz = counting_rate_hz(latest)) co_return *rate_hz;
        }
        co_await scheduler_.sleep_for(look_every);
    }
    co_return 0;
}

Task<Result<void>>
Station::resume(std::string path, RunRecord run, RunRevisions revisions, std::string proof) {
    if (auto reopened = co_await journal_.reopen(path); !reopened)
        co_return tl::unexpected<Error>(reopened.error());
    const std::uint32_t epoch =
        readings_.reference().newest() ? readings_.reference().newest()->epoch : 0;
    RunRecord header = run;
    header.points.clear();
    RunSetup setup = setup_of(run);
    const bool waived = waives_limits(revisions.preflight);
    const std::size_t answers = revisions.answers.size();
    setup.revisions = std::move(revisions);
    RunMachine machine{std::move(setup), run, epoch, scheduler_.now()};
    begin_run(std::move(header), path, std::move(machine));
    run_->limits_waived = waived;
    run_->answers = answers;
    run_->resumed = true;
    const std::string away = is_same_boot(run.boot_id, boot_id_)
                                 ? "for " + in_seconds(scheduler_.now() - last_sign_of_life(run))
                                 : "while " + restart_text(run.boot_id, boot_id_);
    record(EventKind::interrupted,
           "The station recorded nothing " + away + ". " + taken_up_text(run) + proof);
    feed(EnvironmentNow{within_limits(live_scale_now())});
    port_state_ = PortState::armed;
    note("Run " + run_->header.run_id + " goes on after " + std::to_string(run.points.size()) +
         " durable points.");
    co_return co_await publish_last_done(std::move(run));
}

/// The port is not open yet: the first thing a CNC can read of us is the last durable request.
Task<Result<void>> Station::publish_last_done(RunRecord run) {
    const DurableRequest last = last_durable_request(run);
    if (last.sequence == 0) { // tied by a person, or not yet tied
        port_->publish_armed();
        co_return Result<void>{};
    }
    const bool is_point =
        std::ranges::find(run.points, last.step, &PointRecord::step) != run.points.end();
    auto receipt = last.step < 0 || is_point
                       ? co_await journal_.receipt_for(last.step)
                       : co_await journal_.receipt_for_skip(last.sequence, last.step);
    if (!receipt) co_return tl::unexpected<Error>(receipt.error());
    last_receipt_ = *receipt;
    publish_done(receipt->sequence(), last.step >= 0 && !is_point);
    co_return Result<void>{};
}

/// The last daemon may have closed its run and died before the CNC could read `done` of the last
/// point: it stands there and waits for it.
Task<void> Station::publish_done_of_closed(std::string newest_path) {
    if (run_open() || left_over_fault_) co_return;
    const auto receipt = co_await journal_.receipt_of_closed(std::move(newest_path));
    if (!receipt) co_return;
    last_receipt_ = *receipt;
    port_->acknowledge(*receipt);
}

Task<Result<void>>
Station::close_left_over(std::string path, std::string reason, Fault fault, bool whole) {
    const auto stored = co_await journal_.summarize(path);
    if (auto reopened = co_await journal_.reopen(path); !reopened) co_return reopened;
    if (stored) mark_another_boot(stored->boot_id);
    record(EventKind::closed, reason, fault);
    if (whole) reason = "Every planned point is durable; not every retake was done: " + reason;
    if (auto closed = co_await close_file_for_now(whole, reason); !closed) {
        co_await journal_.let_go();
        co_return closed;
    }
    const std::string how = whole ? " is closed again: " : " is closed as incomplete: ";
    note("The open run " + path + how + reason);
    left_over_fault_ = Error{fault, reason, {}, {}};
    co_return Result<void>{};
}

} // namespace axiscal
