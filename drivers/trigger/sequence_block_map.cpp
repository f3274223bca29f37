#include "drivers/trigger/sequence_block_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace axiscal {
namespace {

using namespace sequence_block;

constexpr Duration silence_limit = std::chrono::seconds{2};
constexpr double counts_per_mm = 1e4, counts_per_degree = 1e5;
constexpr double deviation_counts_per_um = 100, deviation_counts_per_millidegree = 1000;

std::optional<TriggerCommand> command_of(std::uint16_t word) {
    switch (word) {
    case 1: return TriggerCommand::prepare;
    case 2: return TriggerCommand::capture;
    case 3: return TriggerCommand::skip;
    case 4: return TriggerCommand::abort;
    case 5: return TriggerCommand::end;
    default: return std::nullopt; // 6 and 7 (moving capture) are not known in this version
    }
}

std::uint16_t environment_word(std::optional<double> value, double counts_per_unit) {
    if (!value || !std::isfinite(*value)) return absent;
    const double counts = std::clamp(std::round(*value * counts_per_unit), -32767.0, 32767.0);
    return static_cast<std::uint16_t>(static_cast<std::int16_t>(counts));
}

std::uint16_t index_word(std::optional<int> index) {
    return index ? static_cast<std::uint16_t>(std::clamp(*index, 0, absent_index - 1))
                 : absent_index;
}

/// The bits of a signed 32-bit word, as many counts as are nearest.
std::uint32_t long_word(std::optional<double> value, double counts_per_unit) {
    if (!value || !std::isfinite(*value)) return absent_long;
    constexpr double most = std::numeric_limits<std::int32_t>::max();
    const double counts = std::clamp(std::round(*value * counts_per_unit), -most, most);
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(counts));
}

std::uint16_t permit_word(const PortStatus& status) {
    return static_cast<std::uint16_t>((status.may_move ? 1 : 0) | (status.feed_hold ? 2 : 0) |
                                      (status.run_complete ? 4 : 0));
}

} // namespace

SequenceBlockMap::SequenceBlockMap(bool low_word_first, bool watch_heartbeat)
    : low_word_first_{low_word_first}
    , watch_heartbeat_{watch_heartbeat} {
    words_[acknowledged_sequence] = no_run_sequence;
    SequenceBlockMap::show(PortStatus{});
}

AddressSpace SequenceBlockMap::space() const {
    return AddressSpace{0, 0, words, words, cnc_words};
}

RegisterImage SequenceBlockMap::image() const {
    RegisterImage image;
    image.space = space();
    image.holding = words_;
    image.input = words_;
    image.beats = true;
    return image;
}

MapNews SequenceBlockMap::write(const ModbusRequest& request, MonotonicTime at) {
    MapNews news;
    const auto first = static_cast<std::size_t>(request.write_address);
    const std::size_t end = first + request.values.size();
    const auto heartbeat_before = words_[cnc_heartbeat];
    std::copy(request.values.begin(), request.values.end(),
              words_.begin() + static_cast<std::ptrdiff_t>(first));
    if (!heard_at_ || words_[cnc_heartbeat] != heartbeat_before) hear_heartbeat(at, news);
    if (first <= command_sequence && command_sequence < end) take_edge(at, news);
    return news;
}

void SequenceBlockMap::hear_heartbeat(MonotonicTime at, MapNews& news) {
    heard_at_ = at;
    if (silent_) news.silent = false;
    silent_ = false;
}

std::optional<MonotonicTime> SequenceBlockMap::due() const {
    if (!watch_heartbeat_ || silent_ || !heard_at_) return std::nullopt;
    return *heard_at_ + silence_limit + Duration{1}; // more than the limit
}

MapNews SequenceBlockMap::tick(MonotonicTime now) {
    MapNews news;
    const auto limit = due();
    if (!limit || now < *limit) return news;
    silent_ = true;
    news.silent = true;
    return news;
}

