// The beam aligned before a run: what is kept stands in the run file.
#include "tests/unit/station/station_bench.hpp"

namespace axiscal::testing::station_align_test {
namespace {

class StationAligns : public ::testing::Test {
protected:
    void SetUp() override { shop.shorten(); }
    static AlignmentOrder order(AlignmentAction action, std::optional<double> spot_mm = {}) {
        return {action, spot_mm};
    }
    void drive(Life& life, double to_mm) {
        shop.axis.go(to_mm, life.scheduler.now());
        life.run(5s);
    }
    std::optional<AlignmentRecord> alignment_of_run() {
        const auto contents = read_run_file_contents(shop.run_files().at(0));
        EXPECT_TRUE(contents);
        return contents ? contents->attachments.alignment : std::nullopt;
    }
    Shop shop;
};

TEST_F(StationAligns, TheLastAlignmentStandsInTheRunFile) {
    Life life{shop};
    ASSERT_TRUE(life.station->align(order(AlignmentAction::begin)));
    EXPECT_TRUE(life.station->alignment().running);
    drive(life, 0);
    drive(life, 1000);
    EXPECT_TRUE(life.station->alignment().at_rest);
    ASSERT_TRUE(life.station->align(order(AlignmentAction::keep, 1.5)));
    EXPECT_FALSE(life.station->alignment().running);
    ASSERT_TRUE(life.arm());
    const auto kept = alignment_of_run();
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->serial, "S-1");
    EXPECT_EQ(kept->travel, mm(1000));
    ASSERT_TRUE(kept->far);
    // The bench's laser reads in vacuum wavelengths: longer by 2.7e-4.
    EXPECT_NEAR(kept->far->distance.in(mm), 1000.27, 1e-6);
    EXPECT_EQ(kept->spot_offset, mm(1.5));
    EXPECT_GT(kept->ended_utc_ns, kept->began_utc_ns);
}

TEST_F(StationAligns, AnAlignmentThatGoesOnIsKeptByArming) {
    Life life{shop};
    ASSERT_TRUE(life.station->align(order(AlignmentAction::begin)));
    drive(life, 500);
    ASSERT_TRUE(life.arm());
    EXPECT_TRUE(alignment_of_run());
    EXPECT_FALSE(life.station->alignment().running);
}

TEST_F(StationAligns, ADroppedOneLeavesTheLastOneKept) {
    Life life{shop};
    ASSERT_TRUE(life.station->align(order(AlignmentAction::begin)));
    life.run(1s); // at the near end
    drive(life, 600);
    ASSERT_TRUE(life.station->align(order(AlignmentAction::keep)));
    ASSERT_TRUE(life.station->align(order(AlignmentAction::begin)));
    drive(life, 100);
    ASSERT_TRUE(life.station->align(order(AlignmentAction::drop)));
    ASSERT_TRUE(life.station->alignment().record);
    EXPECT_NEAR(life.station->alignment().record->reached.in(mm), 600 * (1 + 2.7e-4), 1e-6);
}

TEST_F(StationAligns, WithoutOneTheRunFileHasNone) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    EXPECT_FALSE(alignment_of_run());
}

TEST_F(StationAligns, ThatOfAnotherLaserIsNotTheRunsOwn) {
    Life life{shop};
    ASSERT_TRUE(life.station->align(order(AlignmentAction::begin)));
    drive(life, 500);
    ASSERT_TRUE(life.station->align(order(AlignmentAction::keep)));
    life.laser->unplugged = true;
    life.run(5s);
    life.laser->serial = "S-2";
    life.laser->unplugged = false;
    life.run(20s);
    ASSERT_TRUE(life.arm());
    EXPECT_FALSE(alignment_of_run());
}

// The truth: 90 % less 5 % on each 100 mm, told once a second to an axis that drives 300 mm in that
// second. A strength that was kept for the readings after it would stand 15 % too high.
TEST_F(StationAligns, AStrengthStandsAtThePlaceWhereItWasTold) {
    const auto strength_at = [](double at_mm) { return 90.0 - at_mm * 0.05; };
    shop.laser_strength = [&](MonotonicTime at) { return strength_at(shop.axis.at(at)); };
    shop.axis.speed_mm_per_s = 300;
    Life life{shop};
    ASSERT_TRUE(life.station->align(order(AlignmentAction::begin)));
    drive(life, 0);
    drive(life, 900);
    const auto record = life.station->alignment().record;
    ASSERT_TRUE(record);
    ASSERT_GE(record->places.size(), 3U);
    for (const AlignmentPlace& place : record->places) {
        // The reading comes 5 ms after the strength: 1.5 mm; the beam reads 0.3 mm long.
        const double before_mm = place.begin.in(mm)-2, behind_mm = place.end.in(mm) + 2;
        EXPECT_LE(place.mean_percent, strength_at(before_mm)) << before_mm;
        EXPECT_GE(place.weakest_percent, strength_at(behind_mm)) << behind_mm;
    }
    EXPECT_NEAR(record->places.back().last_percent, 45, 1e-9);
    EXPECT_LE(record->places.back().readings, 6); // five seconds, not a thousand readings
}

TEST_F(StationAligns, AStrengthThatIsOlderThanTwoSecondsIsStaleInTheStatus) {
    shop.laser_strength = [](MonotonicTime) { return 82.0; };
    Life life{shop};
    const auto strength = [&life] {
        const StationStatus status = life.status();
        const auto told =
            std::ranges::find(status.channels, ChannelKind::strength, &ChannelView::kind);
        return told == status.channels.end() ? ChannelView{} : *told;
    };
    EXPECT_EQ(life.status().axis.least_strength_percent, 20.0);
    EXPECT_EQ(strength().stale_after_s, 2.0);
    EXPECT_EQ(strength().value, 82.0);
    life.laser->silent = true;
    life.run(2100ms);
    EXPECT_EQ(strength().quality, "stale");
    EXPECT_FALSE(strength().value);
    EXPECT_FALSE(life.status().axis.strength_percent);
}

TEST_F(StationAligns, IsRefusedWhileARunIsOpen) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    const auto refused = life.station->align(order(AlignmentAction::begin));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::busy);
}

TEST_F(StationAligns, NothingCanBeKeptThatWasNotSeen) {
    Life life{shop};
    EXPECT_EQ(life.station->align(order(AlignmentAction::keep)).error().fault, Fault::not_found);
    life.laser->quality = Quality::beam_lost;
    ASSERT_TRUE(life.station->align(order(AlignmentAction::begin)));
    life.run(2s);
    EXPECT_EQ(life.station->align(order(AlignmentAction::keep)).error().fault, Fault::beam_lost);
    EXPECT_TRUE(life.station->alignment().running);
}

TEST_F(StationAligns, NothingIsKeptOfABeamThatWasSeenAtOnePlace) {
    Life life{shop};
    ASSERT_TRUE(life.station->align(order(AlignmentAction::begin)));
    life.run(2s);
    const auto refused = life.station->align(order(AlignmentAction::keep));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::refused);
    EXPECT_NE(refused.error().detail.find("50 mm or more"), std::string::npos);
    drive(life, 49);
    EXPECT_FALSE(life.station->align(order(AlignmentAction::keep)));
    drive(life, 51);
    EXPECT_TRUE(life.station->align(order(AlignmentAction::keep)));
}

} // namespace
} // namespace axiscal::testing::station_align_test
