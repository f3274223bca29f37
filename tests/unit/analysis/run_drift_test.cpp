// The truth is made here from n and L alone: V = n L of the way from the interferometer, by hand.
#include "analysis/drift/run_drift.hpp"

#include "analysis/air_refraction.hpp"

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

TEST(RunDrift, RefusesWhatIsNoTest) {
    Hall hall;
    RunRecord open = hall.record(600);
    open.complete = false;
    EXPECT_EQ(evaluate_drift(open, hall.setup()).error().fault, Fault::incomplete_run);
    RunRecord rotary = hall.record(600);
    rotary.plan.axis_kind = AxisKind::rotary;
    EXPECT_EQ(evaluate_drift(rotary, hall.setup()).error().fault, Fault::refused);
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
