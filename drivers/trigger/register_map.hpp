#pragma once
// What a CNC sees of us as Modbus registers, one shape a trigger port (docs/trigger.md). Pure: no
// socket, no clock, no library; time comes with each call.

#include "config/station_config.hpp"
#include "drivers/trigger/modbus_request.hpp"
#include "drivers/trigger/trigger_port.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace axiscal {

/// Which addresses a shape has, each table from address 0. A plain value: every thread may ask.
struct AddressSpace {
    int coils = 0, discrete_inputs = 0, holding = 0, input = 0;
    int writable_holding = 0; ///< holding words below it are the CNC's; the others only read
    /// none, illegal_function where the shape has no such table, illegal_address elsewhere.
    [[nodiscard]] ModbusException check(const ModbusRequest& request) const;
};

inline constexpr int largest_table = 33;

/// The readable content at one moment. A plain value: it may be handed to another thread.
struct RegisterImage {
    AddressSpace space;
    std::array<std::uint8_t, 1> coils{}, discrete_inputs{};
    std::array<std::uint16_t, largest_table> holding{}, input{};
    bool beats = false; ///< has a DAEMON_HEARTBEAT word
    /// Fills in what depends on the moment of reading: DAEMON_HEARTBEAT, +1 each 100 ms.
    void stamp(MonotonicTime now);
};

/// What follows from a write or from time passing.
struct MapNews {
    std::vector<TriggerEvent> events;
    std::vector<std::pair<Fault, std::string>> notes;
    std::optional<bool> silent; ///< the CNC's heartbeat stopped (true) or is heard again
    int late_indices = 0;       ///< coil-and-index: the index came after its coil
};

class RegisterMap {
public:
    virtual ~RegisterMap() = default;
    [[nodiscard]] virtual AddressSpace space() const = 0;
    [[nodiscard]] virtual RegisterImage image() const = 0;
    /// Takes a write that space().check() allowed. A repeated value is no edge. The first request
    /// seen since the start is reported as `standing`, unless a run was armed before.
    virtual MapNews write(const ModbusRequest& request, MonotonicTime at) = 0;
    /// Decides what only time can decide; to be called at due(), a little late does no harm.
    virtual MapNews tick(MonotonicTime now) = 0;
    /// As things stand, tick() has something to decide from then on; empty: nothing ever.
    [[nodiscard]] virtual std::optional<MonotonicTime> due() const { return std::nullopt; }
    virtual void arm() = 0;
    /// No run takes requests any more.
    virtual void end_run(RunEnd end) = 0;
    virtual void refuse(std::uint16_t sequence, Fault fault) = 0;
    virtual void show(const PortStatus& status) = 0;

protected:
    friend class TriggerServer; // the one way to `finish` leads through a JournalReceipt
    virtual void finish(std::uint16_t sequence) = 0;
    /// Finished without a point, where the shape can say so.
    virtual void finish_skip(std::uint16_t sequence) { finish(sequence); }
};

/// sequence_block, single_register or coil_and_index; null for dwell, which has no registers.
std::unique_ptr<RegisterMap> make_register_map(const TriggerConfig& config);

} // namespace axiscal
