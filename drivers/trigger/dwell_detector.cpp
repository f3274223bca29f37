#include "drivers/trigger/dwell_detector.hpp"

#include <cmath>

namespace axiscal {

void DwellDetector::aim(std::optional<double> target_mm) {
    if (target_mm == target_mm_) return;
    target_mm_ = target_mm;
    if (state_ != State::requested && state_ != State::leave) arm();
}

void DwellDetector::arm() {
    state_ = target_mm_ ? State::armed : State::off;
    recent_.clear();
}

bool DwellDetector::position(MonotonicTime at, double position_mm) {
    if (!std::isfinite(position_mm)) return false;
    switch (state_) {
    case State::off: return false;
    case State::armed:
        if (within(*target_mm_, position_mm, 0)) enter({at, position_mm, 0});
        return false;
    case State::in_window:
        keep({at, position_mm, 0});
        if (!within(*target_mm_, position_mm, 0)) {
            arm();
            return false;
        }
        if (at - entered_at_ < limits_.minimum_halt || !still(at)) return false;
        left_target_mm_ = *target_mm_;
        gone_ = false;
        state_ = State::requested;
        return true;
    case State::requested:
        gone_ = gone_ || !within(left_target_mm_, position_mm, limits_.hysteresis_mm);
        return false;
    case State::leave:
        if (!within(left_target_mm_, position_mm, limits_.hysteresis_mm)) arm();
        return false;
    }
    return false;
}

void DwellDetector::enter(Reading reading) {
    state_ = State::in_window;
    entered_at_ = reading.at;
    reading.number = 0;
    for (auto* readings : {&recent_, &lows_, &highs_})
        readings->assign(1, reading);
}

void DwellDetector::finished() {
    if (state_ != State::requested) return;
    if (gone_)
        arm();
    else
        state_ = State::leave;
}

void DwellDetector::failed(bool try_again) {
    if (state_ != State::requested) return;
    if (gone_ || try_again)
        arm();
    else
        state_ = State::leave;
}

void DwellDetector::reset() {
    arm();
}

void DwellDetector::keep(Reading reading) {
    if (reading.at - recent_.back().at > limits_.stability_period / 4) return enter(reading);
    reading.number = recent_.back().number + 1;
    while (!lows_.empty() && lows_.back().position_mm >= reading.position_mm)
        lows_.pop_back();
    while (!highs_.empty() && highs_.back().position_mm <= reading.position_mm)
        highs_.pop_back();
    for (auto* readings : {&recent_, &lows_, &highs_})
        readings->push_back(reading);
    forget_before(reading.at - limits_.stability_period);
}

void DwellDetector::forget_before(MonotonicTime begin) {
    while (recent_.size() > 1 && recent_[1].at <= begin)
        recent_.pop_front();
    for (auto* readings : {&lows_, &highs_})
        while (readings->front().number < recent_.front().number)
            readings->pop_front();
}

bool DwellDetector::still(MonotonicTime now) const {
    if (recent_.front().at > now - limits_.stability_period) return false;
    return highs_.front().position_mm - lows_.front().position_mm <= limits_.stability_range_mm;
}

bool DwellDetector::within(double target_mm, double position_mm, double margin_mm) const {
    return std::abs(position_mm - target_mm) <= limits_.window_mm + margin_mm;
}

} // namespace axiscal
