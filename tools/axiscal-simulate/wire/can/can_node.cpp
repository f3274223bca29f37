#include "wire/can/can_node.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace axiscal::simulate {

namespace {

constexpr int most_tpdos = 8;
constexpr double forgotten_s = 0.02; ///< what was due longer ago is never sent
constexpr std::uint32_t no_object = 0x06020000, no_sub = 0x06090011, read_only = 0x06010002,
                        wrong_length = 0x06070010, unknown_command = 0x05040001;

} // namespace

CanNode::Bytes low_byte_first(std::int64_t value, int bytes) {
    CanNode::Bytes out;
    for (int at = 0; at < bytes; ++at)
        out.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * at)));
    return out;
}

void CanNode::put_number(int index, int sub, std::uint32_t value, int bytes, bool writable) {
    objects_[{index, sub}] = {low_byte_first(value, bytes), {}, writable};
    // Once it was switched on: what it is then lasts over a reset.
    if (!delivered_.empty()) delivered_[{index, sub}] = objects_[{index, sub}];
}

void CanNode::put_text(int index, int sub, const std::string& text) {
    objects_[{index, sub}] = {{text.begin(), text.end()}, {}, false};
}

void CanNode::put_measured(int index, int sub, Measured value) {
    objects_[{index, sub}] = {{}, std::move(value), false};
}

void CanNode::put_tpdo(int number,
                       std::uint32_t id,
                       int transmission,
                       int event_ms,
                       const std::vector<std::uint32_t>& mapping) {
    const int parameters = 0x1800 + number - 1, map = 0x1A00 + number - 1;
    put_number(parameters, 0, 5, 1);
    put_number(parameters, 1, id, 4, true);
    put_number(parameters, 2, static_cast<std::uint32_t>(transmission), 1, true);
    put_number(parameters, 3, 0, 2, true);
    put_number(parameters, 5, static_cast<std::uint32_t>(event_ms), 2, true);
    put_number(map, 0, static_cast<std::uint32_t>(mapping.size()), 1);
    for (std::size_t at = 0; at < mapping.size(); ++at)
        put_number(map, static_cast<int>(at) + 1, mapping[at], 4);
}

void CanNode::power_on(double now_s) {
    if (delivered_.empty()) delivered_ = objects_;
    objects_ = delivered_;
    waiting_.clear();
    guard_toggle_ = 0;
    enter(pre_operational, now_s);
    waiting_.push_back({0x700 + node_, {0}});
}

/// Parameters of communication as delivered; the boot-up message.
void CanNode::reset_communication(double now_s) {
    for (const auto& [key, object] : delivered_)
        if (key.first < 0x2000) objects_[key] = object;
    guard_toggle_ = 0;
    enter(pre_operational, now_s);
    waiting_.push_back({0x700 + node_, {0}});
}

void CanNode::enter(State state, double now_s) {
    state_ = state;
    plan(now_s);
}

double CanNode::pdo_period_s(int number) const {
    const int parameters = 0x1800 + number - 1;
    if (state_ != operational || !objects_.contains({parameters, 1})) return 0;
    const bool valid = (number_at(parameters, 1) & 0x80000000U) == 0;
    const bool by_itself = number_at(parameters, 2) >= 0xFE;
    return valid && by_itself ? number_at(parameters, 5) * 1e-3 : 0;
}

void CanNode::plan(double now_s) {
    next_pdo_s_.clear();
    for (int number = 1; number <= most_tpdos; ++number)
        if (const double period = pdo_period_s(number); period > 0)
            next_pdo_s_[number] = now_s + period;
    next_beat_s_ = now_s + number_at(0x1017, 0) * 1e-3;
}

std::uint32_t CanNode::number_at(int index, int sub) const {
    const auto found = objects_.find({index, sub});
    if (found == objects_.end()) return 0;
    std::uint32_t value = 0;
    for (std::size_t at = 0; at < std::min<std::size_t>(4, found->second.value.size()); ++at)
        value |= static_cast<std::uint32_t>(found->second.value[at]) << (8 * at);
    return value;
}

CanNode::Bytes CanNode::content(const Object& object, double now_s) const {
    return object.measured ? object.measured(now_s) : object.value;
}

void CanNode::tell_emergency(std::uint16_t code, std::uint8_t error_register, const Bytes& maker) {
    Bytes bytes = low_byte_first(code, 2);
    bytes.push_back(error_register);
    bytes.insert(bytes.end(), maker.begin(), maker.end());
    bytes.resize(8);
    put_number(0x1001, 0, error_register, 1);
    if (state_ != off) waiting_.push_back({0x080 + node_, bytes});
}

void CanNode::obey(const CanMessage& frame, double now_s) {
    if (frame.data.size() != 2 || (frame.data[1] != 0 && frame.data[1] != node_)) return;
    switch (frame.data[0]) {
    case 0x01: return enter(operational, now_s);
    case 0x02: return enter(stopped, now_s);
    case 0x80: return enter(pre_operational, now_s);
    case 0x81: return power_on(now_s);
    case 0x82: return reset_communication(now_s);
    default: return;
    }
}

std::vector<CanMessage> CanNode::take(const CanMessage& frame, double now_s) {
    if (state_ == off) return {};
    if (frame.remote) {
        if (!guarded_ || frame.id != 0x700 + node_) return {};
        const auto state = static_cast<std::uint8_t>(guard_toggle_ | state_);
        guard_toggle_ ^= 0x80;
        return {{0x700 + node_, {state}}};
    }
    if (frame.id == 0) obey(frame, now_s);
    const bool asks = frame.id == 0x600 + node_ && frame.data.size() == 8 && state_ != stopped;
    if (!asks) return {};
    return {serve(frame, now_s)};
}

