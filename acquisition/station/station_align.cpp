// The beam watched while it is aligned, and kept for the runs that follow.
#include "acquisition/station/station.hpp"

namespace axiscal {
namespace {

constexpr Duration strength_limit = std::chrono::seconds{2}; // an older strength is no strength

} // namespace

std::optional<Sample> Station::strength_told() const {
    if (!roles_.laser) return std::nullopt;
    const int seat = channel_of(*roles_.laser).instrument;
    for (const StationChannel& channel : supervisor_.channels()) {
        if (channel.kind != ChannelKind::strength || channel.instrument != seat) continue;
        const auto& sample = readings_.latest(channel.id);
        if (sample && scheduler_.now() - sample->at <= strength_limit) return sample;
    }
    return std::nullopt;
}

std::optional<double> Station::strength_now() const {
    const auto strength = strength_told();
    return strength ? strength->value() : std::nullopt;
}

void Station::watch_alignment(const Sample& sample) {
    if (beam_.running()) beam_.take(sample, strength_told());
}

AlignmentRecord Station::alignment_so_far() const {
    return beam_.so_far(config_.axis.laser.instrument, laser_serial(),
                        scheduler_.clock_tie().utc_ns);
}

AlignmentView Station::alignment() const {
    AlignmentView view;
    view.running = beam_.running();
    if (!view.running) {
        view.record = beam_.kept();
        return view;
    }
    view.record = alignment_so_far();
    if (const auto distance = beam_.distance()) view.distance_mm = distance->in(mm);
    view.strength_percent = strength_now();
    view.at_rest = beam_.at_rest();
    return view;
}

Result<void> Station::align(AlignmentOrder order) {
    if (!roles_.laser) return fail(Fault::refused, "this station has no laser to align");
    if (config_.axis.scale)
        return fail(Fault::refused, "a linear scale measures the axis: it has no beam to align");
    if (order.action == AlignmentAction::begin) {
        if (config_.cycle.axis_kind == AxisKind::rotary)
            return fail(Fault::refused, "a rotary axis has no travel along the beam");
        if (run_open())
            return fail(Fault::busy, "run " + last_run()->run().run_id +
                                         " is open: a beam that is steered now spoils it; finish "
                                         "it or 'axiscal abort' it first");
        if (drift_open())
            return fail(Fault::busy, "drift test " + tests_.resting()->run().run_id +
                                         " is going on: a beam that is steered now spoils it");
        beam_.begin(config_.cycle.travel_high - config_.cycle.travel_low,
                    config_.capture.spread_limit, scheduler_.clock_tie());
        return {};
    }
    if (!beam_.running())
        return fail(Fault::not_found, "no alignment is going on; 'axiscal align' begins one");
    if (order.action == AlignmentAction::keep) return keep_alignment(order.spot_offset_mm);
    beam_.cancel();
    return {};
}

Result<void> Station::keep_alignment(std::optional<double> spot_offset_mm) {
    AXISCAL_CHECK(beam_.keep(alignment_so_far(), spot_offset_mm));
    note("The alignment of the beam is kept; it stands in the run files from now on.");
    return {};
}

std::optional<AlignmentRecord> Station::alignment_for_run() {
    if (beam_.running() && !keep_alignment({})) beam_.cancel();
    if (!beam_.kept() || beam_.kept()->serial != laser_serial()) return std::nullopt;
    return beam_.kept();
}

} // namespace axiscal
