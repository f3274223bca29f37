// The squareness of two axes through the whole station: a run of either, one after the other.
#include "tests/unit/station/squareness_bench.hpp"

#include <utility>
#include <variant>

namespace axiscal::testing::station_squareness_test {
namespace {

/// Of um: what the index of air makes of the 50 um of these lines.
constexpr double air_um = 0.02;

class StationSquareness : public ::testing::Test {
protected:
    /// One life of the daemon; gives back the id of the run.
    std::string measure(ArmRequest request) {
        Life life{shop};
        const auto id = life.arm(std::move(request));
        EXPECT_TRUE(id) << describe(id.error());
        for (int step = 0; step < 10; ++step)
            EXPECT_TRUE(life.take(step)) << step;
        life.run(2s);
        EXPECT_EQ(life.status().run->state, "complete");
        return id.value_or("");
    }
    Error refusal(const ArmRequest& request = order_of_squareness()) {
        Life life{shop};
        const auto id = life.arm(request);
        EXPECT_FALSE(id);
        EXPECT_TRUE(shop.runs_of(TestKind::squareness).size() == already);
        return id ? Error{} : id.error();
    }
    [[nodiscard]] RunFileContents newest() const {
        return shop.runs_of(TestKind::squareness).back();
    }
    [[nodiscard]] SquarenessSetup setup() const {
        return std::get<SquarenessSetup>(newest().attachments.setup);
    }
    /// Of a target, from the datum.
    [[nodiscard]] double due_um(double target_mm) const {
        return shop.deviation_um(target_mm) - shop.deviation_um(shop.plan().datum.in(mm));
    }
    SquarenessShop shop;
    std::size_t already = 0; ///< squareness runs before one that is refused
};

TEST_F(StationSquareness, TheFileAloneHoldsBothLinesAndTheSquare) {
    const std::string first = measure(order_of_straightness());
    shop.look_at_y("square_error = \"1.2 arcsec\"\nsquare_uncertainty = \"0.4 arcsec\"\n"
                   "mount_limit = \"0.3 arcsec\"\n[squareness.optical_square]\nserial = \"S-4\"\n",
                   "across = \"X\"\nsign = 1\nfactor = 36\n[straightness.optics]\n"
                   "serial = \"W-7\"\n");
    measure(order_of_squareness());
    const RunFileContents file = newest();
    EXPECT_TRUE(file.closed && check_complete(file.run));
    EXPECT_EQ(file.run.plan.pass, "squareness");
    EXPECT_EQ(file.run.statements.axis, "Y");
    const auto& instruments = file.run.instruments;
    ASSERT_GE(instruments.size(), 2U);
    EXPECT_EQ(instruments.back().name, "optical square");
    EXPECT_EQ(instruments.back().serial, "S-4");
    EXPECT_EQ((instruments.end() - 2)->serial, "W-7");
    const SquarenessSetup kept = setup();
    EXPECT_EQ(kept.optics.across, "X");
    EXPECT_EQ(kept.square, SquarePosition::normal);
    EXPECT_NEAR(kept.stated.error.value().in(arcsec), 1.2, 1e-9);
    EXPECT_NEAR(kept.stated.error_U.value().in(arcsec), 0.4, 1e-9);
    EXPECT_NEAR(kept.stated.mount_limit.value().in(arcsec), 0.3, 1e-9);
    EXPECT_FALSE(kept.other);
    EXPECT_EQ(kept.first.run_id, first);
}

TEST_F(StationSquareness, TheFirstLineIsThatOfTheOtherRun) {
    measure(order_of_straightness());
    const double from_datum_um = 0.02 * shop.plan().datum.in(mm);
    shop.look_at_y();
    measure(order_of_squareness());
    const RecordedLine first = setup().first;
    EXPECT_EQ(first.axis, "X");
    EXPECT_EQ(first.across, "Y");
    ASSERT_EQ(first.rows.size(), 5U);
    for (const RecordedLineRow& row : first.rows) {
        const double due = 0.02 * row.target.in(mm)-from_datum_um;
        EXPECT_NEAR(row.forward.in(um), due, air_um);
        EXPECT_NEAR(row.backward.value().in(um), due, air_um);
    }
    for (const PointRecord& point : newest().run.points) {
        const auto target = static_cast<std::size_t>(point.planned.target_index);
        EXPECT_NEAR(point.live_deviation.in(um), due_um(shop.plan().targets[target].in(mm)), 1e-6);
        EXPECT_EQ(point.approach_travel, Length{});
    }
}

TEST_F(StationSquareness, AnOlderFirstLineIsTakenWhereItIsNamed) {
    const std::string older = measure(order_of_straightness());
    shop.now += 20s;
    measure(order_of_straightness());
    shop.look_at_y();
    measure(order_of_squareness({{"first", older}}));
    EXPECT_EQ(setup().first.run_id, older);
}

TEST_F(StationSquareness, IsNotArmedWithoutACompleteRunOfTheFirstAxis) {
    {
        Life life{shop};
        ASSERT_TRUE(life.arm(order_of_straightness()));
        ASSERT_TRUE(life.take(0));
        ASSERT_TRUE(life.abort("the beam was cut"));
    }
    shop.look_at_y();
    const Error error = refusal();
    EXPECT_EQ(error.fault, Fault::not_found);
    EXPECT_NE(error.detail.find("squareness.first = \"latest\" names no complete straightness run "
                                "of axis X"),
              std::string::npos)
        << error.detail;
}

TEST_F(StationSquareness, IsNotArmedWhereTheFirstAxisWasMeasuredInAnotherDirection) {
    shop.look_at_x("across = \"Z\"\nsign = 1\nfactor = 36\n");
    measure(order_of_straightness());
    shop.look_at_y();
    const Error error = refusal();
    EXPECT_EQ(error.field, "squareness.first");
    EXPECT_NE(error.detail.find("is E_ZX, X measured in the direction of Z; with this axis, Y "
                                "across X, the first must be E_YX"),
              std::string::npos)
        << error.detail;
}

TEST_F(StationSquareness, IsNotArmedWithOtherOpticsThanTheFirst) {
    shop.look_at_x("across = \"Y\"\nsign = 1\nfactor = 360\n");
    measure(order_of_straightness());
    shop.look_at_y();
    EXPECT_NE(refusal().detail.find("has the factor 360"), std::string::npos);
}

TEST_F(StationSquareness, TheMirrorStandsAsItStoodBefore) {
    ArmRequest reversed = order_of_straightness();
    reversed.options["mirror"] = "reversed";
    measure(reversed);
    shop.look_at_y();
    EXPECT_NE(refusal().detail.find("the mirror stood reversed"), std::string::npos);
    shop.now += 20s;
    measure(order_of_squareness({{"mirror", "reversed"}}));
    EXPECT_EQ(setup().optics.mirror, MirrorPosition::reversed);
}

TEST_F(StationSquareness, IsNotArmedForAWordThatIsNoPositionOfTheSquare) {
    measure(order_of_straightness());
    shop.look_at_y();
    EXPECT_EQ(refusal(order_of_squareness({{"square", "reversed"}})).field, "options.square");
    shop.now += 20s;
    EXPECT_EQ(refusal(order_of_squareness({{"prism", "turned"}})).field, "options.prism");
}

TEST_F(StationSquareness, IsNotArmedWithoutItsTable) {
    const Error error = refusal(); // the station file of X has none
    EXPECT_EQ(error.field, "pass");
    EXPECT_NE(error.detail.find("[straightness] and [squareness]"), std::string::npos);
}

TEST_F(StationSquareness, ByReversalTheLinesOfTheOtherPositionAreKeptToo) {
    const std::string first = measure(order_of_straightness());
    shop.look_at_y();
    const std::string normal = measure(order_of_squareness());
    shop.now += 20s;
    shop.deviation_um = [](double y_mm) { return -0.06 * y_mm; }; // the square's error turned
    measure(order_of_squareness({{"square", "turned"}, {"reversal_of", "latest"}}));
    const SquarenessSetup kept = setup();
    EXPECT_EQ(kept.square, SquarePosition::turned);
    ASSERT_TRUE(kept.other);
    EXPECT_EQ(kept.first.run_id, first);
    EXPECT_EQ(kept.other->first.run_id, first);
    EXPECT_EQ(kept.other->second.run_id, normal);
    EXPECT_EQ(kept.other->second.axis, "Y");
    EXPECT_EQ(kept.other->second.across, "X");
    const auto& rows = kept.other->second.rows;
    ASSERT_EQ(rows.size(), 5U);
    EXPECT_NEAR((rows.back().forward - rows.front().forward).in(um), -0.05 * 800, air_um);
}

TEST_F(StationSquareness, ByReversalTheSquareIsTurned) {
    measure(order_of_straightness());
    shop.look_at_y("reversal_of = \"latest\"\n");
    EXPECT_NE(refusal().detail.find("names no complete squareness run of axis Y"),
              std::string::npos);
    shop.now += 20s;
    const std::string normal = measure(order_of_squareness({{"reversal_of", ""}}));
    shop.now += 20s;
    already = 1;
    const Error error = refusal();
    EXPECT_EQ(error.field, "squareness.reversal_of");
    EXPECT_NE(error.detail.find("The square stands as in run " + normal + ": turn it"),
              std::string::npos)
        << error.detail;
}

TEST_F(StationSquareness, GoesOnAfterARestart) {
    const std::string first = measure(order_of_straightness());
    shop.look_at_y("square_limit = \"2 arcsec\"\n");
    {
        Life life{shop};
        ASSERT_TRUE(life.arm(order_of_squareness()));
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
    const RunRecord run = newest().run;
    EXPECT_TRUE(run.complete && check_complete(run));
    EXPECT_NEAR(run.points.back().live_deviation.in(um), due_um(70), 1e-6);
    EXPECT_EQ(setup().first.run_id, first);
    EXPECT_NEAR(setup().stated.error_limit.value().in(arcsec), 2, 1e-9);
}

TEST_F(StationSquareness, TheLimitsAreAnglesOfTheirOwn) {
    measure(order_of_straightness());
    shop.look_at_y();
    ToleranceRecord& agreed = shop.config.tolerances.emplace();
    agreed.name = "agreed", agreed.source = "order 17", agreed.unit = "um";
    agreed.limits = {{"squareness_least_squares", {}, 15}, {"straightness_R", {}, 5}};
    measure(order_of_squareness());
    const auto kept = newest().run.tolerances;
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->unit, "um/m");
    ASSERT_EQ(kept->limits.size(), 1U);
    EXPECT_EQ(kept->limits[0].limit, 15);
}

} // namespace
} // namespace axiscal::testing::station_squareness_test
