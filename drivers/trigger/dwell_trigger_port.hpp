#pragma once
// Trigger without a wire: the axis halts at the next target, and that is the request. For CNCs and
// 3D printers without Modbus. Loop-bound.

#include "config/station_config.hpp"
#include "drivers/trigger/dwell_detector.hpp"
#include "drivers/trigger/trigger_port.hpp"

namespace axiscal {

/// Nobody reads `done` here; it says which number the next request bears. Abort and end come from
/// the operator.
class DwellTriggerPort final : public TriggerPort {
public:
    explicit DwellTriggerPort(const TriggerConfig& config);
    Task<Result<void>> run(TriggerContext context) override;
    void publish_armed() override;
    void acknowledge(const JournalReceipt& receipt) override;
    /// not_still, environment_stale and environment_outside are tried again at the same halt; after
    /// other faults the axis must leave the window and come back. The number is not used up.
    void refuse(std::uint16_t sequence, Fault fault) override;
    /// Listens to next_target and next_nominal_mm.
    void publish(const PortStatus& status) override;
    void position(MonotonicTime at, double position_mm) override;
    [[nodiscard]] std::string describe() const override;

private:
    TriggerConfig config_;
    DwellDetector detector_;
    PortStatus status_;
    TriggerContext context_;
    std::uint16_t done_ = 0;
};

} // namespace axiscal
