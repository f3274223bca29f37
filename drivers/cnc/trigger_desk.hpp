#pragma once
// Where a register map meets the station: the one place that may set `done`, and only against a
// receipt. Loop-bound; shared by a port and its connections, which may outlive the port by a turn
// of the loop.

#include "drivers/cnc/register_map.hpp"

#include <functional>

namespace axiscal {

/// Counted, never silent.
struct PortCounters {
    std::uint64_t requests = 0;     ///< answered, exceptions included
    std::uint64_t exceptions = 0;   ///< of these, refused by the map or the protocol
    std::uint64_t refused = 0;      ///< clients beyond the limit
    std::uint64_t hung_up = 0;      ///< clients cut off: garbage, silence in a frame, not reading
    std::uint64_t reconnects = 0;   ///< lines opened again after an error
    std::uint64_t torn_reads = 0;   ///< mirrored: the block changed between its two readings
    std::uint64_t overtaken = 0;    ///< RTU: something followed the request, so nobody was answered
    std::uint64_t late_indices = 0; ///< coil-and-index: the index came after its coil
};

class TriggerDesk {
public:
    explicit TriggerDesk(std::unique_ptr<RegisterMap> map)
        : map_{std::move(map)} {}

    void attach(const TriggerContext& context) { context_ = context; }
    void detach() { context_ = {}; }
    [[nodiscard]] bool attached() const { return context_.sink != nullptr; }

    [[nodiscard]] AddressSpace space() const { return map_->space(); }
    /// Stamped with the moment.
    [[nodiscard]] RegisterImage image(MonotonicTime now) const;
    void write(const ModbusRequest& request, MonotonicTime at);
    void note(Fault fault, std::string sentence);
    void arm();
    void acknowledge(const JournalReceipt& receipt);
    void refuse(std::uint16_t sequence, Fault fault);
    void publish(const PortStatus& status);
    /// Lets the map decide what only time decides; until cancelled.
    Task<void> keep_time(Scheduler* scheduler);

    PortCounters counters;
    std::function<void()> on_change; ///< the image may have changed; called on the loop

private:
    void deliver(MapNews news);
    void changed() const;

    std::unique_ptr<RegisterMap> map_;
    TriggerContext context_;
};

/// What all ports with a register map share. Loop-bound.
class MappedPort : public TriggerPort {
public:
    void publish_armed() override { desk_->arm(); }
    void acknowledge(const JournalReceipt& receipt) override { desk_->acknowledge(receipt); }
    void refuse(std::uint16_t sequence, Fault fault) override { desk_->refuse(sequence, fault); }
    void publish(const PortStatus& status) override { desk_->publish(status); }
    [[nodiscard]] const PortCounters& counters() const { return desk_->counters; }

protected:
    MappedPort(std::unique_ptr<RegisterMap> map, TriggerConfig config)
        : config_{std::move(config)}
        , desk_{std::make_shared<TriggerDesk>(std::move(map))} {}

    TriggerConfig config_;
    std::shared_ptr<TriggerDesk> desk_; ///< shared with connections and threads
};

/// "sequence-block", as the station file says it.
std::string_view shape_name(TriggerShape shape);

} // namespace axiscal
