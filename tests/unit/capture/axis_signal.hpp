#pragma once
// A simulated axis under a laser: a path in axis coordinates, turned into samples with noise,
// vibration and holes. Seeded. Nothing here comes from the code under test.

#include "acquisition/capture/sample_history.hpp"
#include "acquisition/capture/stillness.hpp"
#include "config/station_config.hpp"

#include <cmath>
#include <numbers>
#include <random>

namespace axiscal::testing {

inline MonotonicTime at_s(double seconds) {
    return monotonic_from_ns(static_cast<std::int64_t>(std::llround(seconds * 1e9)));
}

inline CaptureConfig quiet_config() {
    CaptureConfig config;
    config.window = std::chrono::milliseconds{500};
    config.spread_limit = 2.0_um;
    config.slope_limit_um_per_s = 1;
    config.minimum_samples = 20;
    config.fastest = metre_per_second(1);
    return config;
}

/// One look, of a search that begins with it.
inline WindowSearch find_still_window(const SampleHistory& history,
                                      MonotonicTime from,
                                      MonotonicTime now,
                                      const CaptureConfig& config) {
    return StillWindowSearch{from, config}.look(history, now);
}

/// Writes samples at 1 kHz. Motion is at constant feed; `wobble` is a servo ripple of 37 Hz during
/// motion only; `noise` is Gaussian.
class AxisSignal {
public:
    explicit AxisSignal(std::uint64_t seed = 1)
        : random_{seed} {}

    AxisSignal& stand(double seconds) { return go(position_mm_, seconds); }
    AxisSignal& move_to(double target_mm, double feed_mm_per_s = 50) {
        return go(target_mm, std::abs(target_mm - position_mm_) / feed_mm_per_s);
    }
    /// The next `count` samples are not delivered, the device counts on.
    AxisSignal& lose(double seconds) {
        lost_until_ = now_s_ + seconds;
        return *this;
    }
    /// The computer was busy: what follows is stamped later, but the device's numbers go on.
    AxisSignal& read_late(double seconds) {
        now_s_ += seconds;
        return *this;
    }
    AxisSignal& bad(Quality why) {
        tick();
        history.push(Sample::bad(0, at_s(now_s_), why, count_, epoch));
        return *this;
    }
    [[nodiscard]] MonotonicTime now() const { return at_s(now_s_); }
    [[nodiscard]] double position_mm() const { return position_mm_; }

    SampleHistory history;
    double noise_um = 0.05, wobble_um = 0, sign = 1, drift_um_per_s = 0, offset_mm = 0;
    std::uint32_t epoch = 1;
    Duration time_uncertainty{}; ///< u(t) of each sample; 0: not stated

private:
    void tick() {
        now_s_ += 1e-3;
        ++count_;
    }
    AxisSignal& go(double target_mm, double seconds) {
        const double from = position_mm_;
        const bool moving = target_mm != from;
        const auto steps = std::max(1L, std::lround(seconds * 1000));
        std::normal_distribution<double> noise{0, noise_um};
        for (long i = 1; i <= steps; ++i) {
            tick();
            position_mm_ =
                from + (target_mm - from) * static_cast<double>(i) / static_cast<double>(steps);
            if (now_s_ <= lost_until_) continue;
            const double ripple =
                moving && i < steps ? wobble_um * std::sin(2 * std::numbers::pi * 37 * now_s_) : 0;
            const double um_seen = noise(random_) + ripple + drift_um_per_s * now_s_;
            Sample sample{0, at_s(now_s_),
                          sign * ((position_mm_ - offset_mm) * 1e-3 + um_seen * 1e-6), count_,
                          epoch};
            sample.time_uncertainty = time_uncertainty;
            history.push(sample);
        }
        return *this;
    }

    std::mt19937_64 random_;
    double now_s_ = 10, position_mm_ = 0, lost_until_ = 0;
    std::uint64_t count_ = 5000;
};

} // namespace axiscal::testing
