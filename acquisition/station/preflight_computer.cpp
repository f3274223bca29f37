// What the computer and the service's sandbox give the daemon (docs/sandbox.md).
#include "acquisition/station/preflight_checks.hpp"

namespace axiscal::preflight_checks {

PreflightRecord check_computer(const PreflightFacts& facts) {
    if (!facts.boot_known)
        return warned("computer",
                      "axiscald cannot read this computer's boot id "
                      "(/proc/sys/kernel/random/boot_id), so a run that is interrupted cannot go "
                      "on: take ProcSubset=pid out of what `systemctl cat axiscald` shows, and "
                      "start axiscald anew.");
    if (!facts.may_sleep.empty())
        return warned("computer",
                      "This computer may fall asleep in mid-run, and close its lines with it: " +
                          facts.may_sleep +
                          ". Is polkit installed (apt install polkitd) and the rule of axiscal in "
                          "/usr/share/polkit-1/rules.d? Or switch its suspend off: systemctl mask "
                          "suspend.target");
    return passed("computer",
                  "It is kept awake while a run is open, and its restart would be noticed.");
}

} // namespace axiscal::preflight_checks
