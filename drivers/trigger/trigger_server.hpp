#pragma once
// Where a register map meets the station: the one place that may set `done`, and only against a
// receipt. Loop-bound; shared by a port and its connections, which may outlive the port by a turn
// of the loop.

#include "drivers/loop/doorbell.hpp"
#include "drivers/trigger/register_map.hpp"

#include <functional>
#include <memory>
#include <optional>

namespace axiscal {

class TriggerServer {
public:
    explicit TriggerServer(std::unique_ptr<RegisterMap> map)
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
    void acknowledge_skip(const JournalReceipt& receipt);
    void end_run(RunEnd end);
    /// For a reader on another thread: on_change is called with what is shown now.
    void look() const;
    void refuse(std::uint16_t sequence, Fault fault);
    void publish(const PortStatus& status);
    /// Lets the map decide what only time decides, and sleeps while there is nothing; until
    /// cancelled.
    Task<void> keep_time(Scheduler* scheduler);

    PortCounters counters;
    std::function<void()> on_change; ///< the image may have changed; called on the loop

private:
    void deliver(MapNews news);
    void changed() const;

    std::unique_ptr<RegisterMap> map_;
    TriggerContext context_;
    std::weak_ptr<Doorbell> bell_;          ///< of keep_time()
    std::optional<MonotonicTime> wakes_at_; ///< keep_time(), by itself
};

/// What all ports with a register map share. Loop-bound.
class MappedPort : public TriggerPort {
public:
    void publish_armed() override { server_->arm(); }
    void acknowledge(const JournalReceipt& receipt) override { server_->acknowledge(receipt); }
    void acknowledge_skip(const JournalReceipt& receipt) override {
        server_->acknowledge_skip(receipt);
    }
    void publish_no_run(RunEnd end) override { server_->end_run(end); }
    void refuse(std::uint16_t sequence, Fault fault) override { server_->refuse(sequence, fault); }
    void publish(const PortStatus& status) override { server_->publish(status); }
    [[nodiscard]] PortCounters counters() const override { return server_->counters; }

protected:
    MappedPort(std::unique_ptr<RegisterMap> map, TriggerConfig config)
        : config_{std::move(config)}
        , server_{std::make_shared<TriggerServer>(std::move(map))} {}

    TriggerConfig config_;
    std::shared_ptr<TriggerServer> server_; ///< shared with connections and threads
};

/// "sequence-block", as the station file says it.
std::string_view shape_name(TriggerShape shape);

} // namespace axiscal
