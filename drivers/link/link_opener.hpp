#pragma once
// Opens real links: serial lines, TCP connections, USB and HID devices, CAN buses, shared Modbus
// lines. Loop-bound.

#include "drivers/link/byte_link.hpp"
#include "drivers/link/modbus_bus.hpp"
#include "drivers/link/tty_porter.hpp"
#include "drivers/link/work_thread.hpp"

#include <map>

namespace axiscal {

class RealLinkOpener final : public LinkOpener {
public:
    /// `scheduler` is borrowed and must outlive the opener; the opener must outlive its
    /// instruments' coroutines, and be destroyed before the loop (its threads are joined here).
    explicit RealLinkOpener(Scheduler& scheduler);
    ~RealLinkOpener() override;
    RealLinkOpener(const RealLinkOpener&) = delete;
    RealLinkOpener& operator=(const RealLinkOpener&) = delete;
    Task<Result<std::unique_ptr<ByteLink>>> open(const LinkSettings& settings,
                                                 MonotonicTime deadline) override;
    Task<Result<std::unique_ptr<UsbLink>>> open_usb(const LinkSettings& settings,
                                                    MonotonicTime deadline) override;
    Task<Result<std::unique_ptr<CanLink>>> open_can(const LinkSettings& settings,
                                                    MonotonicTime deadline) override;
    [[nodiscard]] ModbusBuses* modbus_buses() override { return &buses_; }

private:
    Scheduler& scheduler_;
    std::map<std::string, std::shared_ptr<TtyPorter>> porters_; ///< by path
    ModbusBuses buses_;
    WorkThreads threads_;
};

} // namespace axiscal
