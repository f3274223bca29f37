// The drift test: every channel against time while the axis rests, without a CNC.
#include "acquisition/station/station.hpp"

#include "acquisition/run/cycle_plan.hpp"
#include "acquisition/station/run_header.hpp"
#include "drivers/spawn.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace axiscal {
namespace {

constexpr Duration hear_every = std::chrono::milliseconds{50}; // an abort is heard within it
constexpr const char* lost_zero = "The counter lost its zero: the readings cannot be "
                                  "compared any more.";

/// E_VE of a sealed test, one millimetre for one degree of a rotary axis. Nothing where the test
/// was of an axis of the other kind.
std::optional<Length> eve_of(const nlohmann::json& document, AxisKind kind) {
    const nlohmann::json::json_pointer place{"/parameters/E_VE/value"};
    if (!document.is_object() || !document.contains(place) || !document[place].is_number())
        return std::nullopt;
    const double value = document[place].get<double>();
    const bool angle = kind == AxisKind::rotary;
    const nlohmann::json stated = document.value("unit", nlohmann::json("um"));
    if (stated != (angle ? "arcsec" : "um") || value < 0) return std::nullopt;
    constexpr double arcsec_per_degree = 3600;
    return angle ? mm(value / arcsec_per_degree) : um(value);
}

/// How many readings of a sealed test became no coordinate: those may have been its extremes.
/// Tests sealed before this was counted state none.
int refused_readings_in(const nlohmann::json& document) {
    const auto stated = document.is_object() ? document.find("refused_readings") : document.end();
    return stated != document.end() && stated->is_number_integer() ? stated->get<int>() : 0;
}

} // namespace

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
    if (request.interval <= Duration{} || request.duration < 2 * request.interval)
        return refuse(Fault::bad_request, "duration", "is shorter than two intervals");
    if (request.interval < config_.capture.window)
        return refuse(Fault::bad_request, "interval",
                      "is shorter than capture.window, over which each reading is a mean");
    const Length low = config_.cycle.travel_low, high = config_.cycle.travel_high;
    const Length far = config_.axis.sign > 0 ? high : low;
    const Length usual = plan.axis_kind == AxisKind::rotary ? plan.datum : far;
    const Length place = request.place_mm ? mm(*request.place_mm) : usual;
    if (place < low || place > high)
        return refuse(Fault::bad_request, "place_mm", "lies outside the travel of the axis");
    return DriftSetup{request.duration, request.interval, place};
}

/// Every channel of the station, the laser that measures the axis first. One that no run uses
/// stands without a medium: it must not count as air or material of the axis.
std::vector<ChannelRecord> Station::every_channel() const {
    const std::vector<int> environment = roles_.environment();
    std::vector<ChannelRecord> records;
    for (const StationChannel& channel : supervisor_.channels()) {
        ChannelRecord record{channel.id,   channel.shown,  channel.instrument_name, channel.place,
                             channel.kind, channel.medium, channel.correction};
        const bool used = channel.id == roles_.laser ||
                          std::ranges::find(environment, channel.id) != environment.end();
        if (!used) record.medium = Medium::none;
        records.push_back(std::move(record));
    }
    // clang 14 does not take the ranges' own.
    std::stable_partition(records.begin(), records.end(), [this](const ChannelRecord& record) {
        return record.id == roles_.laser;
    });
    return records;
}

Task<Result<std::string>> Station::drift(DriftRequest request) {
    if (auto ready = ready_to_measure(); !ready) co_return tl::unexpected<Error>(ready.error());
    arming_ = true;
    auto opened = co_await open_drift(std::move(request));
    arming_ = false;
    co_return opened;
}

