// A station whose axis a linear scale measures: nothing is asked of air, nothing of it is kept.
#include "tests/unit/station/station_bench.hpp"

#include "analysis/compensation/thermal_compensation.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace axiscal::station_scale_test {
namespace {

using testing::Life;
using testing::Shop;
using namespace std::chrono_literals;

/// Machine at 22.5 degC (contact 1), scale at 22.7 degC (contact 2), both grown by that.
class StationWithScale : public ::testing::Test {
protected:
    void SetUp() override {
        shop.shorten();
        AxisConfig& axis = shop.config.axis;
        axis.air_temperature = axis.air_pressure = axis.air_humidity = {};
        axis.material_temperature = {{"material", "contact 1"}};
        axis.material.form = ExpansionForm::exact;
        ScaleConfig scale;
        scale.setup.coefficient = per_kelvin(10e-6);
        scale.temperature = {{"material", "contact 2"}};
        axis.scale = scale;
        shop.reading_m = [this](MonotonicTime at) {
            return shop.axis.at(at) * 1e-3 * (1 + 11.5e-6 * 2.5) / (1 + 10e-6 * 2.7);
        };
    }
    Shop shop;
};

TEST_F(StationWithScale, CapturesAndBringsTo20DegreesWithoutAir) {
    Life life{shop};
    const auto armed = life.arm();
    ASSERT_TRUE(armed) << describe(armed.error());
    for (int step = 0; step < 10; ++step)
        ASSERT_TRUE(life.take(step)) << step;
    const auto run = read_run_file(shop.run_files().at(0));
    ASSERT_TRUE(run) << describe(run.error());
    ASSERT_TRUE(run->scale);
    EXPECT_EQ(run->scale->channels, (std::vector<int>{5})); // laser, three of air, two contacts
    EXPECT_EQ(run->laser.vacuum_wavelength, Length{});
    for (const ChannelRecord& channel : run->channels)
        EXPECT_NE(channel.medium, Medium::air) << channel.name;
    for (const PointRecord& point : run->points)
        EXPECT_LT(std::abs(point.live_deviation.in(um)), 1e-3) << point.step;
    const auto at_20C = compensate_to_20C(*run);
    ASSERT_TRUE(at_20C) << describe(at_20C.error());
    for (const double deviation_mm : at_20C->summary.after)
        EXPECT_NEAR(deviation_mm, 0, 1e-6);
}

TEST_F(StationWithScale, ArmsWithoutTheAirSensorsButNotWithoutTheScalesTemperature) {
    Life life{shop};
    life.air->silent = true;
    life.run(120s); // the readings of air grow old
    EXPECT_TRUE(life.arm());
    ASSERT_TRUE(life.abort("enough"));
    life.run(2s);
    life.material->silent = true;
    life.run(120s);
    const auto refused = life.arm();
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::environment_stale);
}

TEST_F(StationWithScale, HasNoBeamToAlign) {
    Life life{shop};
    AlignmentOrder order;
    order.action = AlignmentAction::begin;
    const auto refused = life.station->align(order);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().detail.find("no beam to align"), std::string::npos);
}

} // namespace
} // namespace axiscal::station_scale_test
