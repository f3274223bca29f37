// What the station shows: to people and to the CNC.
#include "acquisition/station/station.hpp"

#include "acquisition/capture/stillness.hpp"
#include "acquisition/capture/wording.hpp"
#include "acquisition/live/time_limits.hpp"
#include "acquisition/run/live_position.hpp"
#include "analysis/rotary/rotary_position.hpp"
#include "config/version.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
void Station::publish_to_port() {
    PortStatus status;
    status.state = port_state_;
    status.axis_kind = config_.cycle.axis_kind;
    const AxisView axis = axis_view();
    status.measured_mm = axis.position_mm;
    status.deviation_um = axis.deviation_um;
    const MonotonicTime now = scheduler_.now();
    status.air_degC = readings_.mean(EnvironmentRole::air_temperature, now);
    status.pressure_Pa = readings_.mean(EnvironmentRole::air_pressure, now);
    status.humidity_percent = readings_.mean(EnvironmentRole::air_humidity, now);
    status.material_degC = readings_.mean(EnvironmentRole::material_temperature, now);
    if (machine_) {
        const RunView view = machine_->view();
        if (view.next && !view.closed) {
            status.next_target = view.next->target_index;
            status.next_nominal_mm =
                run_->header.plan.targets[static_cast<std::size_t>(view.next->target_index)].in(mm);
        }
        status.run_complete = view.complete;
        const bool stopped = view.stopped && !view.closed;
        status.feed_hold = stopped;
        status.may_move = port_state_ != PortState::settling && !stopped;
    }
    status.run_broken_off = broken_off();
    if (circles_ && !circles_->is_open()) status.run_complete = circles_->run().complete;
    port_->publish(status);
}

void Station::publish_armed() {
    port_->publish_armed();
}

void Station::acknowledge(const JournalReceipt& receipt) {
    port_->acknowledge(receipt);
}

void Station::publish_no_run() {
    port_->publish_no_run(RunEnd::at_once);
}

void Station::show(PortState state) {
    port_state_ = state;
    publish_to_port();
}

AxisView Station::axis_view() const {
    AxisView axis;
    axis.name = config_.axis.name;
    axis.kind = config_.cycle.axis_kind;
    axis.reads_angle = reads_polygon();
    const MonotonicTime now = scheduler_.now();
    const auto newest = readings_.reference().newest();
    if (!newest || now - newest->at > laser_limit) return axis;
    const MonotonicTime begin = newest->at - config_.capture.window;
    const StillnessVerdict verdict =
        judge_window(readings_.reference(), begin, newest->at, config_.capture);
    axis.still = verdict.still;
    if (verdict.statistics.n > 1) {
        axis.spread_um = verdict.statistics.spread.in(um);
        axis.slope_um_per_s = verdict.statistics.slope_um_per_s;
    }
    if (const auto value = newest->value()) {
        axis.displacement_mm = metre(*value).in(mm);
        if (datum_ && run_open()) axis.position_mm = position_now_mm(metre(*value));
    }
    if (axis.position_mm && machine_)
        if (const auto next = machine_->view().next) {
            const double deviation_um =
                (*axis.position_mm -
                 run_->header.plan.targets[static_cast<std::size_t>(next->target_index)].in(mm)) *
                1e3;
            if (std::abs(deviation_um) <= run_->header.plan.near_tolerance.in(um))
                axis.deviation_um = deviation_um;
        }
    return axis;
}

/// Where the indexing table stands shows only near the next target: elsewhere a rotary axis has no
/// position that could be told.
std::optional<double> Station::position_now_mm(Length reading) const {
    const RunRecord& run = run_->header;
    if (!run.rotary)
        return live_position(run.laser, *datum_, reading, readings_.last_scale_minus_1()).in(mm);
    const auto next = machine_ ? machine_->view().next : std::nullopt;
    if (!next) return std::nullopt;
    const Length target = run.plan.targets[static_cast<std::size_t>(next->target_index)];
    const int index = artefact_index(*run.rotary, datum_->coordinate, target);
    const auto position = rotary_position(*run.rotary, run.laser.sign, *datum_, reading,
                                          readings_.last_scale_minus_1(), index);
    if (!position || abs(*position - target) > run.plan.near_tolerance) return std::nullopt;
    return position->in(mm);
}

