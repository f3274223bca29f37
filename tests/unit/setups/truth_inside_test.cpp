// Whether the truth lies where a certificate says: hidden machines, measured by a whole station.
//
//   AXISCAL_MACHINES=N   ten times N machines (100: the table of docs/simulated-truth.md)
//   AXISCAL_SEED=N       other machines
#include "tests/support/asked_seed.hpp"
#include "tests/unit/setups/measured_truth.hpp"

#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

namespace axiscal::hidden_truth_test {
namespace {

struct Count {
    int by_U = 0, by_interval = 0;
    double off_um = 0, U_um = 0, half_um = 0; ///< sums
};

int hidden_machines() {
    const char* text = std::getenv("AXISCAL_MACHINES"); // NOLINT(concurrency-mt-unsafe): one thread
    return 10 * (text == nullptr ? 2 : std::stoi(text));
}

/// So that the next seed has other machines: ten thousand of each.
std::uint64_t machines_before(std::uint64_t seed) {
    return (seed - 1) * 10'000;
}

/// Three standard deviations and seven tenths below 95 in 100: a right interval fails once in 3000
/// figures of 20 machines, once in 6000 of 1000.
int fewest_inside(int n) {
    return static_cast<int>(std::floor(0.95 * n - 3.7 * std::sqrt(0.95 * 0.05 * n)));
}
/// An interval that holds nearly everything says too little.
int most_inside(int n) {
    return n < 1000 ? n : n * 995 / 1000;
}

TEST(TruthInside, TheIntervalOfEachFigureAsOftenAsItSays) {
    spdlog::set_level(spdlog::level::err);
    const int machines = hidden_machines();
    ASSERT_GE(machines, 10);
    const std::uint64_t before = machines_before(axiscal::testing::asked_seed().value_or(1));
    std::map<std::string, Count> counts;
    for (int i = 0; i < machines; ++i) {
        HiddenMachine machine{before + static_cast<std::uint64_t>(i) + 1};
        const MeasuredTruth found = measure(machine);
        ASSERT_EQ(found.why_not, "") << "machine " << i + 1;
        for (const auto& [key, figure] : found.figures) {
            Count& count = counts[key];
            count.by_U += figure.inside_U();
            count.by_interval += figure.inside_interval();
            count.off_um += std::fabs(figure.value - figure.truth);
            count.U_um += figure.U;
            count.half_um += (figure.high - figure.low) / 2;
        }
    }
    EXPECT_EQ(counts.size(), 12U);
    std::printf(
        "of %d machines   in +-U  in interval   mean: off     U   half width of interval (um)\n",
        machines);
    for (const auto& [key, count] : counts) {
        std::printf("%-16s %6.1f %%    %6.1f %%     %8.3f %6.3f %6.3f\n", key.c_str(),
                    100.0 * count.by_U / machines, 100.0 * count.by_interval / machines,
                    count.off_um / machines, count.U_um / machines, count.half_um / machines);
        EXPECT_GE(count.by_interval, fewest_inside(machines)) << key;
        EXPECT_LE(count.by_interval, most_inside(machines)) << key;
        EXPECT_LT(count.half_um, 2.5 * count.U_um) << key << ": far wider than U";
    }
}

} // namespace
} // namespace axiscal::hidden_truth_test
