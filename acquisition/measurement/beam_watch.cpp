#include "acquisition/measurement/beam_watch.hpp"

#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/notices.hpp"
#include "acquisition/live/roles.hpp"
#include "acquisition/live/supervisor.hpp"
#include "acquisition/live/time_limits.hpp"
#include "acquisition/measurement/latest_tests.hpp"
#include "acquisition/measurement/positioning/axis_instruments.hpp"

namespace axiscal {

BeamWatch::BeamWatch(const CncContext& context, const LatestTests& tests)
    : context_(context)
    , tests_{tests} {}

std::optional<Sample> BeamWatch::strength_told() const {
    const std::optional<int>& laser = context_.roles.laser;
    if (!laser) return std::nullopt;
    const int seat = context_.instruments.channel(*laser).instrument;
    for (const StationChannel& channel : context_.instruments.channels()) {
        if (channel.kind != ChannelKind::strength || channel.instrument != seat) continue;
        const auto& sample = context_.readings.latest(channel.id);
        if (sample && context_.scheduler.now() - sample->at <= strength_limit) return sample;
    }
    return std::nullopt;
}

std::string BeamWatch::serial() const {
    return serial_of_axis(context_.config, context_.roles, context_.instruments);
}

void BeamWatch::take(const Sample& sample) {
    if (beam_.running()) beam_.take(sample, strength_told());
}

AlignmentRecord BeamWatch::so_far() const {
    return beam_.so_far(context_.config.axis.laser.instrument, serial(),
                        context_.scheduler.clock_tie().utc_ns);
}

AlignmentView BeamWatch::view() const {
    AlignmentView view;
    view.running = beam_.running();
    if (!view.running) {
        view.record = beam_.kept();
        return view;
    }
    view.record = so_far();
    if (const auto distance = beam_.distance()) view.distance_mm = distance->in(mm);
    if (const auto strength = strength_told()) view.strength_percent = strength->value();
    view.at_rest = beam_.at_rest();
    return view;
}

Result<void> BeamWatch::carry_out(const AlignmentOrder& order) {
    if (!context_.roles.laser) return fail(Fault::refused, "this station has no laser to align");
    if (context_.config.axis.scale)
        return fail(Fault::refused, "a linear scale measures the axis: it has no beam to align");
    if (order.action == AlignmentAction::begin) return begin();
    if (!beam_.running())
        return fail(Fault::not_found, "no alignment is going on; 'axiscal align' begins one");
    if (order.action == AlignmentAction::keep) return keep(order.spot_offset_mm);
    beam_.cancel();
    return {};
}

Result<void> BeamWatch::begin() {
    const CycleConfig& cycle = context_.config.cycle;
    if (cycle.axis_kind == AxisKind::rotary)
        return fail(Fault::refused, "a rotary axis has no travel along the beam");
    if (tests_.run_open())
        return fail(Fault::busy, "run " + tests_.run()->run().run_id +
                                     " is open: a beam that is steered now spoils it; finish "
                                     "it or 'axiscal abort' it first");
    if (tests_.rest_goes_on())
        return fail(Fault::busy, "drift test " + tests_.resting()->run().run_id +
                                     " is going on: a beam that is steered now spoils it");
    beam_.begin(cycle.travel_high - cycle.travel_low, context_.config.capture.spread_limit,
                context_.scheduler.clock_tie());
    return {};
}

Result<void> BeamWatch::keep(std::optional<double> spot_offset_mm) {
    AXISCAL_CHECK(beam_.keep(so_far(), spot_offset_mm));
    context_.notices.note(
        "The alignment of the beam is kept; it stands in the run files from now on.");
    return {};
}

std::optional<AlignmentRecord> BeamWatch::for_run() {
    if (beam_.running() && !keep({})) beam_.cancel();
    if (!beam_.kept() || beam_.kept()->serial != serial()) return std::nullopt;
    return beam_.kept();
}

} // namespace axiscal
