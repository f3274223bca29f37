#pragma once
// Recorded bytes as a link: replay under any Scheduler, and a recorder around any link.
//
// A tape is text: header lines "key = value" (maker, model, firmware, who, when, what,
// origin = device | vendor-document | simulator), then one line per transfer:
//     <direction> <offset_ns> <hex>
// with direction '<' from the instrument, '>' to it, '!' the link closed (or the recording ended),
// 'x' the device refused (STALL, or there is no such file, or it cannot be read; without hex).
// Offsets are monotonic and count from the first opening. '#' begins a comment line.
//
// USB transfers: '>' with the 8 bytes of a setup packet asks, '<' with the data answers it; of bulk
// endpoints '>' and '<' begin with the endpoint's address.
// CAN frames: four bytes of identifier, the high one first (80000000: 29 bits, 40000000:
// a remote frame, with as many bytes of 0 as it asks for), then the data.
// Files of the kernel: '>' has the file's name below their folder, '<' its text, perhaps empty.

#include "drivers/wire/byte_link.hpp"

#include <array>
#include <iosfwd>
#include <map>
#include <optional>
#include <span>
#include <string_view>

namespace axiscal {

struct TapeEntry {
    enum class Direction : char {
        in = '<',
        out = '>',
        closed = '!',
        refused = 'x'
    } direction = Direction::in;
    Duration offset{};
    std::vector<std::byte> bytes;
};

struct Tape {
    std::map<std::string, std::string> header;
    std::vector<TapeEntry> entries;
};

/// One row each. Pure.
inline constexpr std::array tape_origins{
    std::string_view{"device"}, std::string_view{"vendor-document"}, std::string_view{"simulator"}};

/// Pure. @errors Fault::bad_request naming the line: unknown direction, offsets that go back, odd
/// hex, a missing or unknown origin.
Result<Tape> parse_tape(std::string_view text);

/// Plays a tape to a driver: each opening goes on where the last link closed. A write must be the
/// one on the tape. Loop-bound; the tape is a borrowed value that must outlive the opener.
class TapePlayer final : public LinkOpener {
public:
    TapePlayer(Scheduler& scheduler, const Tape& tape);
    Task<Result<std::unique_ptr<ByteLink>>> open(const LinkSettings& settings,
                                                 MonotonicTime deadline) override;
    /// Transfers of USB are played as they are.
    Task<Result<std::unique_ptr<UsbLink>>> open_usb(const LinkSettings& settings,
                                                    MonotonicTime deadline) override;
    /// Frames of CAN are played with the time that the tape has for each.
    Task<Result<std::unique_ptr<CanLink>>> open_can(const LinkSettings& settings,
                                                    MonotonicTime deadline) override;
    [[nodiscard]] bool at_end() const { return next_ == tape_.entries.size(); }

    /// What each opening begins with. It lasts as long as it did where the driver speaks first:
    /// whoever waits for an answer then waits for it from the same instant as on the tape.
    /// An opening that only closes again is none: it is waited for.
    /// @errors Fault::link_closed at the end of the tape and after such an opening, link_timeout
    /// when its end lies beyond the deadline.
    Task<Result<void>> begin_opening(MonotonicTime deadline);
    /// What links of this player are made of: the next entry must be to, or from, the instrument.
    /// @errors Fault::link_timeout when nothing comes before the deadline, link_closed at '!' and
    /// at the end, refused at 'x'.
    /// @param endpoint  of USB bulk transfers, which wait in pipes of their own: one of another
    /// endpoint is silence here, and stays
    Task<Result<TimedBytes>> play_in(MonotonicTime deadline, std::optional<int> endpoint = {});
    /// The same where the kernel stamps and keeps: all that has come by now, at least one, each
    /// with the tape's own time.
    Task<Result<std::vector<TimedBytes>>> play_all_in(MonotonicTime deadline);
    /// @errors Fault::internal for a write that is not the one on the tape.
    Result<void> play_out(std::span<const std::byte> bytes);

private:
    Scheduler& scheduler_;
    const Tape& tape_;
    std::size_t next_ = 0;
    std::optional<MonotonicTime> begin_;
};

/// Writes transfers as the lines of a tape. The stream is borrowed. Loop-bound.
class TapeWriter {
public:
    /// `begin` is the instant of offset 0.
    TapeWriter(std::ostream& tape, MonotonicTime begin)
        : tape_{tape}
        , begin_{begin} {}
    /// What was stamped before the line above it (read ahead, off the loop) gets its offset.
    void write(TapeEntry::Direction direction, MonotonicTime at, std::span<const std::byte> bytes);

private:
    std::ostream& tape_;
    MonotonicTime begin_;
    Duration last_{};
};

/// Writes all that passes through another link to a stream, then hands it on. Loop-bound.
class TapeRecorderLink final : public ByteLink {
public:
    /// `tape` is borrowed; `begin` is the instant of offset 0.
    TapeRecorderLink(std::unique_ptr<ByteLink> inner,
                     Scheduler& scheduler,
                     std::ostream& tape,
                     MonotonicTime begin);
    Task<Result<TimedBytes>> read_some(MonotonicTime deadline) override;
    Task<Result<void>> write_all(std::vector<std::byte> bytes, MonotonicTime deadline) override;
    [[nodiscard]] Duration latency_uncertainty() const override {
        return inner_->latency_uncertainty();
    }
    [[nodiscard]] std::string remark() const override { return inner_->remark(); }

private:
    std::unique_ptr<ByteLink> inner_;
    Scheduler& scheduler_;
    TapeWriter tape_;
};

/// The same for a USB device: each transfer as tape_link.hpp tells it, 'x' where the device
/// refuses.
std::unique_ptr<UsbLink> record_usb(std::unique_ptr<UsbLink> inner,
                                    Scheduler& scheduler,
                                    std::ostream& tape,
                                    MonotonicTime begin);
/// The same for frames of a CAN bus, in and out.
std::unique_ptr<CanLink> record_can(std::unique_ptr<CanLink> inner,
                                    Scheduler& scheduler,
                                    std::ostream& tape,
                                    MonotonicTime begin);

} // namespace axiscal
