// Frames of a CAN bus from a tape; its lines are told in tape_link.hpp.
#include "drivers/framing/byte_order.hpp"
#include "drivers/recording/tape_link.hpp"
#include "drivers/wire/can_link.hpp"

namespace axiscal {
namespace {

constexpr std::size_t id_bytes = 4;
constexpr std::uint32_t extended_flag = 0x80000000U, remote_flag = 0x40000000U;

std::vector<std::byte> bytes_from(const CanFrame& frame) {
    const std::uint32_t id =
        frame.id | (frame.extended ? extended_flag : 0U) | (frame.remote ? remote_flag : 0U);
    std::vector<std::byte> bytes;
    bytes.reserve(id_bytes + frame.length);
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes.push_back(static_cast<std::byte>(id >> shift & 0xFFU));
    bytes.insert(bytes.end(), frame.bytes().begin(), frame.bytes().end());
    return bytes;
}

/// @errors Fault::bad_request for a line that holds no frame.
Result<CanFrame> frame_from(std::span<const std::byte> bytes) {
    CanFrame frame;
    if (bytes.size() < id_bytes || bytes.size() > id_bytes + frame.data.size())
        return fail(Fault::bad_request, "the tape has a line that is no CAN frame");
    const std::uint32_t id = big16(bytes, 0) << 16 | big16(bytes, 2);
    frame.extended = (id & extended_flag) != 0;
    frame.remote = (id & remote_flag) != 0;
    frame.id = id & ~(extended_flag | remote_flag);
    frame.length = bytes.size() - id_bytes;
    std::ranges::copy(bytes.subspan(id_bytes), frame.data.begin());
    return frame;
}

/// One opening of the tape. Loop-bound; the player outlives its links.
class TapeCanLink final : public CanLink {
public:
    explicit TapeCanLink(TapePlayer& player)
        : player_{player} {}
    /// The tape has what was heard.
    Result<void> hear(const std::vector<std::uint32_t>& /*ids*/) override { return {}; }
    Task<Result<std::vector<TimedCanFrame>>> read_some(MonotonicTime deadline) override;
    Task<Result<void>> send(CanFrame frame, MonotonicTime /*deadline*/) override {
        co_return player_.play_out(bytes_from(frame));
    }

private:
    TapePlayer& player_;
};

Task<Result<std::vector<TimedCanFrame>>> TapeCanLink::read_some(MonotonicTime deadline) {
    AXISCAL_CO_TRY(const std::vector<TimedBytes> played, co_await player_.play_all_in(deadline));
    std::vector<TimedCanFrame> frames;
    frames.reserve(played.size());
    for (const TimedBytes& one : played) {
        AXISCAL_CO_TRY(const CanFrame frame, frame_from(one.bytes));
        frames.push_back({frame, one.read_at, 0});
    }
    co_return frames;
}

class CanRecorderLink final : public CanLink {
public:
    CanRecorderLink(std::unique_ptr<CanLink> inner,
                    Scheduler& scheduler,
                    std::ostream& tape,
                    MonotonicTime begin)
        : inner_{std::move(inner)}
        , scheduler_{scheduler}
        , tape_{tape, begin} {}
    Result<void> hear(const std::vector<std::uint32_t>& ids) override { return inner_->hear(ids); }
    Task<Result<std::vector<TimedCanFrame>>> read_some(MonotonicTime deadline) override;
    Task<Result<void>> send(CanFrame frame, MonotonicTime deadline) override;
    [[nodiscard]] std::uint64_t bus_errors() const override { return inner_->bus_errors(); }

private:
    void closed_if(const Error& error) {
        if (error.fault == Fault::link_closed)
            tape_.write(TapeEntry::Direction::closed, scheduler_.now(), {});
    }
    std::unique_ptr<CanLink> inner_;
    Scheduler& scheduler_;
    TapeWriter tape_;
};

Task<Result<std::vector<TimedCanFrame>>> CanRecorderLink::read_some(MonotonicTime deadline) {
    auto frames = co_await inner_->read_some(deadline);
    if (!frames) {
        closed_if(frames.error());
        co_return frames;
    }
    for (const TimedCanFrame& heard : *frames)
        tape_.write(TapeEntry::Direction::in, heard.at, bytes_from(heard.frame));
    co_return frames;
}

Task<Result<void>> CanRecorderLink::send(CanFrame frame, MonotonicTime deadline) {
    const MonotonicTime at = scheduler_.now();
    auto sent = co_await inner_->send(frame, deadline);
    if (sent)
        tape_.write(TapeEntry::Direction::out, at, bytes_from(frame));
    else
        closed_if(sent.error());
    co_return sent;
}

} // namespace

std::unique_ptr<CanLink> record_can(std::unique_ptr<CanLink> inner,
                                    Scheduler& scheduler,
                                    std::ostream& tape,
                                    MonotonicTime begin) {
    return std::make_unique<CanRecorderLink>(std::move(inner), scheduler, tape, begin);
}

Task<Result<std::unique_ptr<CanLink>>> TapePlayer::open_can(const LinkSettings& /*settings*/,
                                                            MonotonicTime deadline) {
    const auto begun = co_await begin_opening(deadline);
    if (!begun) co_return tl::unexpected<Error>(begun.error());
    co_return std::make_unique<TapeCanLink>(*this);
}

} // namespace axiscal
