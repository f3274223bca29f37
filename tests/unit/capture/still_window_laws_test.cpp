// Laws of the search for a still window, over random streams: what a plain search finds that looks
// at every sample each time.
#include "acquisition/capture/capture.hpp"
#include "acquisition/capture/stillness.hpp"

#include "axis_signal.hpp"
#include "plain_stillness.hpp"

#include <gtest/gtest.h>
#include <random>

namespace axiscal::still_window_laws_test {
namespace {

using testing::at_s;

/// A stream with everything that a wire does to one: gaps, equal stamps, samples from the past, bad
/// qualities, lost zeros, jumps, stretches of rest and of motion, and samples that come late.
class RandomStream {
public:
    explicit RandomStream(std::uint64_t seed)
        : random_{seed}
        , period_{std::chrono::microseconds{std::uniform_int_distribution{200, 4000}(random_)}}
        , rude_{chance(0.6)} {}

    bool chance(double share) { return std::bernoulli_distribution{share}(random_); }
    int upto(int most) { return std::uniform_int_distribution{0, most}(random_); }

    void push_next() {
        if (chance(0.002)) moving_ = !moving_;
        now_ += chance(0.01) ? Duration{} : period_ * (50 + upto(100)) / 100;
        if (chance(0.003)) now_ += std::chrono::milliseconds{upto(150)};
        if (moving_) place_m_ += 2e-6;
        if (rude_ && chance(0.00003)) ++epoch_;
        if (rude_ && chance(0.00003)) place_m_ += 0.2;
        const auto at = rude_ && chance(0.003) ? now_ - period_ * upto(5) : now_;
        push(sample_at(at));
    }
    [[nodiscard]] MonotonicTime now() const { return now_; }

    SampleHistory history;
    std::vector<Sample> kept; ///< in order: one that is older than the last does not count

private:
    Sample sample_at(MonotonicTime at) {
        const double noise_m = std::normal_distribution{0.0, 0.25e-6}(random_);
        if (rude_ && chance(0.00005)) return Sample::bad(0, at, Quality::beam_lost, 0, epoch_);
        if (chance(0.0005))
            return Sample::bad(0, at, chance(0.5) ? Quality::absent : Quality::signal_error, 0,
                               epoch_);
        return {0, at, 1.5 + place_m_ + noise_m, 0, epoch_};
    }
    void push(const Sample& sample) {
        history.push(sample);
        if (kept.empty() || sample.at >= kept.back().at) kept.push_back(sample);
    }

