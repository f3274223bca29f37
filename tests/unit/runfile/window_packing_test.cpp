// The samples of a point in the run file: bit for bit, few bytes, damage refused.

#include "acquisition/runfile/window_packing.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace axiscal::window_packing_test {
namespace {

constexpr double laser_step_m = 632.991e-9 / 512;

/// What a laser at 1 kHz shows of an axis that stands at `place_m`: whole counts with 20 nm of noise.
std::vector<WindowSample> still_window(std::size_t count, double place_m, unsigned seed) {
    std::mt19937_64 random{seed};
    std::normal_distribution<double> noise{0, 20e-9};
    std::vector<WindowSample> samples;
    std::int64_t ns = 7'000'000'000;
    for (std::size_t i = 0; i < count; ++i)
        samples.push_back({monotonic_from_ns(ns += 999'999 + static_cast<int>(random() % 3)),
                           std::round((place_m + noise(random)) / laser_step_m) * laser_step_m,
                           1'000'000 + i});
    return samples;
}

std::vector<WindowSample> any_window(std::size_t count, std::mt19937_64& random) {
    std::vector<WindowSample> samples;
    for (std::size_t i = 0; i < count; ++i)
        samples.push_back({monotonic_from_ns(static_cast<std::int64_t>(random())),
                           std::bit_cast<double>(random()), random()});
    return samples;
}

void expect_same_bits(std::span<const WindowSample> a, std::span<const WindowSample> b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].at, b[i].at) << i;
        EXPECT_EQ(std::bit_cast<std::uint64_t>(a[i].reading_m),
                  std::bit_cast<std::uint64_t>(b[i].reading_m))
            << i;
        EXPECT_EQ(a[i].device_count, b[i].device_count) << i;
    }
}

void expect_comes_back(std::span<const WindowSample> samples) {
    const auto back = unpacked_window(packed_window(samples));
    ASSERT_TRUE(back);
    expect_same_bits(samples, *back);
}

TEST(WindowSamples, ShareTheirMemoryWithTheirCopies) { // a second at 50 kHz is a megabyte
    const WindowSamples window{still_window(1000, 0.5, 1)};
    const WindowSamples copy = window;
    EXPECT_EQ(copy.begin(), window.begin());
    EXPECT_EQ(copy.size(), 1000U);
}

TEST(WindowPacking, GivesBackEveryBitOfAnyWindow) {
    std::mt19937_64 random{5};
    for (std::size_t count = 0; count < 200; ++count)
        expect_comes_back(any_window(count, random));
    expect_comes_back(still_window(1000, 0.5, 1));
    constexpr auto most = std::numeric_limits<std::int64_t>::max();
    expect_comes_back(std::vector<WindowSample>{
        {monotonic_from_ns(-most - 1), -0.0, 0},
        {monotonic_from_ns(most), 0.0, std::numeric_limits<std::uint64_t>::max()},
        {monotonic_from_ns(0), std::numeric_limits<double>::denorm_min(), 1}});
}

/// Written down by hand from docs/run-file.md.
TEST(WindowPacking, WritesTheBytesThatTheFormatTells) {
    const std::vector<WindowSample> samples{
        {monotonic_from_ns(1000), 1.0, 7},
        {monotonic_from_ns(2000), 1.0 + std::numeric_limits<double>::epsilon(), 8}};
    const std::string times = "\xD0\x0F" + std::string(1, '\0'); // 1000 folded is 2000; 0
    const std::string readings = "\x80\x80\x80\x80\x80\x80\x80\xF0\x7F\x02";
    const std::string numbers = "\x0E\x0B"; // 7, and 1 - 7
    EXPECT_EQ(packed_window(samples), "\x02" + times + readings + numbers);
    EXPECT_EQ(packed_window({}), std::string(1, '\0'));
}

TEST(WindowPacking, OfAStillLaserTakesAThirdOfTheBytes) {
    for (const double place_m : {0.02, 0.5, 1.9}) {
        const std::size_t bytes = packed_window(still_window(1000, place_m, 2)).size();
        EXPECT_LT(bytes, 8'000U) << place_m;
    }
}

TEST(WindowPacking, RefusesBytesThatAreCutOrHaveMoreBehind) {
    const std::string whole = packed_window(still_window(20, 0.1, 3));
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_FALSE(unpacked_window(std::string_view{whole}.substr(0, size))) << size;
    EXPECT_FALSE(unpacked_window(whole + '\0'));
}

TEST(WindowPacking, RefusesNumbersThatAreLongerThanTheyNeedToBeOrThan64Bits) {
    const auto with_number = [](const std::string& number) {
        return "\x01" + std::string(2, '\0') + number; // of one sample, the number of it
    };
    const std::string nines(9, '\xFF');
    EXPECT_TRUE(unpacked_window(with_number(std::string(1, '\0'))));
    EXPECT_TRUE(unpacked_window(with_number(nines + '\x01')));
    EXPECT_FALSE(unpacked_window(with_number(nines + '\x02')));
    EXPECT_FALSE(unpacked_window(with_number(nines + '\x81' + '\0')));
    EXPECT_FALSE(unpacked_window(with_number(std::string{"\x80\x00", 2})));
}

TEST(WindowPacking, ReservesNothingForACountThatItsBytesCannotHold) {
    const std::string most = std::string(9, '\xFF') + '\x01'; // 2^64 - 1 samples
    EXPECT_FALSE(unpacked_window(most));
    EXPECT_FALSE(unpacked_window(most + std::string(300, '\0')));
    EXPECT_FALSE(unpacked_window("\x65" + std::string(300, '\0'))); // 101 samples in 100
    EXPECT_TRUE(unpacked_window("\x64" + std::string(300, '\0')));
}

} // namespace
} // namespace axiscal::window_packing_test
