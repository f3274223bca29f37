// Whether a drift test says something about the run whose budget takes its E_VE.
#include "acquisition/preflight/preflight_checks.hpp"

#include "acquisition/capture/wording.hpp"

#include <cmath>

namespace axiscal::preflight_checks {
namespace {

/// E_VE grows with the beam: at less than half of the run's longest it says too little of that.
constexpr double least_share_of_beam = 0.5;

std::string rest_of(const EveFacts& eve) {
    if (!eve.rest) return "";
    return ", the axis at " + plain_number(eve.rest->in(mm), 3) + (eve.angle ? " deg" : " mm");
}

/// Rounded up, so that the order makes one that is long enough.
std::string order_for(const EveFacts& eve) {
    const int minutes = static_cast<int>(std::ceil(seconds_of(eve.run_takes) / 60));
    return eve.order + " with --duration \"" + std::to_string(minutes) + " min\" or more";
}

} // namespace

PreflightRecord check_eve(const EveFacts& eve) {
    if (!eve.why_not.empty()) return failed("eve", "There is no E_VE: " + eve.why_not + ".");
    const std::string seen =
        "E_VE is of the drift test " + eve.run_id + ": " + in_minutes(eve.lasted) + rest_of(eve);
    const std::string takes = "the run takes " + in_minutes(eve.run_takes) + " or more";
    if (eve.lasted < eve.run_takes)
        return failed("eve", seen + ". The test is too short: " + takes +
                                 ", and E_VE grows with time. Make another drift test: " +
                                 order_for(eve) +
                                 ".");
    if (eve.beam && eve.longest_beam && *eve.beam < *eve.longest_beam * least_share_of_beam)
        return failed("eve", seen + ". The axis was too near: the beam was " +
                                 plain_number(eve.beam->in(mm), 1) +
                                 " mm long, but the run's beam is up to " +
                                 plain_number(eve.longest_beam->in(mm), 1) +
                                 " mm, and E_VE grows with the length of the beam. Make another "
                                 "drift test: " + eve.order +
                                 " with the axis at the far end (--at).");
    return passed("eve", seen + "; " + takes + ".");
}

} // namespace axiscal::preflight_checks
