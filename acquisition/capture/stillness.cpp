#include "acquisition/capture/stillness.hpp"

#include "acquisition/capture/wording.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

// Stamps jitter by a bus turn (1 ms FTDI latency, twice), so a jump is judged over a little more
// than the time between two stamps.
constexpr Duration stamp_jitter = std::chrono::milliseconds{2};
// Readings can jump by noise without any motion; below this nothing is called lost.
constexpr Length jump_floor = 20.0_um;
constexpr int starts_per_window = 20;

struct LineFit { // of reading over time, both relative to the first good sample
    double sum_t = 0, sum_r = 0, sum_tt = 0, sum_tr = 0;
    int n = 0;
    void add(double t, double r) {
        sum_t += t, sum_r += r, sum_tt += t * t, sum_tr += t * r;
        ++n;
    }
    [[nodiscard]] double slope() const {
        const double spread_t = sum_tt - sum_t * sum_t / n;
        return spread_t > 0 ? (sum_tr - sum_t * sum_r / n) / spread_t : 0;
    }
};

Fault fault_of(Quality quality) {
    switch (quality) {
    case Quality::beam_lost: return Fault::beam_lost;
    case Quality::signal_error: return Fault::overspeed;
    case Quality::absent: return Fault::signal_error;
    case Quality::good: break;
    }
    return Fault::none;
}

std::string worded(Quality quality) {
    switch (quality) {
    case Quality::beam_lost: return "the beam was lost";
    case Quality::signal_error: return "the instrument flagged its signal (slew or phase error)";
    case Quality::absent: return "the instrument gave no value";
    case Quality::good: break;
    }
    return "good";
}

StillnessVerdict not_still(Fault fault, std::string reason, const WindowStatistics& statistics) {
    return {false, fault, std::move(reason), statistics};
}

std::optional<StillnessVerdict> judge_samples(std::span<const Sample> samples,
                                              const WindowStatistics& statistics,
                                              const CaptureConfig& config) {
    const auto bad = std::find_if(samples.begin(), samples.end(),
                                  [](const Sample& sample) { return !sample.value(); });
    if (bad != samples.end())
        return not_still(fault_of(bad->quality()), "In the window " + worded(bad->quality()) + ".",
                         statistics);
    if (const auto lost = find_lost_count(samples, config.fastest))
        return not_still(lost->fault, lost->detail, statistics);
    return std::nullopt;
}

} // namespace

WindowStatistics measure_window(std::span<const Sample> samples) {
    LineFit line;
    double base = 0, low = 0, high = 0;
    MonotonicTime start{};
    for (const auto& sample : samples) {
        const auto reading = sample.value();
        if (!reading) continue;
        if (line.n == 0) base = *reading, start = sample.at;
        const double relative = *reading - base;
        low = std::min(low, relative);
        high = std::max(high, relative);
        line.add(seconds_of(sample.at - start), relative);
    }
    if (line.n == 0) return {};
    return {line.n, metre(base + line.sum_r / line.n), metre(high - low), line.slope() * 1e6};
}

Duration largest_gap(const CaptureConfig& config) {
    return 2 * config.window / std::max(config.minimum_samples, 1);
}

StillnessVerdict judge_window(std::span<const Sample> samples,
                              MonotonicTime begin,
                              MonotonicTime end,
                              const CaptureConfig& config) {
    const auto found = measure_window(samples);
    if (samples.empty())
        return not_still(Fault::link_timeout, "The instrument sent no samples.", found);
    if (auto bad = judge_samples(samples, found, config)) return *std::move(bad);
    if (found.n < config.minimum_samples)
        return not_still(Fault::not_still,
                         "Only " + counted(found.n, "sample") + " in " + in_seconds(end - begin) +
                             ", " + std::to_string(config.minimum_samples) + " are needed.",
                         found);
    const auto silence = longest_silence(samples, begin, end);
    if (silence > largest_gap(config))
        return not_still(Fault::not_still,
                         "The instrument was silent for " + in_seconds(silence) + " in the window.",
                         found);
    if (found.spread > config.spread_limit)
        return not_still(Fault::not_still,
                         "The readings spread over " + in_um(found.spread) + ", the limit is " +
                             in_um(config.spread_limit) + ".",
                         found);
    if (std::abs(found.slope_um_per_s) > config.slope_limit_um_per_s)
        return not_still(Fault::not_still,
                         "The axis drifts by " + plain_number(found.slope_um_per_s, 3) +
                             " um/s, the limit is " + plain_number(config.slope_limit_um_per_s, 3) +
                             " um/s.",
                         found);
    return {true, Fault::none, {}, found};
}

std::optional<Error> find_lost_count(std::span<const Sample> samples, Speed fastest) {
    const Sample* previous = nullptr; // last good one
    for (const auto& sample : samples) {
        if (sample.epoch != samples.front().epoch)
            return Error{Fault::datum_lost, "The counter lost its zero.", {}, {}};
        if (sample.quality() == Quality::beam_lost)
            return Error{Fault::beam_lost, "The beam was interrupted.", {}, {}};
        if (!sample.value()) continue;
        if (previous != nullptr && fastest.si() > 0) {
            const auto jump = abs(metre(*sample.value() - *previous->value()));
            const double span_s = seconds_of(sample.at - previous->at + stamp_jitter);
            if (jump > jump_floor + metre(fastest.si() * span_s))
                return Error{Fault::implausible_jump,
                             "The reading jumped by " + in_mm(jump) + " within " +
                                 in_seconds(sample.at - previous->at) +
                                 ", faster than the axis can move: counts were lost, tie a new "
                                 "datum.",
                             {},
                             {}};
        }
        previous = &sample;
    }
    return std::nullopt;
}

WindowSearch find_still_window(const SampleHistory& history,
                               MonotonicTime from,
                               MonotonicTime now,
                               const CaptureConfig& config) {
    WindowSearch search;
    const auto since = history.between(from, now);
    search.failure = find_lost_count(since, config.fastest);
    if (search.failure) return search;
    const Duration step = std::max(config.window / starts_per_window, Duration{1});
    search.verdict = {false, Fault::not_still, "The window is not over yet.", {}};
    if (since.empty() && now - from >= config.window)
        search.verdict = judge_window(since, from, now, config);
    // Without samples no start needs to be tried: silence is never still.
    if (since.empty()) return search;
    for (auto begin = from; begin + config.window <= now; begin += step) {
        const auto end = begin + config.window;
        search.verdict = judge_window(history.between(begin, end), begin, end, config);
        if (search.verdict.still) {
            search.window = StillWindow{begin, end, search.verdict.statistics};
            break;
        }
    }
    return search;
}

Error give_up(const WindowSearch& search, Duration waited) {
    if (search.failure) return *search.failure;
    const auto fault =
        search.verdict.fault == Fault::none ? Fault::not_still : search.verdict.fault;
    return Error{fault,
                 "No still window within " + in_seconds(waited) + ". " + search.verdict.reason,
                 {},
                 {}};
}

} // namespace axiscal
