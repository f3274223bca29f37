// The straightness of an axis through the whole station.
#include "tests/support/full_disk.hpp"
#include "tests/unit/station/straightness_bench.hpp"

#include <utility>
#include <variant>

namespace axiscal::testing::station_straightness_test {
namespace {

class StationStraightness : public ::testing::Test {
protected:
    void whole_run(Life& life) const {
        ASSERT_TRUE(life.arm(order_of_straightness()));
        for (int step = 0; step < 10; ++step)
            ASSERT_TRUE(life.take(step)) << step;
        life.run(2s);
        ASSERT_EQ(life.status().run->state, "complete");
    }
    static RevisionRequest again_of_target(int target) {
        RevisionRequest request;
        request.selection.target = target;
        request.reason = "a door was slammed";
        return request;
    }
    [[nodiscard]] RunFileContents contents() const {
        return read_run_file_contents(shop.run_files().at(0)).value();
    }
    [[nodiscard]] StraightnessSetup setup() const {
        return std::get<StraightnessSetup>(contents().attachments.setup);
    }
    /// Of a target, from the datum.
    [[nodiscard]] double due_um(const PlannedPoint& point) const {
        const RunPlan plan = shop.plan();
        const Length target = plan.targets[static_cast<std::size_t>(point.target_index)];
        return shop.deviation_um(target.in(mm)) - shop.deviation_um(plan.datum.in(mm));
    }
    [[nodiscard]] PlannedPoint planned(int step) const {
        return shop.plan().points[static_cast<std::size_t>(step)];
    }
    StraightnessShop shop;
};

TEST_F(StationStraightness, EveryPointIsTakenAndTheFileHoldsReadingsAndSetUp) {
    Life life{shop};
    whole_run(life);
    const RunFileContents file = contents();
    EXPECT_EQ(file.run.kind, TestKind::straightness);
    EXPECT_TRUE(file.closed && check_complete(file.run));
    EXPECT_EQ(file.run.plan.pass, "straightness");
    EXPECT_EQ(life.status().run->pass, "straightness");
    const Length at_datum = file.run.datums.at(0).reading;
    for (const PointRecord& point : file.run.points) {
        const double seen_um = (point.reading - at_datum).in(um)*factor_across;
        EXPECT_NEAR(seen_um, due_um(point.planned), 1e-6);
        EXPECT_NEAR(point.live_deviation.in(um), seen_um, 1e-9);
        EXPECT_EQ(point.approach_travel, Length{});
    }
    EXPECT_EQ(setup().across, "Y");
    EXPECT_EQ(setup().factor, factor_across);
    EXPECT_EQ(setup().mirror, MirrorPosition::normal);
}

TEST_F(StationStraightness, TheHeaderSpeaksOfTheMotionAcross) {
    shop.config.uncertainty.emplace();
    shop.state_table("across = \"Y\"\nsign = 1\nfactor = 36\nresolution = \"0.1 nm\"\n"
                     "[straightness.optics]\nserial = \"W-7\"\n");
    Life life{shop};
    ASSERT_TRUE(life.arm(order_of_straightness()));
    const RunRecord run = contents().run;
    EXPECT_FALSE(run.uncertainty);
    EXPECT_EQ(run.laser.dead_path, Length{});
    EXPECT_TRUE(run.standards.empty());
    ASSERT_FALSE(run.instruments.empty());
    EXPECT_EQ(run.instruments.back().name, "straightness optics");
    EXPECT_EQ(run.instruments.back().serial, "W-7");
    EXPECT_NEAR(setup().resolution.in(nm), 0.1, 1e-9);
}

TEST_F(StationStraightness, PeopleAreShownHowFarBesideTheLineAndNoPlace) {
    Life life{shop};
    ASSERT_TRUE(life.arm(order_of_straightness()));
    ASSERT_TRUE(life.take(0));
    life.drive_to(planned(1));
    const AxisView axis = life.status().axis;
    EXPECT_FALSE(axis.position_mm);
    ASSERT_TRUE(axis.deviation_um);
    EXPECT_NEAR(*axis.deviation_um, due_um(planned(1)), 1e-6);
    ASSERT_TRUE(life.status().run->last_deviation_um);
    EXPECT_NEAR(*life.status().run->last_deviation_um, due_um(planned(0)), 1e-6);
}

TEST_F(StationStraightness, TheClaimOfTheCncIsThePosition) {
    Life life{shop};
    ASSERT_TRUE(life.arm(order_of_straightness()));
    life.ask(Life::request_for(planned(3), 1));
    life.run(2s);
    ASSERT_EQ(life.port->refusals.size(), 1U);
    EXPECT_EQ(life.port->refusals[0].second, Fault::wrong_target);
    PlannedPoint from_above = planned(0);
    from_above.direction = Direction::negative;
    life.ask(Life::request_for(from_above, 1));
    life.run(2s);
    ASSERT_EQ(life.port->refusals.size(), 2U);
    EXPECT_EQ(life.port->refusals[1].second, Fault::wrong_direction);
    life.ask(Life::request_for(planned(0), 1)); // where it stands and how it came, nobody sees
    life.run(2s);
    EXPECT_EQ(life.port->done, 1);
}

TEST_F(StationStraightness, BeyondTheRangeOfTheOpticsNothingIsTaken) {
    shop.deviation_um = [](double x_mm) { return 5 * x_mm; };
    Life life{shop};
    ASSERT_TRUE(life.arm(order_of_straightness()));
    for (int step = 0; step < 3; ++step)
        ASSERT_TRUE(life.take(step)) << step;
    EXPECT_FALSE(life.take(3));
    ASSERT_EQ(life.port->refusals.size(), 1U);
    EXPECT_EQ(life.port->refusals[0], (std::pair<std::uint16_t, Fault>{4, Fault::outside_window}));
    EXPECT_NE(life.status().run->last_sentence.find("A slope of 5 um/mm over 610 mm leaves the "
                                                    "range of the optics (+- 2.5 mm): align the "
                                                    "mirror."),
              std::string::npos)
        << life.status().run->last_sentence;
    EXPECT_EQ(contents().run.points.size(), 3U);
}

TEST_F(StationStraightness, TheMirrorIsNotedAsItWasSaidAtArming) {
    ArmRequest turned = order_of_straightness();
    turned.options["mirror"] = "reversed";
    Life life{shop};
    ASSERT_TRUE(life.arm(turned));
    EXPECT_EQ(setup().mirror, MirrorPosition::reversed);
}

/// With the mirror's own bow of 3 um a metre beside that of the axis; `side` is -1 where it stands
/// the other way.
std::function<double(double)> with_mirror(double side) {
    return [side](double x_mm) {
        const double share = x_mm / 1000;
        return 20 * share + (40 + side * 12) * share * (1 - share);
    };
}

ArmRequest order_of_reversal(const std::string& which) {
    ArmRequest turned = order_of_straightness();
    turned.options = {{"mirror", "reversed"}, {"reversal_of", which}};
    return turned;
}

TEST_F(StationStraightness, TheRunWithTheMirrorTurnedKeepsTheLinesOfTheFirst) {
    shop.deviation_um = with_mirror(1);
    Life life{shop};
    whole_run(life);
    shop.deviation_um = with_mirror(-1);
    ASSERT_TRUE(life.arm(order_of_reversal("latest")));
    for (int step = 0; step < 10; ++step)
        ASSERT_TRUE(life.take(step)) << step;
    life.run(2s);
    ASSERT_EQ(life.status().run->state, "complete");
    const RunFileContents first = contents();
    const RunFileContents second = read_run_file_contents(shop.run_files().at(1)).value();
    const auto& setup = std::get<StraightnessSetup>(second.attachments.setup);
    EXPECT_EQ(setup.reversal_of, first.run.run_id);
    ASSERT_TRUE(setup.reversal);
    ASSERT_EQ(setup.reversal->rows.size(), shop.plan().targets.size());
    const auto deviation = with_mirror(1);
    for (const RecordedLineRow& row : setup.reversal->rows) {
        const double due = deviation(row.target.in(mm)) - deviation(shop.plan().datum.in(mm));
        EXPECT_NEAR(row.forward.in(um), due / 1.000271, 1e-6);
        EXPECT_NEAR(row.backward->in(um), due / 1.000271, 1e-6);
    }
}

TEST_F(StationStraightness, IsNotArmedByReversalWhereTheMirrorStandsAsBefore) {
    Life life{shop};
    whole_run(life);
    ArmRequest request = order_of_reversal("latest");
    request.options["mirror"] = "normal";
    const auto refused = life.arm(request);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().field, "reversal_of");
    EXPECT_NE(refused.error().detail.find("turn it by 180 degrees"), std::string::npos);
}

TEST_F(StationStraightness, IsNotArmedByReversalOfARunThatIsNotThere) {
    Life life{shop};
    const auto refused = life.arm(order_of_reversal("station-20200101T000000Z-X"));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::not_found);
    EXPECT_NE(refused.error().detail.find("names no complete straightness run of axis X"),
              std::string::npos)
        << refused.error().detail;
}

