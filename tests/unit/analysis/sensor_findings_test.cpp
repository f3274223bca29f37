#include "analysis/setup/frozen_sensor.hpp"
#include "analysis/setup/sensor_findings.hpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace axiscal::sensor_findings_test {
namespace {

/// The air of a shop, drawn at random, and a machine that follows it by a time constant of its own;
/// read every ten seconds for half an hour to an hour, to the last digit of usual sensors.
struct Shop {
    explicit Shop(unsigned seed)
        : dice{seed} {
        air_C = between(18, 26);
        swing_K = between(0.1, 1.0);
        period_s = between(500, 2500);
        phase = between(0, 2 * std::numbers::pi);
        drift_K_per_h = between(-0.5, 0.5);
        pressure_Pa = between(96000, 103000);
        pressure_Pa_per_h = between(-60, 60);
        time_constant_s = between(2000, 20000);
        machine_K = between(-3, 3);
        minutes = between(30, 60);
    }
    double between(double low, double high) {
        return std::uniform_real_distribution{low, high}(dice);
    }
    double noise(double sigma) { return std::normal_distribution{0.0, sigma}(dice); }

    [[nodiscard]] double swing_at(double s) const {
        return swing_K * std::sin(2 * std::numbers::pi * s / period_s + phase);
    }
    [[nodiscard]] double air_at(double s) const {
        return air_C + swing_at(s) + drift_K_per_h * s / 3600;
    }
    /// The swing through a first-order lag: weaker by sqrt(1 + (w tau)^2), later by atan(w tau).
    [[nodiscard]] double machine_at(double s) const {
        const double w = 2 * std::numbers::pi / period_s, w_tau = w * time_constant_s;
        return air_C + machine_K + drift_K_per_h * (s - time_constant_s) / 3600 +
               swing_K / std::hypot(1, w_tau) * std::sin(w * s + phase - std::atan(w_tau));
    }

    RunRecord run() {
        RunRecord run;
        const double end_s = minutes * 60;
        run.channels = {
            {1, "air temperature", "air", "", ChannelKind::temperature, Medium::air, 0},
            {2, "air pressure", "air", "", ChannelKind::pressure, Medium::air, 0},
            {3, "air humidity", "air", "", ChannelKind::humidity, Medium::air, 0},
            {4, "left", "material", "", ChannelKind::temperature, Medium::material, 0},
            {5, "right", "material", "", ChannelKind::temperature, Medium::material, 0}};
        for (double s = 0; s <= end_s; s += 10)
            for (int channel = 1; channel <= 5; ++channel)
                run.environment.push_back({channel, at(s), shown(channel, s)});
        for (const double s : {0.0, end_s}) {
            PointRecord point;
            point.window_begin = point.window_end = at(s);
            run.points.push_back(point);
        }
        return run;
    }

    std::mt19937 dice;
    double air_C, swing_K, period_s, phase, drift_K_per_h, pressure_Pa, pressure_Pa_per_h,
        time_constant_s, machine_K, minutes;
    bool right_in_air = false;

    static MonotonicTime at(double s) { return MonotonicTime{from_seconds(s)}; }

private:
    static double to_digit(double value, double digit) { return std::round(value / digit) * digit; }
    double shown(int channel, double s) {
        switch (channel) {
        case 1: return to_digit(air_at(s) + noise(0.01), 0.01);
        case 2: return to_digit(pressure_Pa + pressure_Pa_per_h * s / 3600 + noise(2), 1);
        case 3: return to_digit(45 - 2 * swing_at(s) + noise(0.05), 0.1);
        case 5:
            if (right_in_air) return to_digit(air_at(s - 40) + noise(0.01), 0.01);
            break;
        default: break;
        }
        return to_digit(machine_at(s) + noise(0.005), 0.01);
    }
};

/// From `begin_s` on the air instrument repeats what it showed then.
void freeze(RunRecord& run, double begin_s) {
    double held[4] = {};
    for (EnvironmentReading& reading : run.environment) {
        if (reading.channel > 3) continue;
        if (reading.at <= Shop::at(begin_s))
            held[reading.channel] = reading.value;
        else
            reading.value = held[reading.channel];
    }
}

TEST(SensorFindings, ThoseOfAGoodShopAreNotSuspected) {
    int suspected = 0;
    for (unsigned seed = 1; seed <= 1000; ++seed)
        suspected += !find_sensor_errors(Shop{seed}.run()).empty();
    EXPECT_LE(suspected, 10) << "one in a hundred";
}

TEST(SensorFindings, AnAirSensorThatHangsIsNamed) {
    int named = 0;
    for (unsigned seed = 1; seed <= 100; ++seed) {
        Shop shop{seed};
        RunRecord run = shop.run();
        freeze(run, shop.between(0, shop.minutes * 60 - 660));
        const auto found = find_sensor_errors(run);
        named += found.size() == 1 && found.front().error == SetupError::frozen_air;
    }
    EXPECT_GE(named, 95);
}

TEST(SensorFindings, HowLongItHungIsTold) {
    Shop shop{5};
    shop.minutes = 50;
    RunRecord run = shop.run();
    freeze(run, 600);
    const auto found = find_sensor_errors(run);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found.front().value, 40, 0.01);
    EXPECT_EQ(found.front().seen,
              "No figure of the air sensor \"air\" changed for 40 minutes, not by its last digit.");
    EXPECT_NE(found.front().look_at.find("plug it in again"), std::string::npos);
}

