// What JSON and CSV say of the limits that stand in a run file, of every kind of test.

#include "acquisition/documents/conformity_json.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/analysis/simulated_run.hpp"
#include "tests/unit/analysis/stated_uncertainty.hpp"
#include "tests/unit/documents/evaluated.hpp"
#include "tests/unit/documents/probed_block.hpp"
#include "tests/unit/documents/written_circle.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace axiscal::conformity_json_test {
namespace {

using Json = nlohmann::ordered_json;
using testing::ScratchFolder;

ToleranceRecord agreed(DecisionRule rule, std::vector<ToleranceLimit> limits) {
    return {"acceptance", "order 17, annex 2", "um", rule, false, std::move(limits)};
}

/// One metre, 3 um of play, without noise: A, E and B are known.
RunRecord measured_run() {
    test::Truth truth;
    truth.deviation_mm = [](const PlannedPoint& point, double) {
        return point.direction == Direction::positive ? 0.0015 : -0.0015;
    };
    RunRecord run = test::simulated_run(truth);
    run.uncertainty = test::stated_uncertainty();
    return run;
}

TEST(ConformityJson, ARowOfARunHasTheFiguresOfTheResult) {
    RunRecord run = measured_run();
    run.tolerances = agreed(DecisionRule::guard_U,
                            {{"A", 500, 1}, {"A", 1000, 100}, {"B", {}, 2}, {"M", 10, 1}});
    const Certificate certificate = make_certificate(run, std::string(64, 'a')).value();
    const TestResult result{certificate};
    const Json json = json_of(result);
    EXPECT_EQ(json.at("tolerances").at("source"), "order 17, annex 2");
    EXPECT_EQ(json.at("tolerances").at("rule"), "guard-U");
    const Json& rows = json.at("verdicts");
    ASSERT_EQ(rows.size(), 3U);
    const Json& a = rows[0];
    EXPECT_EQ(a.at("parameter"), "A");
    EXPECT_EQ(a.at("value"), json.at("parameters").at("A").at("value"));
    EXPECT_EQ(a.at("U"), json.at("parameters").at("A").at("expanded_uncertainty").at("value"));
    EXPECT_EQ(a.at("limit"), 0.1) << "of the band up to 1000 mm, in the unit of the result";
    EXPECT_EQ(a.at("travel_up_to"), 1000);
    EXPECT_EQ(a.at("guard_band"), a.at("U"));
    EXPECT_EQ(a.at("verdict"), "pass");
    EXPECT_EQ(a.at("unit"), "mm");
    EXPECT_NEAR(rows[1].at("value").get<double>(), 0.003, 1e-9);
    EXPECT_EQ(rows[2].at("verdict"), "not_evaluated");
    EXPECT_EQ(rows[2].at("reason"), "the travel is longer than every band");
    EXPECT_TRUE(rows[2].at("limit").is_null());
    EXPECT_NE(csv_of(result).find("# tolerances,acceptance,\"order 17, annex 2\",rule guard-U"),
              std::string::npos);
    EXPECT_NE(csv_of(result).find("\n# verdict,A,pass,"), std::string::npos);
}

TEST(ConformityJson, WithoutLimitsAndOfAPartialResultThereIsNone) {
    RunRecord run = measured_run();
    EXPECT_FALSE(json_of(make_certificate(run, {}).value()).contains("verdicts"));
    run.tolerances = agreed(DecisionRule::simple, {{"A", {}, 100}});
    EXPECT_TRUE(json_of(make_certificate(run, {}).value()).contains("verdicts"));
    run.points.pop_back();
    run.complete = false;
    const auto partial = make_certificate(run, {});
    ASSERT_TRUE(partial) << describe(partial.error());
    EXPECT_FALSE(json_of(*partial).contains("verdicts"));
    EXPECT_EQ(csv_of(*partial).find("# verdict"), std::string::npos);
}

TEST(ConformityJson, OfCirclesTheVerdictRestsOnTheWorstFigure) {
    const ScratchFolder folder;
    test::DrivenBar bar = test::bar_of_the_shop();
    bar.setup.uncertainty.device_width_um = 0.5;
    bar.setup.uncertainty.repeatability_um = 0.3;
    bar.setup.uncertainty.eve_um = 0.4;
    RunRecord header = test::circular_header();
    header.tolerances =
        agreed(DecisionRule::iso_14253_1_2017, {{"G_ccw", {}, 1000}, {"G_b", {}, 0.01}});
    const std::string path = test::write_circles(folder, bar, bar.drive(), true, {}, header);
    const auto circles = test::evaluated<CircularCertificate>(path);
    ASSERT_TRUE(circles) << describe(circles.error());
    const Json json = json_of(*circles);
    EXPECT_EQ(json.at("verdict"), "fail");
    EXPECT_EQ(json.at("verdicts")[0].at("verdict"), "pass");
    EXPECT_EQ(json.at("verdicts")[1].at("verdict"), "fail");
    EXPECT_EQ(circles->conformity->decisive()->parameter, "G_b");
    EXPECT_NEAR(json.at("verdicts")[1].at("guard_band").get<double>(),
                json.at("verdicts")[1].at("U").get<double>() * 1.6448536269514722 / 2, 1e-15);
}

TEST(ConformityJson, OfAProbingTestTheSimpleRuleNeedsNoUncertainty) {
    const ScratchFolder folder;
    for (const auto& [rule, verdict] :
         {std::pair{DecisionRule::simple, "fail"}, {DecisionRule::guard_U, "not_evaluated"}}) {
        RunRecord run = test::probing_header();
        run.tolerances = agreed(rule, {{"E_TD,Y", {}, 30}}); // the block's delay there is 40 um
        RunAttachments beside;
        beside.setup = test::probed_block();
        const std::string path = folder.file(std::string{name_of(rule)} + ".axiscal");
        auto writer = RunFileWriter::create(path, run, beside).value();
        ASSERT_TRUE(writer.close(true, "", run.closed));
        const auto probing = test::evaluated<ProbingResult>(path);
        ASSERT_TRUE(probing) << describe(probing.error());
        const Json row = json_of(*probing).at("verdicts")[0];
        EXPECT_EQ(row.at("verdict"), verdict);
        EXPECT_EQ(row.at("comparison"), "beyond_limit");
        EXPECT_NEAR(row.at("value").get<double>(), 0.040, 1e-12);
    }
}

TEST(ConformityJson, OfADriftTestItIsTheRangeOfTheAxis) {
    const ScratchFolder folder;
    RunRecord run;
    run.kind = TestKind::drift;
    run.run_id = "bench-drift";
    run.laser.instrument = "laser";
    run.laser.vacuum_wavelength = nm(632.991354);
    run.channels = {{0, "axis 1", "laser", "", ChannelKind::displacement, Medium::none, 0},
                    {1, "air", "weather", "", ChannelKind::temperature, Medium::air, 0},
                    {2, "pressure", "weather", "", ChannelKind::pressure, Medium::air, 0},
                    {3, "humidity", "weather", "", ChannelKind::humidity, Medium::air, 0},
                    {4, "bed", "contacts", "", ChannelKind::temperature, Medium::material, 0}};
    run.tolerances = agreed(DecisionRule::simple, {{"E_VE", {}, 9}, {"ETVE", {}, 12}});
    RunAttachments beside;
    beside.setup = DriftSetup{std::chrono::minutes{10}, std::chrono::minutes{1}, Length{}, false};
    const std::string path = folder.file("drift.axiscal");
    auto writer = RunFileWriter::create(path, run, beside).value();
    RunBatch batch; // the axis creeps by 1 um a minute for ten minutes
    for (int minute = 0; minute <= 10; ++minute)
        for (const auto& [channel, value] :
             {std::pair{0, 1e-6 * minute}, {1, 20.0}, {2, 101325.0}, {3, 50.0}, {4, 20.0}})
            batch.environment.push_back(
                {channel, monotonic_from_ns(60'000'000'000LL * minute), value});
    ASSERT_TRUE(writer.write(batch));
    ASSERT_TRUE(writer.close(true, "over", {}));
    const auto drift = test::evaluated<DriftResult>(path);
    ASSERT_TRUE(drift) << describe(drift.error());
    const Json json = json_of(*drift);
    EXPECT_EQ(json.at("verdict"), "fail");
    EXPECT_NEAR(json.at("verdicts")[0].at("value").get<double>(), 10, 0.01); // um, as the document
    EXPECT_EQ(json.at("verdicts")[0].at("limit"), 9);
    EXPECT_EQ(json.at("verdicts")[1].at("verdict"), "pass");
}

} // namespace
} // namespace axiscal::conformity_json_test
