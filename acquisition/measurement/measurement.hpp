#pragma once
// One test, from its run file to its certificate: what the station asks of it, whatever its kind.

#include "acquisition/live/station_interface.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/run_revisions.hpp"
#include "config/station_config.hpp"
#include "drivers/loop/scheduler.hpp"
#include "drivers/sample.hpp"
#include "drivers/trigger/trigger_port.hpp"

#include <cstddef>
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
class Revisable;
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
    /// In place of begin(), of one that an earlier daemon left open. The port is not open yet.
    /// @errors what could not be read or written. It records all the same.
    virtual Task<Result<void>> go_on();
    /// Of every channel of the station.
    virtual void on_sample(const Sample& sample) = 0;
    /// Of a CNC. @returns whether it is a request of this test, which answers it; of any other the
    /// CNC is told that no run takes it. A test without a CNC has none.
    virtual bool on_trigger(const TriggerEvent& event);
    /// Ten times a second while something can change by time alone, also when it is closed.
    virtual void on_time(MonotonicTime now);
    /// A person does what the CNC would ask for next. @errors why it is refused.
    virtual Result<void> trigger();
    /// A person read the autocollimator. @errors as StationInterface::type_reading.
    virtual Result<void> type_reading(double seconds_of_arc);
    /// Once a second: one that goes on after a restart ends where an instrument was exchanged.
    virtual void judge_instruments();
    /// What is no full block yet goes into the file with what is written next.
    virtual void keep_rest();
    /// One attempt after the disk failed. @param since  when that was seen
    /// @errors why the file cannot be written yet.
    virtual Task<Result<void>> on_disk_back(MonotonicTime since);
    /// Ends it early; returns when it is closed. Whoever waits for that holds the test meanwhile.
    /// @errors as StationInterface::abort; Fault::busy or no_run_armed where it is not open, or is
    /// being closed already.
    virtual Task<Result<RunEnding>> abort(std::string reason, Orderer by) = 0;

    /// Its closing row is on disk.
    [[nodiscard]] virtual bool is_written() const { return run().is_written(); }
    /// Ended as incomplete, and a CNC may stand at a request of it; also while it is being closed.
    [[nodiscard]] virtual bool broken_off() const { return false; }
    /// Of its certificate, where it is made outside the test.
    virtual void keep_certificate(const Result<std::string>& entry);
    /// As something that a person may add to. @errors why nobody can.
    virtual Result<std::shared_ptr<Revisable>> to_be_added_to();

    /// Where the axis stands by the datum of this test, while that holds.
    [[nodiscard]] virtual std::optional<Length> place_now() const { return std::nullopt; }
    /// At most `most` stretches; none of a test that records no stream.
    [[nodiscard]] virtual std::optional<StreamView> stream(std::size_t most) const;
    /// Without the first `from`; none of a test that takes no points.
    [[nodiscard]] virtual PointsView points(std::size_t from) const;
    virtual void put_on_status(StationStatus& shown) const = 0;
    /// @param axis  with all that needs no test. @param reading  of what measures it, now
    virtual void put_on_axis(AxisView& axis, Length reading) const;
    /// @param status  with its state
    virtual void put_on_port(PortStatus& status) const;

    /// Its file is open, or on the way to being closed.
    [[nodiscard]] bool is_open() const { return run().stage != RunState::Stage::closed; }
};

/// An order of a person, given now. @param about  as OrderRecord::about
inline OrderRecord
order_now(const Scheduler& scheduler, std::string kind, const Orderer& by, std::string about = {}) {
    return {std::move(kind), std::move(about), scheduler.now(), scheduler.clock_tie().utc_ns, by};
}

} // namespace axiscal