CanMessage CanNode::answer(Bytes bytes) const {
    bytes.resize(8);
    return {0x580 + node_, std::move(bytes)};
}

CanMessage CanNode::abort(Key key, std::uint32_t code) const {
    Bytes bytes{0x80, static_cast<std::uint8_t>(key.first),
                static_cast<std::uint8_t>(key.first >> 8), static_cast<std::uint8_t>(key.second)};
    const Bytes reason = low_byte_first(code, 4);
    bytes.insert(bytes.end(), reason.begin(), reason.end());
    return answer(bytes);
}

CanMessage CanNode::serve(const CanMessage& request, double now_s) {
    const std::uint8_t command = request.data[0];
    const Key key{request.data[1] | request.data[2] << 8, request.data[3]};
    if ((command & 0xE0) == 0x60) return next_segment(command);
    const bool reads = command == 0x40, writes = (command & 0xE2) == 0x22;
    if (!reads && !writes) return abort(key, unknown_command);
    if (!objects_.contains(key)) {
        const bool has_index = std::any_of(objects_.begin(), objects_.end(), [&](const auto& one) {
            return one.first.first == key.first;
        });
        return abort(key, has_index ? no_sub : no_object);
    }
    return reads ? begin_upload(key, now_s) : download(request, key, now_s);
}

CanMessage CanNode::begin_upload(Key key, double now_s) {
    const Bytes bytes = content(objects_.at(key), now_s);
    Bytes reply{0, static_cast<std::uint8_t>(key.first), static_cast<std::uint8_t>(key.first >> 8),
                static_cast<std::uint8_t>(key.second)};
    if (bytes.size() <= 4) {
        reply[0] = static_cast<std::uint8_t>(0x43 | (4 - bytes.size()) << 2);
        reply.insert(reply.end(), bytes.begin(), bytes.end());
        return answer(reply);
    }
    upload_ = {bytes, 0, 0};
    reply[0] = 0x41;
    const Bytes size = low_byte_first(static_cast<std::uint32_t>(bytes.size()), 4);
    reply.insert(reply.end(), size.begin(), size.end());
    return answer(reply);
}

CanMessage CanNode::next_segment(std::uint8_t command) {
    if ((command & 0x10) != upload_.toggle || upload_.content.empty())
        return abort({0, 0}, unknown_command);
    const std::size_t rest = upload_.content.size() - upload_.sent;
    const std::size_t size = std::min<std::size_t>(7, rest);
    Bytes reply{static_cast<std::uint8_t>(upload_.toggle | (7 - size) << 1 | (size == rest))};
    const auto from = upload_.content.begin() + static_cast<std::ptrdiff_t>(upload_.sent);
    reply.insert(reply.end(), from, from + static_cast<std::ptrdiff_t>(size));
    upload_.sent += size;
    upload_.toggle ^= 0x10;
    if (size == rest) upload_ = {};
    return answer(reply);
}

CanMessage CanNode::download(const CanMessage& request, Key key, double now_s) {
    Object& object = objects_.at(key);
    if (!object.writable) return abort(key, read_only);
    const std::uint8_t command = request.data[0];
    const std::size_t size = (command & 1) != 0 ? 4 - (command >> 2 & 3U) : object.value.size();
    if (size != object.value.size()) return abort(key, wrong_length);
    std::copy_n(request.data.begin() + 4, size, object.value.begin());
    plan(now_s);
    return answer({0x60, request.data[1], request.data[2], request.data[3]});
}

CanMessage CanNode::pdo(int number, double now_s) const {
    CanMessage frame{number_at(0x1800 + number - 1, 1) & 0x7FFU, {}};
    const std::uint32_t entries = number_at(0x1A00 + number - 1, 0);
    for (std::uint32_t at = 1; at <= entries; ++at) {
        const std::uint32_t word = number_at(0x1A00 + number - 1, static_cast<int>(at));
        const auto found =
            objects_.find({static_cast<int>(word >> 16), static_cast<int>(word >> 8 & 0xFF)});
        Bytes bytes = found == objects_.end() ? Bytes{} : content(found->second, now_s);
        bytes.resize((word & 0xFF) / 8);
        frame.data.insert(frame.data.end(), bytes.begin(), bytes.end());
    }
    return frame;
}

void CanNode::send_pdos(double now_s, std::vector<CanMessage>& sent) {
    for (auto& [number, due_s] : next_pdo_s_) {
        const double period_s = pdo_period_s(number);
        for (; now_s - due_s > forgotten_s; due_s += period_s)
            ++pdos_skipped_;
        for (; due_s <= now_s; due_s += period_s) {
            sent.push_back(pdo(number, due_s));
            ++pdos_sent_;
        }
    }
}

std::vector<CanMessage> CanNode::advance(double now_s) {
    if (state_ == off) return {};
    std::vector<CanMessage> sent = std::exchange(waiting_, {});
    send_pdos(now_s, sent);
    const double beat_s = number_at(0x1017, 0) * 1e-3;
    if (beat_s > 0 && now_s >= next_beat_s_) {
        sent.push_back({0x700 + node_, {static_cast<std::uint8_t>(state_)}});
        next_beat_s_ = std::max(next_beat_s_ + beat_s, now_s);
    }
    return sent;
}

double CanNode::next_due_s() const {
    if (!waiting_.empty()) return 0;
    double due = std::numeric_limits<double>::infinity();
    if (state_ == off) return due;
    for (const auto& [number, due_s] : next_pdo_s_)
        due = std::min(due, due_s);
    return number_at(0x1017, 0) > 0 ? std::min(due, next_beat_s_) : due;
}

} // namespace axiscal::simulate
