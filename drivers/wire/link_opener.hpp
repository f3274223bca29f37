#pragma once
// Opens real links: serial lines, TCP connections, USB and HID devices, CAN buses, the kernel's
// counters and files, shared Modbus lines. Loop-bound.

#include "drivers/loop/work_thread.hpp"
#include "drivers/wire/arrival.hpp"
#include "drivers/wire/file_link.hpp"
#include "drivers/wire/modbus_bus.hpp"
#include "drivers/wire/serial_opener.hpp"

#include <map>

namespace axiscal {

class RealLinkOpener final : public LinkOpener, public PlugListener {
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
    /// Hears of serial lines and USB devices; a network says nothing of who comes.
    Task<bool>
    worth_another_try(Scheduler& scheduler, LinkSettings settings, RetryTimes times) override;
    [[nodiscard]] ModbusBuses* modbus_buses() override { return &buses_; }

private:
    Scheduler& scheduler_;
    std::map<std::string, std::shared_ptr<SerialOpener>> serial_openers_; ///< by path
    ModbusBuses buses_;
    FileLinks files_;
    WorkThreads threads_;
};

} // namespace axiscal
