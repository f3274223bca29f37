#include "acquisition/capture/stillness.hpp"

#include "acquisition/capture/wording.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

constexpr int starts_per_window = 20;

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

/// The sample by which a count was lost, after those before it.
Error lost_by(const Sample& sample, const SampleSummary& before) {
    if (sample.epoch != before.first_epoch)
        return Error{Fault::datum_lost, "The counter lost its zero.", {}, {}};
    if (sample.quality() == Quality::beam_lost)
        return Error{Fault::beam_lost, "The beam was interrupted.", {}, {}};
    const Length jump = abs(metre(sample.value().value_or(0) - before.last_good_m));
    return Error{Fault::implausible_jump,
                 "The reading jumped by " + in_mm(jump) + " within " +
                     in_seconds(sample.at - before.last_good_at) +
                     ", faster than the axis can move: counts were lost, tie a new datum.",
                 {},
                 {}};
}

/// Everything but what only a lost count's own sample tells.
StillnessVerdict judge_summary(const SampleSummary& found,
                               MonotonicTime begin,
                               MonotonicTime end,
                               const CaptureConfig& config) {
    const WindowStatistics statistics = statistics_of(found);
    if (statistics.n < config.minimum_samples)
        return not_still(Fault::not_still,
                         "Only " + counted(statistics.n, "sample") + " in " +
                             in_seconds(end - begin) + ", " +
                             std::to_string(config.minimum_samples) + " are needed.",
                         statistics);
    const auto silence = longest_silence(found, begin, end);
    if (silence > largest_gap(config))
        return not_still(Fault::not_still,
                         "The instrument was silent for " + in_seconds(silence) + " in the window.",
                         statistics);
    if (statistics.spread > config.spread_limit)
        return not_still(Fault::not_still,
                         "The readings spread over " + in_um(statistics.spread) +
                             ", the limit is " + in_um(config.spread_limit) + ".",
                         statistics);
    if (std::abs(statistics.slope_um_per_s) > config.slope_limit_um_per_s)
        return not_still(Fault::not_still,
                         "The axis drifts by " + plain_number(statistics.slope_um_per_s, 3) +
                             " um/s, the limit is " + plain_number(config.slope_limit_um_per_s, 3) +
                             " um/s.",
                         statistics);
    return {true, Fault::none, {}, statistics};
}

} // namespace

WindowStatistics statistics_of(const SampleSummary& samples) {
    return {static_cast<int>(samples.good), metre(samples.mean_m()), metre(samples.spread_m()),
            samples.slope() * 1e6};
}

Duration largest_gap(const CaptureConfig& config) {
    return 2 * config.window / std::max(config.minimum_samples, 1);
}

StillnessVerdict judge_window(const SampleHistory& history,
                              MonotonicTime begin,
                              MonotonicTime end,
                              const CaptureConfig& config) {
    const auto samples = history.between(begin, end);
    const SampleSummary found = history.summary_of(samples);
    const WindowStatistics statistics = statistics_of(found);
    if (samples.empty())
        return not_still(Fault::link_timeout, "The instrument sent no samples.", statistics);
    if (found.first_bad != Quality::good)
        return not_still(fault_of(found.first_bad),
                         "In the window " + worded(found.first_bad) + ".", statistics);
    if (const auto lost = find_lost_count(history, samples, config.fastest))
        return not_still(lost->fault, lost->detail, statistics);
    return judge_summary(found, begin, end, config);
}

std::optional<Error>
find_lost_count(const SampleHistory& history, std::span<const Sample> samples, Speed fastest) {
    if (!history.summary_of(samples).lost_count(fastest)) return std::nullopt;
    // Once a count is lost it stays so: the shortest beginning with a loss ends at its sample.
    std::size_t whole = 1, lost = samples.size();
    while (whole < lost) {
        const std::size_t middle = whole + (lost - whole) / 2;
        if (history.summary_of(samples.first(middle)).lost_count(fastest))
            lost = middle;
        else
            whole = middle + 1;
    }
    const auto before = lost > 1 ? samples.first(lost - 1) : samples.first(1);
    return lost_by(samples[lost - 1], history.summary_of(before));
}

StillWindowSearch::StillWindowSearch(MonotonicTime from, const CaptureConfig& config)
    : config_{config}
    , step_{std::max(config.window / starts_per_window, Duration{1})}
    , from_{from}
    , next_{from} {
    rejected_ = not_still(Fault::not_still, "The window is not over yet.", {});
}

/// The first start whose window reaches the next sample; without one the last start of all.
MonotonicTime StillWindowSearch::start_after_silence(const SampleHistory& history,
                                                     MonotonicTime begin,
                                                     MonotonicTime now) const {
    const MonotonicTime last_start = now - config_.window;
    const auto later = history.between(begin, now);
    const MonotonicTime wanted =
        later.empty() ? last_start : std::min(later.front().at - config_.window, last_start);
    const auto steps = std::max(Duration{wanted - begin}, step_) / step_;
    return begin + steps * step_;
}

WindowSearch StillWindowSearch::look(const SampleHistory& history, MonotonicTime now) {
    WindowSearch search;
    const auto since = history.between(from_, now);
    search.failure = find_lost_count(history, since, config_.fastest);
    if (search.failure) return search;
    search.verdict = rejected_;
    // Without samples no start needs to be tried: silence is never still.
    if (since.empty()) {
        if (now - from_ >= config_.window)
            search.verdict = judge_window(history, from_, now, config_);
        return search;
    }
    // A sample may still come for a window that does not end before the newest one.
    const MonotonicTime settled = history.newest()->at;
    for (auto begin = next_; begin + config_.window <= now;) {
        const auto end = begin + config_.window;
        search.verdict = judge_window(history, begin, end, config_);
        if (search.verdict.still) {
            search.window = StillWindow{begin, end, search.verdict.statistics};
            break;
        }
        const bool silent = search.verdict.fault == Fault::link_timeout;
        const auto next = silent ? start_after_silence(history, begin, now) : begin + step_;
        if (end < settled) {
            next_ = next;
            rejected_ = search.verdict;
        }
        begin = next;
    }
    return search;
}

Error not_still(const WindowSearch& search, Duration waited) {
    if (search.failure) return *search.failure;
    const auto fault =
        search.verdict.fault == Fault::none ? Fault::not_still : search.verdict.fault;
    return Error{fault,
                 "No still window within " + in_seconds(waited) + ". " + search.verdict.reason,
                 {},
                 {}};
}

} // namespace axiscal
