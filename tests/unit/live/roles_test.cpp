#include "acquisition/live/roles.hpp"

#include <gtest/gtest.h>

namespace axiscal::roles_test {
namespace {

class Roles : public ::testing::Test {
protected:
    void SetUp() override {
        axis.laser = {"laser", "axis 1"};
        axis.air_temperature = {"air", "temperature"};
        axis.air_pressure = {"air", "pressure"};
        axis.air_humidity = {"air", "humidity"};
        axis.material_temperature = {{"contacts", "1"}};
        add("laser", "axis 1", ChannelKind::displacement, Medium::none);
        add("air", "temperature", ChannelKind::temperature, Medium::air);
        add("air", "pressure", ChannelKind::pressure, Medium::air);
        add("air", "humidity", ChannelKind::humidity, Medium::air);
        add("contacts", "1", ChannelKind::temperature, Medium::material);
        add("contacts", "2", ChannelKind::temperature, Medium::material);
    }
    void add(const char* instrument, const char* name, ChannelKind kind, Medium medium) {
        StationChannel channel;
        channel.id = static_cast<int>(channels.size());
        channel.instrument_name = instrument;
        channel.name = name;
        channel.kind = kind;
        channel.medium = medium;
        channels.push_back(channel);
    }
    void expect_refused(Fault fault, const std::string& words) {
        const auto roles = resolve_roles(axis, channels);
        ASSERT_FALSE(roles);
        EXPECT_EQ(roles.error().fault, fault);
        EXPECT_NE(roles.error().detail.find(words), std::string::npos) << roles.error().detail;
    }
    AxisConfig axis;
    std::vector<StationChannel> channels;
};

TEST_F(Roles, AreFoundByName) {
    axis.material_temperature.push_back({"contacts", "2"});
    const auto roles = resolve_roles(axis, channels);
    ASSERT_TRUE(roles);
    EXPECT_EQ(roles->laser, 0);
    EXPECT_EQ(roles->environment(), (std::vector<int>{1, 2, 3, 4, 5}));
}

/// A station file that names none of them.
class RolesByKind : public Roles {
protected:
    void SetUp() override {
        Roles::SetUp();
        const RoleConfig by_kind{{}, {}, true};
        axis.laser = axis.air_temperature = axis.air_pressure = axis.air_humidity = by_kind;
        axis.material_temperature = {by_kind};
    }
    void expect_not_named(const std::vector<std::string>& words) {
        const auto named = name_roles(axis, {}, channels);
        ASSERT_FALSE(named);
        for (const std::string& word : words)
            EXPECT_NE(named.error().detail.find(word), std::string::npos) << named.error().detail;
    }
};

TEST_F(RolesByKind, AreTheOnlyChannelsThatCanPlayThem) {
    ASSERT_TRUE(name_roles(axis, {}, channels));
    EXPECT_EQ(axis.laser.instrument + "/" + axis.laser.channel, "laser/axis 1");
    EXPECT_TRUE(axis.laser.by_kind) << "as check-config tells";
    const auto roles = resolve_roles(axis, channels);
    ASSERT_TRUE(roles) << describe(roles.error());
    EXPECT_EQ(roles->laser, 0);
    EXPECT_EQ(roles->environment(), (std::vector<int>{1, 2, 3, 4, 5}));
}

TEST_F(RolesByKind, AreAskedForWhereTwoChannelsCouldBeIt) {
    add("gauge", "length", ChannelKind::displacement, Medium::none);
    expect_not_named({"axis.laser is not named", "\"laser/axis 1\", \"gauge/length\"", "name one"});
    ASSERT_TRUE(name_roles(axis, {{"gauge", "length"}}, channels)) << "it is the ballbar";
    EXPECT_EQ(axis.laser.instrument, "laser");
}

/// A uMD has inputs for two air temperatures, connected or not.
TEST_F(RolesByKind, AreASensorOfItsOwnBeforeOneOfTheLaser) {
    add("laser", "temperature 1", ChannelKind::temperature, Medium::air);
    add("laser", "temperature 2", ChannelKind::temperature, Medium::air);
    ASSERT_TRUE(name_roles(axis, {}, channels));
    EXPECT_EQ(axis.air_temperature.instrument, "air");
    std::erase_if(channels, [](const auto& one) { return one.instrument_name == "air"; });
    axis.air_temperature = RoleConfig{{}, {}, true};
    expect_not_named({"axis.air.temperature", "\"laser/temperature 1\", \"laser/temperature 2\""});
}

TEST_F(RolesByKind, AreAskedForWhereNoChannelCouldBeIt) {
    std::erase_if(channels, [](const auto& one) { return one.kind == ChannelKind::pressure; });
    expect_not_named({"axis.air.pressure is not named", "no instrument has such a channel"});
}

TEST_F(RolesByKind, OfMaterialAreNoSensorsThatTouchAnotherPart) {
    ASSERT_TRUE(name_roles(axis, {{"contacts", "2"}}, channels));
    ASSERT_EQ(axis.material_temperature.size(), 1U);
    EXPECT_EQ(axis.material_temperature[0].channel, "1");
}

TEST_F(Roles, AnAutocollimatorMustGiveAnAngle) {
    axis.laser = axis.air_temperature = axis.air_pressure = axis.air_humidity = {};
    axis.material_temperature.clear();
    add("collimator", "angle", ChannelKind::angle, Medium::none);
    axis.angle.emplace().autocollimator = {"collimator", "angle"};
    const auto roles = resolve_roles(axis, channels);
    ASSERT_TRUE(roles) << describe(roles.error());
    EXPECT_EQ(roles->autocollimator, 6);
    EXPECT_FALSE(roles->laser);
    axis.angle->autocollimator = {"laser", "axis 1"};
    expect_refused(Fault::bad_configuration,
                   "axis.angle.autocollimator = \"laser/axis 1\" measures displacement, not angle");
    axis.angle->autocollimator = {}; // a person types
    const auto typed = resolve_roles(axis, channels);
    ASSERT_TRUE(typed);
    EXPECT_FALSE(typed->autocollimator);
}

TEST_F(Roles, AScaleNeedsItsOwnTemperatureAndNoAir) {
    axis.air_temperature = axis.air_pressure = axis.air_humidity = {};
    axis.scale = ScaleConfig{{}, {{"contacts", "2"}}};
    const auto roles = resolve_roles(axis, channels);
    ASSERT_TRUE(roles) << describe(roles.error());
    EXPECT_EQ(roles->laser, 0);
    EXPECT_FALSE(roles->air_temperature);
    EXPECT_EQ(roles->material, (std::vector<int>{4}));
    EXPECT_EQ(roles->scale, (std::vector<int>{5}));
    EXPECT_EQ(roles->environment(), (std::vector<int>{4, 5}));
    axis.scale->temperature = {{"contacts", "1"}}; // on the machine already
    expect_refused(Fault::bad_configuration, "it touches one of them");
    axis.scale->temperature = {{"air", "temperature"}};
    expect_refused(Fault::wrong_medium, "axis.scale.temperature");
}

TEST_F(Roles, TheBallbarIsAnyChannelOfALength) {
    add("bar", "ballbar", ChannelKind::displacement, Medium::none);
    EXPECT_EQ(resolve_ballbar({"bar", "ballbar"}, {}, channels).value(), 6);
    const auto absent = resolve_ballbar({"bar", "length"}, {}, channels);
    ASSERT_FALSE(absent);
    EXPECT_NE(absent.error().detail.find("ballbar.sensor"), std::string::npos);
    EXPECT_FALSE(resolve_ballbar({"air", "pressure"}, {}, channels));
}

/// Each reading is the axis' or the bar's: the circles would wait for it for ever.
TEST_F(Roles, TheLaserOfTheAxisIsRefusedAsBallbar) {
    const auto roles = resolve_roles(axis, channels);
    ASSERT_TRUE(roles);
    const auto bar = resolve_ballbar({"laser", "axis 1"}, *roles, channels);
    ASSERT_FALSE(bar);
    EXPECT_EQ(bar.error().fault, Fault::bad_configuration);
    EXPECT_NE(bar.error().detail.find("\"laser/axis 1\" measures the axis, too"), std::string::npos)
        << bar.error().detail;
}

TEST_F(Roles, ALaserWithCorrectionsIsRefused) {
    channels[0].calibration.corrections = {{0, 0}, {1, 1e-6}};
    expect_refused(Fault::bad_configuration, "\"laser/axis 1\" has corrections");
    channels[0].calibration.corrections.clear();
    channels[0].correction = 1e-6;
    expect_refused(Fault::bad_configuration, "\"laser/axis 1\" has corrections");
}

TEST_F(Roles, AnAirChannelIsRefusedAsMaterial) {
    axis.material_temperature = {{"air", "temperature"}};
    expect_refused(Fault::wrong_medium, "medium 'air' but must have 'material'");
}

TEST_F(Roles, AContactSensorIsRefusedAsAir) {
    axis.air_temperature = {"contacts", "2"};
    expect_refused(Fault::wrong_medium, "medium 'material' but must have 'air'");
}

TEST_F(Roles, AnotherQuantityIsRefusedByName) {
    axis.air_pressure = {"air", "humidity"};
    expect_refused(Fault::bad_configuration, "axis.air.pressure = \"air/humidity\" measures");
}

TEST_F(Roles, AnUnknownChannelIsRefusedWithThoseThereAre) {
    axis.laser = {"laser", "axis 2"};
    expect_refused(Fault::bad_configuration, "laser/axis 1, air/temperature");
}

TEST_F(Roles, AnAxisWithoutAContactSensorIsRefused) {
    axis.material_temperature.clear();
    expect_refused(Fault::bad_configuration, "names no sensor");
}

} // namespace
} // namespace axiscal::roles_test
