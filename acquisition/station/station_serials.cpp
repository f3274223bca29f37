// Whether the instruments after a restart are those of the run: serial numbers of what has
// answered, when the run is taken over and each second from then on.
#include "acquisition/station/station.hpp"

#include "acquisition/measurement/instrument_serials.hpp"
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

/// Of those that a positioning run uses.
std::vector<InstrumentSerial> Station::serials_of_axis() const {
    std::vector<int> channels = roles_.environment();
    if (roles_.laser) channels.push_back(*roles_.laser);
    return answered_serials(supervisor_, channels);
}

/// Until it answers, an instrument keeps points from being taken, and no more than that.
void Station::judge_instruments() {
    if (circles_) return circles_->judge_instruments();
    if (!recording() || !run_->resumed) return;
    std::string exchanged = exchanged_instrument(run_->header, serials_of_axis());
    if (exchanged.empty()) return;
    run_->resumed = false; // told once
    note(exchanged);
    feed(Abort{std::move(exchanged), scheduler_.now()});
}

} // namespace axiscal
