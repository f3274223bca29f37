#pragma once
// The stream of a bar that was driven through circles whose truth is known: rest, feed-in, arc with
// overshoot, feed-out, rest. It knows the plan of the program and nothing of how circles are cut.

#include "analysis/record/circular_setup.hpp"
#include "analysis/record/stream_record.hpp"
#include "synthetic_circle.hpp"

#include <algorithm>
#include <array>
#include <random>

namespace axiscal::test {

/// Way after `t` seconds of a move of `length_mm` that accelerates and brakes.
struct Trapezoid {
    double length_mm = 0, speed = 1, acceleration = 0; ///< 0: at full speed from the first moment
    [[nodiscard]] double ramp_s() const { return acceleration > 0 ? speed / acceleration : 0; }
    [[nodiscard]] double duration_s() const { return length_mm / speed + ramp_s(); }
    [[nodiscard]] double way(double t) const {
        const double left = duration_s() - t;
        if (t <= 0) return 0;
        if (left <= 0) return length_mm;
        if (t < ramp_s()) return acceleration * t * t / 2;
        if (left < ramp_s()) return length_mm - acceleration * left * left / 2;
        return speed * (t - ramp_s() / 2);
    }
};

class DrivenBar {
public:
    CircularSetup setup;
    CircleTruth truth;
    double acceleration = 0, noise_mm = 0, rate_hz = 1000, rest_s = 0.7;
    /// Ends of the bar's range about R; outside there are no samples.
    double range_mm = 10;
    std::vector<std::pair<int, MonotonicTime>> begun; ///< number of each circle, 0 at the end
    std::vector<std::array<MonotonicTime, 2>> arcs;   ///< begin and end of each circle's arc

    /// Drives every circle of the plan.
    StreamSamples drive() {
        for (const PlannedCircle& circle : planned_circles(setup.plan)) {
            begun.emplace_back(circle.number, at(now_s_));
            rest();
            drive(circle.sense);
            rest();
        }
        begun.emplace_back(0, at(now_s_));
        return std::move(stream_);
    }
    /// Samples that the instrument lost; `share` of the way through the stream.
    static void lose(StreamSamples& stream, double share, std::size_t count) {
        const auto first = static_cast<std::size_t>(share * static_cast<double>(stream.at.size()));
        const auto from = static_cast<std::ptrdiff_t>(first);
        const auto to = from + static_cast<std::ptrdiff_t>(count);
        stream.at.erase(stream.at.begin() + from, stream.at.begin() + to);
        stream.value.erase(stream.value.begin() + from, stream.value.begin() + to);
        stream.gaps.push_back({first, count, "gap"});
    }

private:
    static MonotonicTime at(double seconds) {
        return monotonic_from_ns(5'000'000'000 + static_cast<std::int64_t>(seconds * 1e9));
    }
    void put(double deviation_mm) {
        const double seconds = static_cast<double>(sample_) / rate_hz + 0.000'37; // no round phase
        ++sample_;
        if (std::fabs(deviation_mm) > range_mm) return void(hole_ = true);
        if (std::exchange(hole_, false) && !stream_.at.empty())
            stream_.gaps.push_back({stream_.at.size(), 0, "absent"});
        stream_.at.push_back(at(seconds));
        stream_.value.push_back(setup.bar_sign * (deviation_mm + noise_(random_) * noise_mm) *
                                1e-3);
    }
    /// Samples until `seconds` from now, each at its own time since now.
    template <class Reading> void during(double seconds, const Reading& deviation_mm) {
        for (;;) {
            const double t = static_cast<double>(sample_) / rate_hz + 0.000'37 - now_s_;
            if (t >= seconds) break;
            put(deviation_mm(t));
        }
        now_s_ += seconds;
    }
    void rest() {
        during(rest_s, [this](double) { return outside(); });
    }
    [[nodiscard]] double outside() const {
        return setup.plan.feed_in_outside ? setup.plan.feed_in_mm : -setup.plan.feed_in_mm;
    }
    [[nodiscard]] double form(double degrees, Sense sense) const {
        return true_deviation(truth, degrees * one_degree, sense, setup.plan.nominal_radius_mm,
                              setup.plan.feed_mm_per_s);
    }
    void drive(Sense sense) {
        const CircularPlan& plan = setup.plan;
        const Trapezoid radial{plan.feed_in_mm, plan.feed_mm_per_s, acceleration};
        const double from = entry_deg(plan, sense), to = exit_deg(plan, sense);
        const Trapezoid arc{driven_deg(plan) * one_degree * plan.nominal_radius_mm,
                            plan.feed_mm_per_s, acceleration};
        during(radial.duration_s(), [&](double t) {
            return outside() * (1 - radial.way(t) / plan.feed_in_mm) + form(from, sense);
        });
        arcs.push_back({at(now_s_), at(now_s_ + arc.duration_s())});
        during(arc.duration_s(), [&](double t) {
            return form(from + (to - from) * arc.way(t) / arc.length_mm, sense);
        });
        during(radial.duration_s(), [&](double t) {
            return outside() * radial.way(t) / plan.feed_in_mm + form(to, sense);
        });
    }

    StreamSamples stream_;
    double now_s_ = 0;
    std::int64_t sample_ = 0;
    bool hole_ = false;
    std::mt19937_64 random_{20261122};
    std::normal_distribution<double> noise_{0, 1};
};

} // namespace axiscal::test
