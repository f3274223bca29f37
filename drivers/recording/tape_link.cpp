#include "drivers/recording/tape_link.hpp"

#include <algorithm>
#include <charconv>
#include <ostream>

namespace axiscal {
namespace {

std::string_view trimmed(std::string_view text) {
    const auto begin = text.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::string_view take_word(std::string_view& rest) {
    rest = trimmed(rest);
    const auto word = rest.substr(0, rest.find(' '));
    rest = trimmed(rest.substr(word.size()));
    return word;
}

Result<std::vector<std::byte>> bytes_from_hex(std::string_view hex) {
    std::vector<std::byte> bytes;
    for (std::size_t at = 0; at + 1 < hex.size(); at += 2) {
        unsigned value = 0;
        const auto [end, error] = std::from_chars(hex.data() + at, hex.data() + at + 2, value, 16);
        if (error != std::errc{} || end != hex.data() + at + 2)
            return fail(Fault::bad_request, "not a hexadecimal byte");
        bytes.push_back(static_cast<std::byte>(value));
    }
    if (hex.size() % 2 != 0) return fail(Fault::bad_request, "half a hexadecimal byte");
    return bytes;
}

Result<TapeEntry> parse_entry(std::string_view line, Duration not_before) {
    TapeEntry entry;
    entry.direction = static_cast<TapeEntry::Direction>(line.front());
    std::string_view rest = line.substr(1);
    const auto offset = take_word(rest);
    std::int64_t nanoseconds = 0;
    const auto [end, error] =
        std::from_chars(offset.data(), offset.data() + offset.size(), nanoseconds);
    if (error != std::errc{} || end != offset.data() + offset.size())
        return fail(Fault::bad_request, "the offset is not a whole number of nanoseconds");
    entry.offset = Duration{nanoseconds};
    if (entry.offset < not_before) return fail(Fault::bad_request, "the offset goes back");
    AXISCAL_TRY(entry.bytes, bytes_from_hex(rest));
    return entry;
}

Result<void> parse_line(std::string_view line, Tape& tape) {
    line = trimmed(line);
    if (line.empty() || line.front() == '#') return {};
    const bool transfer = line.size() > 1 && line[1] == ' ';
    if (transfer && std::string_view{"<>!x"}.find(line.front()) != std::string_view::npos) {
        const Duration last = tape.entries.empty() ? Duration{} : tape.entries.back().offset;
        AXISCAL_TRY(auto entry, parse_entry(line, last));
        tape.entries.push_back(std::move(entry));
        return {};
    }
    const auto equals = line.find('=');
    if (equals == std::string_view::npos || !tape.entries.empty())
        return fail(Fault::bad_request, "neither a header line nor a transfer");
    tape.header.emplace(trimmed(line.substr(0, equals)), trimmed(line.substr(equals + 1)));
    return {};
}

/// A file of the kernel that is not there or cannot be read says so at once, as a device that
/// refuses does: without an entry the tape would be silent there for the driver's whole patience.
bool no_answer_will_come(Fault fault) {
    return fault == Fault::not_found || fault == Fault::io || fault == Fault::refused;
}

bool is_of_endpoint(const TapeEntry& entry, std::optional<int> endpoint) {
    if (!endpoint || entry.direction != TapeEntry::Direction::in) return true;
    return !entry.bytes.empty() && std::to_integer<int>(entry.bytes.front()) == *endpoint;
}

} // namespace

Result<Tape> parse_tape(std::string_view text) {
    Tape tape;
    for (int number = 1; !text.empty(); ++number) {
        const auto line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        if (const auto read = parse_line(line, tape); !read)
            return fail(Fault::bad_request,
                        "tape line " + std::to_string(number) + ": " + read.error().detail);
    }
    if (std::ranges::find(tape_origins, tape.header["origin"]) == tape_origins.end())
        return fail(Fault::bad_request, "tape: origin = device | vendor-document | simulator");
    return tape;
}

/// One opening of the tape. Loop-bound; the player outlives its links.
class TapePlayerLink final : public ByteLink {
public:
    explicit TapePlayerLink(TapePlayer& player)
        : player_{player} {}
    Task<Result<TimedBytes>> read_some(MonotonicTime deadline) override;
    Task<Result<void>> write_all(std::vector<std::byte> bytes, MonotonicTime deadline) override;

private:
    TapePlayer& player_;
};

TapePlayer::TapePlayer(Scheduler& scheduler, const Tape& tape)
    : scheduler_{scheduler}
    , tape_{tape} {}

Task<Result<void>> TapePlayer::begin_opening(MonotonicTime deadline) {
    if (at_end()) co_return fail(Fault::link_closed, "the tape is at its end");
    if (!begin_) begin_ = scheduler_.now();
    const TapeEntry& first = tape_.entries[next_];
    const MonotonicTime when = *begin_ + first.offset;
    if (first.direction == TapeEntry::Direction::out)
        co_await scheduler_.sleep_until(std::min(deadline, when));
    if (first.direction != TapeEntry::Direction::closed) co_return Result<void>{};
    co_await scheduler_.sleep_until(std::min(deadline, when));
    if (when > deadline) co_return fail(Fault::link_timeout, "nothing is there on the tape");
    ++next_;
    co_return fail(Fault::link_closed, "the link closed on the tape");
}

Task<Result<std::unique_ptr<ByteLink>>> TapePlayer::open(const LinkSettings& /*settings*/,
                                                         MonotonicTime deadline) {
    const auto begun = co_await begin_opening(deadline);
    if (!begun) co_return tl::unexpected<Error>(begun.error());
    co_return std::make_unique<TapePlayerLink>(*this);
}

Task<Result<TimedBytes>> TapePlayerLink::read_some(MonotonicTime deadline) {
    return player_.play_in(deadline);
}

Task<Result<void>> TapePlayerLink::write_all(std::vector<std::byte> bytes,
                                             MonotonicTime /*deadline*/) {
    co_return player_.play_out(bytes);
}

Task<Result<TimedBytes>> TapePlayer::play_in(MonotonicTime deadline, std::optional<int> endpoint) {
    if (at_end()) co_return fail(Fault::link_closed, "the tape is at its end");
    const TapeEntry& entry = tape_.entries[next_];
    const MonotonicTime when = *begin_ + entry.offset;
    if (entry.direction == TapeEntry::Direction::out || when > deadline ||
        !is_of_endpoint(entry, endpoint)) {
        co_await scheduler_.sleep_until(deadline);
        co_return fail(Fault::link_timeout, "the tape is silent");
    }
    co_await scheduler_.sleep_until(when);
    ++next_;
    if (entry.direction == TapeEntry::Direction::closed)
        co_return fail(Fault::link_closed, "the link closed on the tape");
    if (entry.direction == TapeEntry::Direction::refused)
        co_return fail(Fault::refused, "the device refused on the tape");
    TimedBytes played{entry.bytes, scheduler_.now()};
    co_return played;
}

Task<Result<std::vector<TimedBytes>>> TapePlayer::play_all_in(MonotonicTime deadline) {
    const std::size_t before = next_;
    auto first = co_await play_in(deadline);
    if (!first) co_return tl::unexpected<Error>(first.error());
    first->read_at = *begin_ + tape_.entries[before].offset;
    std::vector<TimedBytes> played;
    played.push_back(*std::move(first));
    while (!at_end() && tape_.entries[next_].direction == TapeEntry::Direction::in &&
           *begin_ + tape_.entries[next_].offset <= scheduler_.now()) {
        const TapeEntry& entry = tape_.entries[next_++];
        played.push_back({entry.bytes, *begin_ + entry.offset});
    }
    co_return played;
}

Result<void> TapePlayer::play_out(std::span<const std::byte> bytes) {
    if (!at_end() && tape_.entries[next_].direction == TapeEntry::Direction::closed &&
        scheduler_.now() >= *begin_ + tape_.entries[next_].offset) {
        ++next_;
        return fail(Fault::link_closed, "the link closed on the tape");
    }
    const bool expected = !at_end() &&
                          tape_.entries[next_].direction == TapeEntry::Direction::out &&
                          std::ranges::equal(tape_.entries[next_].bytes, bytes);
    if (!expected) return fail(Fault::internal, "the driver writes what the tape does not know");
    ++next_;
    return {};
}

TapeRecorderLink::TapeRecorderLink(std::unique_ptr<ByteLink> inner,
                                   Scheduler& scheduler,
                                   std::ostream& tape,
                                   MonotonicTime begin)
    : inner_{std::move(inner)}
    , scheduler_{scheduler}
    , tape_{tape, begin} {}

void TapeWriter::write(TapeEntry::Direction direction,
                       MonotonicTime at,
                       std::span<const std::byte> bytes) {
    constexpr std::string_view digits = "0123456789abcdef";
    last_ = std::max(last_, Duration{at - begin_});
    tape_ << static_cast<char>(direction) << ' ' << last_.count();
    if (!bytes.empty()) tape_ << ' ';
    for (const std::byte byte : bytes)
        tape_ << digits[std::to_integer<std::size_t>(byte >> 4)]
              << digits[std::to_integer<std::size_t>(byte & std::byte{15})];
    tape_ << '\n';
}

Task<Result<TimedBytes>> TapeRecorderLink::read_some(MonotonicTime deadline) {
    auto arrived = co_await inner_->read_some(deadline);
    if (arrived)
        tape_.write(TapeEntry::Direction::in, arrived->read_at, arrived->bytes);
    else if (arrived.error().fault == Fault::link_closed)
        tape_.write(TapeEntry::Direction::closed, scheduler_.now(), {});
    else if (no_answer_will_come(arrived.error().fault))
        tape_.write(TapeEntry::Direction::refused, scheduler_.now(), {});
    co_return arrived;
}

Task<Result<void>> TapeRecorderLink::write_all(std::vector<std::byte> bytes,
                                               MonotonicTime deadline) {
    const MonotonicTime at = scheduler_.now();
    const std::vector<std::byte> copy = bytes;
    auto written = co_await inner_->write_all(std::move(bytes), deadline);
    if (written)
        tape_.write(TapeEntry::Direction::out, at, copy);
    else if (written.error().fault == Fault::link_closed)
        tape_.write(TapeEntry::Direction::closed, scheduler_.now(), {});
    co_return written;
}

} // namespace axiscal
