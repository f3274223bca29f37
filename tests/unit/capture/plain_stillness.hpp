#pragma once
// The search for a still window as one would write it down: every window looked at anew, sample by
// sample. The oracle of the search that forgets nothing and walks over nothing.

#include "acquisition/capture/stillness.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace axiscal::testing {

struct PlainWindow {
    int n = 0;
    double mean_m = 0, spread_m = 0, slope_um_per_s = 0;
};

/// Least squares about the means of time and reading, in extended precision.
inline PlainWindow plain_window(const std::vector<Sample>& samples) {
    std::vector<std::pair<long double, long double>> good;
    for (const Sample& sample : samples)
        if (const auto value = sample.value())
            good.emplace_back(
                static_cast<long double>(sample.at.time_since_epoch().count()) * 1e-9L, *value);
    PlainWindow found;
    found.n = static_cast<int>(good.size());
    if (good.empty()) return found;
    long double mean_t = 0, mean_r = 0, spread_t = 0, both = 0;
    for (const auto& [t, r] : good)
        mean_t += t / found.n, mean_r += r / found.n;
    for (const auto& [t, r] : good)
        spread_t += (t - mean_t) * (t - mean_t), both += (t - mean_t) * (r - mean_r);
    const auto [low, high] = std::minmax_element(
        good.begin(), good.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    found.mean_m = static_cast<double>(mean_r);
    found.spread_m = static_cast<double>(high->second - low->second);
    found.slope_um_per_s = spread_t > 0 ? static_cast<double>(both / spread_t * 1e6L) : 0;
    return found;
}

/// The fault by which a count was lost, or none.
inline Fault plain_loss(const std::vector<Sample>& samples, Speed fastest) {
    const Sample* previous = nullptr;
    for (const Sample& sample : samples) {
        if (sample.epoch != samples.front().epoch) return Fault::datum_lost;
        if (sample.quality() == Quality::beam_lost) return Fault::beam_lost;
        if (!sample.value()) continue;
        if (previous != nullptr && fastest.si() > 0) {
            const double jump_m = std::abs(*sample.value() - *previous->value());
            const double span_s = seconds_of(sample.at - previous->at) + 2e-3;
            if (jump_m > 20e-6 + fastest.si() * span_s) return Fault::implausible_jump;
        }
        previous = &sample;
    }
    return Fault::none;
}

/// What speaks against the window, Fault::none where it is still.
inline Fault plain_judgement(const std::vector<Sample>& samples,
                             MonotonicTime begin,
                             MonotonicTime end,
                             const CaptureConfig& config) {
    if (samples.empty()) return Fault::link_timeout;
    for (const Sample& sample : samples) {
        if (sample.quality() == Quality::beam_lost) return Fault::beam_lost;
        if (sample.quality() == Quality::signal_error) return Fault::overspeed;
        if (sample.quality() == Quality::absent) return Fault::signal_error;
    }
    if (const Fault loss = plain_loss(samples, config.fastest); loss != Fault::none) return loss;
    Duration silence = samples.front().at - begin;
    for (std::size_t i = 1; i < samples.size(); ++i)
        silence = std::max(silence, Duration{samples[i].at - samples[i - 1].at});
    silence = std::max(silence, Duration{end - samples.back().at});
    const PlainWindow found = plain_window(samples);
    const bool still = found.n >= config.minimum_samples &&
                       silence <= 2 * config.window / config.minimum_samples &&
                       found.spread_m <= config.spread_limit.si() &&
                       std::abs(found.slope_um_per_s) <= config.slope_limit_um_per_s;
    return still ? Fault::none : Fault::not_still;
}

struct PlainSearch {
    Fault failure = Fault::none, verdict = Fault::not_still;
    std::optional<MonotonicTime> begin; ///< of the still window
    PlainWindow window;
};

/// Of all the samples that have come; later ones and earlier ones do not count.
inline PlainSearch plain_search(const std::vector<Sample>& all,
                                MonotonicTime from,
                                MonotonicTime now,
                                const CaptureConfig& config) {
    const auto between = [&all](MonotonicTime begin, MonotonicTime end) {
        std::vector<Sample> part;
        for (const Sample& sample : all)
            if (sample.at >= begin && sample.at <= end) part.push_back(sample);
        return part;
    };
    PlainSearch search;
    search.failure = plain_loss(between(from, now), config.fastest);
    if (search.failure != Fault::none) return search;
    for (auto begin = from; begin + config.window <= now; begin += config.window / 20) {
        const auto samples = between(begin, begin + config.window);
        search.verdict = plain_judgement(samples, begin, begin + config.window, config);
        if (search.verdict != Fault::none) continue;
        search.begin = begin;
        search.window = plain_window(samples);
        return search;
    }
    return search;
}

} // namespace axiscal::testing
