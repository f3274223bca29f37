// The truth is made here from n and L alone: V = n L of the way from the interferometer, by hand.
#include "analysis/drift/run_drift.hpp"

#include "analysis/air/air_refraction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace axiscal::run_drift_test {
namespace {

constexpr double start_s = 100, lambda_nm = 632.991354;

MonotonicTime at_seconds(double seconds) {
    return monotonic_from_ns(std::llround((start_s + seconds) * 1e9));
}

double index_of(double celsius, double pressure_Pa) {
    AirState air;
    air.temperature = Temperature::celsius(celsius);
    air.pressure = pascal(pressure_Pa);
    air.relative_humidity = percent(50);
    air.vacuum_wavelength = nm(lambda_nm);
    air.co2_ppm = 450;
    return 1 + refractivity_of(AirFormula::ciddor, air)->n_minus_1;
}

/// An axis at rest at 900 mm from its datum, 150 mm of dead path before that.
struct Hall {
    std::function<double(double)> air_C = [](double) { return 20.0; };
    std::function<double(double)> material_C = [](double) { return 20.0; };
    std::function<double(double)> creep_um = [](double) { return 0.0; }; ///< of the coordinate
    double dead_path_m = 0.15, rest_mm = 900, datum_mm = 0, alpha = 0;
    int sign = 1;