RunStatus Station::run_status() const {
    const RunView view = machine_->view();
    RunStatus run;
    run.run_id = run_->header.run_id;
    run.pass = run_->header.plan.pass;
    run.file = run_->path;
    run.step = view.done;
    run.steps = view.total;
    run.done = view.last_durable;
    run.certificate = run_->certificate;
    if (view.last_deviation) run.last_deviation_um = view.last_deviation->in(um);
    if (view.last_synchronisation)
        run.last_synchronisation_um = view.last_synchronisation->error_um;
    if (run_->closed)
        run.state = run_->outcome->complete ? "complete" : "incomplete";
    else if (view.stopped)
        run.state = "stopped";
    else if (!view.datum)
        run.state = "tying datum";
    else
        run.state = view.state == PortState::settling ? "settling" : "armed";
    if (view.next && run_open()) {
        run.next_target = view.next->target_index;
        run.next_nominal_mm =
            run_->header.plan.targets[static_cast<std::size_t>(view.next->target_index)].in(mm);
        run.next_direction = view.next->direction;
        run.next_approach = view.next->approach;
    }
    run.retakes_asked = view.retakes_asked;
    run.retakes_left = view.retakes_left;
    run.excluded = view.excluded;
    run.seconds_left = seconds_left(view);
    const auto tell = [&run](Fault fault, std::string sentence) {
        if (fault != Fault::none) run.last_fault = fault_name(fault);
        run.last_sentence = std::move(sentence);
    };
    if (run_->outcome && !run_->outcome->complete)
        tell(run_->outcome->fault, run_->outcome->reason);
    else if (run_->no_certificate)
        tell(run_->no_certificate->fault, describe(*run_->no_certificate));
    else if (run_->refusal && !run_->closed)
        tell(run_->refusal->fault, describe(*run_->refusal));
    else if (view.without_point > 0)
        tell(Fault::none, "Warning: " + counted(view.without_point, "point") +
                              " skipped by the CNC, and not taken since: 'axiscal retake' takes "
                              "what is missing, 'axiscal abort' ends the run without.");
    run.skipped = view.without_point;
    return run;
}

/// From the mean time between points; none before the second, for the first one waited for people.
std::optional<double> Station::seconds_left(const RunView& view) const {
    if (run_->taken < 2 || !run_open() || view.stopped) return std::nullopt;
    const double spacing = seconds_of(run_->last_taken - run_->first_taken) / (run_->taken - 1);
    const double since = seconds_of(scheduler_.now() - run_->last_taken);
    return std::max(0.0, spacing * (view.total - view.done - view.skipped) - since);
}

ChannelView Station::channel_view(const StationChannel& channel) const {
    ChannelView view;
    view.instrument = channel.instrument_name;
    view.channel = channel.name;
    view.name = channel.shown;
    view.place = channel.place;
    view.unit = stored_unit_of(channel.kind);
    view.kind = channel.kind;
    view.medium = channel.medium;
    const std::vector<int> environment = roles_.environment();
    if (channel.id == roles_.laser || channel.id == roles_.autocollimator)
        view.role = "axis";
    else if (channel.id == roles_.ballbar)
        view.role = "ballbar";
    else if (std::ranges::find(environment, channel.id) != environment.end())
        view.role = "environment";
    view.used = !view.role.empty();
    const auto& sample = readings_.latest(channel.id);
    if (!sample) return view;
    const Duration age = scheduler_.now() - sample->at;
    const bool measures =
        channel.kind == ChannelKind::displacement || channel.kind == ChannelKind::angle;
    const bool stale = age > (measures ? laser_limit : config_.axis.air.oldest);
    view.age_s = seconds_of(age);
    view.quality = stale ? "stale" : std::string{name_of(sample->quality())};
    if (!stale) view.value = sample->value();
    return view;
}

StationStatus Station::status() const {
    StationStatus status;
    status.station = config_.station;
    status.version = software_version();
    status.utc = iso8601_utc(scheduler_.clock_tie().utc_ns);
    status.axis = axis_view();
    for (const StationChannel& channel : supervisor_.channels()) {
        status.channels.push_back(channel_view(channel));
        if (channel.kind == ChannelKind::strength)
            status.axis.strength_percent = status.channels.back().value;
    }
    status.instruments = supervisor_.view();
    status.trigger = port_->describe();
    status.trigger_note = notices_.port();
    status.trigger_counters = port_->counters();
    status.cnc_silent = cnc_silent_;
    if (circles_)
        status.run = circles_->status();
    else if (run_ && machine_)
        status.run = run_status();
    status.run_open = run_open();
    if (resting_) status.drift = resting_->view();
    status.outbox = outbox_watch_.look(scheduler_.clock_tie());
    status.notes.assign(notices_.last().begin(), notices_.last().end());
    return status;
}

} // namespace axiscal
