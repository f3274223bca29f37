#include "analysis/probing/tooth_period.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace axiscal {
namespace {

constexpr std::size_t fewest_readings = 5;
constexpr double steps_a_cycle = 20; // of the scan: the phase between ends moves by 1/20 of a turn
constexpr double most_work = 2e7;    // phases computed: about half a second

double span_of(std::span<const double> values) {
    const auto [low, high] = std::ranges::minmax(values);
    return high - low;
}

double squares_about_mean(std::span<const double> values) {
    double mean = 0;
    for (const double value : values)
        mean += (value - values[0]) / static_cast<double>(values.size());
    double sum = 0;
    for (const double value : values)
        sum += (value - values[0] - mean) * (value - values[0] - mean);
    return sum;
}

/// Readings freed of their slope: they stand on a lattice c + P n.
struct Levels {
    std::vector<double> values; ///< from the first reading on
    int slope = 1;
    double span = 0;
};

Levels levels_of(std::span<const double> approach, std::span<const double> reading, int slope) {
    Levels levels;
    levels.slope = slope;
    for (std::size_t i = 0; i < reading.size(); ++i)
        levels.values.push_back((reading[i] - reading[0]) - slope * (approach[i] - approach[0]));
    levels.span = span_of(levels.values);
    return levels;
}

/// Length of the mean phase vector at a frequency: 1 where all levels stand on the lattice.
struct Phase {
    double coherence = 0, turn = 0;
};
Phase phase_at(const Levels& levels, double frequency) {
    double cosines = 0, sines = 0;
    for (const double value : levels.values) {
        const double turns = value * frequency;
        const double angle = 2 * std::numbers::pi * (turns - std::round(turns));
        cosines += std::cos(angle);
        sines += std::sin(angle);
    }
    return {std::sqrt(cosines * cosines + sines * sines) /
                static_cast<double>(levels.values.size()),
            std::atan2(sines, cosines) / (2 * std::numbers::pi)};
}

struct Candidate {
    Tooth tooth;
    double squares = 0, worst = 0; ///< residuals
};

/// Whole numbers at the frequency, then least squares of c and P, until the numbers stay.
std::optional<Candidate> fit_lattice(const Levels& levels, double frequency) {
    const auto count = static_cast<double>(levels.values.size());
    double period = 1 / frequency;
    double offset = phase_at(levels, frequency).turn * period;
    Candidate candidate;
    for (int round = 0; round < 4; ++round) {
        double mean_n = 0, mean_y = 0, nn = 0, ny = 0;
        std::vector<double> whole;
        for (const double value : levels.values) {
            whole.push_back(std::round((value - offset) / period));
            mean_n += whole.back() / count;
            mean_y += value / count;
        }
        for (std::size_t i = 0; i < whole.size(); ++i) {
            nn += (whole[i] - mean_n) * (whole[i] - mean_n);
            ny += (whole[i] - mean_n) * (levels.values[i] - mean_y);
        }
        if (nn == 0 || ny <= 0) return std::nullopt; // one tooth only: no jump was met
        period = ny / nn;
        offset = mean_y - period * mean_n;
        candidate.squares = candidate.worst = 0;
        for (std::size_t i = 0; i < whole.size(); ++i) {
            const double residual = levels.values[i] - offset - period * whole[i];
            candidate.squares += residual * residual;
            candidate.worst = std::max(candidate.worst, std::fabs(residual));
        }
        candidate.tooth = {period, std::sqrt(candidate.squares / (count - 2) / nn),
                           std::sqrt(candidate.squares / count), levels.slope};
    }
    return candidate;
}

/// The step of which every difference of two readings is a whole multiple: the resolution of the
/// latch. 0: they share none that is coarse beside their variation. Euclid's algorithm.
double grid_of(std::span<const double> reading, double variation) {
    const double rounding = 1e-6 * variation, finest = 1e-4 * variation;
    double grid = 0;
    for (const double value : reading) {
        double rest = std::fabs(value - reading[0]);
        while (rest > rounding) {
            if (grid > 0) rest = std::fabs(rest - grid * std::round(rest / grid));
            if (grid == 0 || rest > rounding) std::swap(grid, rest);
        }
    }
    return grid < finest ? 0 : grid;
}

struct Scan {
    std::span<const double> reading;
    double variation, scatter, grid;

    [[nodiscard]] bool accepts(const Candidate& candidate, double lattices) const {
        const Tooth& tooth = candidate.tooth;
        const double slack = 4 * tooth.residual_rms + 1e-9 * variation;
        return candidate.squares <= 0.1 * scatter && variation <= tooth.period + slack &&
               tooth.period <= 2.05 * variation && chance_of(candidate, lattices) < 1e-3;
    }

