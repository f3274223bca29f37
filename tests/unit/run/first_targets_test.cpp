#include "acquisition/run/first_targets.hpp"

#include "acquisition/run/live_position.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace axiscal::first_targets_test {
namespace {

constexpr Length datum = 10.0_mm;

/// The axis moves `ratio` times what is claimed, from a datum that is `shift` off.
Error diagnose(double ratio, Length shift, const std::vector<Length>& targets) {
    std::vector<ClaimedTarget> claims;
    for (const auto target : targets)
        claims.push_back({target, datum + (target - datum) * ratio + shift});
    return diagnose_first_targets(datum, claims);
}

bool names(const Error& error, const std::string& words) {
    return error.detail.find(words) != std::string::npos;
}

TEST(FirstTargets, ATurnedSignIsOneSentenceWithNumbers) {
    const auto error = diagnose(-1, {}, {30.0_mm});
    EXPECT_EQ(error.fault, Fault::wrong_direction);
    EXPECT_EQ(error.detail.find("From the datum at 10 mm the program claims a move of 20 mm, the "
                                "readings show -20 mm: the sign is turned"),
              0u)
        << error.detail;
}

TEST(FirstTargets, AnAxisThatDoesNotMoveIsAnotherAxis) {
    const auto error = diagnose(0, 3.0_um, {30.0_mm});
    EXPECT_EQ(error.fault, Fault::wrong_target);
    EXPECT_TRUE(names(error, "another axis is measured, the axis does not move, or the program "
                             "asks one step early"))
        << error.detail;
    EXPECT_FALSE(names(error, "shifted"));
}

TEST(FirstTargets, InchesAndMillimetresAreTold) {
    EXPECT_TRUE(names(diagnose(25.4, {}, {30.0_mm}), "an inch is taken for a millimetre"));
    EXPECT_TRUE(names(diagnose(1 / 25.4, {}, {30.0_mm}), "a millimetre is taken for an inch"));
}

TEST(FirstTargets, OpticsAndDiameterProgrammingAreNamedTogether) {
    for (const double ratio : {2.0, 0.5}) {
        const auto error = diagnose(ratio, {}, {30.0_mm});
        EXPECT_TRUE(names(error, "optical fold")) << error.detail;
        EXPECT_TRUE(names(error, "diameter")) << error.detail;
    }
    for (const double ratio : {4.0, 0.25}) {
        const auto error = diagnose(ratio, {}, {30.0_mm});
        EXPECT_TRUE(names(error, "optical fold")) << error.detail;
        EXPECT_FALSE(names(error, "diameter")) << error.detail;
    }
}

TEST(FirstTargets, ATurnedSignAndAWrongUnitAreNamedTogether) {
    const auto error = diagnose(-25.4, {}, {30.0_mm});
    EXPECT_EQ(error.fault, Fault::wrong_direction);
    EXPECT_TRUE(names(error, "inch")) << error.detail;
    EXPECT_TRUE(names(error, "and the sign is turned")) << error.detail;
}

TEST(FirstTargets, AShiftAfterARightTargetIsTold) {
    const std::vector<ClaimedTarget> claims{{14.0_mm, 14.003_mm}, {105.0_mm, 106.002_mm}};
    const auto error = diagnose_first_targets(datum, claims);
    EXPECT_TRUE(names(error, "the datum is shifted by 1.002 mm since the target before"))
        << error.detail;
}

TEST(FirstTargets, ATargetThatIsReadOneStepLateIsTold) {
    const std::vector<ClaimedTarget> claims{{14.0_mm, 14.003_mm}, {105.0_mm, 14.002_mm}};
    const auto error = diagnose_first_targets(datum, claims);
    EXPECT_TRUE(names(error, "the axis still stands at the target before")) << error.detail;
    EXPECT_FALSE(names(error, "shifted")) << error.detail;
}

TEST(FirstTargets, OneTargetCannotTellAScaleFromAShift) {
    const auto error = diagnose(1.1, {}, {30.0_mm});
    EXPECT_EQ(error.fault, Fault::outside_window);
    EXPECT_TRUE(names(error, "factor 1.1")) << error.detail;
    EXPECT_TRUE(names(error, "datum is shifted by 2 mm")) << error.detail;
    EXPECT_TRUE(names(error, "abort, go to the datum and arm again")) << error.detail;
    EXPECT_LT(error.detail.find("shifted"), error.detail.find("factor")) << error.detail;
}

TEST(FirstTargets, ARunArmedOffItsDatumIsNotToldAnImpossibleFactor) {
    for (const Length shift : {24.7_mm, -24.7_mm}) {
        const auto error = diagnose(1, shift, {30.0_mm});
        EXPECT_TRUE(names(error, "the axis stood 24.7 mm from its datum when the run was armed "
                                 "(abort, go to the datum and arm again)"))
            << error.detail;
        EXPECT_FALSE(names(error, "factor")) << error.detail;
    }
}

TEST(FirstTargets, TwoTargetsCan) {
    const auto scaled = diagnose(1.02, {}, {30.0_mm, 210.0_mm});
    EXPECT_TRUE(names(scaled, "factor 1.02")) << scaled.detail;
    EXPECT_FALSE(names(scaled, "shifted")) << scaled.detail;
    const auto shifted = diagnose(1, 0.7_mm, {30.0_mm, 210.0_mm});
    EXPECT_TRUE(names(shifted, "datum is shifted by 0.7 mm")) << shifted.detail;
    EXPECT_FALSE(names(shifted, "factor")) << shifted.detail;
}

TEST(FirstTargets, NoCauseIsInventedForAnAxisThatStandsAnywhere) {
    const std::vector<ClaimedTarget> claims{{30.0_mm, 30.2_mm}, {210.0_mm, 150.0_mm}};
    const auto error = diagnose_first_targets(datum, claims);
    EXPECT_EQ(error.fault, Fault::outside_window);
    EXPECT_TRUE(names(error, "another place than the program")) << error.detail;
}

TEST(FirstTargets, LawTheTrueCauseIsAlwaysAmongTheNamed) {
    std::mt19937_64 random{4};
    const std::vector<std::pair<double, std::string>> causes{
        {-1, "sign is turned"},        {0, "does not move"},
        {25.4, "inch is taken"},       {1 / 25.4, "millimetre is taken"},
        {2, "half of their passes"},   {0.5, "twice their passes"},
        {4, "quarter of their"},       {0.25, "four times their"},
        {-2, "and the sign is turned"}};
    for (int round = 0; round < 3000; ++round) {
        const auto& [ratio, words] = causes[random() % causes.size()];
        std::vector<Length> targets{datum + mm(2 + static_cast<double>(random() % 30'000) / 1000)};
        if (random() % 2 == 0)
            targets.push_back(targets[0] + mm(5 + static_cast<double>(random() % 200'000) / 1000));
        const auto noise = um(static_cast<double>(random() % 60) - 30);
        const auto error = diagnose(ratio, noise, targets);
        EXPECT_TRUE(names(error, words)) << ratio << ": " << error.detail;
        EXPECT_TRUE(error.detail.ends_with("."));
    }
}

TEST(LivePosition, TakesSignDatumAndAirIntoAccount) {
    LaserSetup laser;
    laser.sign = -1;
    DatumRecord tied;
    tied.coordinate = 50.0_mm;
    tied.reading = 2.0_mm;
    // 100.027 mm of vacuum wavelengths are 100 mm at n = 1.00027; the count falls with the axis.
    EXPECT_NEAR(live_position(laser, tied, 2.0_mm - 100.027_mm, 2.7e-4).in(mm), 150.0, 1e-9);
    EXPECT_EQ(live_position(laser, tied, 2.0_mm, 2.7e-4), 50.0_mm);
}

} // namespace
} // namespace axiscal::first_targets_test
