#pragma once
// May an open run go on after a restart of the daemon? Pure.

#include "analysis/record/run_record.hpp"
#include "analysis/record/skipped_step.hpp"
#include "drivers/sample.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

enum class ResumeDecision : std::uint8_t {
    wait_for_request,     ///< resumable; the CNC has not spoken yet, or is idle before request 1
    republish_done,       ///< request = last durable
    capture_standing,     ///< request = last durable + 1
    close_sequence_lost,  ///< any other request
    close_config_changed, ///< the station file is not the run's
    close_other_instrument,
    close_never_armed, ///< the daemon, or the computer, ended before the datum was tied
    close_datum_lost,
    close_environment ///< the air or the machine is outside the station's limits
};

struct ResumeVerdict {
    ResumeDecision decision = ResumeDecision::wait_for_request;
    Fault fault = Fault::none; ///< of the closing ones
    std::string sentence;      ///< goes on the record either way
};

/// One reading of the laser with the laser's own number of it.
struct CounterSighting {
    MonotonicTime at;
    Length reading;
    std::uint64_t device_count = 0;
};

struct ContinuityLimits {
    double rate_hz = 0;       ///< the laser's own; counting_rate_hz() or the driver's nominal
    double rate_share = 0.01; ///< uncertainty of the rate
    Duration stamp_slack = std::chrono::milliseconds{500}; ///< bytes that waited in the USB buffer
    std::uint64_t count_modulus = 0; ///< 0: the number does not wrap (65536 for the 16-bit one)
    Speed fastest;                   ///< of the axis; 0: the jump is not judged
};

struct ContinuityVerdict {
    bool continues = false;
    std::string reason; ///< one sentence, with the numbers
};

/// What the run file last saw of the laser: the datum or the newest sample of the last point.
std::optional<CounterSighting> last_sighting(const RunRecord& run);

/// Samples a second between the first and the last sighting; none when they are too near each
/// other (10 s) to tell.
std::optional<double> counting_rate_hz(const RunRecord& run);

/// The same from readings alone, for a run too young to tell; none below one second.
std::optional<double> counting_rate_hz(std::span<const Sample> samples);

/// When the run file was last written to.
MonotonicTime last_sign_of_life(const RunRecord& run);

/// An interferometer is incremental: its zero survives a restart of the daemon only if its counter
/// is proven to have run on. The laser's own number must have advanced by elapsed time x rate (a
/// counter that was switched off starts from 1 again), and the axis cannot have moved faster than
/// it can. Not provable (no number, number too young, wrapped) is lost. What can pass unseen: a
/// beam that was broken while the daemon was away. A heterodyne counter then runs off by 0.5 mm
/// each millisecond, which the near check of the next point finds; a homodyne one loses the travel
/// made meanwhile, found only if it exceeds the near tolerance. The interruption is therefore
/// recorded.
/// @param reference  "laser" | "scale", for the sentence
ContinuityVerdict datum_continues(const CounterSighting& last_before,
                                  const Sample& first_after,
                                  const ContinuityLimits& limits,
                                  std::string_view reference = "laser");

/// What an instrument says of itself after the restart.
struct InstrumentSerial {
    std::string name, serial;
};

/// One sentence with the first instrument that is not the run's any more, its serial number and the
/// run's; empty when there is none. A serial number that nobody told, then or now, proves nothing.
std::string exchanged_instrument(const RunRecord& run, const std::vector<InstrumentSerial>& now);

/// The station as it is after the restart.
struct StationNow {
    std::string config_hash;
    BootId boot_id;
    std::string laser_serial;
    std::optional<Sample> laser;  ///< first good sample; none: the laser is silent
    ContinuityLimits limits;      ///< rate_hz 0: taken from the run
    std::string outside_limits{}; ///< of the environment, in words; empty: nothing is
    std::vector<InstrumentSerial> instruments{}; ///< of the run, that have answered
};

/// The newest record that a request of the CNC made durable: point, datum by prepare (step -1),
/// skip. Sequence 0: there is none.
struct DurableRequest {
    std::uint16_t sequence = 0;
    int step = -1;
};
DurableRequest last_durable_request(const RunRecord& run);

/// The request alone, the rest being in order. `request` empty: nothing seen yet.
ResumeVerdict judge_first_request(std::uint16_t last_durable, std::optional<std::uint16_t> request);

/// Everything: configuration, instruments, datum, environment, then the request. A run whose datum
/// the CNC is to tie has none to lose; one whose datum a person was tying has to be armed again.
ResumeVerdict
decide_resume(const RunRecord& run, std::optional<std::uint16_t> request, const StationNow& now);

} // namespace axiscal
