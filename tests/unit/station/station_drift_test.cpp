// The drift test from its order to its file, and what it does to later runs.
#include "analysis/drift/run_drift.hpp"
#include "tests/support/report_script.hpp"
#include "tests/unit/station/station_bench.hpp"

namespace axiscal::testing::station_drift_test {
namespace {

class StationDrifts : public ::testing::Test {
protected:
    void SetUp() override { shop.shorten(); }
    static DriftRequest short_test() {
        DriftRequest request;
        request.duration = 60s;
        request.interval = 1s;
        return request;
    }
    RunFileContents contents() {
        const auto read = read_run_file_contents(shop.run_files().at(0));
        EXPECT_TRUE(read) << (read ? "" : describe(read.error()));
        return read.value_or(RunFileContents{});
    }
    Shop shop;
};

TEST_F(StationDrifts, RecordsEveryChannelWithoutACnc) {
    Life life{shop};
    shop.axis.go(900, life.scheduler.now());
    life.run(5s);
    DriftRequest request = short_test();
    request.place_mm = 900;
    request.statements["operator"] = "Shift 2";
    const auto id = life.begin_drift(request);
    ASSERT_TRUE(*id && **id);
    EXPECT_TRUE((**id)->ends_with("-drift"));
    EXPECT_EQ(life.status().drift->state, "recording");
    life.run(70s);
    EXPECT_EQ(life.status().drift->state, "complete");
    const RunFileContents file = contents();
    EXPECT_TRUE(file.closed && file.run.complete);
    ASSERT_TRUE(std::holds_alternative<DriftSetup>(file.attachments.setup));
    EXPECT_EQ(std::get<DriftSetup>(file.attachments.setup).place, mm(900));
    EXPECT_EQ(std::get<DriftSetup>(file.attachments.setup).duration, 60s);
    EXPECT_EQ(file.run.statements.operator_name, "Shift 2");
    EXPECT_EQ(file.run.channels.size(), 6U);
    const auto drift = evaluate_drift(file.run, std::get<DriftSetup>(file.attachments.setup));
    ASSERT_TRUE(drift) << describe(drift.error());
    EXPECT_EQ(drift->axis.times.size(), 60U);
    EXPECT_EQ(drift->missing, 0);
    EXPECT_NEAR(drift->eve.range, 0, 1e-6); // nothing moves on this bench
    for (const ChannelDrift& channel : drift->channels)
        EXPECT_GE(channel.series.times.size(), 59U) << channel.name;
}

/// A scale measures the axis, so that no run uses air; a ballbar stands beside it.
void measure_by_scale_beside_a_ballbar(Shop& shop) {
    AxisConfig& axis = shop.config.axis;
    axis.air_temperature = axis.air_pressure = axis.air_humidity = {};
    axis.material_temperature = {{"material", "contact 1"}};
    axis.scale.emplace().temperature = {{"material", "contact 2"}};
    InstrumentConfig& bar = shop.config.instruments.emplace_back();
    bar.name = "ballbar";
    bar.driver = "made";
    shop.config.ballbar = RoleConfig{"ballbar", "ballbar"};
    const MonotonicTime since = shop.now;
    shop.ballbar = [since](MonotonicTime at) { return 1e-8 * seconds_of(at - since); };
}

TEST_F(StationDrifts, RecordsWhatNoRunUsesWithoutAMedium) {
    measure_by_scale_beside_a_ballbar(shop);
    Life life{shop};
    life.begin_drift(short_test());
    life.run(70s);
    const RunFileContents file = contents();
    ASSERT_EQ(file.run.channels.size(), 7U);
    const auto drift = evaluate_drift(file.run, std::get<DriftSetup>(file.attachments.setup));
    ASSERT_TRUE(drift) << describe(drift.error());
    EXPECT_EQ(drift->reading.name, "axis 1");
    for (const ChannelDrift& channel : drift->channels) {
        const bool used = channel.instrument == "material";
        EXPECT_EQ(channel.medium, used ? Medium::material : Medium::none) << channel.name;
        EXPECT_GE(channel.series.times.size(), 59U) << channel.name;
    }
    const ChannelDrift& bar = drift->channels.back();
    EXPECT_EQ(bar.instrument, "ballbar");
    EXPECT_NEAR(bar.total.range, 0.59, 0.002); // 0.01 um a second, 59 seconds
    EXPECT_NEAR(bar.slope_per_h.value(), 36, 0.01);
}

TEST_F(StationDrifts, AChannelThatStaysSilentIsTold) {
    Life life{shop};
    life.air->silent = life.material->silent = true;
    life.begin_drift(short_test());
    life.run(70s);
    const RunFileContents file = contents();
    EXPECT_EQ(file.run.channels.size(), 6U);
    const auto drift = evaluate_drift(file.run, std::get<DriftSetup>(file.attachments.setup));
    ASSERT_TRUE(drift) << describe(drift.error()); // the last readings are fresh for a minute
    for (const ChannelDrift& channel : drift->channels)
        EXPECT_LE(channel.series.times.size(), 1U) << channel.name;
}

TEST_F(StationDrifts, SeesTheAxisCreep) {
    Life life{shop};
    shop.axis.go(900, life.scheduler.now());
    life.run(5s);
    shop.axis.go(900, life.scheduler.now()); // it rests: the speed is of the next move
    shop.axis.speed_mm_per_s = 1e-4;         // 0.1 um/s
    shop.axis.go(901, life.scheduler.now());
    life.begin_drift(short_test());
    life.run(70s);
    const RunFileContents file = contents();
    const auto drift = evaluate_drift(file.run, std::get<DriftSetup>(file.attachments.setup));
    ASSERT_TRUE(drift);
    // 59 intervals of 1 s; in air 22.6 degC warm steel: 3e-5 shorter. The bench's light is
    // longer by 2.7e-4, its air nearly as much.
    EXPECT_NEAR(drift->eve.range, 5.9, 0.001);
    EXPECT_NEAR(life.status().drift->range_um.value(), 5.9, 0.01);
}

TEST_F(StationDrifts, StandsAtTheFarEndUnlessSaidOtherwise) {
    Life life{shop};
    life.begin_drift(short_test());
    EXPECT_EQ(life.status().drift->place_mm, 1000);
    ASSERT_TRUE(life.abort("enough"));
    life.run(1s);
    EXPECT_EQ(life.status().drift->state, "incomplete");
    EXPECT_EQ(life.status().drift->sentence, "enough");
    EXPECT_FALSE(contents().run.complete);
}

TEST_F(StationDrifts, AtAnotherPlaceThanTheLaserSeesIsRefused) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    const double datum_mm = shop.plan().datum.in(mm);
    ASSERT_TRUE(life.abort("enough"));
    life.run(1s);
    const auto refused = life.begin_drift(short_test()); // at the far end, it says
    ASSERT_TRUE(*refused && !**refused);
    EXPECT_EQ((*refused)->error().field, "place_mm");
    EXPECT_NE((*refused)->error().detail.find("drive it to the place, or say --at"),
              std::string::npos)
        << (*refused)->error().detail;
    DriftRequest there = short_test();
    there.place_mm = datum_mm + 0.5;
    const auto begun = life.begin_drift(there);
    EXPECT_TRUE(*begun && **begun) << describe((*begun)->error());
}

TEST_F(StationDrifts, RunsAndAlignmentsWaitForItsEnd) {
    Life life{shop};
    life.begin_drift(short_test());
    EXPECT_EQ(life.arm().error().fault, Fault::busy);
    EXPECT_EQ(life.station->align({AlignmentAction::begin, {}}).error().fault, Fault::busy);
    EXPECT_EQ((**life.begin_drift(short_test())).error().fault, Fault::busy);
    life.run(70s);
    EXPECT_TRUE(life.arm());
    EXPECT_EQ((**life.begin_drift(short_test())).error().fault, Fault::busy);
}

TEST_F(StationDrifts, RefusesWhatCannotBeATest) {
    Life life{shop};
    DriftRequest request = short_test();
    request.interval = 100ms; // shorter than the window of a reading
    EXPECT_EQ((**life.begin_drift(request)).error().field, "interval");
    request = short_test();
    request.duration = 1500ms;
    EXPECT_EQ((**life.begin_drift(request)).error().field, "duration");
    request = short_test();
    request.place_mm = 1001;
    EXPECT_EQ((**life.begin_drift(request)).error().field, "place_mm");
    request = short_test();
    request.statements["colour"] = "red";
    EXPECT_EQ((**life.begin_drift(request)).error().fault, Fault::bad_request);
    EXPECT_TRUE(shop.run_files().empty());
}

TEST_F(StationDrifts, ALostZeroEndsItAndSaysSo) {
    Life life{shop};
    life.begin_drift(short_test());
    life.run(10s);
    ++life.laser->epoch;
    life.run(5s);
    EXPECT_EQ(life.status().drift->state, "incomplete");
    EXPECT_NE(life.status().drift->sentence.find("lost its zero"), std::string::npos);
}

TEST_F(StationDrifts, ASilentLaserLeavesGapsThatAreCounted) {
    Life life{shop};
    life.begin_drift(short_test());
    life.run(10s);
    life.laser->silent = true;
    life.run(10s);
    life.laser->silent = false;
    life.run(50s);
    const DriftView view = *life.status().drift;
    EXPECT_EQ(view.state, "complete");
    EXPECT_NEAR(view.missing, 10, 1);
    EXPECT_EQ(view.taken + view.missing, 60);
}

TEST_F(StationDrifts, ADaemonThatWentAwayClosesItAsIncomplete) {
    {
        Life life{shop};
        life.begin_drift(short_test());
        life.run(10s);
    }
    Life again{shop};
    EXPECT_FALSE(again.status().run);
    const RunFileContents file = contents();
    EXPECT_TRUE(file.closed);
    EXPECT_FALSE(file.run.complete);
    EXPECT_NE(file.run.closing_reason.find("Nobody watched"), std::string::npos);
    EXPECT_TRUE(again.arm());
}

/// What axiscal-report leaves behind, without it.
void store_eve(const std::string& path, double um) {
    const std::string document = R"({"format":"axiscal.drift/1","parameters":{"E_VE":{"value":)" +
                                 std::to_string(um) + "}}}";
    ASSERT_TRUE(store_result(path, {sha256_hex(document), document}));
}

TEST_F(StationDrifts, FeedsTheBudgetOfLaterRuns) {
    shop.config.eve_run = "latest";
    Life life{shop};
    const auto refused = life.arm();
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::not_found);
    EXPECT_NE(refused.error().detail.find("axiscal drift"), std::string::npos);
    DriftRequest long_enough = short_test();
    long_enough.duration = 5min;
    const auto id = life.begin_drift(long_enough);
    life.run(5min + 10s);
    EXPECT_FALSE(life.arm()) << "complete, but not evaluated yet";
    store_eve(shop.run_files().at(0), 1.25);
    ASSERT_TRUE(life.arm());
    for (const std::string& path : shop.run_files()) {
        const auto file = read_run_file_contents(path);
        if (std::holds_alternative<DriftSetup>(file->attachments.setup)) continue;
        ASSERT_TRUE(file->run.uncertainty && file->run.uncertainty->eve);
        EXPECT_NEAR(file->run.uncertainty->eve->in(um), 1.25, 1e-9);
        EXPECT_EQ(file->attachments.eve_source, **id);
    }
}