TEST_F(StationStraightness, IsNotArmedByReversalOfARunWithOtherOpticsOrTargets) {
    {
        Life life{shop};
        whole_run(life);
    }
    const auto refusal = [&](const std::string& table) {
        shop.state_table(table);
        Life life{shop};
        const auto armed = life.arm(order_of_reversal("latest"));
        return armed ? std::string{"armed"} : armed.error().detail;
    };
    const std::string optics = "across = \"Y\"\nsign = 1\nfactor = ";
    EXPECT_NE(refusal(optics + "35\n").find("another factor"), std::string::npos);
    EXPECT_NE(refusal(optics + "36\ntargets = [\"70 mm\", \"270 mm\", \"480 mm\", \"670 mm\", "
                               "\"870 mm\"]\n")
                  .find("other targets"),
              std::string::npos);
}

TEST_F(StationStraightness, IsNotArmedForAWordThatIsNoPositionOfTheMirror) {
    ArmRequest request = order_of_straightness();
    request.options["mirror"] = "turned";
    Life life{shop};
    EXPECT_EQ(life.arm(request).error().field, "options.mirror");
    request.options = {{"prism", "turned"}};
    EXPECT_EQ(life.arm(request).error().field, "options.prism");
    EXPECT_TRUE(shop.run_files().empty());
}

