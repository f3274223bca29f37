// What the computer and the service's sandbox give the daemon (docs/sandbox.md).
#include "acquisition/preflight/preflight_checks.hpp"

#include <algorithm>

namespace axiscal::preflight_checks {
namespace {

/// A day that has gone by for certain, and how that is known.
struct PastDay {
    std::string date, from;
};

void keep_later(PastDay& latest, const std::string& date, const std::string& from) {
    if (date > latest.date) latest = {date, from};
}

/// ISO dates sort as time does.
PastDay latest_past_day(const PreflightFacts& facts) {
    PastDay latest{std::string{earliest_date}, "this version of axiscal is of that year"};
    for (const InstrumentConfig& instrument : facts.config.instruments) {
        if (std::ranges::find(facts.in_use, instrument.name) == facts.in_use.end()) continue;
        keep_later(latest, instrument.calibrated_on, instrument.name + " was calibrated then");
        for (const ChannelConfig& channel : instrument.channels)
            keep_later(latest, channel.calibration.calibrated_on,
                       instrument.name + "/" + channel.channel + " was calibrated then");
    }
    if (facts.config.axis.angle && !facts.circular)
        keep_later(latest, facts.config.axis.angle->artefact.calibrated_on,
                   facts.config.axis.angle->artefact.name + " was calibrated then");
    keep_later(latest, facts.newest_run_day, "run " + facts.newest_run + " was measured then");
    return latest;
}

} // namespace

/// Behind a clock that is slow every certificate is in date, and the paper would bear a wrong day.
PreflightRecord check_clock(const PreflightFacts& facts) {
    const PastDay past = latest_past_day(facts);
    if (facts.today >= past.date)
        return passed("clock", "The clock shows " + facts.today +
                                   "; no calibration and no stored run has a later date.");
    return failed("clock",
                  "This computer's clock shows " + facts.today + ", which is wrong: " + past.date +
                      " is already past, because " + past.from +
                      ". Set the clock (sudo date --set ..., or timedatectl set-ntp true; a dead "
                      "battery on the main board?), or correct that date in the station file.");
}

PreflightRecord check_computer(const PreflightFacts& facts) {
    if (!facts.boot_known)
        return warned("computer",
                      "axiscald cannot read this computer's boot id "
                      "(/proc/sys/kernel/random/boot_id), so a run that is interrupted cannot "
                      "continue: remove ProcSubset=pid from the service file that `systemctl cat "
                      "axiscald` shows, and restart axiscald.");
    if (!facts.may_sleep.empty())
        return warned(
            "computer",
            "This computer may suspend during a run, and then the connections to the "
            "instruments close: " +
                facts.may_sleep +
                ". Is polkit installed (apt install polkitd), and is the rule of axiscal in "
                "/usr/share/polkit-1/rules.d? If not, install them, or disable suspend: "
                "systemctl mask suspend.target");
    return passed(
        "computer",
        "This computer stays awake while a run is open, and axiscald detects a restart of it.");
}

} // namespace axiscal::preflight_checks
