#include "acquisition/capture/capture.hpp"

#include "acquisition/capture/wording.hpp"

#include <algorithm>
#include <span>

namespace axiscal {
namespace {

enum class PathEnd : std::uint8_t { turned, reached_start, samples_missing };

struct Path {
    Length travel;
    PathEnd end = PathEnd::reached_start;
};

Length turning_tolerance(const StillWindow& window, Length overrun) {
    return std::max({overrun / 20, window.statistics.spread, 2.0_um});
}

/// A hole in time is none where the instrument's own numbers go on: the computer was busy and read
/// late, nothing was lost. Number 0: the instrument does not count.
bool misses_samples(const Sample& earlier, const Sample& later, Duration gap) {
    const bool numbered = earlier.device_count != 0 && later.epoch == earlier.epoch;
    if (numbered && later.device_count - earlier.device_count <= 1) return false;
    return later.at - earlier.at > gap;
}

/// The way to the rest, taken from its end backwards. `along` grows towards the target from the
/// claimed side.
class WayBack {
public:
    WayBack(const StillWindow& window, const ApproachClaim& claim, Duration gap, Sample rest)
        : toward_{static_cast<double>(static_cast<int>(claim.direction) * claim.sign)}
        , mean_m_{window.statistics.mean.si()}
        , tolerance_{turning_tolerance(window, claim.overrun)}
        , gap_{gap}
        , later_{rest} {}

    /// @returns what ends the way at this sample, if anything.
    std::optional<PathEnd> take(const Sample& sample) {
        const auto reading = sample.value();
        if (!reading || misses_samples(sample, later_, gap_)) return PathEnd::samples_missing;
        later_ = sample;
        if (along(*reading) > farthest_ + tolerance_) return PathEnd::turned;
        farthest_ = std::min(farthest_, along(*reading));
        return std::nullopt;
    }
    /// Nothing in these samples ends the way: they are taken at once.
    bool take_whole(std::span<const Sample> samples, const SampleSummary& found) {
        const double turn_m = toward_ > 0 ? found.fall_m : found.rise_m;
        const Length low = along(toward_ > 0 ? found.low_m : found.high_m);
        const Length high = along(toward_ > 0 ? found.high_m : found.low_m);
        if (found.good < found.n || found.longest_gap > gap_ || metre(turn_m) > tolerance_ ||
            high > farthest_ + tolerance_ || misses_samples(samples.back(), later_, gap_))
            return false;
        later_ = samples.front();
        farthest_ = std::min(farthest_, low);
        return true;
    }
    [[nodiscard]] Length travel() const { return -farthest_; }
    [[nodiscard]] MonotonicTime reached() const { return later_.at; }

private:
    [[nodiscard]] Length along(double reading_m) const {
        return metre(toward_ * (reading_m - mean_m_));
    }

