// Whether the instruments after a restart are those of the run: serial numbers of what has
// answered, when the run is taken over and each second from then on.
#include "acquisition/station/station.hpp"

#include "acquisition/run/resume.hpp"

#include <algorithm>

namespace axiscal {

/// Of a laser that has said nothing yet the run's own: it must not be taken for another one.
std::string Station::laser_serial_for(const RunRecord& run) const {
    const std::optional<int> id = roles_.laser ? roles_.laser : roles_.autocollimator;
    const auto then =
        std::ranges::find(run.instruments, run.laser.instrument, &InstrumentRecord::name);
    if (!id || then == run.instruments.end()) return laser_serial();
    const Identity& who = supervisor_.identity(channel_of(*id).instrument);
    const bool silent = who.maker.empty() && who.model.empty() && who.serial.empty();
    return silent ? then->serial : laser_serial();
}

/// Of those that this run uses.
std::vector<InstrumentSerial> Station::answered_serials(const RunRecord& run) const {
    const bool circles = run.kind == TestKind::circular;
    std::vector<int> channels = circles ? roles_.of_circles() : roles_.environment();
    if (const auto& reference = circles ? roles_.ballbar : roles_.laser)
        channels.push_back(*reference);
    std::vector<InstrumentSerial> answered;
    for (const int id : channels) {
        const StationChannel& channel = channel_of(id);
        const std::string& serial = supervisor_.identity(channel.instrument).serial;
        if (!serial.empty()) answered.push_back({channel.instrument_name, serial});
    }
    return answered;
}

/// Until it answers, an instrument keeps points from being taken, and no more than that.
void Station::judge_instruments() {
    if (!recording() || !run_->resumed) return;
    std::string exchanged = exchanged_instrument(run_->header, answered_serials(run_->header));
    if (exchanged.empty()) return;
    run_->resumed = false; // told once
    note(exchanged);
    if (circular_)
        end_circular({false, std::move(exchanged), Fault::unknown_instrument});
    else
        feed(Abort{std::move(exchanged), scheduler_.now()});
}

} // namespace axiscal