TEST_F(StationStraightness, IsNotArmedWithoutItsTable) {
    shop.config.kind_sections.clear();
    Life life{shop};
    const auto refused = life.arm(order_of_straightness());
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().field, "pass");
    EXPECT_NE(refused.error().detail.find("[straightness]"), std::string::npos);
}

TEST_F(StationStraightness, TheSameStationStillMeasuresPositions) {
    shop.reading_m = nullptr;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    ASSERT_TRUE(life.take(0));
    EXPECT_EQ(contents().run.kind, TestKind::positioning);
    EXPECT_GT(contents().run.points.at(0).approach_travel, mm(4.9));
}

TEST_F(StationStraightness, GoesOnAfterARestart) {
    {
        Life life{shop};
        ASSERT_TRUE(life.arm(order_of_straightness()));
        life.run(10s); // older than what a restart counts again
        for (int step = 0; step < 6; ++step)
            ASSERT_TRUE(life.take(step)) << step;
    }
    shop.now += 20s;
    Life life{shop};
    EXPECT_EQ(life.port->done_before_open, 6);
    for (int step = 6; step < 10; ++step)
        ASSERT_TRUE(life.take(step)) << step;
    life.run(2s);
    const RunRecord run = contents().run;
    EXPECT_TRUE(run.complete && check_complete(run));
    EXPECT_NEAR(run.points.back().live_deviation.in(um), due_um(planned(9)), 1e-6);
}

TEST_F(StationStraightness, IsClosedAfterARestartWhereTheCounterLostItsZero) {
    {
        Life life{shop};
        ASSERT_TRUE(life.arm(order_of_straightness()));
        life.run(10s);
        ASSERT_TRUE(life.take(0));
    }
    shop.now += 20s;
    shop.laser_switched_on = shop.now;
    Life life{shop};
    const RunFileContents file = contents();
    EXPECT_TRUE(file.closed);
    EXPECT_FALSE(file.run.complete);
    EXPECT_NE(file.run.closing_reason.find("The datum is lost"), std::string::npos)
        << file.run.closing_reason;
}

TEST_F(StationStraightness, AFullDiskAcknowledgesNothingUntilItHasRoomAgain) {
    Life life{shop};
    ASSERT_TRUE(life.arm(order_of_straightness()));
    ASSERT_TRUE(life.take(0));
    {
        const FullDisk full;
        EXPECT_FALSE(life.take(1));
        life.run(5s);
        EXPECT_EQ(life.port->done, 1);
    }
    life.port->refusals.clear();
    life.run_until([&] { return life.port->done == 2; });
    for (int step = 2; step < 10; ++step)
        ASSERT_TRUE(life.take(step)) << step;
    life.run_until([&] { return life.status().run->state == "complete"; });
    EXPECT_TRUE(check_complete(contents().run));
}

TEST_F(StationStraightness, PointsAreTakenAgainAfterItWasClosed) {
    Life life{shop};
    whole_run(life);
    ASSERT_TRUE(life.retake(again_of_target(2)));
    ASSERT_TRUE(life.take(2, 11));
    ASSERT_TRUE(life.take(7, 12));
    life.run(2s);
    const RunFileContents file = contents();
    EXPECT_TRUE(file.closed && file.run.complete);
    EXPECT_EQ(file.revisions.superseded.size(), 2U);
    EXPECT_EQ(file.run.points[2].sequence, 11);
}

TEST_F(StationStraightness, PointsAreTakenAgainAfterItWasClosedByAnEarlierDaemon) {
    {
        Life life{shop};
        whole_run(life);
        life.run(20s); // long enough to know how fast the laser counts
    }
    shop.now += 5s;
    Life life{shop};
    const auto answer = life.retake(again_of_target(2));
    ASSERT_TRUE(answer) << describe(answer.error());
    ASSERT_TRUE(life.take(2, 11));
    ASSERT_TRUE(life.take(7, 12));
    life.run(2s);
    const RunFileContents file = contents();
    EXPECT_TRUE(file.closed && file.run.complete);
    EXPECT_NEAR(file.run.points[2].live_deviation.in(um), due_um(planned(2)), 1e-6);
    EXPECT_EQ(file.run.points[2].approach_travel, Length{});
}

} // namespace
} // namespace axiscal::testing::station_straightness_test
