// What the station shows: to people and to the CNC.
#include "acquisition/station/station.hpp"

#include "acquisition/capture/stillness.hpp"
#include "acquisition/live/time_limits.hpp"
#include "config/version.hpp"

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
    if (const auto& run = last_run()) run->put_on_port(status);
    status.run_broken_off = broken_off();
    port_->publish(status);
}

void Station::publish_armed() {
    port_->publish_armed();
}

void Station::acknowledge(const JournalReceipt& receipt) {
    port_->acknowledge(receipt);
}

void Station::acknowledge_skip(const JournalReceipt& receipt) {
    port_->acknowledge_skip(receipt);
}

void Station::publish_no_run() {
    end_requests(RunEnd::at_once);
}

void Station::end_requests(RunEnd end) {
    port_->publish_no_run(end);
}

void Station::publish_position(MonotonicTime at, double position_mm) {
    port_->position(at, position_mm);
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
    axis.stale_after_s = seconds_of(laser_limit);
    axis.least_strength_percent = config_.preflight.least_strength_percent;
    const MonotonicTime now = scheduler_.now();
    const auto newest = readings_.reference().newest();
    if (newest) axis.age_s = seconds_of(now - newest->at);
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
        if (const auto& run = last_run()) run->put_on_axis(axis, metre(*value));
    }
    return axis;
}

StationStatus Station::status() const {
    StationStatus status;
    status.station = config_.station;
    status.version = software_version();
    status.utc = iso8601_utc(scheduler_.clock_tie().utc_ns);
    status.axis = axis_view();
    const ChannelFacts seen = channels();
    const MonotonicTime now = scheduler_.now();
    for (const StationChannel& channel : supervisor_.channels()) {
        status.channels.push_back(seen.view(channel, now));
        if (channel.kind == ChannelKind::strength)
            status.axis.strength_percent = status.channels.back().value;
    }
    status.instruments = supervisor_.view();
    status.trigger = port_->describe();
    status.trigger_note = notices_.port();
    status.trigger_counters = port_->counters();
    status.cnc_silent = cnc_silent_;
    if (const auto& run = last_run()) run->put_on_status(status);
    status.run_open = run_open();
    if (const auto& resting = tests_.resting()) resting->put_on_status(status);
    status.outbox = outbox_watch_.look(scheduler_.clock_tie());
    status.notes.assign(notices_.last().begin(), notices_.last().end());
    status.to_do = things_to_do(status, to_do_facts());
    return status;
}

ToDoFacts Station::to_do_facts() const {
    ToDoFacts facts;
    facts.disk = disk_.trouble();
    facts.judged = judged_checks_;
    if (const auto& run = last_run())
        facts.findings = certificates_.unanswered_of(run->run().run_id);
    return facts;
}

std::optional<StreamView> Station::stream(std::size_t most) const {
    if (!last_run()) return std::nullopt;
    return last_run()->stream(most);
}

PointsView Station::points(std::size_t from) const {
    if (!last_run()) return {};
    return last_run()->points(from);
}

AlignmentView Station::alignment() const {
    return beam_.view();
}

} // namespace axiscal
