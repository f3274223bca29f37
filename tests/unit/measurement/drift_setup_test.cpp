// How long, how often and where: what a drift test of an axis is held against.
#include "acquisition/measurement/drift/resting_test.hpp"

#include <gtest/gtest.h>

#include <chrono>

namespace axiscal::drift_setup_test {
namespace {

using namespace std::chrono_literals;

class DriftSetups : public ::testing::Test {
protected:
    void SetUp() override {
        config.cycle.travel_low = mm(0);
        config.cycle.travel_high = mm(1000);
        config.axis.sign = 1;
        plan.datum = mm(30);
        request.duration = 60s;
        request.interval = 1s;
    }
    [[nodiscard]] Result<DriftSetup> setup() const {
        return drift_setup_of(config, roles, request, plan);
    }
    [[nodiscard]] std::string refused_field() const {
        const auto refused = setup();
        return refused ? "nothing" : refused.error().field;
    }
    StationConfig config;
    StationRoles roles;
    RunPlan plan;
    DriftRequest request;
};

TEST_F(DriftSetups, RestAtTheEndOfTheTravelThatIsFarFromTheInterferometer) {
    EXPECT_EQ(setup().value().place, mm(1000));
    config.axis.sign = -1;
    EXPECT_EQ(setup().value().place, mm(0));
    request.place_mm = 250;
    EXPECT_EQ(setup().value().place, mm(250));
}

TEST_F(DriftSetups, OfARotaryAxisRestAtItsDatum) {
    plan.axis_kind = AxisKind::rotary;
    EXPECT_EQ(setup().value().place, mm(30));
}

TEST_F(DriftSetups, TakeTheSpansOfTheOrder) {
    const DriftSetup made = setup().value();
    EXPECT_EQ(made.duration, 60s);
    EXPECT_EQ(made.interval, 1s);
    EXPECT_FALSE(made.of_bar);
}

TEST_F(DriftSetups, AreRefusedWithTheFieldThatCannotBe) {
    request.place_mm = 1001;
    EXPECT_EQ(refused_field(), "place_mm");
    request.duration = 1500ms;
    EXPECT_EQ(refused_field(), "duration");
    request.duration = 60s;
    request.interval = config.capture.window / 2;
    EXPECT_EQ(refused_field(), "interval");
}

TEST_F(DriftSetups, BeforeAPolygonAreRefused) {
    config.axis.angle.emplace().setup.method = AngleMethod::polygon;
    EXPECT_NE(setup().error().detail.find("readings are typed"), std::string::npos);
    roles.autocollimator = 0;
    EXPECT_NE(setup().error().detail.find("at the faces of a run alone"), std::string::npos);
}

} // namespace
} // namespace axiscal::drift_setup_test
