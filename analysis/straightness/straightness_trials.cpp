#include "analysis/straightness/straightness_trials.hpp"

#include "analysis/checked_numbers.hpp"
#include "analysis/uncertainty/random_lanes.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace axiscal {
namespace {

constexpr int fewest_trials = 1000, most_trials = 1'000'000;

Result<void> check_error(double u, const char* field) {
    AXISCAL_CHECK(check_case_number(u, field));
    if (u < 0) return refuse(Fault::bad_case, field, "is negative");
    return {};
}

/// Mean and standard deviation, about the undisturbed figure so that no digits are lost.
class Tally {
public:
    explicit Tally(double base)
        : base_{base} {}
    void add(double value) {
        ++count_;
        sum_ += value - base_;
        squares_ += (value - base_) * (value - base_);
    }
    [[nodiscard]] TriedFigure figure() const {
        const double mean = sum_ / count_;
        const double variance = (squares_ - count_ * mean * mean) / (count_ - 1);
        return {base_ + mean, std::sqrt(variance > 0 ? variance : 0)};
    }

private:
    double base_, count_ = 0, sum_ = 0, squares_ = 0;
};

std::array<double, 3> figures_of(const Straightness& found) {
    return {found.end_points.straightness, found.least_squares.straightness,
            found.minimum_zone.line.straightness};
}

/// Eight trials side by side: draw k of trial t stands at k * lanes + t. The first m draws are of
/// the readings, the others of the steps.
MeasuredLine disturbed(const MeasuredLine& line,
                       const StraightnessErrors& errors,
                       const std::vector<double>& draws,
                       std::size_t trial) {
    MeasuredLine out = line;
    const std::size_t m = line.positions.size();
    double shift = 0;
    for (std::size_t i = 0; i < m; ++i) {
        if (i > 0) shift += errors.step_u_um * draws[(m + i - 1) * lanes + trial];
        out.deviations[i] += shift + errors.reading_u_um * draws[i * lanes + trial];
    }
    return out;
}

Result<void> check_order(const StraightnessErrors& errors, int trials) {
    AXISCAL_CHECK(check_error(errors.reading_u_um, "reading_u_um"));
    AXISCAL_CHECK(check_error(errors.step_u_um, "step_u_um"));
    if (trials < fewest_trials || trials > most_trials)
        return refuse(Fault::bad_case, "trials", "must be 1000 to 1000000");
    return {};
}

} // namespace

Result<TriedStraightness> try_straightness(const MeasuredLine& line,
                                           const StraightnessErrors& errors,
                                           int trials,
                                           std::uint64_t seed) {
    AXISCAL_CHECK(check_order(errors, trials));
    AXISCAL_TRY(const Straightness undisturbed, straightness_of(line));
    const std::array<double, 3> base = figures_of(undisturbed);
    std::array<Tally, 3> tallies{Tally{base[0]}, Tally{base[1]}, Tally{base[2]}};
    const std::size_t draws_a_trial = 2 * line.positions.size() - 1;
    std::vector<double> draws(draws_a_trial * lanes);
    RandomLanes random{seed};
    const LaneCode code = fastest_lane_code();
    TriedStraightness out{0, seed, {}};
    while (out.trials < trials) {
        fill_uniform(random, draws.data(), draws_a_trial, code);
        to_normal(draws.data(), draws.size(), code);
        for (std::size_t trial = 0; trial < lanes; ++trial, ++out.trials) {
            AXISCAL_TRY(const Straightness found,
                        straightness_of(disturbed(line, errors, draws, trial)));
            const std::array<double, 3> figures = figures_of(found);
            for (std::size_t k = 0; k < figures.size(); ++k)
                tallies[k].add(figures[k]);
        }
    }
    for (std::size_t k = 0; k < tallies.size(); ++k)
        out.by_reference[k] = tallies[k].figure();
    return out;
}

} // namespace axiscal
