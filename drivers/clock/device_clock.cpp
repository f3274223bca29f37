#include "drivers/clock/device_clock.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace axiscal {
namespace {

constexpr double bucket_s = 0.05;
/// A quiet window follows a crystal that swings; teeth of the beat need a long one.
constexpr double short_window_s = 10, long_window_s = 90;
/// Two crystals disagree by less (100 ppm each).
constexpr double steepest = 200e-6;
/// What no fit can find: the least delay from the end of a record to the time that was read for it.
/// Through a pty and a serial driver 3 to 44 us were measured; taken as 0 to 50 us, rectangular.
constexpr double least_delay_s = 50e-6;
/// Two crystals that swing by 0.5 ppm in some minutes bend the long window by up to +-10 us.
constexpr double swing_s = 20e-6;
/// A line over so little says nothing about a slope.
constexpr std::size_t fewest_buckets = 20;
/// The line is used at the end of its window, where it is off by up to twice its misfit.
constexpr double at_the_end = 2;

/// How far the last half second stayed above the line.
double least_above(const ClockLine& line, const std::deque<ClockPoint>& points) {
    constexpr std::size_t half_a_second = 10;
    double least_s = points.back().delay_s - line.at(points.back().device_s);
    for (std::size_t i = points.size() - std::min(half_a_second, points.size()); i < points.size();
         ++i)
        least_s = std::min(least_s, points[i].delay_s - line.at(points[i].device_s));
    return least_s;
}

} // namespace

DeviceClock::DeviceClock(Duration frame)
    : frame_{frame} {}

void DeviceClock::restart() {
    begun_ = false;
    lowest_.clear();
    open_.reset();
    line_ = {};
    seen_.reset();
    fit_uncertainty_s_ = 0;
    pinned_ = false;
    state_uncertainty();
}

/// Within how much the delay of the newest record of a read is unknown: it came out of a frame, but
/// no record was missing after it.
double DeviceClock::grain_s() const {
    return seconds_of(std::min(frame_, period_));
}

double DeviceClock::window_s() const {
    return 2 * grain_s() > seconds_of(frame_) && frame_ > Duration{} ? long_window_s
                                                                     : short_window_s;
}

PlacedTime DeviceClock::place(std::uint64_t number,
                              MonotonicTime read_at,
                              Duration period,
                              std::int64_t behind) {
    if (std::exchange(period_, period) != period) restart();
    if (!begun_) {
        begun_ = true;
        first_number_ = number;
        first_read_ = read_at - period * behind;
    }
    const Duration since_first = period * static_cast<std::int64_t>(number - first_number_);
    const Duration newest = since_first + period * behind;
    // Records that were read together all tell of the newest of them: once is enough.
    if (const Read read{newest, read_at}; seen_ != read) {
        seen_ = read;
        observe({seconds_of(newest), seconds_of(read_at - first_read_ - newest)});
    }
    const double late_s = delay_s(seconds_of(since_first)) - early_s_;
    return {first_read_ + since_first + from_seconds(late_s), uncertainty_};
}

void DeviceClock::state_uncertainty() {
    const double unseen_s = pinned_ ? 0 : grain_s();
    early_s_ = (unseen_s + least_delay_s) / 2;
    const double bent_s = window_s() == long_window_s ? swing_s : 0;
    // All rectangular; added, since in one set-up all may lie at their ends for hours.
    const double rectangular_s = (unseen_s + least_delay_s + bent_s) / std::sqrt(12.0);
    uncertainty_ = from_seconds(std::hypot(rectangular_s, fit_uncertainty_s_));
}

/// An arrival below the line proves the line wrong before the next fit does.
double DeviceClock::delay_s(double device_s) const {
    const double line_s = line_.at(device_s);
    if (!open_) return line_s;
    return line_s + std::min(0.0, open_->delay_s - line_.at(open_->device_s));
}

void DeviceClock::observe(ClockPoint newest) {
    if (open_ && std::floor(open_->device_s / bucket_s) != std::floor(newest.device_s / bucket_s))
        close_bucket();
    if (!open_ && lowest_.empty()) line_ = {newest.delay_s, 0};
    const auto above = [this](const ClockPoint& p) { return p.delay_s - line_.at(p.device_s); };
    if (!open_ || above(newest) < above(*open_)) open_ = newest;
}

void DeviceClock::close_bucket() {
    lowest_.push_back(*std::exchange(open_, std::nullopt));
    while (lowest_.back().device_s - lowest_.front().device_s > window_s())
        lowest_.pop_front();
    if (lowest_.size() < fewest_buckets)
        begin_flat();
    else
        refit();
    state_uncertainty();
}

void DeviceClock::begin_flat() {
    line_ = line_below(lowest_, 0);
    const double span_s = lowest_.back().device_s - lowest_.front().device_s + bucket_s;
    fit_uncertainty_s_ = steepest * span_s / std::sqrt(3.0);
}

void DeviceClock::refit() {
    line_ = line_below(lowest_, steepest);
    const double grain = grain_s();
    const SawTeeth teeth = grain > 0 ? teeth_on(line_, lowest_, grain) : SawTeeth{};
    pinned_ = grain == 0 || (teeth.begun >= 3 && teeth.whole >= 2); // two beats
    // More than a grain above the line is no clock: the host came late for half a second.
    if (!pinned_) line_.delay_s += std::min(grain, least_above(line_, lowest_));
    // The grain covers what a line that is not pinned is off.
    const double misfit_s = grain == 0 ? misfit_of(line_, lowest_) : teeth.misfit_s;
    fit_uncertainty_s_ = pinned_ ? at_the_end * misfit_s : 0;
}

} // namespace axiscal
