#include "tools/axiscal/imports/standstills.hpp"

#include "acquisition/capture/capture.hpp"
#include "acquisition/capture/wording.hpp"
#include "analysis/quantity/counted.hpp"
#include "tools/axiscal/imports/passes.hpp"
#include "tools/axiscal/imports/text_lines.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace axiscal {
namespace {

SampleHistory history_of(std::span<const AxisSample> samples) {
    constexpr Duration all_of_it = std::chrono::hours{24 * 366};
    SampleHistory history{SampleHistory::Limits{all_of_it, samples.size()}};
    for (const AxisSample& sample : samples)
        history.push(Sample{0, sample.at, sample.position_m, sample.number});
    return history;
}

/// A stay near one target; `end` is the sample behind it.
struct Stay {
    std::size_t target = 0, begin = 0, end = 0;
};

std::optional<std::size_t> target_near(const RunPlan& plan, double position_m) {
    const auto above = std::ranges::lower_bound(plan.targets, metre(position_m));
    for (const auto back : {0, 1}) {
        if (above == plan.targets.end() && back == 0) continue;
        if (above == plan.targets.begin() && back == 1) continue;
        const auto at = above - back;
        if (abs(*at - metre(position_m)) <= plan.near_tolerance)
            return static_cast<std::size_t>(at - plan.targets.begin());
    }
    return std::nullopt;
}

std::vector<Stay> stays_in(std::span<const AxisSample> samples, const RunPlan& plan) {
    std::vector<Stay> stays;
    std::optional<std::size_t> last;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const auto target = target_near(plan, samples[i].position_m);
        if (target && target == last)
            stays.back().end = i + 1;
        else if (target)
            stays.push_back({*target, i, i + 1});
        last = target;
    }
    return stays;
}

/// As the map wrote it: 250.25 times a thousandth of a metre is not 250.25 mm.
double as_written_mm(Length target) {
    constexpr double parts = 1e9;
    return std::round(target.in(mm)*parts) / parts;
}

/// What a stay holds: a window, or why there is none.
struct Rest {
    std::optional<StillWindow> window;
    std::string reason;
};

/// The end of the window to be tried before this one: over silence at once.
MonotonicTime end_before(const SampleHistory& history,
                         MonotonicTime first,
                         MonotonicTime end,
                         const CaptureConfig& config,
                         bool silent) {
    constexpr int steps_per_window = 20; // as StillWindowSearch
    if (silent) return history.between(first, end - config.window).back().at;
    return end - config.window / steps_per_window;
}

/// The last still window; where the one a step before it is still as well that one, so that no part
/// of the departure is in its mean. Without one the reason of the window that spreads least.
Rest last_rest_in(std::span<const AxisSample> stay, const CaptureConfig& config) {
    const MonotonicTime first = stay.front().at, last = stay.back().at;
    Rest rest;
    rest.reason = "it was there for " + in_seconds(last - first) + " only, the window is " +
                  in_seconds(config.window) + ".";
    if (last - first < config.window) return rest;
    const SampleHistory history = history_of(stay);
    std::optional<Length> least;
    for (auto end = last; end - config.window >= first;) {
        const auto begin = end - config.window;
        const StillnessVerdict verdict = judge_window(history, begin, end, config);
        const bool found = rest.window.has_value();
        if (verdict.still) rest.window = StillWindow{begin, end, verdict.statistics};
        if (found) return rest;
        const bool silent = verdict.fault == Fault::link_timeout;
        if (!verdict.still && !silent && (!least || verdict.statistics.spread < *least)) {
            least = verdict.statistics.spread;
            rest.reason = verdict.reason;
        }
        end = end_before(history, first, end, config, silent);
    }
    return rest;
}

/// @param place  of the window, for the refusal
Result<void> check_numbers(std::span<const AxisSample> samples,
                           MonotonicTime begin,
                           MonotonicTime end,
                           const std::string& place) {
    const AxisSample* last = nullptr;
    for (const AxisSample& sample : samples) {
        if (sample.at < begin || sample.at > end) continue;
        if (last != nullptr && sample.number > last->number + 1)
            return refuse_line(sample.line,
                               place + ": " +
                                   counted(static_cast<long>(sample.number - last->number - 1),
                                           "sample is", "samples are") +
                                   " lost before this line, within the window that counts");
        last = &sample;
    }
    return {};
}

/// The claim is that of the plan; the positions prove it.
class StandstillSearch {
public:
    StandstillSearch(std::span<const AxisSample> samples, const StandstillMap& map)
        : samples_{samples}
        , map_{map} {}

    Result<std::vector<Captured>> captures() {
        for (const Stay& stay : stays_in(samples_, map_.plan))
            AXISCAL_CHECK(take(stay));
        if (captured_.size() == map_.plan.points.size()) return std::move(captured_);
        return refuse(Fault::bad_case, "file",
                      "ends before the axis has stood at " + place(awaited()) + "." +
                          seen_without_stop());
    }

private:
    [[nodiscard]] const PlannedPoint& awaited() const { return map_.plan.points[captured_.size()]; }
    [[nodiscard]] std::string place(std::size_t target) const {
        return "target " + std::to_string(target + 1) + " (" +
               in_axis_unit(map_.plan.axis_kind, map_.plan.targets[target]) + ")";
    }
    [[nodiscard]] std::string place(const PlannedPoint& point) const {
        return place(static_cast<std::size_t>(point.target_index)) + ", approach " +
               std::to_string(point.approach + 1) +
               (point.direction == Direction::positive ? " forward" : " backward");
    }
    [[nodiscard]] std::size_t line_of(const Stay& stay) const { return samples_[stay.begin].line; }
    /// A sentence, or nothing.
    [[nodiscard]] std::string seen_without_stop() const {
        if (!no_stop_) return {};
        return " At line " + std::to_string(line_of(no_stop_->first)) +
               " it was near that target, but this is no stop: " + no_stop_->second;
    }

