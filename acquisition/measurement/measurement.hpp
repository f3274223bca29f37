#pragma once
// One test, from its run file to its certificate: what the station asks of it, whatever its kind.

#include "acquisition/live/station_interface.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/run_revisions.hpp"
#include "config/station_config.hpp"
#include "drivers/loop/scheduler.hpp"
#include "drivers/sample.hpp"
#include "drivers/trigger/trigger_port.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace axiscal {

class Certificates;
class Journal;
class LiveReadings;
class Notices;
class RunFileCloser;

/// What a test works with. All of it lives longer than the tasks of any test.
struct MeasurementContext {
    Scheduler& scheduler;
    Journal& journal;
    Notices& notices;
    const LiveReadings& readings;
    const StationConfig& config;
    RunFileCloser& files;
    Certificates& certificates;
    const bool& stopping; ///< the daemon is about to end: an open file stays open
};

/// How far a test has come.
struct RunState {
    /// closing: nothing more is recorded, and its file is not closed yet.
    enum class Stage : std::uint8_t { open, closing, closed };
    std::string run_id, path;
    Stage stage = Stage::open;
    bool complete = false;              ///< closed with all that was planned
    std::string reason;                 ///< why it was closed, once it is
    Fault fault = Fault::none;          ///< of the reason, where something failed
    std::optional<Error> closing_error; ///< why its file could not be closed
    std::string certificate;            ///< folder, once it is made
    std::optional<Error> no_certificate;
    /// Closed, and its closing row is on disk.
    [[nodiscard]] bool is_written() const { return stage == Stage::closed && !closing_error; }
};

/// Loop-bound. The next test may take its place while its certificate is made, or while somebody
/// waits for its end: its tasks keep it alive, so it is made by std::make_shared.
class Measurement : public std::enable_shared_from_this<Measurement> {
public:
    Measurement() = default;
    virtual ~Measurement() = default;
    Measurement(const Measurement&) = delete;
    Measurement& operator=(const Measurement&) = delete;

    [[nodiscard]] virtual const RunState& run() const = 0;
    /// Records from now on, into the file that the journal has open. Once.
    virtual void begin(const Orderer& by) = 0;
    /// Of every channel of the station.
    virtual void on_sample(const Sample& sample) = 0;
    /// Of a CNC. @returns whether it is a request of this test, which answers it; of any other the
    /// CNC is told that no run takes it. A test without a CNC has none.
    virtual bool on_trigger(const TriggerEvent& event);
    /// Ends it early; returns when it is closed. Whoever waits for that holds the test meanwhile.
    /// @errors as StationInterface::abort; Fault::busy or no_run_armed where it is not open, or is
    /// being closed already.
    virtual Task<Result<RunEnding>> abort(std::string reason, Orderer by) = 0;

    /// Its file is open, or on the way to being closed.
    [[nodiscard]] bool is_open() const { return run().stage != RunState::Stage::closed; }
};

inline bool Measurement::on_trigger(const TriggerEvent& /*event*/) {
    return false;
}

/// An order of a person, given now. @param about  as OrderRecord::about
inline OrderRecord
order_now(const Scheduler& scheduler, std::string kind, const Orderer& by, std::string about = {}) {
    return {std::move(kind), std::move(about), scheduler.now(), scheduler.clock_tie().utc_ns, by};
}

} // namespace axiscal
