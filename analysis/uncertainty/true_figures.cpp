#include "analysis/uncertainty/true_figures.hpp"

#include "analysis/uncertainty/random_lanes.hpp"
#include "analysis/uncertainty/session_kernel.hpp"
#include "analysis/uncertainty/session_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace axiscal {
namespace {

using OfLanes = std::array<double, lanes>;

/// A random walk through the readings in the order of time.
struct Walk {
    std::vector<std::size_t> order; ///< rows of readings, the earliest first
    std::vector<double> steps;      ///< standard deviation of each step; the first is 0
    double even_step = 0;           ///< of a walk as long whose steps are all alike
};

Walk walk_through(const std::vector<double>& seconds) {
    Walk walk;
    walk.order.resize(seconds.size());
    std::iota(walk.order.begin(), walk.order.end(), std::size_t{0});
    std::ranges::stable_sort(walk.order, {}, [&](std::size_t i) { return seconds[i]; });
    const bool timed = seconds[walk.order.back()] > seconds[walk.order.front()];
    walk.steps.assign(seconds.size(), 0.0);
    for (std::size_t k = 1; k < seconds.size(); ++k)
        walk.steps[k] = timed ? std::sqrt(seconds[walk.order[k]] - seconds[walk.order[k - 1]]) : 1;
    const auto steps = static_cast<double>(seconds.size() - 1);
    const double lasted = seconds[walk.order.back()] - seconds[walk.order.front()];
    walk.even_step = timed ? std::sqrt(lasted / steps) : 1;
    return walk;
}

/// E_VE, whose u is that of a rectangular distribution.
double range_of(const SessionErrors& errors) {
    return factor_of_draw(errors.environment_u, Distribution::rectangular);
}

class TrueSessions {
public:
    static constexpr std::size_t mean_reversal = 11; ///< B_mean, the only figure with a sign

    TrueSessions(SessionModel model,
                 const SessionErrors& errors,
                 Walk walk,
                 const EvaluatedFigures& evaluated,
                 std::uint64_t seed)
        : still_{std::move(model)}
        , drifting_{still_}
        , walk_{std::move(walk)}
        , eve_{range_of(errors)}
        , evaluated_{evaluated.values}
        , random_{seed}
        , scratch_{still_} {
        drifting_.environment = 1;
        for (const SessionErrors::Common& one : errors.common)
            (one.distribution == Distribution::normal ? normal_ : even_).push_back(one);
        numbers_.resize((even_.size() + normal_.size() + 2 * walk_.order.size()) * lanes);
        drift_.resize(still_.readings() * lanes);
    }

    const Figures& next() {
        draw();
        const OfLanes common = common_errors();
        evaluate_sessions(still_, drift_.data(), common, scratch_, figures_, code_);
        evaluate_sessions(drifting_, drift_.data(), OfLanes{}, scratch_, moved_, code_);
        evaluate_sessions(drifting_, drift_.data(), common, scratch_, without_, code_);
        for (std::size_t f = 0; f < figure_count; ++f)
            for (std::size_t l = 0; l < lanes; ++l)
                figures_[f][l] = is_largest(f) && l % 2 == 1
                                     ? without_[f][l]
                                     : less_added(f, figures_[f][l], moved_[f][l]);
        return figures_;
    }

private:
    void draw() {
        const std::size_t even = even_.size() * lanes;
        fill_uniform(random_, numbers_.data(), numbers_.size() / lanes, code_);
        to_normal(numbers_.data() + even, numbers_.size() - even, code_);
        const double* steps = numbers_.data() + even + normal_.size() * lanes;
        walk(steps);
        scale_drift(range_of_walk(steps + walk_.order.size() * lanes));
    }

    void walk(const double* step) {
        OfLanes at{};
        for (std::size_t k = 0; k < walk_.order.size(); ++k)
            for (std::size_t l = 0; l < lanes; ++l) {
                at[l] += walk_.steps[k] * *step++;
                drift_[walk_.order[k] * lanes + l] = at[l];
            }
    }

    /// Of the walk that stands for the drift test: as long as the run, without its pauses.
    [[nodiscard]] OfLanes range_of_walk(const double* step) const {
        OfLanes at{}, low{}, high{};
        for (std::size_t k = 1; k < walk_.order.size(); ++k)
            for (std::size_t l = 0; l < lanes; ++l) {
                at[l] += walk_.even_step * *step++;
                low[l] = std::min(low[l], at[l]);
                high[l] = std::max(high[l], at[l]);
            }
        for (std::size_t l = 0; l < lanes; ++l)
            high[l] -= low[l];
        return high;
    }

