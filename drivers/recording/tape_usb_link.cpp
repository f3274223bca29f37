// USB transfers from a tape; its lines are told in tape_link.hpp.
#include "drivers/framing/byte_order.hpp"
#include "drivers/recording/tape_link.hpp"
#include "drivers/wire/usb_link.hpp"

namespace axiscal {
namespace {

std::vector<std::byte> setup_packet(const UsbRequest& r) {
    return bytes_of({r.request_type, r.request, r.value & 0xFF, r.value >> 8, r.index & 0xFF,
                     r.index >> 8, r.length & 0xFF, r.length >> 8});
}

/// One opening of the tape. Loop-bound; the player outlives its links.
class TapeUsbLink final : public UsbLink {
public:
    TapeUsbLink(TapePlayer& player, UsbEntry entry)
        : player_{player}
        , entry_{std::move(entry)} {}
    Task<Result<TimedBytes>> control_in(UsbRequest request, MonotonicTime deadline) override;
    Task<Result<void>>
    bulk_out(int endpoint, std::vector<std::byte> bytes, MonotonicTime deadline) override;
    Task<Result<TimedBytes>>
    bulk_in(int endpoint, std::size_t longest, MonotonicTime deadline) override;
    Task<Result<TimedBytes>>
    next_packet(int endpoint, std::size_t longest, MonotonicTime deadline) override {
        return bulk_in(endpoint, longest, deadline);
    }
    [[nodiscard]] const UsbEntry& entry() const override { return entry_; }

private:
    TapePlayer& player_;
    UsbEntry entry_; ///< name and serial number as the tape's header has them
};

Task<Result<TimedBytes>> TapeUsbLink::control_in(UsbRequest request, MonotonicTime deadline) {
    const auto asked = player_.play_out(setup_packet(request));
    if (!asked) co_return tl::unexpected<Error>(asked.error());
    auto answer = co_await player_.play_in(deadline);
    co_return answer;
}

Task<Result<void>>
TapeUsbLink::bulk_out(int endpoint, std::vector<std::byte> bytes, MonotonicTime /*deadline*/) {
    bytes.insert(bytes.begin(), static_cast<std::byte>(endpoint));
    co_return player_.play_out(bytes);
}

Task<Result<TimedBytes>>
TapeUsbLink::bulk_in(int endpoint, std::size_t /*longest*/, MonotonicTime deadline) {
    auto packet = co_await player_.play_in(deadline, endpoint);
    if (!packet) co_return packet;
    packet->bytes.erase(packet->bytes.begin());
    co_return packet;
}

class UsbRecorderLink final : public UsbLink {
public:
    UsbRecorderLink(std::unique_ptr<UsbLink> inner,
                    Scheduler& scheduler,
                    std::ostream& tape,
                    MonotonicTime begin)
        : inner_{std::move(inner)}
        , scheduler_{scheduler}
        , tape_{tape, begin} {}
    Task<Result<TimedBytes>> control_in(UsbRequest request, MonotonicTime deadline) override;
    Task<Result<void>>
    bulk_out(int endpoint, std::vector<std::byte> bytes, MonotonicTime deadline) override;
    Task<Result<TimedBytes>>
    bulk_in(int endpoint, std::size_t longest, MonotonicTime deadline) override;
    Task<Result<TimedBytes>>
    next_packet(int endpoint, std::size_t longest, MonotonicTime deadline) override;
    [[nodiscard]] const UsbEntry& entry() const override { return inner_->entry(); }

private:
    void wrote(std::vector<std::byte> bytes, std::optional<int> endpoint = {});
    /// What came, or how it failed; silence leaves no line.
    void came(const Result<TimedBytes>& answer, std::optional<int> endpoint = {});

    std::unique_ptr<UsbLink> inner_;
    Scheduler& scheduler_;
    TapeWriter tape_;
};

void UsbRecorderLink::wrote(std::vector<std::byte> bytes, std::optional<int> endpoint) {
    if (endpoint) bytes.insert(bytes.begin(), static_cast<std::byte>(*endpoint));
    tape_.write(TapeEntry::Direction::out, scheduler_.now(), bytes);
}

void UsbRecorderLink::came(const Result<TimedBytes>& answer, std::optional<int> endpoint) {
    if (answer) {
        std::vector<std::byte> bytes = answer->bytes;
        if (endpoint) bytes.insert(bytes.begin(), static_cast<std::byte>(*endpoint));
        return tape_.write(TapeEntry::Direction::in, answer->read_at, bytes);
    }
    if (answer.error().fault == Fault::refused)
        tape_.write(TapeEntry::Direction::refused, scheduler_.now(), {});
    if (answer.error().fault == Fault::link_closed)
        tape_.write(TapeEntry::Direction::closed, scheduler_.now(), {});
}

Task<Result<TimedBytes>> UsbRecorderLink::control_in(UsbRequest request, MonotonicTime deadline) {
    wrote(setup_packet(request));
    auto answer = co_await inner_->control_in(request, deadline);
    came(answer);
    co_return answer;
}

Task<Result<void>>
UsbRecorderLink::bulk_out(int endpoint, std::vector<std::byte> bytes, MonotonicTime deadline) {
    const std::vector<std::byte> copy = bytes;
    auto written = co_await inner_->bulk_out(endpoint, std::move(bytes), deadline);
    if (written)
        wrote(copy, endpoint);
    else if (written.error().fault == Fault::link_closed)
        tape_.write(TapeEntry::Direction::closed, scheduler_.now(), {});
    co_return written;
}

Task<Result<TimedBytes>>
UsbRecorderLink::bulk_in(int endpoint, std::size_t longest, MonotonicTime deadline) {
    auto packet = co_await inner_->bulk_in(endpoint, longest, deadline);
    came(packet, endpoint);
    co_return packet;
}

Task<Result<TimedBytes>>
UsbRecorderLink::next_packet(int endpoint, std::size_t longest, MonotonicTime deadline) {
    auto packet = co_await inner_->next_packet(endpoint, longest, deadline);
    came(packet, endpoint);
    co_return packet;
}

} // namespace

std::unique_ptr<UsbLink> record_usb(std::unique_ptr<UsbLink> inner,
                                    Scheduler& scheduler,
                                    std::ostream& tape,
                                    MonotonicTime begin) {
    return std::make_unique<UsbRecorderLink>(std::move(inner), scheduler, tape, begin);
}

Task<Result<std::unique_ptr<UsbLink>>> TapePlayer::open_usb(const LinkSettings& /*settings*/,
                                                            MonotonicTime deadline) {
    const auto begun = co_await begin_opening(deadline);
    if (!begun) co_return tl::unexpected<Error>(begun.error());
    const auto header = [&](const char* key) {
        const auto found = tape_.header.find(key);
        return found == tape_.header.end() ? std::string{} : found->second;
    };
    UsbEntry entry;
    entry.name = header("model");
    entry.serial = header("serial");
    co_return std::make_unique<TapeUsbLink>(*this, std::move(entry));
}

} // namespace axiscal
