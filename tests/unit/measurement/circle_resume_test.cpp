// An open circular test after a restart: the stream's truth is the driven bar's, cut off where the
// daemon died.

#include "acquisition/measurement/circular/circle_resume.hpp"
#include "tests/unit/analysis/driven_bar.hpp"

#include <gtest/gtest.h>

namespace axiscal::circle_resume_test {
namespace {

using Decision = CircleResume::Decision;

/// Two circles at 10 m/min, driven; requests 1 and 2 durable at their begins.
struct Recorded {
    test::DrivenBar bar;
    StreamSamples stream;
    RunRecord run;
    BarNow now;
    Recorded() {
        bar.setup.plan.nominal_radius_mm = 50;
        bar.setup.plan.feed_mm_per_s = 1000.0 / 6;
        bar.setup.plan.overshoot_deg = 45;
        stream = bar.drive();
        run.config_hash = now.config_hash = "c";
        run.boot_id = now.boot_id = {"b"};
        now.bar = Sample{0, stream.at.back() + std::chrono::seconds{3}, 1e-6, 20'000, 0};
        now.speaks = true;
        now.limits.rate_hz = 1000;
    }
    void begin(std::uint16_t circle) {
        run.events.push_back(
            {EventKind::note, bar.begun[circle - 1U].second, 0, "", Fault::none, circle});
    }
    void die_after(std::size_t samples) {
        stream.at.resize(samples);
        stream.value.resize(samples);
    }
    CircleResume decide(std::optional<std::uint64_t> last_count = {}) {
        std::optional<CounterSighting> last;
        if (last_count) last = CounterSighting{stream.at.back(), metre(0), *last_count};
        return decide_circle_resume({run, bar.setup, stream, last}, now);
    }
    [[nodiscard]] std::size_t samples_of_one() const { return stream.at.size() / 2; }
};

TEST(CircleResume, WithoutACircleNothingIsLost) {
    Recorded from;
    from.die_after(300);
    const auto verdict = from.decide();
    EXPECT_EQ(verdict.decision, Decision::go_on);
    EXPECT_EQ(verdict.before.last, 0);
    EXPECT_NE(verdict.sentence.find("No circle had begun"), std::string::npos);
}

TEST(CircleResume, ACircleIsWholeOnceItsFeedOutIsStored) {
    Recorded from;
    from.begin(1);
    Recorded cut = from;
    from.die_after(from.samples_of_one()); // the rest after the first circle
    EXPECT_TRUE(from.decide().before.whole);
    EXPECT_EQ(from.decide().before.last, 1);
    cut.die_after(cut.samples_of_one() / 2);
    EXPECT_EQ(cut.decide().decision, Decision::go_on);
    EXPECT_FALSE(cut.decide().before.whole);
    EXPECT_NE(cut.decide().sentence.find("has to be driven again"), std::string::npos);
}

TEST(CircleResume, AHoleInACircleLeavesItNotWhole) {
    Recorded from;
    from.begin(1);
    from.die_after(from.samples_of_one());
    test::DrivenBar::lose(from.stream, 0.5, 50);
    EXPECT_FALSE(from.decide().before.whole);
}

TEST(CircleResume, AfterTheLastRequestOnlyTheClosingIsMissing) {
    Recorded from;
    from.begin(1);
    from.begin(2);
    from.run.events.push_back({EventKind::note, from.bar.begun[2].second, 0, "", Fault::none, 3});
    from.now.speaks = false; // not needed any more
    EXPECT_EQ(from.decide().decision, Decision::close_complete);
}

TEST(CircleResume, AnotherBootAnotherFileOrASilentBarEndTheTest) {
    Recorded from;
    from.now.boot_id = {"b2"};
    EXPECT_EQ(from.decide().decision, Decision::close_incomplete);
    EXPECT_NE(from.decide().sentence.find("computer was restarted"), std::string::npos);
    from.run.boot_id = from.now.boot_id = {};
    EXPECT_EQ(from.decide().decision, Decision::close_incomplete);
    EXPECT_NE(from.decide().sentence.find("nobody can tell whether"), std::string::npos);
    from.now.config_hash = "c2";
    EXPECT_EQ(from.decide().fault, Fault::bad_configuration);
    Recorded silent;
    silent.now.speaks = false;
    EXPECT_EQ(silent.decide().fault, Fault::link_timeout);
}

TEST(CircleResume, AnInterferometerMustHaveCountedOn) {
    Recorded from;
    from.now.incremental = true;
    EXPECT_EQ(from.decide(17'000).decision, Decision::go_on); // 3 s of 1 kHz
    EXPECT_EQ(from.decide(25'000).fault, Fault::datum_lost);  // its count began anew
    EXPECT_EQ(from.decide().fault, Fault::datum_lost);        // nothing numbers its samples
    from.now.bar.reset();
    EXPECT_EQ(from.decide(17'000).fault, Fault::datum_lost); // out of its range: no proof
}

} // namespace
} // namespace axiscal::circle_resume_test