TEST_F(StationDrifts, ShorterThanTheRunNeedsAReasonThatStandsInItsFile) {
    shop.config.eve_run = "latest";
    shop.config.cycle.dwell = 60s; // two halts are longer than the test
    Life life{shop};
    const auto eve_now = [&] {
        const auto checks = life.preflight().value();
        return *std::ranges::find(checks, "eve", &PreflightRecord::name);
    };
    EXPECT_NE(eve_now().verdict.find("names no complete drift test of axis X"), std::string::npos)
        << eve_now().verdict;
    life.begin_drift(short_test());
    life.run(70s);
    store_eve(shop.run_files().at(0), 1.25);
    EXPECT_FALSE(eve_now().passed);
    const auto refused = life.arm();
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().field, "preflight");
    EXPECT_NE(refused.error().detail.find("60 s, the axis at 1000 mm. The test is too short"),
              std::string::npos)
        << refused.error().detail;
    ArmRequest request;
    request.overrides["eve"] = "the hall is at rest";
    ASSERT_TRUE(life.arm(request));
    const auto file = read_run_file_contents(life.status().run->file);
    const auto& checks = file->revisions.preflight;
    const auto kept = std::ranges::find(checks, "eve", &PreflightRecord::name);
    ASSERT_NE(kept, checks.end());
    EXPECT_EQ(kept->override_reason, "the hall is at rest");
    EXPECT_NEAR(file->run.uncertainty->eve->in(um), 1.25, 1e-9);
}