    /// Chance that readings which know nothing of the distance come as near to some lattice of the
    /// scan. Such a reading meets a place by the share of the readings that lie there, and no less
    /// than if they were spread evenly: of the few levels of a coarse latch each holds many,
    /// however exactly a lattice goes through them.
    [[nodiscard]] double chance_of(const Candidate& candidate, double lattices) const {
        const auto count = static_cast<double>(reading.size());
        const double near = std::max(candidate.worst, 0.5 * grid);
        const double even = 2 * near / std::min(candidate.tooth.period, variation + grid);
        double logarithm = 0;
        for (const double value : reading) {
            const auto there = std::ranges::count_if(
                reading, [&](double other) { return std::fabs(other - value) <= near; });
            const double share = grid > 0 ? static_cast<double>(there) / count : 0;
            logarithm += std::log(std::min(1.0, std::max(share, even)));
        }
        return lattices * count * std::exp(logarithm * (count - 2) / count);
    }

    void search(const Levels& levels, std::vector<Candidate>& found) const {
        const double lowest = 0.5 / variation, highest = 1 / (0.7 * variation);
        const double step = 1 / (steps_a_cycle * std::max(levels.span, variation));
        const double lattices = 1 + 2 * levels.span * (highest - lowest);
        // the middle of each three is tried when it stands no lower than its neighbours
        double before = 0, here = phase_at(levels, lowest - step).coherence;
        const auto steps = static_cast<std::size_t>((highest - lowest) / step) + 2;
        for (std::size_t k = 0; k <= steps; ++k) {
            const double frequency = lowest + static_cast<double>(k) * step;
            const double after = phase_at(levels, frequency).coherence;
            if (here >= before && here >= after && here > 0.7)
                if (const auto candidate = fit_lattice(levels, frequency - step);
                    candidate && accepts(*candidate, lattices))
                    found.push_back(*candidate);
            before = here;
            here = after;
        }
    }
};

bool same_period(const Candidate& a, const Candidate& b) {
    const double slack = 4 * (a.tooth.standard_uncertainty + b.tooth.standard_uncertainty);
    return std::fabs(a.tooth.period - b.tooth.period) <= slack + 1e-6 * a.tooth.period;
}

/// All readings on one line: no jump was met.
bool is_one_tooth(const Levels& levels, double variation) {
    return levels.span < 0.1 * variation;
}

Result<Tooth> chosen_of(const std::vector<Candidate>& found, const Scan& scan) {
    constexpr double few_levels = 4;
    if (found.empty() && scan.variation < (few_levels - 0.5) * scan.grid)
        return fail(Fault::bad_case,
                    "the readings lie on " +
                        std::to_string(std::lround(scan.variation / scan.grid) + 1) +
                        " levels of their resolution: no saw-tooth stands out of so few");
    if (found.empty())
        return fail(Fault::bad_case, "no saw-tooth stands out of the scatter of the readings");
    const Candidate best = *std::ranges::min_element(found, {}, &Candidate::squares);
    for (const Candidate& other : found)
        if (!same_period(best, other) && other.squares <= 4 * best.squares + 1e-9 * scan.scatter)
            return fail(Fault::bad_case,
                        "more than one period fits these approach distances equally well");
    return best.tooth;
}

} // namespace

Result<Tooth> find_tooth(std::span<const double> approach, std::span<const double> reading) {
    if (reading.size() < fewest_readings) return fail(Fault::bad_case, "fewer than 5 readings");
    const double variation = span_of(reading), travel = span_of(approach);
    const double size = std::fabs(reading[0]) + travel;
    if (!(variation > 1e-12 * size)) // rounding
        return fail(Fault::bad_case, "the readings do not vary");
    if (!(travel > 0)) return fail(Fault::bad_case, "the approach distance does not vary");
    const double work = 40 * (travel / variation + 2) * static_cast<double>(reading.size());
    if (!(work < most_work))
        return fail(Fault::bad_case, "the approach distances span too many periods for a search");
    const Scan scan{reading, variation, squares_about_mean(reading), grid_of(reading, variation)};
    std::vector<Candidate> found;
    for (const int slope : {1, -1}) {
        const Levels levels = levels_of(approach, reading, slope);
        if (is_one_tooth(levels, variation))
            return fail(Fault::bad_case,
                        "the readings follow one flank: the distances span less than a period");
        scan.search(levels, found);
    }
    return chosen_of(found, scan);
}

} // namespace axiscal
