// Expected numbers: the sensitivities of the index of air that NIST's Engineering Metrology Toolbox
// gives (1 degC: 0.93 to 0.96 ppm; 1 hPa: 0.27 ppm; 1 % humidity near 20 degC: 0.0085 ppm).
#include "analysis/uncertainty/calibrated_terms.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace axiscal::calibrated_terms_test {
namespace {

RunRecord calibrated_run() {
    RunRecord run;
    run.laser.vacuum_wavelength = nm(632.991354);
    const auto channel = [&](int id, ChannelKind kind, Medium medium) {
        ChannelRecord record;
        record.id = id, record.kind = kind, record.medium = medium;
        run.channels.push_back(record);
        ChannelCalibration calibration;
        calibration.channel = id;
        run.calibrations.push_back(calibration);
        return run.calibrations.size() - 1;
    };
    run.calibrations[channel(0, ChannelKind::displacement, Medium::none)]
        .expanded_uncertainty_per_m = 0.4e-6;
    run.calibrations[channel(1, ChannelKind::temperature, Medium::air)].expanded_uncertainty = 0.1;
    run.calibrations[channel(2, ChannelKind::pressure, Medium::air)].expanded_uncertainty = 20;
    run.calibrations[channel(3, ChannelKind::humidity, Medium::air)].expanded_uncertainty = 4;
    run.calibrations[channel(4, ChannelKind::temperature, Medium::material)].expanded_uncertainty =
        0.06;
    run.calibrations[channel(5, ChannelKind::temperature, Medium::material)].expanded_uncertainty =
        0.09;
    run.calibrations.back().coverage = 3; // u = 0.03 K, as the other one's
    return run;
}

TEST(CalibratedTerms, JoinTheLaserAndTheSensorsOfTheAir) {
    std::vector<std::string> remarks;
    const auto U_um = calibrated_device_um(calibrated_run(), 1, remarks);
    ASSERT_TRUE(U_um);
    // u: 0.2 um of the laser, 0.05 K, 10 Pa and 2 % of the air, over one metre.
    const double expected = 2 * std::hypot(std::hypot(0.2, 0.05 * 0.945), 0.1 * 0.27, 2 * 0.0085);
    EXPECT_NEAR(*U_um, expected, 0.002);
    ASSERT_EQ(remarks.size(), 1U);
    EXPECT_NE(remarks[0].find("certificates"), std::string::npos);
    EXPECT_NEAR(calibrated_device_um(calibrated_run(), 3, remarks).value(), 3 * *U_um, 1e-9);
}

TEST(CalibratedTerms, AreNotOfferedWhereACertificateIsMissing) {
    std::vector<std::string> remarks;
    RunRecord run = calibrated_run();
    run.calibrations[2].expanded_uncertainty.reset(); // pressure
    EXPECT_FALSE(calibrated_device_um(run, 1, remarks));
    ASSERT_EQ(remarks.size(), 1U);
    EXPECT_NE(remarks[0].find("air pressure"), std::string::npos);
    run.calibrations.erase(run.calibrations.begin()); // the laser's own
    remarks.clear();
    EXPECT_FALSE(calibrated_device_um(run, 1, remarks));
    EXPECT_TRUE(remarks.empty());
    run.calibrations.pop_back(); // one material sensor
    EXPECT_FALSE(calibrated_temperature_width_K(run, remarks));
}

TEST(CalibratedTerms, TakeTheFullWidthFromTheWorstMaterialSensor) {
    std::vector<std::string> remarks;
    // u = 0.03 K of both: a rectangle of full width 2 sqrt(3) u.
    EXPECT_NEAR(calibrated_temperature_width_K(calibrated_run(), remarks).value(), 0.10392, 1e-5);
    EXPECT_NE(remarks.at(0).find("Contact"), std::string::npos);
}

} // namespace
} // namespace axiscal::calibrated_terms_test
