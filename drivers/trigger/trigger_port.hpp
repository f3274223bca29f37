#pragma once
// The CNC's side of the handshake: requests come in, `done` goes out against a receipt. Loop-bound.

#include "analysis/record/run_record.hpp"
#include "drivers/trigger/journal_receipt.hpp"
#include "drivers/loop/scheduler.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace axiscal {

/// Requests run from 1 to this; 0 is the idle number.
inline constexpr std::uint16_t last_sequence = 65534;
/// What `done` shows while no run takes requests: before the first `arm`, and after a run that was
/// not completed. It is no number of a request, so no program goes on with it.
inline constexpr std::uint16_t no_run_sequence = 65535;

/// The last number is followed by 1.
constexpr std::uint16_t next_sequence(std::uint16_t sequence) {
    return sequence >= last_sequence ? std::uint16_t{1} : static_cast<std::uint16_t>(sequence + 1);
}

/// When `done` becomes no_run_sequence.
enum class RunEnd : std::uint8_t {
    at_once,
    once_answered ///< the CNC ended the run itself: its answer stands until it writes another number
};

enum class TriggerCommand : std::uint8_t { prepare, capture, skip, abort, end };

/// One edge of the CNC's request. A repeated sequence number is delivered again: the station
/// decides what it means.
struct TriggerEvent {
    TriggerCommand command = TriggerCommand::capture;
    std::uint16_t sequence = 0;
    MonotonicTime at;
    TriggerOrigin origin = TriggerOrigin::cnc;
    std::optional<int> target_index; ///< 0-based, where the shape carries it
    std::optional<Direction> direction;
    std::optional<std::int32_t> nominal_counts; ///< 0.1 um, or 1e-5 degree on a rotary axis
    std::optional<int> run_index;
    /// The request stood there when the port was opened (daemon restart), no edge was seen.
    bool standing = false;
};

class TriggerSink {
public:
    virtual ~TriggerSink() = default;
    virtual void on_trigger(const TriggerEvent& event) = 0;
    virtual void on_cnc_silent(bool silent) = 0; ///< heartbeat frozen > 2 s, or heard again
    virtual void on_port_note(Fault fault, std::string sentence) = 0;
};

/// STATE word of the sequence-block.
enum class PortState : std::uint16_t {
    offline = 0,
    idle = 1,
    armed = 2,
    settling = 3,
    captured = 4,
    error = 5,
    hold = 6
};

/// Everything the CNC may read besides `done`; an absent value is published as a number that no
/// value has (docs/trigger.md).
struct PortStatus {
    PortState state = PortState::idle;
    std::optional<double> measured_mm, deviation_um, next_nominal_mm;
    std::optional<int> next_target;
    std::optional<double> air_degC, pressure_Pa, humidity_percent, material_degC;
    bool may_move = true, feed_hold = false, run_complete = false;
    /// The run was closed as incomplete, and not by the CNC's own request: a program that stands at
    /// a request is to hold.
    bool run_broken_off = false;
    AxisKind axis_kind = AxisKind::linear;
};

/// Counted, never silent.
struct PortCounters {
    std::uint64_t requests = 0;     ///< answered, exceptions included
    std::uint64_t exceptions = 0;   ///< of these, refused by the map or the protocol
    std::uint64_t refused = 0;      ///< idle clients that had to make room for another
    std::uint64_t strangers = 0;    ///< clients that the allow-list does not name
    std::uint64_t hung_up = 0;      ///< clients cut off: garbage, silence in a frame, not reading
    std::uint64_t reconnects = 0;   ///< lines opened again after an error
    std::uint64_t torn_reads = 0;   ///< mirrored: the block changed between its two readings
    std::uint64_t overtaken = 0;    ///< RTU: something followed the request, so nobody was answered
    std::uint64_t late_indices = 0; ///< coil-and-index: the index came after its coil
};

struct TriggerContext {
    Scheduler* scheduler = nullptr;
    TriggerSink* sink = nullptr;
};

class TriggerPort {
public:
    virtual ~TriggerPort() = default;
    /// Serves until cancelled; returns only with the error that ended it.
    virtual Task<Result<void>> run(TriggerContext context) = 0;
    /// A new run: done = 0, RESULT = 0, FAULT_SEQ = 0; the next request counts from here.
    virtual void publish_armed() = 0;
    /// done = the receipt's sequence.
    virtual void acknowledge(const JournalReceipt& receipt) = 0;
    /// The same of a skip: where the shape has a RESULT, it says that there is no point.
    virtual void acknowledge_skip(const JournalReceipt& receipt) { acknowledge(receipt); }
    /// No run takes requests: done = no_run_sequence.
    virtual void publish_no_run(RunEnd end);
    /// done stays; sequence-block shows RESULT and FAULT_SEQ, other shapes hold until their
    /// time-out.
    virtual void refuse(std::uint16_t sequence, Fault fault) = 0;
    virtual void publish(const PortStatus& status) = 0;
    /// The axis position as it is read, fed by the station; only the dwell port listens.
    virtual void position(MonotonicTime at, double position_mm);
    [[nodiscard]] virtual PortCounters counters() const { return {}; }
    [[nodiscard]] virtual std::string
    describe() const = 0; ///< "sequence-block, Modbus TCP 127.0.0.1:1502"
};

inline void TriggerPort::publish_no_run(RunEnd /*end*/) {}
inline void TriggerPort::position(MonotonicTime /*at*/, double /*position_mm*/) {}

} // namespace axiscal
