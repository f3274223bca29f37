#pragma once
// Opens instruments, restarts them with back-off and judges them by what they send. Loop-bound.

#include "config/instrument_config.hpp"
#include "drivers/instrument.hpp"
#include "drivers/loop/scheduler.hpp"
#include "drivers/recording/tape_link.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// unavailable: no connection, or nothing arrives. faulty: connected, but no good value.
enum class InstrumentState : std::uint8_t { unavailable, available, faulty };
std::string_view name_of(InstrumentState state);

/// One channel of the whole station, numbered from 0 over all instruments.
struct StationChannel {
    int id = 0;
    int instrument = 0; ///< index
    std::string name;   ///< the driver's, by which the station file speaks of it
    std::string shown;  ///< on certificate and screens; the driver's where none is configured
    std::string instrument_name, place;
    ChannelKind kind = ChannelKind::temperature;
    Medium medium = Medium::none;
    double correction = 0;
    ChannelCalibration calibration; ///< its table of corrections is applied as `correction` is
    [[nodiscard]] bool certified() const; ///< the station file states a certificate of this channel
};

/// The channels of one instrument as this station uses them, numbered from `first_id`.
std::vector<StationChannel> station_channels(const InstrumentConfig& config,
                                             const Instrument& instrument,
                                             int index,
                                             int first_id);

struct InstrumentView {
    std::string name, driver;
    std::string tape;   ///< full path of what is played in place of its link; empty: an instrument
    std::string due_on; ///< ISO date of its certificate, the last day that counts; empty: none
    InstrumentState state = InstrumentState::unavailable;
    MonotonicTime since;
    std::int64_t since_utc_ns = 0; ///< the same by the wall clock of that moment; 0: not known
    Identity identity;
    InstrumentCounters counters;
    std::uint64_t restarts = 0;
    Fault last_fault = Fault::none;
    std::string last_note;
    std::uint64_t repeats = 0; ///< notes that came since and were not told
};

/// "unavailable", "available", "faulty"; "tape" for what would be available, but is a tape's. Pure.
std::string_view shown_state(const InstrumentView& view);

class SupervisorListener {
public:
    virtual ~SupervisorListener() = default;
    /// `sample.channel` is the station's channel id; the channel's correction is already added.
    virtual void on_sample(const Sample& sample) = 0;
    /// The state changed; at most a few times a second, for a restart waits.
    virtual void on_instrument_state(const InstrumentView& view) = 0;
    /// Something new to tell. What was told last, and what comes within two seconds of it, is only
    /// counted: an instrument that floods must not drown the others. What goes on is told then. Of
    /// one outage its reason is told at once, another one when two tries in a row ended with it.
    virtual void on_instrument_note(const InstrumentView& view) = 0;
};

class Supervisor {
public:
    Supervisor(Scheduler& scheduler, LinkOpener& links, SupervisorListener& listener);
    ~Supervisor();
    Supervisor(const Supervisor&) = delete;
    Supervisor& operator=(const Supervisor&) = delete;

    /// The configuration was checked against the driver (make_instruments).
    /// @param tape  played to the driver in place of its link, once, from the first opening on
    void add(const InstrumentConfig& config,
             std::unique_ptr<Instrument> instrument,
             std::optional<Tape> tape = {});
    /// Spawns one task an instrument; each runs until the loop stops, for good.
    void start();
    /// Without a good value for ten seconds an instrument is faulty when it still sends something,
    /// else unavailable. Call it every second.
    void judge();
    /// Some instrument is available or faulty.
    [[nodiscard]] bool somebody_speaks() const;

    [[nodiscard]] const std::vector<StationChannel>& channels() const { return channels_; }
    [[nodiscard]] const StationChannel& channel(int id) const {
        return channels_[static_cast<std::size_t>(id)];
    }
    [[nodiscard]] std::vector<InstrumentView> view() const;
    [[nodiscard]] const Instrument& instrument(int index) const;
    [[nodiscard]] const Identity& identity(int index) const;

private:
    struct Seat;
    Task<Result<void>> run_once(Seat& seat);
    Task<void> keep_running(Seat& seat);
    /// @returns it was plugged in meanwhile
    Task<bool> pause_after(const Seat& seat, Duration pause);
    void set_state(Seat& seat, InstrumentState state);

    Scheduler& scheduler_;
    LinkOpener& links_;
    SupervisorListener& listener_;
    std::vector<StationChannel> channels_;
    std::vector<std::unique_ptr<Seat>> seats_;
};

} // namespace axiscal
