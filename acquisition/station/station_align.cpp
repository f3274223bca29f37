// The beam watched while it is aligned, and kept for the runs that follow.
#include "acquisition/capture/wording.hpp"
#include "acquisition/station/station.hpp"

#include <algorithm>

namespace axiscal {
namespace {

constexpr Duration strength_limit = std::chrono::seconds{2}; // an older strength is no strength

} // namespace

std::optional<Sample> Station::strength_told() const {
    if (!roles_.laser) return std::nullopt;
    const int seat = channel_of(*roles_.laser).instrument;
    for (const StationChannel& channel : supervisor_.channels()) {
        if (channel.kind != ChannelKind::strength || channel.instrument != seat) continue;
        const auto& sample = latest_[static_cast<std::size_t>(channel.id)];
        if (sample && scheduler_.now() - sample->at <= strength_limit) return sample;
    }
    return std::nullopt;
}

std::optional<double> Station::strength_now() const {
    const auto strength = strength_told();
    return strength ? strength->value() : std::nullopt;
}

/// A strength belongs to the reading that follows it, once: an instrument tells it a hundred times
/// more seldom than the place, and an axis that moves has left that place by the next reading but
/// one.
void Station::watch_alignment(const Sample& sample) {
    if (!aligning_) return;
    const auto strength = strength_told();
    if (!strength || strength->at <= strength_placed_at_)
        return aligning_->take(sample, std::nullopt);
    strength_placed_at_ = strength->at;
    aligning_->take(sample, strength->value());
}

AlignmentRecord Station::alignment_so_far() const {
    AlignmentRecord record = aligning_->record();
    record.began_utc_ns = aligning_since_utc_ns_;
    record.ended_utc_ns = scheduler_.clock_tie().utc_ns;
    record.instrument = config_.axis.laser.instrument;
    record.serial = laser_serial();
    return record;
}

AlignmentView Station::alignment() const {
    AlignmentView view;
    view.running = aligning_.has_value();
    if (!view.running) {
        view.record = alignment_;
        return view;
    }
    view.record = alignment_so_far();
    if (const auto distance = aligning_->distance()) view.distance_mm = distance->in(mm);
    view.strength_percent = strength_now();
    view.at_rest = aligning_->at_rest();
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
            return fail(Fault::busy, "run " + run_->header.run_id +
                                         " is open: a beam that is steered now spoils it; finish "
                                         "it or 'axiscal abort' it first");
        if (drift_open())
            return fail(Fault::busy, "drift test " + drift_->run_id +
                                         " is going on: a beam that is steered now spoils it");
        aligning_.emplace(config_.cycle.travel_high - config_.cycle.travel_low,
                          config_.capture.spread_limit);
        aligning_since_utc_ns_ = scheduler_.clock_tie().utc_ns;
        strength_placed_at_ = scheduler_.now();
        return {};
    }
    if (!aligning_)
        return fail(Fault::not_found, "no alignment is going on; 'axiscal align' begins one");
    if (order.action == AlignmentAction::keep) return keep_alignment(order.spot_offset_mm);
    aligning_.reset();
    return {};
}

Result<void> Station::keep_alignment(std::optional<double> spot_offset_mm) {
    AlignmentRecord record = alignment_so_far();
    if (record.readings == 0)
        return fail(Fault::beam_lost, "the laser gave no good reading since the alignment began");
    const Length needed = std::min(AlignmentWatch::least_distance, record.travel / 2);
    if (record.reached < needed)
        return fail(Fault::refused,
                    "the axis was seen over " + in_mm(record.reached) +
                        " only: a beam is judged along its way; move the axis over " +
                        in_mm(needed) + " or more and keep the alignment then");
    if (spot_offset_mm) record.spot_offset = mm(*spot_offset_mm);
    alignment_ = std::move(record);
    aligning_.reset();
    note("The alignment of the beam is kept; it stands in the run files from now on.");
    return {};
}

std::optional<AlignmentRecord> Station::alignment_for_run() {
    if (aligning_ && !keep_alignment({})) aligning_.reset();
    if (!alignment_ || alignment_->serial != laser_serial()) return std::nullopt;
    return alignment_;
}

} // namespace axiscal
