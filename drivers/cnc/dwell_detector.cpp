#include "drivers/cnc/dwell_detector.hpp"

#include <algorithm>
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
        if (within(*target_mm_, position_mm, 0)) enter({at, position_mm});
        return false;
    case State::in_window:
        keep({at, position_mm});
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

void DwellDetector::enter(const Reading& reading) {
    state_ = State::in_window;
    entered_at_ = reading.at;
    recent_.assign(1, reading);
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

void DwellDetector::keep(const Reading& reading) {
    if (reading.at - recent_.back().at > limits_.stability_period / 4) return enter(reading);
    recent_.push_back(reading);
    while (recent_.size() > 1 && recent_[1].at <= reading.at - limits_.stability_period)
        recent_.pop_front();
}

bool DwellDetector::still(MonotonicTime now) const {
    if (recent_.front().at > now - limits_.stability_period) return false;
    const auto [low, high] = std::ranges::minmax_element(recent_, {}, &Reading::position_mm);
    return high->position_mm - low->position_mm <= limits_.stability_range_mm;
}

bool DwellDetector::within(double target_mm, double position_mm, double margin_mm) const {
    return std::abs(position_mm - target_mm) <= limits_.window_mm + margin_mm;
}

} // namespace axiscal