    double toward_, mean_m_;
    Length tolerance_, farthest_{};
    Duration gap_;
    Sample later_;
};

/// Backwards from the rest, over whole blocks where nothing ends the way.
Path follow_back(const SampleHistory& history,
                 const StillWindow& window,
                 const ApproachClaim& claim,
                 Duration gap) {
    auto samples = history.between(claim.since, window.begin);
    const auto rest = history.between(window.begin, window.end);
    Sample first = rest.empty() ? Sample{} : rest.front();
    first.at = window.begin;
    WayBack way{window, claim, gap, first};
    for (std::size_t levels = SummaryLevels::count; !samples.empty();) {
        const auto [block, level] = history.last_block_of(samples, levels);
        const std::size_t taken = block ? block->n : 1;
        const bool at_once = block && way.take_whole(samples.last(taken), *block);
        levels = at_once || level == 0 ? SummaryLevels::count : level;
        if (levels == level) continue; // a smaller block
        for (std::size_t i = 1; i <= taken && !at_once; ++i)
            if (const auto end = way.take(samples[samples.size() - i])) return {way.travel(), *end};
        samples = samples.first(samples.size() - taken);
    }
    const bool whole = history.reaches_back_to(claim.since) && way.reached() - claim.since <= gap;
    return {way.travel(), whole ? PathEnd::reached_start : PathEnd::samples_missing};
}

/// The largest u(t) of the window: its samples were placed by one fit, so their errors do not
/// average out. Empty when one of them states none.
std::optional<Duration> time_uncertainty_of(std::span<const Sample> samples) {
    Duration largest{};
    for (const Sample& sample : samples) {
        if (sample.time_uncertainty <= Duration{}) return std::nullopt;
        largest = std::max(largest, sample.time_uncertainty);
    }
    return largest;
}

std::vector<WindowSample> good_ones_of(std::span<const Sample> samples) {
    std::vector<WindowSample> good;
    good.reserve(samples.size());
    for (const Sample& sample : samples)
        if (const auto reading = sample.value())
            good.push_back({sample.at, *reading, sample.device_count});
    return good;
}

std::string side_of(Direction direction) {
    return direction == Direction::positive ? "below" : "above";
}

Direction opposite_of(Direction direction) {
    return direction == Direction::positive ? Direction::negative : Direction::positive;
}

/// Why the way from the claimed side is too short, and what to change in the program.
std::string cause_of_short_way(const SampleHistory& history,
                               const StillWindow& window,
                               const ApproachClaim& claim,
                               Duration gap,
                               Length needed) {
    ApproachClaim other = claim;
    other.direction = opposite_of(claim.direction);
    const Length travel = follow_back(history, window, other, gap).travel;
    if (travel >= needed)
        return ": it came " + in_mm(travel) + " from " + side_of(other.direction) +
               ". The program exchanges forward and backward: let it reach this target from " +
               side_of(claim.direction) + ".";
    return ": the program has no overrun before this target, or too little. Let it go further past "
           "the target before it comes back.";
}

} // namespace

Length lost_motion_allowance(Length overrun) {
    return std::min(50.0_um, overrun / 20);
}

Result<Length> approach_travel(const SampleHistory& history,
                               const StillWindow& window,
                               const ApproachClaim& claim,
                               const CaptureConfig& config) {
    const auto path = follow_back(history, window, claim, largest_gap(config));
    const auto needed = claim.overrun - lost_motion_allowance(claim.overrun);
    if (path.travel >= needed) return path.travel;
    const std::string seen = "was seen to come only " + in_mm(path.travel) + " from " +
                             side_of(claim.direction) + ", " + in_mm(needed) + " are needed";
    if (path.end == PathEnd::samples_missing)
        return fail(Fault::samples_lost,
                    "The axis " + seen + "; before that its readings are missing.");
    return fail(Fault::wrong_direction,
                "The axis " + seen +
                    cause_of_short_way(history, window, claim, largest_gap(config), needed));
}

Result<Capture> make_capture(const SampleHistory& history,
                             const StillWindow& window,
                             const std::optional<ApproachClaim>& claim,
                             const CaptureConfig& config) {
    const auto since = claim ? std::min(claim->since, window.begin) : window.begin;
    if (auto lost = find_lost_count(history, history.between(since, window.end), config.fastest))
        return tl::unexpected<Error>(*std::move(lost));
    const auto samples = history.between(window.begin, window.end);
    if (samples.empty() || std::ssize(samples) < window.statistics.n)
        return fail(Fault::samples_lost, "The still window is no longer in the history.");

    const auto& found = window.statistics;
    Capture capture;
    capture.begin = window.begin;
    capture.end = window.end;
    capture.mean = found.mean;
    capture.spread = found.spread;
    capture.slope_um_per_s = found.slope_um_per_s;
    capture.n = found.n;
    capture.synchronisation =
        synchronisation_of(found.slope_um_per_s, time_uncertainty_of(samples));
    capture.epoch = samples.back().epoch;
    capture.device_count = samples.back().device_count;
    capture.samples = good_ones_of(samples);
    if (claim) capture.approach_travel = approach_travel(history, window, *claim, config);
    return capture;
}

} // namespace axiscal