void SequenceBlockMap::take_edge(MonotonicTime at, MapNews& news) {
    const std::uint16_t sequence = words_[command_sequence];
    const bool first_seen = !last_request_;
    if (last_request_ == sequence) return;
    last_request_ = sequence;
    if (std::exchange(ends_with_request_, false)) words_[acknowledged_sequence] = no_run_sequence;
    show_permission();
    if (sequence == 0) return;
    words_[result] = 0;
    words_[fault_sequence] = 0;
    show_permission();
    auto event = decode();
    if (!event) {
        refuse(sequence, Fault::bad_command);
        news.notes.emplace_back(Fault::bad_command,
                                "CMD " + std::to_string(words_[command]) + " with DIRECTION " +
                                    std::to_string(words_[direction]) + " in request " +
                                    std::to_string(sequence) + " is no command here.");
        return;
    }
    event->at = at;
    event->standing = first_seen && !armed_;
    news.events.push_back(*event);
}

std::optional<TriggerEvent> SequenceBlockMap::decode() const {
    const auto known = command_of(words_[command]);
    if (!known || words_[direction] > 2) return std::nullopt;
    TriggerEvent event;
    event.command = *known;
    event.sequence = words_[command_sequence];
    event.target_index = words_[target_index];
    if (words_[direction] == 1) event.direction = Direction::positive;
    if (words_[direction] == 2) event.direction = Direction::negative;
    event.nominal_counts = long_at(nominal_position);
    event.run_index = words_[run_index];
    return event;
}

void SequenceBlockMap::arm() {
    armed_ = true;
    finish(0);
}

void SequenceBlockMap::end_run(RunEnd end) {
    const bool stands = words_[command_sequence] == words_[acknowledged_sequence];
    ends_with_request_ = end == RunEnd::once_answered && stands;
    if (!ends_with_request_) words_[acknowledged_sequence] = no_run_sequence;
}

void SequenceBlockMap::finish(std::uint16_t sequence) {
    ends_with_request_ = false;
    words_[acknowledged_sequence] = sequence;
    words_[result] = words_[fault_sequence] = 0;
    show_permission();
}

void SequenceBlockMap::finish_skip(std::uint16_t sequence) {
    finish(sequence);
    words_[result] = skipped_without_point;
}

void SequenceBlockMap::refuse(std::uint16_t sequence, Fault fault) {
    words_[result] = cnc_result_code(fault);
    words_[fault_sequence] = sequence;
    show_permission();
}

void SequenceBlockMap::show(const PortStatus& status) {
    const bool rotary = status.axis_kind == AxisKind::rotary; // 1 mm stands for 1 degree
    const double position_scale = rotary ? counts_per_degree : counts_per_mm;
    const double deviation_scale =
        rotary ? deviation_counts_per_millidegree : deviation_counts_per_um;
    shown_ = status;
    show_permission();
    put_long(measured_position, long_word(status.measured_mm, position_scale));
    put_long(deviation, long_word(status.deviation_um, deviation_scale));
    words_[next_target] = index_word(status.next_target);
    put_long(next_nominal, long_word(status.next_nominal_mm, position_scale));
    words_[air_temperature] = environment_word(status.air_degC, 100);
    words_[air_pressure] = environment_word(status.pressure_Pa, 0.1);
    words_[air_humidity] = environment_word(status.humidity_percent, 10);
    words_[material_temperature] = environment_word(status.material_degC, 100);
}

/// A request that was refused, or whose run was broken off, holds until the CNC takes it back.
void SequenceBlockMap::show_permission() {
    const std::uint16_t standing = words_[command_sequence];
    const bool refused = standing != 0 && words_[fault_sequence] == standing;
    PortStatus status = shown_;
    if (refused || (shown_.run_broken_off && standing != 0)) {
        status.may_move = false;
        status.feed_hold = true;
    }
    if (refused && status.state != PortState::error) status.state = PortState::hold;
    words_[state] = static_cast<std::uint16_t>(status.state);
    words_[permit] = permit_word(status);
}

std::int32_t SequenceBlockMap::long_at(int word) const {
    const auto place = static_cast<std::size_t>(word);
    const std::uint32_t high = words_[place + (low_word_first_ ? 1 : 0)];
    const std::uint32_t low = words_[place + (low_word_first_ ? 0 : 1)];
    return static_cast<std::int32_t>(high << 16 | low);
}

void SequenceBlockMap::put_long(int word, std::uint32_t bits) {
    const auto place = static_cast<std::size_t>(word);
    words_[place + (low_word_first_ ? 1 : 0)] = static_cast<std::uint16_t>(bits >> 16);
    words_[place + (low_word_first_ ? 0 : 1)] = static_cast<std::uint16_t>(bits);
}

} // namespace axiscal
