#include "analysis/uncertainty/random_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <vector>

namespace axiscal::random_lanes_test {
namespace {

double normal_probability(double z) {
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

std::vector<double> normals(std::uint64_t seed, std::size_t draws) {
    RandomLanes random{seed};
    std::vector<double> numbers(draws * lanes);
    fill_uniform(random, numbers.data(), draws, fastest_lane_code());
    to_normal(numbers.data(), numbers.size(), fastest_lane_code());
    return numbers;
}

/// The quantile of q + 1/2, in each lane's place.
double quantile(double q, LaneCode code = LaneCode::baseline) {
    std::vector<double> numbers(lanes, q);
    to_normal(numbers.data(), lanes, code);
    EXPECT_EQ(numbers.front(), numbers.back());
    return numbers.front();
}

TEST(RandomLanes, FollowThePublishedSequenceOfXoshiro256Plus) {
    // the authors' reference implementation with the state 1, 2, 3, 4
    const std::vector<std::uint64_t> published{5u,
                                               211106232532999u,
                                               211106635186183u,
                                               9223759065350669058u,
                                               9250833439874351877u,
                                               13862484359527728515u,
                                               2346507365006083650u,
                                               1168864526675804870u,
                                               34095955243042024u,
                                               3466914240207415127u};
    for (const LaneCode code : {LaneCode::baseline, fastest_lane_code()}) {
        RandomLanes random{0};
        for (std::size_t word = 0; word < 4; ++word)
            random.state[word].fill(word + 1);
        std::vector<double> q(published.size() * lanes);
        fill_uniform(random, q.data(), published.size(), code);
        for (std::size_t i = 0; i < q.size(); ++i)
            EXPECT_EQ(q[i], (static_cast<double>(published[i / lanes] >> 12) + 0.5) * 0x1p-52 - 0.5)
                << i;
    }
}

TEST(RandomLanes, AreSeededByThePublishedSequenceOfSplitmix64) {
    const RandomLanes random{1477776061723855037u}; // the authors' reference implementation
    EXPECT_EQ(random.state[0][0], 1985237415132408290u);
    EXPECT_EQ(random.state[1][0], 2979275885539914483u);
    EXPECT_EQ(random.state[2][0], 13511426838097143398u);
    EXPECT_EQ(random.state[3][0], 8488337342461049707u);
    EXPECT_EQ(random.state[0][1], 15141737807933549159u);
}

TEST(RandomLanes, GiveTheSameBitsWithEveryInstructionSet) {
    RandomLanes first{7}, second{7};
    std::vector<double> a(4096 * lanes), b = a;
    fill_uniform(first, a.data(), 4096, LaneCode::baseline);
    fill_uniform(second, b.data(), 4096, fastest_lane_code());
    EXPECT_EQ(a, b);
    EXPECT_EQ(first.state, second.state);
    to_normal(a.data(), a.size(), LaneCode::baseline);
    to_normal(b.data(), b.size(), fastest_lane_code());
    EXPECT_EQ(a, b);
}

TEST(RandomLanes, DoNotFollowEachOther) {
    const std::size_t draws = 100'000;
    const std::vector<double> numbers = normals(3, draws);
    for (std::size_t one = 0; one < lanes; ++one)
        for (std::size_t other = 0; other <= one; ++other) {
            double product = 0;
            for (std::size_t draw = 1; draw < draws; ++draw) // a lane with its own past, too
                product += numbers[draw * lanes + one] *
                           numbers[(one == other ? draw - 1 : draw) * lanes + other];
            EXPECT_LT(std::fabs(product) / std::sqrt(draws), 4.5) << one << ' ' << other;
        }
}

TEST(NormalQuantile, AgreesWithPublishedValues) {
    const std::map<double, double> published{
        {0.9, 1.2815515655446004},   {0.95, 1.6448536269514722},   {0.975, 1.959963984540054},
        {0.99, 2.3263478740408408},  {0.995, 2.5758293035489004},  {0.999, 3.090232306167813},
        {0.9999, 3.719016485455709}, {0.999999, 4.753424308822899}};
    for (const auto& [p, z] : published) {
        EXPECT_NEAR(quantile(p - 0.5) / z, 1, 1.2e-9) << p;
        EXPECT_EQ(quantile(0.5 - p), -quantile(p - 0.5)) << p;
    }
}

TEST(NormalQuantile, InvertsTheDistributionToItsBoundEverywhere) {
    double worst = 0;
    for (double p = 0x1p-53; p < 0.4999; p *= 1.003) {
        const double q = p - 0.5, z = quantile(q);
        const double density = std::exp(-z * z / 2) / std::sqrt(2 * std::acos(-1.0));
        worst = std::max(worst, std::fabs((normal_probability(z) - (0.5 + q)) / density / z));
    }
    EXPECT_LT(worst, 1.2e-9);
    EXPECT_GT(worst, 1e-10); // it is the approximation that it says it is
    EXPECT_TRUE(std::isfinite(quantile(-0.5 + 0x1p-53)));
}

TEST(NormalQuantile, RisesAcrossTheSeamsOfItsThreePieces) {
    for (const double seam : {0.47575, -0.47575})
        for (double step = 1e-6; step > 1e-8; step /= 2)
            EXPECT_LT(quantile(seam - step), quantile(seam + step)) << seam;
}

TEST(NormalDraws, HaveTheMomentsOfANormalDistribution) {
    const std::vector<double> numbers = normals(11, 500'000);
    const auto size = static_cast<double>(numbers.size());
    double moments[5] = {};
    for (const double z : numbers)
        for (int power = 1; power <= 4; ++power)
            moments[power] += std::pow(z, power) / size;
    // variances of the sample moments of N(0, 1): 1, 2, 15, 96 over the size
    EXPECT_NEAR(moments[1], 0, 4 / std::sqrt(size));
    EXPECT_NEAR(moments[2], 1, 4 * std::sqrt(2 / size));
    EXPECT_NEAR(moments[3], 0, 4 * std::sqrt(15 / size));
    EXPECT_NEAR(moments[4], 3, 4 * std::sqrt(96 / size));
}

TEST(NormalDraws, HaveTheTailsOfANormalDistribution) {
    const std::vector<double> numbers = normals(12, 1'000'000);
    const auto size = static_cast<double>(numbers.size());
    for (const double z : {1.0, 1.97, 2.0, 3.0, 4.0, 4.8}) {
        const double expected = size * normal_probability(-z);
        const auto above = std::ranges::count_if(numbers, [&](double x) { return x > z; });
        const auto below = std::ranges::count_if(numbers, [&](double x) { return x < -z; });
        EXPECT_NEAR(static_cast<double>(above), expected, 4.5 * std::sqrt(expected)) << z;
        EXPECT_NEAR(static_cast<double>(below), expected, 4.5 * std::sqrt(expected)) << z;
    }
}

TEST(NormalDraws, PassTheKolmogorovSmirnovTest) {
    std::vector<double> numbers = normals(13, 125'000);
    std::ranges::sort(numbers);
    const auto size = static_cast<double>(numbers.size());
    double distance = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double p = normal_probability(numbers[i]), rank = static_cast<double>(i);
        distance = std::max({distance, p - rank / size, (rank + 1) / size - p});
    }
    EXPECT_LT(distance * std::sqrt(size), 1.63); // exceeded by one sample in a hundred
    EXPECT_GT(distance * std::sqrt(size), 0.35); // and as rarely below this: no lattice
}

} // namespace
} // namespace axiscal::random_lanes_test