TEST_F(StationDrifts, ThatLeftReadingsOutFeedsNothingAndSaysWhy) {
    shop.config.eve_run = "latest";
    Life life{shop};
    life.begin_drift(short_test());
    life.run(70s);
    const std::string document =
        R"({"unit":"um","parameters":{"E_VE":{"value":1}},"refused_readings":3})";
    ASSERT_TRUE(store_result(shop.run_files().at(0), {sha256_hex(document), document}));
    const auto refused = life.arm();
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::refused);
    EXPECT_NE(refused.error().detail.find("3 of its readings"), std::string::npos);
}

TEST_F(StationDrifts, OfAnAxisOfTheOtherKindFeedsNothing) {
    shop.config.eve_run = "latest";
    Life life{shop};
    life.begin_drift(short_test());
    life.run(70s);
    const std::string document = R"({"unit":"arcsec","parameters":{"E_VE":{"value":1}}})";
    ASSERT_TRUE(store_result(shop.run_files().at(0), {sha256_hex(document), document}));
    EXPECT_EQ(life.arm().error().fault, Fault::bad_run_file);
}

TEST_F(StationDrifts, OfAnotherAxisIsNotTheRunsOwn) {
    shop.config.eve_run = "latest";
    {
        Life life{shop};
        life.begin_drift(short_test());
        life.run(70s);
        store_eve(shop.run_files().at(0), 1.25);
    }
    shop.config.axis.name = "Y";
    Life again{shop};
    EXPECT_EQ(again.arm().error().fault, Fault::not_found);
}

} // namespace
} // namespace axiscal::testing::station_drift_test
