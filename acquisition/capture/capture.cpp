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

/// Backwards from the rest. `along` grows towards the target from the claimed side.
Path follow_back(const SampleHistory& history,
                 const StillWindow& window,
                 const ApproachClaim& claim,
                 Duration gap) {
    const double toward = static_cast<int>(claim.direction) * claim.sign;
    const auto along = [&](double reading_m) {
        return metre(toward * (reading_m - window.statistics.mean.si()));
    };
    const auto tolerance = turning_tolerance(window, claim.overrun);
    const auto samples = history.between(claim.since, window.begin);
    const auto rest = history.between(window.begin, window.end);
    Length farthest{};
    Sample later = rest.empty() ? Sample{} : rest.front();
    later.at = window.begin;
    for (auto sample = samples.rbegin(); sample != samples.rend(); ++sample) {
        const auto reading = sample->value();
        if (!reading || misses_samples(*sample, later, gap))
            return {-farthest, PathEnd::samples_missing};
        later = *sample;
        const auto place = along(*reading);
        if (place > farthest + tolerance) return {-farthest, PathEnd::turned};
        farthest = std::min(farthest, place);
    }
    const bool whole = history.reaches_back_to(claim.since) && later.at - claim.since <= gap;
    return {-farthest, whole ? PathEnd::reached_start : PathEnd::samples_missing};
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

std::string side_of(Direction direction) {
    return direction == Direction::positive ? "below" : "above";
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
                    ": let the program go further past the target before it comes back.");
}

Result<Capture> make_capture(const SampleHistory& history,
                             const StillWindow& window,
                             const std::optional<ApproachClaim>& claim,
                             const CaptureConfig& config) {
    const auto since = claim ? std::min(claim->since, window.begin) : window.begin;
    if (auto lost = find_lost_count(history.between(since, window.end), config.fastest))
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
    for (const auto& sample : samples)
        if (const auto reading = sample.value())
            capture.samples.push_back({sample.at, *reading, sample.device_count});
    if (claim) capture.approach_travel = approach_travel(history, window, *claim, config);
    return capture;
}

} // namespace axiscal
