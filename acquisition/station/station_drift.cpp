// The drift test: every channel against time while the axis rests, without a CNC.
#include "acquisition/station/station.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/live/time_limits.hpp"
#include "acquisition/measurement/run_header.hpp"
#include "acquisition/run/cycle_plan.hpp"
#include "acquisition/run/live_position.hpp"
#include "acquisition/station/held.hpp"
#include "drivers/loop/spawn.hpp"

#include <algorithm>

namespace axiscal {
namespace {

constexpr Duration hear_every = std::chrono::milliseconds{50}; // an abort is heard within it
/// capture.minimum_samples speaks of a laser's points; a gauge that is asked for each reading gives
/// few, and each of them is steady.
constexpr int fewest_of_bar = 2;
constexpr const char* lost_zero = "The counter lost its zero: the readings cannot be "
                                  "compared any more.";

} // namespace

/// The axis, unless the ballbar is asked for or is all that the station has.
bool Station::drift_is_of_bar(const DriftRequest& request) const {
    return request.of_bar.value_or(!roles_.laser && !reads_polygon());
}

Result<void> Station::ready_for_drift(bool of_bar) const {
    if (!of_bar && !roles_.laser && !reads_polygon())
        return refuse(Fault::bad_request, "of",
                      "is an axis, and this station has a ballbar alone: 'axiscal drift --of "
                      "ballbar'");
    if (!of_bar) return ready_to_measure();
    AXISCAL_CHECK(plays_no_tape());
    if (!roles_.ballbar)
        return refuse(Fault::bad_request, "of",
                      "is the ballbar, which needs the table [ballbar] of the station file");
    AXISCAL_CHECK(disk_takes_records());
    AXISCAL_CHECK(nothing_goes_on());
    AXISCAL_CHECK(ballbar_speaks());
    const auto& reading = readings_.latest(*roles_.ballbar);
    if (!reading || !reading->value())
        return fail(Fault::signal_error, "the ballbar (" + config_.ballbar->instrument +
                                             ") shows no good reading now; mount it so that it "
                                             "rests within its range");
    return {};
}

Result<void> Station::check_spans(const DriftRequest& request) const {
    if (request.interval <= Duration{} || request.duration < 2 * request.interval)
        return refuse(Fault::bad_request, "duration", "is shorter than two intervals");
    if (request.interval < config_.capture.window)
        return refuse(Fault::bad_request, "interval",
                      "is shorter than capture.window, over which each reading is a mean");
    return {};
}

/// The far end of the travel: the reading rises away from the interferometer. A rotary axis rests
/// at its datum, where the reflectors are square to the beam.
Result<DriftSetup> Station::drift_setup_of(const DriftRequest& request, const RunPlan& plan) const {
    if (reads_faces())
        return fail(Fault::refused, "a drift test before a polygon is not supported, the "
                                    "autocollimator is read at the faces of a run alone: state "
                                    "uncertainty.eve, the range of its reading, by hand");
    if (reads_polygon())
        return fail(Fault::refused, "an autocollimator whose readings are typed cannot be recorded "
                                    "against time: state uncertainty.eve by hand");
    AXISCAL_CHECK(check_spans(request));
    const Length low = config_.cycle.travel_low, high = config_.cycle.travel_high;
    const Length far = config_.axis.sign > 0 ? high : low;
    const Length usual = plan.axis_kind == AxisKind::rotary ? plan.datum : far;
    const Length place = request.place_mm ? mm(*request.place_mm) : usual;
    if (place < low || place > high)
        return refuse(Fault::bad_request, "place_mm", "lies outside the travel of the axis");
    AXISCAL_CHECK(rests_at(place));
    return DriftSetup{request.duration, request.interval, place};
}

/// While the datum of the last run stands, the laser tells where the axis is. A rotary axis may be
/// behind any position of its table.
Result<void> Station::rests_at(Length place) const {
    constexpr Length near = mm(1);
    if (!run_ || !datum_ || run_->header.rotary || !set_up_.lost().empty() || !datum_stands())
        return {};
    const auto reading = readings_.reference().newest();
    if (!reading || !reading->value()) return {};
    const Length seen = live_position(run_->header.laser, *datum_, metre(*reading->value()),
                                      readings_.last_scale_minus_1());
    if (abs(seen - place) <= near) return {};
    const std::string there = plain_number(seen.in(mm), 1);
    return refuse(Fault::bad_request, "place_mm",
                  "is " + plain_number(place.in(mm), 3) + " mm, and by the datum of run " +
                      run_->header.run_id + " the axis stands at " + there +
                      " mm: drive it to the place, or say --at " + there);
}

/// Every channel of the station, the one that is watched first. One that no run of it uses stands
/// without a medium: it must not count as air or material of the axis.
std::vector<ChannelRecord> Station::every_channel(int watched,
                                                  const std::vector<int>& environment) const {
    std::vector<ChannelRecord> records;
    for (const StationChannel& channel : supervisor_.channels()) {
        ChannelRecord record{channel.id,   channel.shown,  channel.instrument_name, channel.place,
                             channel.kind, channel.medium, channel.correction};
        const bool used = channel.id == watched ||
                          std::ranges::find(environment, channel.id) != environment.end();
        if (!used) record.medium = Medium::none;
        records.push_back(std::move(record));
    }
    // clang 14 does not take the ranges' own.
    std::stable_partition(records.begin(), records.end(),
                          [watched](const ChannelRecord& record) { return record.id == watched; });
    return records;
}

Task<Result<std::string>> Station::drift(DriftRequest request) {
    const bool of_bar = drift_is_of_bar(request);
    if (auto ready = ready_for_drift(of_bar); !ready)
        co_return tl::unexpected<Error>(ready.error());
    const Held arming{arming_};
    co_return co_await open_drift(std::move(request), of_bar);
}

Result<Station::RestingTest> Station::drift_of_axis(const DriftRequest& request) const {
    ArmRequest statements;
    statements.statements = request.statements;
    AXISCAL_TRY(RunPlan plan, plan_for(statements));
    AXISCAL_TRY(const DriftSetup setup, drift_setup_of(request, plan));
    plan.pass = RunPlan{}.pass;
    plan.targets.clear();
    plan.points.clear();
    plan.remark.clear();
    const RunHeaderParts parts{config_,         supervisor_,     roles_,
                               TestKind::drift, std::move(plan), scheduler_.clock_tie(),
                               boot_id_,        config_hash_};
    AXISCAL_TRY(RunRecord header, make_run_header(parts, statements));
    header.run_id = free_run_id(config_, config_.axis.name, parts.opened.utc_ns, "-drift");
    header.channels = every_channel(*roles_.laser, roles_.environment());
    return RestingTest{std::move(header), setup, *roles_.laser};
}

/// Before its first second nothing is known of it; intervals are counted as missing then.
Result<void> Station::check_rate_of_bar() const {
    const double readings = readings_.bar_rate_hz() * seconds_of(config_.capture.window);
    if (readings_.bar_rate_hz() == 0 || readings >= fewest_of_bar) return {};
    return fail(Fault::refused, "the ballbar (" + config_.ballbar->instrument + ") sends " +
                                    plain_number(readings_.bar_rate_hz(), 1) +
                                    " readings a second: let it send at least two within each " +
                                    plain_number(seconds_of(config_.capture.window), 3) +
                                    " s, over which each reading is a mean");
}

Result<Station::RestingTest> Station::drift_of_bar(const DriftRequest& request) const {
    AXISCAL_CHECK(check_spans(request));
    AXISCAL_CHECK(check_rate_of_bar());
    if (request.place_mm)
        return refuse(Fault::bad_request, "place_mm",
                      "is of an axis; a ballbar has no place on it");
    ArmRequest statements;
    statements.statements = request.statements;
    const std::string plane =
        config_.circular ? std::string{name_of(config_.circular->setup.plan.plane)} : "";
    const std::string name = (plane.empty() ? plane : plane + "-") + "ballbar";
    AXISCAL_TRY(RunRecord header, header_without_axis(TestKind::drift, name, statements));
    header.run_id = free_run_id(config_, name, header.opened.utc_ns, "-drift");
    header.statements.axis = plane;
    header.laser = {};
    header.laser.instrument = config_.ballbar->instrument;
    if (header.rotary) header.tolerances.reset(); // stated in arcsec, of the axis
    header.rotary.reset();
    header.scale.reset();
    header.channels = every_channel(*roles_.ballbar, roles_.of_circles());
    return RestingTest{
        std::move(header), {request.duration, request.interval, Length{}, true}, *roles_.ballbar};
}

Task<Result<std::string>> Station::open_drift(DriftRequest request, bool of_bar) {
    AXISCAL_CO_TRY(RestingTest order, of_bar ? drift_of_bar(request) : drift_of_axis(request));
    // No certificate: a number of the station file is none of it.
    if (!request.statements.contains("certificate_number"))
        order.header.statements.certificate_number.clear();
    order.header.calibrations = calibrations_of(supervisor_, order.header.channels);
    const std::string id = order.header.run_id;
    std::string path = config_.state_directory + "/runs/" + id + std::string{run_file_ending};
    RunAttachments attachments;
    if (!of_bar) attachments.alignment = alignment_for_run();
    attachments.setup = order.setup;
    if (auto opened = co_await journal_.open(path, std::move(order.header), std::move(attachments));
        !opened)
        co_return tl::unexpected<Error>(opened.error());
    const auto newest = of_bar ? readings_.latest(order.watched) : readings_.reference().newest();
    DriftRecorder recorder{order.setup, order.watched, newest ? newest->epoch : 0,
                           scheduler_.now()};
    drift_.emplace(CurrentDrift{
        id, std::move(path), std::move(recorder), {}, false, false, false, {}, {}, {}, {}});
    if (of_bar) drift_->bar.emplace(SampleHistory::Limits{2 * config_.capture.window});
    journal_.note(order_of("drift", request.by));
    note("Drift test " + id + " has begun, ordered by " + name_of(request.by) + ": leave " +
         (of_bar ? "machine and ballbar" : "the axis") + " alone.");
    spawn(scheduler_, record_drift(id));
    co_return id;
}

Task<void> Station::record_drift(std::string run_id) {
    const auto goes_on = [&] { return !stopping_ && drift_->run_id == run_id && !drift_->closing; };
    while (goes_on() && !drift_->recorder.is_over()) {
        const MonotonicTime now = scheduler_.now(), due = drift_->recorder.next_due();
        if (now >= due)
            note_drift();
        else
            co_await scheduler_.sleep_for(std::min(due - now, hear_every));
        if (goes_on() && drift_->recorder.zero_is_lost()) co_await close_drift(false, lost_zero);
        if (const auto why = journal_.failure(); why && goes_on())
            co_await close_drift(false, disk_text(*why));
    }
    if (goes_on()) co_await close_drift(true, "");
}

void Station::note_drift() {
    const DriftLimits limits{config_.capture.window, config_.axis.air.oldest,
                             drift_->bar ? fewest_of_bar : config_.capture.minimum_samples};
    const SampleHistory& watched = drift_->bar ? *drift_->bar : readings_.reference();
    auto readings = drift_->recorder.take(scheduler_.now(), watched, readings_.latest(), limits);
    if (!readings.empty()) journal_.note(std::move(readings));
}

Task<Result<void>> Station::close_drift(bool complete, std::string reason) {
    if (std::exchange(drift_->closing, true)) co_return Result<void>{};
    const Result<void> closed = co_await close_file(complete, reason);
    if (!closed) {
        reason = "The run file could not be closed: " + disk_text(closed.error());
        drift_->closing_error = closed.error();
        co_await journal_.let_go(); // the next test or run has a file of its own
    }
    note("Drift test " + drift_->run_id +
         (complete && closed ? " is complete." : " is closed as incomplete: " + reason));
    drift_->reason = std::move(reason);
    drift_->complete = complete && closed;
    drift_->closed = true;
    if (drift_->complete) co_await certify(drift_->run_id, drift_->path);
    if (closed) co_return closed;
    co_return fail(Fault::not_durable, drift_->reason, closed.error().cause);
}

Task<void> Station::abort_drift(std::string reason) {
    (void)co_await close_drift(false, std::move(reason)); // await_drift_closing() tells
}

/// As await_closing(). A file that could not be closed is left to the next start.
Task<Result<RunEnding>> Station::await_drift_closing(std::string run_id) {
    const MonotonicTime limit = scheduler_.now() + closing_limit;
    const auto same = [&] { return drift_->run_id == run_id; };
    while (same() && !drift_->closed && scheduler_.now() < limit && !stopping_)
        co_await scheduler_.sleep_for(look_every);
    if (!same()) co_return RunEnding{};
    if (!drift_->closed) co_return not_closed_yet();
    if (drift_->closing_error)
        co_return fail(Fault::not_durable, drift_->reason, drift_->closing_error->cause);
    co_return RunEnding{drift_->complete, drift_->reason};
}

DriftView Station::drift_view() const {
    const DriftRecorder& recorder = drift_->recorder;
    DriftView view;
    view.run_id = drift_->run_id;
    view.state = !drift_->closed ? "recording" : drift_->complete ? "complete" : "incomplete";
    view.file = drift_->path;
    view.certificate = drift_->certificate;
    view.of_bar = drift_->bar.has_value();
    if (!view.of_bar) view.place_mm = recorder.setup().place.in(mm);
    view.taken = recorder.taken();
    view.missing = recorder.missing();
    view.planned = recorder.planned();
    if (const auto range = recorder.range()) view.range_um = range->in(um);
    if (!drift_->closed)
        view.seconds_left = std::max(0.0, seconds_of(recorder.end() - scheduler_.now()));
    view.sentence = drift_->no_certificate ? describe(*drift_->no_certificate) : drift_->reason;
    return view;
}

} // namespace axiscal