Task<Result<std::string>> Station::open_drift(DriftRequest request) {
    ArmRequest statements;
    statements.statements = request.statements;
    AXISCAL_CO_TRY(RunPlan plan, plan_for(statements));
    AXISCAL_CO_TRY(const DriftSetup setup, drift_setup_of(request, plan));
    plan.pass = "drift";
    plan.targets.clear();
    plan.points.clear();
    plan.remark.clear();
    const RunHeaderParts parts{
        config_,  supervisor_, roles_, std::move(plan), scheduler_.clock_tie(),
        boot_id_, config_hash_};
    AXISCAL_CO_TRY(RunRecord header, make_run_header(parts, statements));
    header.run_id += "-drift";
    header.channels = every_channel();
    header.calibrations = calibrations_of(supervisor_, header.channels);
    const std::string id = header.run_id;
    std::string path = config_.state_directory + "/runs/" + id + std::string{run_file_ending};
    RunAttachments attachments;
    attachments.alignment = alignment_for_run();
    attachments.drift = setup;
    if (auto opened = co_await journal_.open(path, std::move(header), std::move(attachments));
        !opened)
        co_return tl::unexpected<Error>(opened.error());
    const auto newest = history_.newest();
    DriftRecorder recorder{setup, *roles_.laser, newest ? newest->epoch : 0, scheduler_.now()};
    drift_.emplace(
        CurrentDrift{id, std::move(path), std::move(recorder), false, false, false, {}, {}, {}});
    note("Drift test " + id + " has begun: leave the axis alone.");
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
            co_await close_drift(false, disk_in_words(*why));
    }
    if (goes_on()) co_await close_drift(true, "");
}

void Station::note_drift() {
    const DriftLimits limits{config_.capture.window, config_.axis.air.oldest,
                             config_.capture.minimum_samples};
    auto readings = drift_->recorder.take(scheduler_.now(), history_, latest_, limits);
    if (!readings.empty()) journal_.note(std::move(readings));
}

Task<void> Station::close_drift(bool complete, std::string reason) {
    if (std::exchange(drift_->closing, true)) co_return;
    const Result<void> closed = co_await journal_.close(complete, reason);
    if (!closed) {
        reason = "The run file could not be closed: " + disk_in_words(closed.error());
        co_await journal_.let_go(); // the next test or run has a file of its own
    }
    note("Drift test " + drift_->run_id +
         (complete && closed ? " is complete." : " is closed as incomplete: " + reason));
    drift_->reason = std::move(reason);
    drift_->complete = complete && closed;
    drift_->closed = true;
    if (drift_->complete) co_await certify(drift_->run_id, drift_->path);
}

DriftView Station::drift_view() const {
    const DriftRecorder& recorder = drift_->recorder;
    DriftView view;
    view.run_id = drift_->run_id;
    view.state = !drift_->closed ? "recording" : drift_->complete ? "complete" : "incomplete";
    view.file = drift_->path;
    view.certificate = drift_->certificate;
    view.place_mm = recorder.setup().place.in(mm);
    view.taken = recorder.taken();
    view.missing = recorder.missing();
    view.planned = recorder.planned();
    if (const auto range = recorder.range()) view.range_um = range->in(um);
    if (!drift_->closed)
        view.seconds_left = std::max(0.0, seconds_of(recorder.end() - scheduler_.now()));
    view.sentence = drift_->no_certificate ? describe(*drift_->no_certificate) : drift_->reason;
    return view;
}

Task<Result<void>> Station::adopt_eve(RunRecord& header, RunAttachments& attachments) {
    if (config_.eve_run.empty()) co_return Result<void>{};
    const auto found = co_await journal_.find_drift(config_.state_directory + "/runs",
                                                    config_.eve_run, header.statements.axis);
    if (!found) co_return tl::unexpected<Error>(found.error());
    const auto document = nlohmann::json::parse(found->document, nullptr, false);
    if (const int refused = refused_readings_in(document); refused > 0)
        co_return fail(Fault::refused,
                       "the drift test " + found->run_id + " could not evaluate " +
                           std::to_string(refused) +
                           " of its readings, so that its E_VE may be too small: make another by "
                           "'axiscal drift', or name a good one in uncertainty.eve_run");
    const std::optional<Length> eve = eve_of(document, header.plan.axis_kind);
    if (!eve)
        co_return fail(Fault::bad_run_file, "the drift test " + found->run_id +
                                                " states no E_VE in the unit of this axis");
    if (!header.uncertainty) header.uncertainty.emplace();
    header.uncertainty->eve = *eve;
    attachments.eve_source = found->run_id;
    co_return Result<void>{};
}

} // namespace axiscal
