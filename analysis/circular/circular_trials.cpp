#include "analysis/circular/circular_trials.hpp"

#include "analysis/uncertainty/random_lanes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace axiscal::circular {
namespace {

/// Draws one after another out of the eight lanes: the same on every compiler and CPU.
class Draws {
public:
    explicit Draws(std::uint64_t seed)
        : random_{seed} {}
    /// Rectangular of full width `width` about 0.
    double rectangular(double width) { return width * next(uniform_, false); }
    double normal(double sigma) { return sigma * next(normal_, true); }

private:
    struct Stock {
        std::array<double, 32 * lanes> draws{};
        std::size_t used = 32 * lanes;
    };
    double next(Stock& stock, bool normal) {
        if (stock.used == stock.draws.size()) {
            const LaneCode code = fastest_lane_code();
            fill_uniform(random_, stock.draws.data(), stock.draws.size() / lanes, code);
            if (normal) to_normal(stock.draws.data(), stock.draws.size(), code);
            stock.used = 0;
        }
        return stock.draws[stock.used++];
    }
    RandomLanes random_;
    Stock uniform_, normal_;
};

constexpr std::size_t most_readings = 720;

CircularTest thinned(const CircularTest& test) {
    CircularTest out = test;
    for (CircularTrace& trace : out.traces) {
        const std::size_t stride = (trace.angle_rad.size() + most_readings - 1) / most_readings;
        std::size_t kept = 0;
        for (std::size_t i = 0; i < trace.angle_rad.size(); i += stride, ++kept) {
            trace.angle_rad[kept] = trace.angle_rad[i];
            trace.radial_deviation_mm[kept] = trace.radial_deviation_mm[i];
        }
        trace.angle_rad.resize(kept);
        trace.radial_deviation_mm.resize(kept);
    }
    return out;
}

struct ReadRange {
    double middle = 0, width = 0;
};
ReadRange range_of(const CircularTest& test) {
    double low = test.traces.front().radial_deviation_mm.front(), high = low;
    for (const CircularTrace& trace : test.traces) {
        const auto [least, most] = std::ranges::minmax(trace.radial_deviation_mm);
        low = std::min(low, least);
        high = std::max(high, most);
    }
    return {(low + high) / 2, high - low};
}

/// One trial's readings.
CircularTest
disturbed(const CircularTest& test, const ReadRange& range, const Disturbances& by, Draws& draws) {
    CircularTest out = test;
    const double turn = range.width > 0 ? draws.rectangular(by.device_width_mm) / range.width : 0;
    const double length = draws.normal(by.calibration_u_mm);
    const double center_x = draws.rectangular(by.centre_width_mm);
    const double center_y = draws.rectangular(by.centre_width_mm);
    for (CircularTrace& trace : out.traces) {
        double start = 0, end = 0;
        for (int run = 0; run < by.runs; ++run) {
            start += draws.rectangular(by.eve_mm) / by.runs;
            end += draws.rectangular(by.eve_mm) / by.runs;
        }
        const auto last = static_cast<double>(trace.angle_rad.size() - 1);
        for (std::size_t i = 0; i < trace.angle_rad.size(); ++i) {
            const double read = trace.radial_deviation_mm[i], angle = trace.angle_rad[i];
            trace.radial_deviation_mm[i] += turn * (read - range.middle) + length + start +
                                            (end - start) * static_cast<double>(i) / last +
                                            center_x * std::cos(angle) + center_y * std::sin(angle);
        }
    }
    return out;
}

BarExpansion disturbed(const BarExpansion& bar, const Disturbances& by, Draws& draws) {
    BarExpansion out = bar;
    out.machine_degC += draws.rectangular(by.machine_temperature_width_K);
    out.bar_degC += draws.rectangular(by.bar_temperature_width_K);
    out.machine_alpha_per_K += draws.rectangular(by.machine_alpha_width_per_K);
    out.bar_alpha_per_K += draws.rectangular(by.bar_alpha_width_per_K);
    return out;
}

} // namespace

std::map<std::string, double> figures_by_key(const CircularParameters& parameters) {
    std::map<std::string, double> figures;
    for (const Sense sense : {Sense::ccw, Sense::cw}) {
        const auto& seen = parameters.of(sense);
        if (!seen) continue;
        const std::string suffix = "_" + std::string{name_of(sense)};
        figures["G" + suffix] = seen->G.minimum_zone_mm;
        figures["F_max" + suffix] = seen->F.max_mm;
        figures["F_min" + suffix] = seen->F.min_mm;
    }
    if (parameters.G_b) figures["G_b"] = parameters.G_b->minimum_zone_mm;
    if (parameters.D_mm) figures["D"] = *parameters.D_mm;
    for (const auto& [key, reason] : parameters.not_evaluated)
        figures.erase(key);
    return figures;
}

Result<std::map<std::string, double>> try_circular(const CircularTest& test,
                                                   RadialCentre f_centre,
                                                   const std::optional<BarExpansion>& bar,
                                                   const Disturbances& disturbances,
                                                   int trials,
                                                   std::uint64_t seed) {
    const CircularTest base = thinned(test);
    const ReadRange range = range_of(base);
    Draws draws{seed};
    struct Moments {
        double mean = 0, squares = 0;
    };
    std::map<std::string, Moments> moments;
    const double repeat = disturbances.repeatability_mm / std::sqrt(disturbances.runs);
    for (int trial = 1; trial <= trials; ++trial) {
        const CircularTest tried = disturbed(base, range, disturbances, draws);
        std::optional<BarExpansion> warm;
        if (bar) warm = disturbed(*bar, disturbances, draws);
        AXISCAL_TRY(const CircularParameters seen, evaluate_circular(tried, f_centre, warm));
        for (const auto& [key, figure] : figures_by_key(seen)) {
            const double value = figure + draws.normal(repeat);
            auto& [mean, squares] = moments[key];
            const double step = value - mean;
            mean += step / trial;
            squares += step * (value - mean);
        }
    }
    std::map<std::string, double> deviations;
    for (const auto& [key, moment] : moments)
        deviations[key] = trials > 1 ? std::sqrt(moment.squares / (trials - 1)) : 0;
    return deviations;
}

} // namespace axiscal::circular