    std::mt19937_64 random_;
    Duration period_;
    bool rude_, moving_ = true;
    double place_m_ = 0;
    std::uint32_t epoch_ = 1;
    MonotonicTime now_ = at_s(100);
};

CaptureConfig limits_for(RandomStream& stream) {
    CaptureConfig config = testing::quiet_config();
    config.window = std::chrono::milliseconds{40 + stream.upto(300)} +
                    std::chrono::nanoseconds{stream.upto(50)};
    config.minimum_samples = 5 + stream.upto(10);
    config.slope_limit_um_per_s = 2;
    return config;
}

void expect_same(const WindowSearch& search, const testing::PlainSearch& plain) {
    ASSERT_EQ(search.failure ? search.failure->fault : Fault::none, plain.failure);
    ASSERT_EQ(search.window.has_value(), plain.begin.has_value()) << search.verdict.reason;
    if (plain.failure == Fault::none) {
        ASSERT_EQ(search.verdict.fault, plain.verdict) << search.verdict.reason;
    }
    if (!plain.begin) return;
    EXPECT_EQ(search.window->begin, *plain.begin);
    EXPECT_EQ(search.window->statistics.n, plain.window.n);
    EXPECT_NEAR(search.window->statistics.mean.si(), plain.window.mean_m, 1e-14);
    EXPECT_NEAR(search.window->statistics.spread.si(), plain.window.spread_m, 1e-14);
    EXPECT_NEAR(search.window->statistics.slope_um_per_s, plain.window.slope_um_per_s, 1e-6);
}

/// Looks every 20 ms, at samples of which the last may not have come yet.
bool search_one(std::uint64_t seed) {
    RandomStream stream{seed};
    const CaptureConfig config = limits_for(stream);
    for (int i = stream.upto(300); i > 0; --i)
        stream.push_next();
    const MonotonicTime from = stream.now() + std::chrono::milliseconds{stream.upto(30)};
    StillWindowSearch still{from, config};
    MonotonicTime now = from;
    for (int look = 0; look < 60; ++look) {
        now += std::chrono::milliseconds{20};
        const auto come = now + std::chrono::milliseconds{10 - stream.upto(40)};
        while (stream.now() < come)
            stream.push_next();
        const WindowSearch search = still.look(stream.history, now);
        expect_same(search, testing::plain_search(stream.kept, from, now, config));
        if (::testing::Test::HasFailure()) return false;
        if (search.failure || search.window) return search.window.has_value();
    }
    return false;
}

TEST(StillWindowSearch, LawFindsWhatALookAtEverySampleFinds) {
    int found = 0;
    constexpr int streams = 300;
    for (std::uint64_t seed = 1; seed <= streams; ++seed) {
        if (search_one(seed)) ++found;
        ASSERT_FALSE(HasFailure()) << "seed " << seed;
    }
    EXPECT_GT(found, streams / 10) << "the streams must hold rests";
    EXPECT_LT(found, streams) << "and more than rests";
}

TEST(SampleSummary, LawOfAnyStretchIsThatOfItsSamples) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        RandomStream stream{seed};
        for (int i = 0; i < 20'000; ++i)
            stream.push_next();
        const auto all = stream.history.all();
        for (int turn = 0; turn < 50; ++turn) {
            const auto begin = static_cast<std::size_t>(stream.upto(19'000)) % all.size();
            const auto size = static_cast<std::size_t>(stream.upto(20'000)) % (all.size() - begin);
            const auto part = all.subspan(begin, size);
            const SampleSummary found = stream.history.summary_of(part);
            const std::vector<Sample> copy{part.begin(), part.end()};
            const testing::PlainWindow plain = testing::plain_window(copy);
            ASSERT_EQ(found.n, part.size());
            ASSERT_EQ(static_cast<int>(found.good), plain.n);
            ASSERT_NEAR(found.mean_m(), plain.mean_m, 1e-13);
            ASSERT_NEAR(found.spread_m(), plain.spread_m, 1e-14);
            ASSERT_NEAR(found.slope() * 1e6, plain.slope_um_per_s, 1e-5);
            const auto lost = find_lost_count(stream.history, part, metre_per_second(1));
            ASSERT_EQ(lost ? lost->fault : Fault::none,
                      testing::plain_loss(copy, metre_per_second(1)));
        }
    }
}

TEST(SampleSummary, IsThatOfWhatAHistoryStillHolds) {
    SampleHistory history{{std::chrono::hours{1}, 5000}};
    for (int i = 0; i < 300'000; ++i) {
        history.push(Sample{0, at_s(1 + i * 1e-3), i * 1e-9});
        if (i % 4999 != 0) continue;
        const auto found = history.summary_of(history.all());
        ASSERT_EQ(found.n, history.all().size());
        ASSERT_EQ(found.last_good_m, i * 1e-9);
        ASSERT_NEAR(found.spread_m(), static_cast<double>(found.n - 1) * 1e-9, 1e-15);
    }
}

/// The way back sample by sample, as capture.hpp describes it; no sample is missing.
Length plain_travel(std::span<const Sample> samples, double mean_m, double toward, Length turn) {
    Length farthest{};
    for (auto sample = samples.rbegin(); sample != samples.rend(); ++sample) {
        const Length along = metre(toward * (*sample->value() - mean_m));
        if (along > farthest + turn) break;
        farthest = std::min(farthest, along);
    }
    return -farthest;
}

TEST(ApproachTravel, LawIsThatOfAWalkOverEverySample) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        testing::AxisSignal signal{seed};
        std::mt19937_64 random{seed};
        signal.wobble_um = 0.02 * static_cast<double>(random() % 100);
        const auto since = signal.now();
        for (int move = 0; move < 6; ++move)
            signal
                .move_to(static_cast<double>(random() % 200) * 0.1,
                         1 + static_cast<double>(random() % 100))
                .stand(0.2 + 0.001 * static_cast<double>(random() % 3000));
        for (int move = 0; move < 12; ++move) // by as much as turns the way and less
            signal.move_to(signal.position_mm() + 1e-4 * static_cast<double>(random() % 61) - 3e-3,
                           0.05);
        signal.stand(0.11);
        const auto end = signal.now(), begin = end - std::chrono::milliseconds{100};
        const StillWindow window{begin, end,
                                 statistics_of(summary_of(signal.history.between(begin, end)))};
        for (const Direction direction : {Direction::positive, Direction::negative}) {
            // An overrun of 0.04 mm and less turns by 2 um; of 5 mm by 0.25 mm.
            for (const Length overrun : {mm(0.04), mm(5)}) {
                const ApproachClaim claim{direction, 1, overrun, since};
                const Length turn = std::max({overrun / 20, window.statistics.spread, 2.0_um});
                const Length walked =
                    plain_travel(signal.history.between(since, begin), window.statistics.mean.si(),
                                 static_cast<int>(direction), turn);
                const auto seen =
                    approach_travel(signal.history, window, claim, testing::quiet_config());
                if (seen)
                    EXPECT_EQ(seen->si(), walked.si()) << "seed " << seed;
                else
                    EXPECT_LT(walked, overrun - lost_motion_allowance(overrun)) << "seed " << seed;
            }
        }
    }
}

} // namespace
} // namespace axiscal::still_window_laws_test