TEST(SensorFindings, AMaterialSensorThatHangsInTheAirIsNamed) {
    int named = 0;
    for (unsigned seed = 1; seed <= 100; ++seed) {
        Shop shop{seed};
        shop.right_in_air = true;
        const auto found = find_sensor_errors(shop.run());
        named += found.size() == 1 && found.front().error == SetupError::sensor_in_air &&
                 found.front().sensor == "right";
    }
    EXPECT_GE(named, 95);
}

SensorTrack steady(ChannelKind kind, double value, bool as_sent = true) {
    SensorTrack track{kind, {}, as_sent};
    for (int i = 0; i < 200; ++i) {
        track.readings.times.push_back(10.0 * i);
        track.readings.readings.push_back(value);
    }
    return track;
}

TEST(FrozenSensor, IsSuspectedOnlyWhereItsLastDigitWouldHaveMoved) {
    using enum ChannelKind;
    const auto hangs = [](const SensorTrack& track) {
        return find_frozen_span(std::span{&track, 1}).has_value();
    };
    EXPECT_TRUE(hangs(steady(temperature, 20.43)));
    EXPECT_TRUE(hangs(steady(pressure, 101287)));
    EXPECT_FALSE(hangs(steady(temperature, 20.4))) << "a tenth of a kelvin may well hold";
    EXPECT_FALSE(hangs(steady(pressure, 101300))) << "may be resolved to 100 Pa";
    EXPECT_FALSE(hangs(steady(humidity, 45.123))) << "no length depends on it so much";
    EXPECT_FALSE(hangs(steady(temperature, 20.43, false))) << "the digits are the correction's";
}

TEST(FrozenSensor, OneQuantityThatMovesTellsThatTheInstrumentLives) {
    std::vector<SensorTrack> tracks{steady(ChannelKind::temperature, 20.43),
                                    steady(ChannelKind::humidity, 45)};
    EXPECT_TRUE(find_frozen_span(tracks));
    for (std::size_t i = 0; i < 200; i += 30)
        tracks[1].readings.readings[i] += 1;
    EXPECT_FALSE(find_frozen_span(tracks));
}

TEST(FrozenSensor, TheResolutionIsTakenFromTheChangesThatWereSeen) {
    SensorTrack coarse = steady(ChannelKind::temperature, 20.437, false); // corrected by a table
    coarse.readings.readings[0] += 0.5;
    EXPECT_FALSE(find_frozen_span(std::span{&coarse, 1}));
    coarse.readings.readings[1] += 0.01;
    const auto span = find_frozen_span(std::span{&coarse, 1});
    ASSERT_TRUE(span);
    EXPECT_EQ(span->begin_s, 20);
    EXPECT_EQ(span->end_s, 1990);
}

TEST(FrozenSensor, LessThanTenMinutesOrTenReadingsTellNothing) {
    SensorTrack track = steady(ChannelKind::temperature, 20.43);
    track.readings.times.resize(57); // 560 s
    track.readings.readings.resize(57);
    EXPECT_FALSE(find_frozen_span(std::span{&track, 1}));
    const SensorTrack few{
        ChannelKind::temperature, {{0, 900, 1800, 2700}, {20.43, 20.43, 20.43, 20.43}}, true};
    EXPECT_FALSE(find_frozen_span(std::span{&few, 1}));
    EXPECT_FALSE(find_frozen_span({}));
}

} // namespace
} // namespace axiscal::sensor_findings_test