    void scale_drift(const OfLanes& range) {
        for (std::size_t r = 0; r < walk_.order.size(); ++r)
            for (std::size_t l = 0; l < lanes; ++l)
                drift_[r * lanes + l] *= range[l] > 0 ? eve_ / range[l] : 0;
    }

    /// What lies between the readings and the truth over the whole length.
    [[nodiscard]] OfLanes common_errors() const {
        OfLanes sum{};
        const double* draw = numbers_.data();
        for (const auto* group : {&even_, &normal_})
            for (const SessionErrors::Common& one : *group) {
                const double factor = factor_of_draw(one.u, one.distribution);
                const double from = one.one_sided ? 0.5 : 0; // a draw lies between -1/2 and 1/2
                for (std::size_t l = 0; l < lanes; ++l)
                    sum[l] += factor * (*draw++ + from);
            }
        return sum;
    }

    /// `value` less what a drift adds to the figure. Spreads add as squares, all else as it is.
    [[nodiscard]] double less_added(std::size_t figure, double value, double moved) const {
        const double measured = evaluated_[figure];
        if (figure >= first_spread && figure <= last_spread)
            return std::sqrt(std::max(value * value + measured * measured - moved * moved, 0.0));
        const double left = value + measured - moved;
        return figure == mean_reversal ? left : std::max(left, 0.0);
    }
    /// Of all targets. With its drift taken off it comes out too large, less what a drift adds too
    /// small: half of the sessions each.
    static bool is_largest(std::size_t figure) {
        return figure >= first_spread && figure < mean_reversal;
    }

    /// In the order of uncertain_parameters(): R, R_forward, R_backward.
    static constexpr std::size_t first_spread = 7, last_spread = 9;

    SessionModel still_, drifting_;
    Walk walk_;
    double eve_;
    std::array<double, figure_count> evaluated_;
    RandomLanes random_;
    LaneCode code_ = fastest_lane_code();
    SessionScratch scratch_;
    std::vector<SessionErrors::Common> even_, normal_;
    std::vector<double> numbers_, drift_; ///< [draw][lane], [reading][lane]
    Figures figures_{}, moved_{}, without_{};
};

Result<void> check_request(const RunAt20C& run,
                           const std::vector<double>& seconds,
                           const MonteCarloRequest& request) {
    AXISCAL_CHECK(check_equal_rows(run));
    AXISCAL_CHECK(check_trials(number_of_readings(run), request));
    constexpr std::size_t fewest_readings =
        10; // two walks of a few steps say nothing of each other
    if (number_of_readings(run) < fewest_readings)
        return refuse(Fault::bad_case, "readings", "must be ten or more");
    if (seconds.size() != number_of_readings(run))
        return refuse(Fault::bad_case, "seconds", "must be as many as the readings");
    return {};
}

} // namespace

const TrueFigure* TrueFigures::find(std::string_view key) const {
    const auto found = std::ranges::find(figures, key, &TrueFigure::key);
    return found == figures.end() ? nullptr : &*found;
}

Result<TrueFigures> simulate_true_figures(const RunAt20C& run,
                                          const PositioningResult& result,
                                          const SessionErrors& errors,
                                          const std::vector<double>& seconds,
                                          const MonteCarloRequest& request) {
    AXISCAL_CHECK(check_request(run, seconds, request));
    const std::size_t groups = (static_cast<std::size_t>(request.trials) + lanes - 1) / lanes;
    const EvaluatedFigures evaluated = evaluated_figures(result.parameters);
    TrueSessions sessions{session_model_of(run, result, errors.length), errors,
                          walk_through(seconds), evaluated, request.seed};
    const FigureTally tally = tally_of(sessions, groups, evaluated.values);
    TrueFigures out{static_cast<int>(groups * lanes), request.seed, {}};
    for (const std::size_t f : evaluated.present) {
        Interval lies_in = tally.intervals(f).symmetric;
        // the tally spreads sessions of 0 over their bucket, which reaches below it
        if (f != TrueSessions::mean_reversal) lies_in.low = std::max(lies_in.low, 0.0);
        out.figures.push_back({uncertain_parameters()[f], lies_in});
    }
    return out;
}

} // namespace axiscal
