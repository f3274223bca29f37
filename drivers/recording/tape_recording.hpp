#pragma once
// Records whatever an instrument opens: serial and TCP links, HID reports, USB transfers, CAN
// frames, Modbus lines, records of a counter, files of the kernel. Loop-bound.

#include "drivers/recording/tape_link.hpp"
#include "drivers/wire/modbus_bus.hpp"

#include <iosfwd>
#include <memory>
#include <string_view>

namespace axiscal {

/// Opens by another opener and writes all that passes to a stream, as the lines of a tape; offset 0
/// is the first opening. `scheduler`, `inner` and `tape` are borrowed and must outlive the opener,
/// and it the instrument's coroutines.
class RecordingOpener final : public LinkOpener {
public:
    RecordingOpener(Scheduler& scheduler, LinkOpener& inner, std::ostream& tape);
    RecordingOpener(const RecordingOpener&) = delete;
    RecordingOpener& operator=(const RecordingOpener&) = delete;

    Task<Result<std::unique_ptr<ByteLink>>> open(const LinkSettings& settings,
                                                 MonotonicTime deadline) override;
    Task<Result<std::unique_ptr<UsbLink>>> open_usb(const LinkSettings& settings,
                                                    MonotonicTime deadline) override;
    Task<Result<std::unique_ptr<CanLink>>> open_can(const LinkSettings& settings,
                                                    MonotonicTime deadline) override;
    [[nodiscard]] ModbusBuses* modbus_buses() override { return &buses_; }
    /// What was opened last: "serial", "tcp", "usb", "hid", "can", "counter" or "files"; empty
    /// before.
    [[nodiscard]] std::string_view wire() const { return wire_; }
    /// Closes the wire on the tape, once, now: whoever plays it knows that until here nothing more
    /// came. Does nothing before the first opening.
    void end();

private:
    MonotonicTime begin();

    Scheduler& scheduler_;
    LinkOpener& inner_;
    std::ostream& tape_;
    std::optional<MonotonicTime> begin_;
    std::string_view wire_;
    ModbusBuses buses_;
};

} // namespace axiscal
