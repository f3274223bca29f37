#include "drivers/recording/tape_wire.hpp"

#include <algorithm>

namespace axiscal {
namespace {

using Direction = TapeEntry::Direction;

constexpr Duration very_long = std::chrono::hours{24};  // nobody may have opened the wire yet
constexpr Duration patience = std::chrono::seconds{30}; // to take what is played

std::string hex_of(std::span<const std::byte> bytes) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (const std::byte byte : bytes) {
        text += digits[std::to_integer<std::size_t>(byte >> 4)];
        text += digits[std::to_integer<std::size_t>(byte & std::byte{15})];
    }
    return text;
}

/// One opening of the wire.
class Playing {
public:
    Playing(Scheduler& scheduler, ByteLink& link, TapePace pace, Duration first)
        : scheduler_{scheduler}
        , link_{link}
        , pace_{pace}
        , zero_{scheduler.now() - first} {}

    Task<Result<void>> in(const TapeEntry& entry) {
        if (!pace_.fast) co_await scheduler_.sleep_until(zero_ + entry.offset);
        std::vector<std::byte> bytes = entry.bytes;
        auto written = co_await link_.write_all(std::move(bytes), scheduler_.now() + patience);
        co_return written;
    }
    /// Bytes count, not the pieces in which they come.
    Task<Result<void>> out(const TapeEntry& entry) {
        const auto& wanted = entry.bytes;
        while (heard_.size() < wanted.size()) {
            auto some = co_await link_.read_some(scheduler_.now() + very_long);
            if (!some) co_return tl::unexpected<Error>(std::move(some).error());
            heard_.insert(heard_.end(), some->bytes.begin(), some->bytes.end());
        }
        const std::span<const std::byte> said{heard_.data(), wanted.size()};
        if (!std::ranges::equal(said, wanted))
            co_return fail(Fault::refused,
                           "it writes " + hex_of(said) + ", on the tape is " + hex_of(wanted));
        heard_.erase(heard_.begin(), heard_.begin() + static_cast<std::ptrdiff_t>(wanted.size()));
        zero_ = scheduler_.now() - entry.offset;
        co_return Result<void>{};
    }

private:
    Scheduler& scheduler_;
    ByteLink& link_;
    TapePace pace_;
    MonotonicTime zero_; ///< when offset 0 would have been
    std::vector<std::byte> heard_;
};

/// As far as this opening goes. `next` is moved on.
Task<Result<void>> play_opening(Playing& playing, const Tape& tape, std::size_t& next) {
    for (; next < tape.entries.size(); ++next) {
        const TapeEntry& entry = tape.entries[next];
        if (entry.direction == Direction::closed) break;
        if (entry.direction == Direction::refused) continue; // only USB devices do that
        Task<Result<void>> transfer =
            entry.direction == Direction::in ? playing.in(entry) : playing.out(entry);
        auto done = co_await std::move(transfer);
        if (!done) co_return done;
    }
    co_return Result<void>{};
}

} // namespace

Task<Result<void>>
play_on_wire(Scheduler& scheduler, NearWire& wire, const Tape& tape, TapePace pace) {
    for (std::size_t next = 0; next < tape.entries.size();) {
        auto link = co_await wire.accept(scheduler.now() + very_long);
        if (!link) continue;
        Playing playing{scheduler, **link, pace,
                        next == 0 ? Duration{} : tape.entries[next].offset};
        const auto played = co_await play_opening(playing, tape, next);
        if (!played && played.error().fault == Fault::refused)
            co_return fail(Fault::refused, "transfer " + std::to_string(next + 1) +
                                               " of the tape: " + played.error().detail);
        const bool unplugs =
            next < tape.entries.size() && tape.entries[next].direction == Direction::closed;
        if (!played || !unplugs) continue;
        ++next;
        co_await wire.drain(scheduler.now() + patience);
        link->reset();
        if (auto ready = wire.unplug(); !ready) co_return ready;
    }
    co_await wire.drain(scheduler.now() + patience);
    co_return Result<void>{};
}

} // namespace axiscal