    [[nodiscard]] RunRecord record(double duration_s) const {
        RunRecord run;
        run.opened = {at_seconds(0), 0, at_seconds(0)};
        run.complete = true;
        run.plan.datum = mm(datum_mm);
        run.laser.instrument = "laser";
        run.laser.vacuum_wavelength = nm(lambda_nm);
        run.laser.sign = sign;
        run.laser.dead_path = metre(dead_path_m);
        run.material.coefficient = per_kelvin(alpha);
        run.channels = {
            {0, "axis 1", "laser", "", ChannelKind::displacement, Medium::none, 0},
            {1, "air", "air", "", ChannelKind::temperature, Medium::air, 0},
            {2, "pressure", "air", "", ChannelKind::pressure, Medium::air, 0},
            {3, "humidity", "air", "", ChannelKind::humidity, Medium::air, 0},
            {4, "bed", "material", "left", ChannelKind::temperature, Medium::material, 0}};
        for (double s = 0; s <= duration_s; s += 10) {
            // What the machine measures with its own scale is the coordinate; the reflector is
            // where the material of that temperature has carried it.
            const double away_m = sign * (rest_mm - datum_mm) * 1e-3 + sign * creep_um(s) * 1e-6;
            const double grown_m = away_m * (1 + alpha * (material_C(s) - 20));
            const double path_m = index_of(air_C(s), 101325) * (dead_path_m + grown_m);
            const double values[] = {path_m - 0.7, air_C(s), 101325, 50, material_C(s)};
            for (int channel = 0; channel < 5; ++channel)
                run.environment.push_back({channel, at_seconds(s), values[channel]});
        }
        return run;
    }
    [[nodiscard]] DriftSetup setup() const {
        return {std::chrono::minutes{10}, std::chrono::seconds{10}, mm(rest_mm)};
    }
};

TEST(RunDrift, OfAnAxisThatOnlyCreepsIsItsCreep) {
    Hall hall;
    hall.creep_um = [](double s) { return 3 * std::sin(s / 60); }; // 10 min: a whole swing
    const auto drift = evaluate_drift(hall.record(600), hall.setup());
    ASSERT_TRUE(drift) << describe(drift.error());
    EXPECT_EQ(drift->axis.times.size(), 61U);
    EXPECT_NEAR(drift->axis.times.back(), 10, 1e-9);
    EXPECT_NEAR(drift->eve.range, 6, 0.02); // samples each 10 s miss the tops by 0.01 um
    EXPECT_NEAR(drift->eve.u_eve, drift->eve.range / std::sqrt(12.0), 1e-12);
    EXPECT_NEAR(drift->end_change, 3 * std::sin(10.0), 1e-3);
}

TEST(RunDrift, TakesOutTheAirOnTheWholePath) {
    Hall hall;
    hall.air_C = [](double s) { return 20 + s / 600; }; // 1 K: 0.95 um/m on 1.05 m
    const auto drift = evaluate_drift(hall.record(600), hall.setup());
    ASSERT_TRUE(drift);
    EXPECT_NEAR(drift->as_read.range, 0.95 * 1.05, 0.02);
    EXPECT_LT(drift->eve.range, 1e-3); // the same n was put in; what is left is rounding of 1 m
}

TEST(RunDrift, TakesOutTheMaterialAsARunDoes) {
    Hall hall;
    hall.alpha = 11.5e-6;
    hall.material_C = [](double s) { return 22 + s / 1200; }; // 0.5 K on 0.9 m: 5.2 um
    const auto drift = evaluate_drift(hall.record(600), hall.setup());
    ASSERT_TRUE(drift);
    EXPECT_NEAR(drift->as_read.range, 11.5 * 0.5 * 0.9, 0.01);
    EXPECT_LT(drift->eve.range, 0.002); // first order against exact: 0.9 m (alpha dT)^2
}

TEST(RunDrift, OfABeamFromTheOtherSideHasTheSignOfTheAxis) {
    Hall hall;
    hall.sign = -1, hall.rest_mm = -900;
    hall.creep_um = [](double s) { return s / 600; };
    const auto drift = evaluate_drift(hall.record(600), hall.setup());
    ASSERT_TRUE(drift);
    EXPECT_NEAR(drift->end_change, 1, 1e-3);
    EXPECT_NEAR(drift->as_read.range, 1, 1e-3);
    EXPECT_NEAR(drift->bare.readings.back(), 1, 1e-3); // drawn beside the axis, so as it goes
    EXPECT_NEAR(drift->reading.series.readings.back(), -1, 1e-3); // the counter's own
}

/// A bar at rest in a hall that warms up by 1 K an hour; its reading in um at a second.
RunRecord resting_bar(const std::function<double(double)>& reading_um) {
    RunRecord run;
    run.opened = {at_seconds(0), 0, at_seconds(0)};
    run.complete = true;
    run.laser.instrument = "gauge";
    run.material.coefficient = per_kelvin(11.5e-6);
    run.channels = {{3, "axis 2", "gauge", "", ChannelKind::displacement, Medium::none, 0},
                    {1, "bed", "material", "left", ChannelKind::temperature, Medium::material, 0},
                    {2, "axis 1", "gauge", "", ChannelKind::displacement, Medium::none, 0}};
    for (double s = 0; s <= 7200; s += 10) {
        run.environment.push_back({3, at_seconds(s), 0.1003 + reading_um(s) * 1e-6});
        run.environment.push_back({1, at_seconds(s), 20 + s / 3600});
        run.environment.push_back({2, at_seconds(s), 0.5 - s * 1e-6});
    }
    return run;
}

/// r = t / 2 + 2 sin(2 pi t / T), T = 40 min, t in hours. Its highest and lowest lie where
/// cos(2 pi t / T) = -1 / (12 pi) = -0.026526: at 5410.1 s +2.7507 um, at 1789.9 s -1.7507 um. Over
/// an hour, one and a half periods, it changes by 1/2 + 4 um at most. The line through three whole
/// periods has the slope 1/2 - 2/pi um an hour. Readings each 10 s miss a top by 0.2 nm, and 721 of
/// them in the place of the integral change the slope by 3 / 721 of 2/pi.
TEST(RunDrift, OfABallbarIsTheRangeOfItsReadingsAsTheyAre) {
    const auto rise_and_swing = [](double s) {
        return s / 7200 + 2 * std::sin(2 * std::acos(-1.0) * s / 2400);
    };
    const DriftSetup setup{std::chrono::hours{2}, std::chrono::seconds{10}, Length{}, true};
    const auto drift = evaluate_drift(resting_bar(rise_and_swing), setup);
    ASSERT_TRUE(drift) << describe(drift.error());
    EXPECT_TRUE(drift->of_bar);
    EXPECT_EQ(drift->unit, "um");
    EXPECT_EQ(drift->reading.name, "axis 2") << "the first channel of its instrument";
    EXPECT_EQ(drift->axis.times.size(), 721U);
    EXPECT_NEAR(drift->eve.range, 4.5014, 5e-4);
    EXPECT_NEAR(drift->eve.u_eve, 4.5014 / (2 * std::sqrt(3.0)), 2e-4);
    EXPECT_NEAR(drift->window.range, 4.5, 5e-4);
    EXPECT_NEAR(drift->end_change, 1, 1e-6);
    EXPECT_NEAR(drift->slope_per_h.value(), 0.5 - 2 / std::acos(-1.0), 4e-3);
    EXPECT_EQ(drift->as_read.range, drift->eve.range);
    EXPECT_EQ(drift->channels.size(), 2U);
}

TEST(RunDrift, OfABallbarNeedsNeitherAirNorMaterialBesideIt) {
    RunRecord run = resting_bar([](double s) { return s / 7200; });
    std::erase_if(run.environment, [](const EnvironmentReading& one) { return one.channel != 3; });
    const DriftSetup setup{std::chrono::hours{2}, std::chrono::seconds{10}, Length{}, true};
    const auto drift = evaluate_drift(run, setup);
    ASSERT_TRUE(drift) << describe(drift.error());
    EXPECT_EQ(drift->without_air, 0);
    EXPECT_TRUE(drift->refused.empty());
    EXPECT_NEAR(drift->eve.range, 1, 1e-6);
    run.environment.resize(1);
    const auto too_few = evaluate_drift(run, setup);
    ASSERT_FALSE(too_few);
    EXPECT_NE(too_few.error().detail.find("1 usable reading of the ballbar"), std::string::npos)
        << too_few.error().detail;
    run.channels.clear();
    EXPECT_EQ(evaluate_drift(run, setup).error().fault, Fault::bad_run_file);
}

TEST(RunDrift, GivesTheLargestRangeWithinAnHour) {
    Hall hall;
    hall.creep_um = [](double s) { return s / 3600; }; // 1 um an hour for three hours
    const auto drift = evaluate_drift(hall.record(3 * 3600), hall.setup());
    ASSERT_TRUE(drift);
    EXPECT_NEAR(drift->eve.range, 3, 1e-3);
    EXPECT_NEAR(drift->window.range, 1, 1e-3);
    EXPECT_EQ(drift->window_min, 60);
}

TEST(RunDrift, ShowsEveryOtherChannelInItsUnit) {
    Hall hall;
    hall.material_C = [](double s) { return 22 + s / 1200; };
    const auto drift = evaluate_drift(hall.record(600), hall.setup());
    ASSERT_TRUE(drift);
    ASSERT_EQ(drift->channels.size(), 4U);
    EXPECT_EQ(drift->channels[3].name, "bed");
    EXPECT_EQ(drift->channels[3].unit, "degC");
    EXPECT_NEAR(drift->channels[3].total.range, 0.5, 1e-9);
}

TEST(RunDrift, GivesEachChannelItsSlopeInAnHour) {
    Hall hall;
    hall.material_C = [](double s) { return 22 + s / 1200; }; // 3 K in an hour
    hall.creep_um = [](double s) { return s / 100; };         // 36 um in an hour
    const auto drift = evaluate_drift(hall.record(600), hall.setup());
    ASSERT_TRUE(drift);
    EXPECT_NEAR(drift->slope_per_h.value(), 36, 0.01);
    EXPECT_NEAR(drift->channels[3].slope_per_h.value(), 3, 1e-9);
    EXPECT_NEAR(drift->channels[1].slope_per_h.value(), 0, 1e-9);
}

TEST(RunDrift, TellsTheReadingOfTheLaserAsAChannelOfItsOwn) {
    Hall hall;
    hall.air_C = [](double s) { return 20 + s / 600; }; // 1 K: 0.95 um/m on 1.05 m
    const auto drift = evaluate_drift(hall.record(600), hall.setup());
    ASSERT_TRUE(drift);
    EXPECT_EQ(drift->reading.name, "axis 1");
    EXPECT_EQ(drift->reading.instrument, "laser");
    EXPECT_EQ(drift->reading.unit, "um");
    EXPECT_EQ(drift->reading.series.times.size(), 61U);
    EXPECT_NEAR(drift->reading.total.range, 0.95 * 1.05, 0.02);
    EXPECT_NEAR(drift->reading.slope_per_h.value(), -0.95 * 1.05 * 6, 0.12);
}

/// A gauge that sees 2.5 um, a barometer 2000 Pa off, a thermometer 5 K off, a fifth of CO2 more,
/// and a hygrometer that never speaks: none of them is of the axis.
void add_bystanders(RunRecord& run) {
    const auto none = Medium::none;
    run.channels.push_back({10, "gauge", "gauge", "table", ChannelKind::displacement, none, 0});
    run.channels.push_back({11, "hall", "hall", "door", ChannelKind::pressure, none, 0});
    run.channels.push_back({12, "spindle", "hall", "nose", ChannelKind::temperature, none, 0});
    run.channels.push_back({13, "CO2", "hall", "door", ChannelKind::carbon_dioxide, none, 0});
    run.channels.push_back({14, "damp", "hall", "door", ChannelKind::humidity, none, 0});
    for (double s = 0; s <= 600; s += 10) {
        const double share = s / 600;
        const double values[] = {0.1 + 2.5e-6 * share, 103325 + 50 * share, 25 + share,
                                 500 + 100 * share};
        for (int i = 0; i < 4; ++i)
            run.environment.push_back({10 + i, at_seconds(s), values[i]});
    }
}

TEST(RunDrift, TellsWhatIsNotOfTheAxisAndLetsItActOnNothing) {
    const Hall hall;
    const auto alone = evaluate_drift(hall.record(600), hall.setup());
    RunRecord run = hall.record(600);
    add_bystanders(run);
    const auto drift = evaluate_drift(run, hall.setup());
    ASSERT_TRUE(alone && drift);
    EXPECT_EQ(drift->axis.readings, alone->axis.readings);
    EXPECT_EQ(drift->without_air, 0);
    ASSERT_EQ(drift->channels.size(), 9U);
    EXPECT_NEAR(drift->channels[4].total.range, 2.5, 1e-9);
    EXPECT_NEAR(drift->channels[4].total.u_eve, 2.5 / std::sqrt(12.0), 1e-9);
    EXPECT_NEAR(drift->channels[5].total.range, 50, 1e-9);
    EXPECT_NEAR(drift->channels[5].slope_per_h.value(), 300, 1e-6);
    EXPECT_NEAR(drift->channels[7].total.range, 100, 1e-9);
    EXPECT_EQ(drift->channels[8].name, "damp");
    EXPECT_TRUE(drift->channels[8].series.readings.empty());
    EXPECT_FALSE(drift->channels[8].slope_per_h);
}

/// A rotary axis at rest at 12.4 degrees, of which the table has taken back three steps of 5
/// degrees since the datum at -2: 0.6 degrees short of square. It creeps by 4 seconds of arc while
/// the air warms up by 1 K.
struct Turntable {
    double arm_mm = 32.61;
    int sign = 1;
    [[nodiscard]] RunRecord record() const {
        Hall hall;
        RunRecord run = hall.record(600);
        run.environment.clear();
        run.plan.axis_kind = AxisKind::rotary;
        run.plan.datum = mm(-2);
        run.laser.sign = sign;
        run.laser.dead_path = Length{};
        RotarySetup& rotary = run.rotary.emplace();
        rotary.step_deg = 5;
        rotary.arm = mm(arm_mm);
        rotary.deviations_arcsec.assign(72, 1.5);
        run.channels.resize(4); // no sensor of material
        for (double s = 0; s <= 600; s += 10) {
            const double rest_rad = (-0.6 + 4 * s / 600 / 3600) * std::acos(-1.0) / 180;
            const double path_m =
                sign * arm_mm * 1e-3 * std::sin(rest_rad) * index_of(20 + s / 600, 101325);
            const double values[] = {path_m + 0.3, 20 + s / 600, 101325, 50};
            for (int channel = 0; channel < 4; ++channel)
                run.environment.push_back({channel, at_seconds(s), values[channel]});
        }
        return run;
    }
    static DriftSetup setup() {
        return {std::chrono::minutes{10}, std::chrono::seconds{10}, mm(12.4)};
    }
};

TEST(RunDrift, OfARotaryAxisIsInSecondsOfArcAndNeedsNoMaterial) {
    for (const int sign : {1, -1}) {
        Turntable table;
        table.sign = sign;
        const auto drift = evaluate_drift(table.record(), Turntable::setup());
        ASSERT_TRUE(drift) << describe(drift.error());
        EXPECT_EQ(drift->unit, "arcsec");
        EXPECT_EQ(drift->without_air, 0);
        EXPECT_NEAR(drift->eve.range, 4, 1e-6);
        EXPECT_NEAR(drift->end_change, 4, 1e-6);
        EXPECT_NEAR(drift->slope_per_h.value(), 24, 1e-4);
        // 1 K of air is 0.95e-6 of the 0.6 degrees: 0.002 seconds of arc that the reading adds;
        // it is short by 1 - cos(0.6 degrees), and longer by n.
        EXPECT_NEAR(drift->as_read.range, 4 * (1 + 2.7e-4) * std::cos(0.6 * 0.0174533) + 0.00205,
                    2e-4);
        // Of the interferometer: S times the angle.
        EXPECT_NEAR(drift->reading.total.range, 4 / 206264.8 * 32.61e3, 1e-3);
        EXPECT_EQ(drift->reading.unit, "um");
        EXPECT_NEAR(drift->bare.readings.back(), 4, 0.01);
    }
}

TEST(RunDrift, CountsWhatIsMissingAndWhatHasNoAir) {
    Hall hall;
    RunRecord run = hall.record(600);
    run.air.oldest = std::chrono::seconds{60};
    // No reading of the laser from 100 s to 195 s, none of the humidity after 400 s.
    std::erase_if(run.environment, [](const EnvironmentReading& reading) {
        const double s = seconds_of(reading.at - at_seconds(0));
        return (reading.channel == 0 && s > 99 && s < 195) || (reading.channel == 3 && s > 400);
    });
    const auto drift = evaluate_drift(run, hall.setup());
    ASSERT_TRUE(drift);
    EXPECT_EQ(drift->without_air, 14); // 470 s to 600 s
    EXPECT_EQ(drift->missing, 9);      // 60 intervals, 51 of 61 readings left
    EXPECT_EQ(drift->axis.times.size(), 37U);
}

/// Up to 2.16 of its 4 seconds of arc the angle is beyond what the interferometer shows.
TEST(RunDrift, NamesReadingsBeyondTheRangeAndNotAsWithoutAir) {
    RunRecord run = Turntable{}.record();
    run.rotary->range_deg = 0.5994;
    const auto drift = evaluate_drift(run, Turntable::setup());
    ASSERT_TRUE(drift) << describe(drift.error());
    EXPECT_EQ(drift->without_air, 0);
    ASSERT_EQ(drift->refused.size(), 1U);
    EXPECT_EQ(drift->refused[0].fault, Fault::outside_window);
    EXPECT_EQ(drift->refused[0].count, 33); // 0 s to 320 s
    EXPECT_NEAR(drift->refused[0].first_min, 0, 1e-9);
    EXPECT_NEAR(drift->refused[0].last_min, 320.0 / 60, 1e-9);
    EXPECT_NE(drift->refused[0].reason.find("range of 0.5994 deg"), std::string::npos);
    EXPECT_NEAR(drift->eve.range, 4 * 270.0 / 600, 1e-6); // 330 s to 600 s: less than the truth
}

TEST(RunDrift, NamesEachFaultOnceAndTellsOfNothingElse) {
    Hall hall;
    RunRecord run = hall.record(600);
    run.air.oldest = std::chrono::seconds{15};
    // No material from 200 s on; at 50 s and 80 s a humidity that cannot be.
    std::erase_if(run.environment, [](const EnvironmentReading& reading) {
        return reading.channel == 4 && seconds_of(reading.at - at_seconds(0)) > 199;
    });
    for (EnvironmentReading& reading : run.environment)
        if (reading.channel == 3 && (reading.at == at_seconds(50) || reading.at == at_seconds(80)))
            reading.value = 130;
    const auto drift = evaluate_drift(run, hall.setup());
    ASSERT_TRUE(drift) << describe(drift.error());
    EXPECT_EQ(drift->without_air, 40); // 210 s to 600 s: 190 s is 20 s away
    ASSERT_EQ(drift->refused.size(), 1U);
    EXPECT_EQ(drift->refused[0].fault, Fault::bad_request);
    EXPECT_EQ(drift->refused[0].reason, "relative humidity must lie in 0..100 %");
    EXPECT_EQ(drift->refused[0].count, 2);
    EXPECT_EQ(drift->axis.times.size(), 19U);
}

TEST(RunDrift, SaysWhyTooFewReadingsAreLeft) {
    RunRecord turned = Turntable{}.record();
    turned.rotary->range_deg = 0.1;
    const auto beyond = evaluate_drift(turned, Turntable::setup());
    ASSERT_FALSE(beyond);
    EXPECT_EQ(beyond.error().fault, Fault::incomplete_run);
    EXPECT_NE(beyond.error().detail.find("61 cannot be evaluated"), std::string::npos);
    EXPECT_NE(beyond.error().detail.find("range of 0.1000 deg"), std::string::npos);
    Hall hall;
    RunRecord airless = hall.record(600);
    std::erase_if(airless.environment, [](const auto& reading) { return reading.channel == 3; });
    const auto without = evaluate_drift(airless, hall.setup());
    ASSERT_FALSE(without);
    EXPECT_NE(without.error().detail.find("61 have no fresh air"), std::string::npos);
}

TEST(RunDrift, RefusesWhatIsNoTest) {
    Hall hall;
    RunRecord open = hall.record(600);
    open.complete = false;
    EXPECT_EQ(evaluate_drift(open, hall.setup()).error().fault, Fault::incomplete_run);
    RunRecord rotary = hall.record(600);
    rotary.plan.axis_kind = AxisKind::rotary;
    EXPECT_EQ(evaluate_drift(rotary, hall.setup()).error().fault, Fault::refused);
    RunRecord typed = Turntable{}.record();
    typed.rotary->method = AngleMethod::polygon;
    EXPECT_EQ(evaluate_drift(typed, Turntable::setup()).error().fault, Fault::refused);
    RunRecord armless = Turntable{}.record();
    armless.rotary->arm = Length{};
    EXPECT_EQ(evaluate_drift(armless, Turntable::setup()).error().fault, Fault::bad_run_file);
    RunRecord blind = hall.record(600);
    blind.channels.erase(blind.channels.begin());
    EXPECT_EQ(evaluate_drift(blind, hall.setup()).error().fault, Fault::bad_run_file);
    RunRecord one = hall.record(0);
    EXPECT_EQ(evaluate_drift(one, hall.setup()).error().fault, Fault::incomplete_run);
    DriftSetup never = hall.setup();
    never.interval = Duration{};
    EXPECT_EQ(evaluate_drift(hall.record(600), never).error().fault, Fault::bad_run_file);
}

} // namespace
} // namespace axiscal::run_drift_test
