#include "cnc/cnc_lines.hpp"

#include <cmath>

namespace axiscal::simulate {

namespace {

/// Words of a 32-bit value, high word first unless told otherwise.
void put_long(std::array<std::uint16_t, 9>& words, std::size_t at, std::int64_t value, bool low) {
    const auto bits = static_cast<std::uint32_t>(value);
    words[at + (low ? 1 : 0)] = static_cast<std::uint16_t>(bits >> 16);
    words[at + (low ? 0 : 1)] = static_cast<std::uint16_t>(bits);
}

std::uint16_t clip(double value) {
    return static_cast<std::uint16_t>(std::lround(std::fmin(std::fmax(value, 0.0), 65535.0)));
}

constexpr std::uint16_t command_capture = 2;

/// Position of words 1..9 in the array.
enum At : std::size_t {
    command = 0,
    sequence = 1,
    target = 2,
    direction = 3,
    nominal = 4,
    run = 6
};

} // namespace

CncLines::CncLines(CncScenario cnc)
    : cnc_{std::move(cnc)} {}

std::array<std::uint16_t, 9> CncLines::block(const CncScenario& cnc, const CncOutputs& outputs) {
    std::array<std::uint16_t, 9> words{};
    if (cnc.shape != "sequence-block") {
        words[0] = clip(outputs[0]);
        return words;
    }
    const double code = outputs[command_output];
    words[command] = code == 0 ? command_capture : clip(code);
    words[sequence] = clip(outputs[0]);
    words[target] = clip(outputs[1]);
    words[direction] = clip(outputs[2]);
    put_long(words, nominal, std::llround(outputs[3] * cnc.counts_per_unit), cnc.low_word_first);
    words[run] = clip(outputs[4]);
    put_long(words, 7, std::llround(outputs[5]), cnc.low_word_first);
    return words;
}

const CncFault* CncLines::fault_now() const {
    for (const CncFault& fault : cnc_.faults)
        if (fault.request == requests_) return &fault;
    return nullptr;
}

/// Puts one request on the queue, or what an injected fault makes of it.
void CncLines::request(CncWrite write, double now_s) {
    ++requests_;
    const CncFault* fault = fault_now();
    const std::string kind = fault == nullptr ? "" : fault->kind;
    const bool block = cnc_.shape == "sequence-block";
    deaf_ = kind == "missed" || kind == "late";
    if (kind == "missed") return;
    if (kind == "late") write.not_before_s = now_s + fault->late_s;
    if (kind == "out-of-order") ++write.words[block ? std::size_t{sequence} : 0];
    if (kind == "wrong-direction" && block)
        write.words[direction] = write.words[direction] == 1 ? 2 : 1;
    if (kind == "wrong-target" && block) {
        ++write.words[target];
        auto outputs = analog_;
        outputs[3] += 10; // mm: no pitch of targets is so fine that this is still near
        const auto shifted = CncLines::block(cnc_, outputs);
        write.words[nominal] = shifted[nominal];
        write.words[nominal + 1] = shifted[nominal + 1];
    }
    queue_.push_back(write);
    if (kind != "doubled") return;
    if (write.is_coil) {
        CncWrite low = write;
        low.coil = false;
        queue_.push_back(low);
    }
    queue_.push_back(write);
}

void CncLines::set_analog(int output, double value, double now_s) {
    const std::lock_guard lock{mutex_};
    if (output < 0 || output >= static_cast<int>(analog_.size())) return;
    const auto at = static_cast<std::size_t>(output);
    const bool changed = analog_[at] != value;
    analog_[at] = value;
    // A zero is always written: it is how a program finds out that the station is armed.
    if (output != 0 || (!changed && value != 0)) return;
    deaf_ = false;
    const CncWrite write{block(cnc_, analog_)};
    if (cnc_.shape == "coil-and-index" || value == 0)
        queue_.push_back(write);
    else
        request(write, now_s);
}

void CncLines::set_digital(int output, bool on, double now_s) {
    const std::lock_guard lock{mutex_};
    if (output != 0 || cnc_.shape != "coil-and-index") return;
    CncWrite write;
    write.is_coil = true;
    write.coil = on;
    if (on) return request(write, now_s);
    queue_.push_back(write);
    deaf_ = false;
}

bool CncLines::input(int input) const {
    const std::lock_guard lock{mutex_};
    const bool coil = cnc_.shape == "coil-and-index";
    if (input != 0 && !(coil && input == 1)) return false;
    if (deaf_) return true;
    if (coil && input == 0) return answer_.acknowledged;
    return answer_.done && *answer_.done == clip(analog_[0]);
}

std::optional<CncWrite> CncLines::due(double now_s) const {
    const std::lock_guard lock{mutex_};
    if (queue_.empty() || queue_.front().not_before_s > now_s) return std::nullopt;
    return queue_.front();
}

void CncLines::written() {
    const std::lock_guard lock{mutex_};
    if (queue_.empty()) return;
    (queue_.front().is_coil ? standing_coil_ : standing_) = queue_.front();
    queue_.pop_front();
}

void CncLines::connected() {
    const std::lock_guard lock{mutex_};
    if (!queue_.empty() && queue_.front().restored) return; // of a connection that died at once
    for (const auto& last : {standing_coil_, standing_}) {
        if (!last) continue;
        queue_.push_front(*last);
        queue_.front().restored = true;
    }
}

void CncLines::answered(const CncAnswer& answer) {
    const std::lock_guard lock{mutex_};
    answer_ = answer;
}

void CncLines::disconnected() {
    const std::lock_guard lock{mutex_};
    answer_.done.reset();
    answer_.acknowledged = false;
}

CncAnswer CncLines::answer() const {
    const std::lock_guard lock{mutex_};
    return answer_;
}

int CncLines::requests() const {
    const std::lock_guard lock{mutex_};
    return requests_;
}

} // namespace axiscal::simulate