    Result<void> take(const Stay& stay) {
        const bool at_begin = stay.begin == 0; // its way is not in the file
        const Rest rest = at_begin ? Rest{{},
                                          "the file begins there, so that nothing shows how it "
                                          "came to it."}
                                   : last_rest_in(of(stay.begin, stay.end), map_.capture);
        if (!rest.window) {
            const bool expected = captured_.size() < map_.plan.points.size() &&
                                  static_cast<int>(stay.target) == awaited().target_index;
            if (expected) no_stop_ = std::pair{stay, rest.reason};
            return {};
        }
        AXISCAL_CHECK(check_planned(stay));
        AXISCAL_CHECK(check_numbers(of(stay.begin, stay.end), rest.window->begin, rest.window->end,
                                    place(awaited())));
        AXISCAL_CHECK(check_approach(stay, *rest.window));
        add(stay, *rest.window);
        return {};
    }

    [[nodiscard]] std::span<const AxisSample> of(std::size_t begin, std::size_t end) const {
        return samples_.subspan(begin, end - begin);
    }

    [[nodiscard]] Result<void> check_planned(const Stay& stay) const {
        if (captured_.size() == map_.plan.points.size())
            return refuse_line(
                line_of(stay),
                "the axis stands at " + place(stay.target) +
                    " after the last point of the plan: state its approaches, or cut "
                    "off what follows the test");
        if (static_cast<int>(stay.target) == awaited().target_index) return {};
        const bool again =
            !captured_.empty() &&
            map_.plan.points[captured_.size() - 1].target_index == static_cast<int>(stay.target);
        const std::string what =
            "the axis stands at " + place(stay.target) + (again ? " once more" : "");
        return refuse_line(line_of(stay),
                           what + ", where the plan has " + place(awaited()) +
                               ": a stop is missing, stands twice or lies farther "
                               "from its target than " +
                               in_axis_unit(map_.plan.axis_kind, map_.plan.near_tolerance) +
                               ", or the map states another cycle." + seen_without_stop());
    }

    [[nodiscard]] Result<void> check_approach(const Stay& stay, const StillWindow& window) const {
        const SampleHistory history = history_of(of(left_, stay.end));
        ApproachClaim claim;
        claim.direction = awaited().direction;
        claim.overrun = map_.plan.overrun;
        claim.since = samples_[left_].at;
        const auto way = history.between(claim.since, window.end);
        if (const auto lost = find_lost_count(history, way, map_.capture.fastest))
            return refuse_line(line_of(stay), place(awaited()) + ": " + lost->detail);
        if (const auto came = approach_travel(history, window, claim, map_.capture); !came)
            return refuse_line(line_of(stay), place(awaited()) + ": " + came.error().detail);
        return {};
    }

    void add(const Stay& stay, const StillWindow& window) {
        const PlannedPoint& point = awaited();
        Captured one;
        one.target = as_written_mm(map_.plan.targets[stay.target]);
        one.reading = window.statistics.mean.in(mm);
        one.says_forward = point.direction == Direction::positive;
        one.pass = "approach " + std::to_string(point.approach + 1) +
                   (*one.says_forward ? " forward" : " backward");
        one.line = line_of(stay);
        captured_.push_back(std::move(one));
        no_stop_.reset();
        const auto stood = of(stay.begin, stay.end);
        const auto after = std::ranges::upper_bound(stood, window.end, {}, &AxisSample::at);
        left_ = stay.begin + static_cast<std::size_t>(after - stood.begin()) - 1;
    }

    std::span<const AxisSample> samples_;
    const StandstillMap& map_;
    std::vector<Captured> captured_;
    std::optional<std::pair<Stay, std::string>> no_stop_; ///< near the awaited target, and why not
    std::size_t left_ = 0;                                ///< the last sample of the last window
};

} // namespace

Result<void> tie_datum(std::vector<AxisSample>& samples, const StandstillMap& map) {
    if (samples.empty()) return refuse(Fault::bad_case, "file", "holds no sample");
    const MonotonicTime begin = samples.front().at, end = begin + map.capture.window;
    const auto after = std::ranges::upper_bound(samples, end, {}, &AxisSample::at);
    const SampleHistory history = history_of({samples.begin(), after});
    const StillnessVerdict verdict = judge_window(history, begin, end, map.capture);
    if (!verdict.still)
        return refuse_line(samples.front().line,
                           "the axis does not stand where the file begins, at the datum " +
                               in_axis_unit(map.plan.axis_kind, map.plan.datum) +
                               " of the map: " + verdict.reason);
    AXISCAL_CHECK(check_numbers({samples.begin(), after}, begin, end, "the datum"));
    const double shift_m = map.plan.datum.si() - verdict.statistics.mean.si();
    for (AxisSample& sample : samples)
        sample.position_m += shift_m;
    return {};
}

Result<LaserReadings> readings_of_standstills(std::span<const AxisSample> samples,
                                              const StandstillMap& map) {
    AXISCAL_TRY(const auto captured, StandstillSearch(samples, map).captures());
    LaserReadings out;
    out.kind = map.plan.axis_kind;
    out.unit = out.target_unit = out.kind == AxisKind::linear ? "mm" : "deg";
    out.positions = true;
    out.order_tells = false; // the way to each target has shown its direction
    AXISCAL_CHECK(add_passes(captured, out));
    return out;
}

} // namespace axiscal
