#include "analysis/positioning/positioning_certificate.hpp"
#include "simulated_run.hpp"

#include <gtest/gtest.h>
#include <memory>
#include <numbers>
#include <random>

namespace axiscal::setup_of_run_test {
namespace {

double swing(double seconds, double period_s) {
    return std::sin(2 * std::numbers::pi * seconds / period_s);
}

/// Scatter of 0.3 um, in air and on a machine whose temperatures swing by a degree.
test::Truth truth_of_a_shop(int sign) {
    test::Truth truth;
    truth.sign = sign;
    truth.dead_path_mm = 1500;
    truth.air_C = [](double s) { return 22 + swing(s, 1500); };
    truth.material_C = [](double s) { return 23 + swing(s, 2300); };
    auto dice = std::make_shared<std::mt19937>(20261127);
    truth.deviation_mm = [dice](const PlannedPoint& point, double target_mm) {
        std::normal_distribution<double> scatter{0, 0.0003};
        return 0.00001 * target_mm + (point.direction == Direction::positive ? 0.002 : 0) +
               scatter(*dice);
    };
    return truth;
}

TEST(SetupOfARun, OneThatIsRightGetsNoRemark) {
    for (const int sign : {1, -1}) {
        const auto certificate = make_certificate(test::simulated_run(truth_of_a_shop(sign)), "");
        ASSERT_TRUE(certificate);
        EXPECT_TRUE(certificate->setup_findings.empty());
        EXPECT_TRUE(certificate->remarks.empty());
    }
}

TEST(SetupOfARun, ADeadPathThatIsNotStatedIsFoundWhicheverWayTheAxisRuns) {
    for (const int sign : {1, -1}) {
        RunRecord run = test::simulated_run(truth_of_a_shop(sign));
        run.laser.dead_path = Length{};
        const auto certificate = make_certificate(std::move(run), "");
        ASSERT_TRUE(certificate) << sign;
        ASSERT_EQ(certificate->setup_findings.size(), 1U) << sign;
        const SetupFinding& found = certificate->setup_findings.front();
        EXPECT_EQ(found.error, SetupError::dead_path);
        EXPECT_NEAR(found.value, 1.5, 3 * found.standard_uncertainty);
        EXPECT_EQ(certificate->remarks.back(),
                  "Set-up: " + found.seen + " " + found.probably + " " + found.look_at);
    }
}

TEST(SetupOfARun, AWrongExpansionIsFound) {
    RunRecord run = test::simulated_run(truth_of_a_shop(1));
    run.material.coefficient = per_kelvin(23.1e-6); // aluminium; the axis is of steel
    const auto certificate = make_certificate(std::move(run), "");
    ASSERT_TRUE(certificate);
    ASSERT_EQ(certificate->setup_findings.size(), 1U);
    EXPECT_EQ(certificate->setup_findings.front().error, SetupError::expansion);
    EXPECT_NEAR(certificate->setup_findings.front().value, 11.7 - 23.1,
                3 * certificate->setup_findings.front().standard_uncertainty);
}

/// Within what its certificate states a coefficient is not wrong.
TEST(SetupOfARun, AnExpansionWithinItsStatedUncertaintyIsNoFinding) {
    RunRecord run = test::simulated_run(truth_of_a_shop(1));
    run.material.coefficient = per_kelvin(23.1e-6);
    run.material.standard_uncertainty = per_kelvin(6e-6);
    const auto certificate = make_certificate(std::move(run), "");
    ASSERT_TRUE(certificate);
    EXPECT_TRUE(certificate->setup_findings.empty());
}

TEST(SetupOfARun, AnOpticThatMovedIsFoundAndNoFigureChanges) {
    RunRecord run = test::simulated_run(truth_of_a_shop(1));
    for (std::size_t i = 60; i < run.points.size(); ++i)
        run.points[i].reading = run.points[i].reading + um(8);
    const auto certificate = make_certificate(run, "");
    ASSERT_TRUE(certificate);
    ASSERT_EQ(certificate->setup_findings.size(), 1U);
    EXPECT_EQ(certificate->setup_findings.front().error, SetupError::moved_optic);
    EXPECT_NEAR(certificate->setup_findings.front().value, 8, 0.5);
    EXPECT_EQ(certificate->setup_findings.front().from->step, 60);
    EXPECT_GT(*certificate->result.parameters.A, 0.008) << "the step is in it";
}

RunRevisions answered(const std::string& finding, const std::string& text) {
    RunRevisions revisions;
    revisions.answers = {{finding, monotonic_from_ns(1), 1, "a first word"},
                         {finding, monotonic_from_ns(2), 2, text}};
    Orderer jo;
    jo.name = "Jo Miller";
    jo.door = "token";
    revisions.orders = {{"answer", finding, monotonic_from_ns(2), 2, jo}};
    return revisions;
}

TEST(SetupOfARun, TheLastAnswerStandsBesideTheFinding) {
    RunRecord run = test::simulated_run(truth_of_a_shop(1));
    for (std::size_t i = 60; i < run.points.size(); ++i)
        run.points[i].reading = run.points[i].reading + um(8);
    const auto certificate =
        make_certificate(std::move(run), answered("moved_optic", "the table was bumped"), "");
    ASSERT_TRUE(certificate);
    ASSERT_EQ(certificate->setup_findings.size(), 1U);
    EXPECT_EQ(certificate->setup_findings[0].answer, "the table was bumped");
    EXPECT_EQ(certificate->setup_findings[0].answered_by, "Jo Miller (token)");
    EXPECT_TRUE(
        certificate->remarks.back().ends_with(" Answer of Jo Miller (token): the table was bumped"))
        << certificate->remarks.back();
}

TEST(SetupOfARun, AnAnswerToWhatIsNoLongerFoundIsARemark) {
    const auto certificate = make_certificate(test::simulated_run(truth_of_a_shop(1)),
                                              answered("moved_optic", "the table was bumped"), "");
    ASSERT_TRUE(certificate);
    EXPECT_TRUE(certificate->setup_findings.empty());
    EXPECT_EQ(certificate->remarks.back(),
              "Set-up: these readings no longer show what Jo Miller (token) answered to "
              "(moved_optic): the table was bumped");
}

TEST(SetupOfARun, AReadingThatIsExcludedIsLeftOut) {
    RunRecord run = test::simulated_run(truth_of_a_shop(1));
    run.points[40].reading = run.points[40].reading + mm(1);
    RunRevisions revisions;
    revisions.exclusions.push_back({});
    revisions.exclusions.back().step = 40;
    revisions.exclusions.back().reason = "leaned on the table";
    const auto certificate = make_certificate(std::move(run), std::move(revisions), "");
    ASSERT_TRUE(certificate);
    EXPECT_TRUE(certificate->setup_findings.empty());
}

} // namespace
} // namespace axiscal::setup_of_run_test
