#pragma once
// What must hold before a run is armed: each check has a name, a verdict in one sentence with the
// way out, and may be overridden with a reason that is printed. Pure.

#include "acquisition/capture/sensor_log.hpp"
#include "analysis/record/run_revisions.hpp"
#include "config/station_config.hpp"
#include "drivers/sample.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

struct SensorFacts {
    std::string name; ///< "material/contact 1"
    ChannelKind kind = ChannelKind::temperature;
    Medium medium = Medium::none;
    bool fresh = false;
    std::string quality; ///< "good", "stale", ...
    const SensorLog* log = nullptr;
    bool on_scale = false; ///< of the scale that measures the axis, none of the machine
    bool as_sent = true;   ///< no correction was added to what the instrument sent
};

/// The drift test that the budget takes its E_VE from, beside what the run asks of it.
struct EveFacts {
    std::string run_id, order; ///< `order` makes another
    std::string why_not = {};  ///< it cannot be taken; the rest says nothing then
    Duration lasted{};
    Duration run_takes{};       ///< at least
    std::optional<Length> rest; ///< coordinate at which the axis stood; of a bar: none
    bool angle = false;         ///< one millimetre of `rest` for one degree
    /// Of the beam, dead path included: at rest, and the longest of the run. Absent where no beam
    /// measures a length.
    std::optional<Length> beam, longest_beam;
};

/// Everything that the checks look at.
struct PreflightFacts {
    const StationConfig& config;
    MonotonicTime now;
    std::string today;                       ///< ISO date
    std::string state, control_compensation; ///< as the certificate will say
    std::vector<std::string> unavailable;    ///< instruments in use that are not there
    std::vector<std::string> in_use;         ///< names of instruments with a part to play
    std::vector<SensorFacts> sensors;        ///< of the environment
    std::vector<SensorFacts> strengths;      ///< of the length's signal; empty: it tells none
    std::optional<Duration> laser_age;       ///< of its last good reading
    std::span<const Sample> laser_samples;   ///< of a little more than the last drift_window
    Length laser_range = {};                 ///< of all its good readings within drift_window
    bool circular = false;                   ///< for circles: a ballbar in the laser's place
    std::optional<Duration> bar_age = {};    ///< of its last reading, good or not
    const SensorLog* bar = nullptr;          ///< its good readings lately, m
    bool polygon = false;                    ///< before an autocollimator, typed or read
    bool faces_read = false;                 ///< by the autocollimator itself, not typed
    std::optional<Duration> face_age = {};   ///< of its last reading, with a face in sight or not
    std::string run_out = {};                ///< of a rotary axis's set-up, as stated
    bool boot_known = true;                  ///< the kernel tells the daemon its boot id
    std::string newest_run = {}, newest_run_day = {}; ///< its ISO date; empty: none is stored
    std::optional<EveFacts> eve = {}; ///< where the station file takes E_VE from a drift test
    /// Of each instrument in use that tells one, by name: its serial number.
    std::map<std::string, std::string> serials = {};
    std::string may_sleep = {}; ///< why the computer may fall asleep in mid-run; empty: it may not
};

/// No run is of an earlier day.
inline constexpr std::string_view earliest_date = "2026-01-01";

/// How far back `laser_samples` go: a laser that is asked seldom has its last sample before the
/// window there.
inline Duration drift_reach(const PreflightConfig& config) {
    return config.drift_window * 5 / 4;
}

/// "instruments", "soak", "sensors", "contact", "strength", "drift", "expansion", "compensation",
/// "certificates", "environment", "computer", "clock", in this order, of a linear or rotary run and
/// of a circular test alike; of a rotary run also "run_out", of a linear one whose dead path is
/// stated as 0 also "dead_path", with an `eve_run` also "eve".
std::vector<PreflightRecord> judge_preflight(const PreflightFacts& facts);

/// Puts reasons on the checks that failed. One for a check that passed is not needed and not kept.
/// @errors Fault::bad_request for a name that is no check, or without a reason.
Result<void> override_checks(std::vector<PreflightRecord>& checks,
                             const std::map<std::string, std::string>& reasons);

/// Those that failed and have no reason, one sentence each; empty when the run may be armed.
std::string open_objections(const std::vector<PreflightRecord>& checks);

} // namespace axiscal
