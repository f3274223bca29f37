// The drift test of a ballbar at rest, and the E_VE that later circular tests take from it.
#include "analysis/drift/run_drift.hpp"
#include "tests/unit/station/station_bench.hpp"

#include <numbers>

namespace axiscal::testing::station_bar_drift_test {
namespace {

constexpr double swing_s = 20; // of the reading

class StationBarDrifts : public ::testing::Test {
protected:
    void SetUp() override {
        shop.shorten();
        CircularConfig circular;
        circular.setup.plan.nominal_radius_mm = 50;
        circular.setup.plan.feed_mm_per_s = 100;
        circular.setup.bar_instrument = "ballbar";
        shop.config.circular = circular;
        shop.config.ballbar = RoleConfig{"ballbar", "ballbar"};
        InstrumentConfig& bar = shop.config.instruments.emplace_back();
        bar.name = "ballbar";
        bar.driver = "made";
        bar.certificate_number = "C-1";
        bar.due_on = "2099-12-31";
        shop.ballbar = [this](MonotonicTime at) { return bar_m(at); };
    }
    /// Rises by 0.01 um a second and swings by 1 um, lowest 5 s after the begin.
    [[nodiscard]] double bar_m(MonotonicTime at) const {
        const double s = seconds_of(at - began);
        return 2e-4 + 1e-6 * (0.01 * s - std::sin(2 * std::numbers::pi * s / swing_s));
    }
    /// As a station file without [axis] makes it.
    void leave_out_the_axis() {
        AxisConfig& axis = shop.config.axis;
        axis.name = "XY";
        axis.laser = axis.air_temperature = axis.air_pressure = axis.air_humidity = {};
        shop.config.cycle = {};
        shop.config.capture = {};
    }
    std::shared_ptr<std::optional<Result<std::string>>> begin(Life& life, DriftRequest request) {
        began = life.scheduler.now();
        return life.begin_drift(std::move(request));
    }
    static DriftRequest a_minute(std::optional<bool> of_bar = {}) {
        DriftRequest request;
        request.duration = 60s;
        request.interval = 1s;
        request.of_bar = of_bar;
        return request;
    }
    Error refusal(Life& life, DriftRequest request) {
        const auto answer = begin(life, std::move(request));
        if (!*answer || **answer) return {Fault::none, "it began", {}, {}};
        return (**answer).error();
    }
    [[nodiscard]] RunFileContents contents() const {
        const auto read = read_run_file_contents(shop.run_files().at(0));
        EXPECT_TRUE(read) << (read ? "" : describe(read.error()));
        return read.value_or(RunFileContents{});
    }
    static Result<std::string> arm_circles(Life& life) {
        ArmRequest request;
        request.kind = TestKind::circular;
        const auto answer = life.begin_arm(std::move(request));
        life.run(2s);
        return *answer ? **answer : Result<std::string>{fail(Fault::internal, "still arming")};
    }
    Shop shop;
    MonotonicTime began{};
};

/// What axiscal-report leaves behind, without it.
void store_figures(const std::string& path, double eve_um, int refused = 0) {
    const std::string document = R"({"unit":"um","parameters":{"E_VE":{"value":)" +
                                 std::to_string(eve_um) + R"(}},"refused_readings":)" +
                                 std::to_string(refused) + "}";
    ASSERT_TRUE(store_result(path, {sha256_hex(document), document}));
}

TEST_F(StationBarDrifts, AStationWithABallbarAloneRecordsItAtRest) {
    leave_out_the_axis();
    Life life{shop};
    const auto id = begin(life, a_minute());
    ASSERT_TRUE(*id && **id) << describe((**id).error());
    EXPECT_TRUE((**id)->ends_with("-XY-ballbar-drift")) << ***id;
    EXPECT_TRUE(life.status().drift->of_bar);
    EXPECT_FALSE(life.status().drift->place_mm);
    life.run(70s);
    EXPECT_EQ(life.status().drift->state, "complete");
    const RunFileContents file = contents();
    EXPECT_TRUE(file.closed && file.run.complete);
    EXPECT_EQ(file.run.kind, TestKind::drift);
    EXPECT_TRUE(std::get<DriftSetup>(file.attachments.setup).of_bar);
    EXPECT_EQ(file.run.laser.instrument, "ballbar");
    EXPECT_EQ(file.run.statements.axis, "XY");
    ASSERT_EQ(file.run.channels.size(), 7U); // light, three of the air, two contacts, the bar
    EXPECT_EQ(file.run.channels.front().instrument, "ballbar");
    const auto drift = evaluate_drift(file.run, std::get<DriftSetup>(file.attachments.setup));
    ASSERT_TRUE(drift) << describe(drift.error());
    EXPECT_TRUE(drift->of_bar);
    EXPECT_EQ(drift->axis.times.size(), 60U);
    EXPECT_EQ(drift->missing, 0);
    // Lowest at 5 s, highest at 55 s: 2 um and 50 s of 0.01 um. A mean over 0.5 s of 20 takes 0.1 %
    // of the swing, readings a second apart miss a top by 0.012 um at most.
    EXPECT_NEAR(drift->eve.range, 2.5, 0.03);
    EXPECT_NEAR(life.status().drift->range_um.value(), drift->eve.range, 1e-6);
    for (const ChannelDrift& channel : drift->channels)
        EXPECT_GE(channel.series.times.size(), 59U) << channel.name;
}

TEST_F(StationBarDrifts, BesideAnAxisItMustBeAskedFor) {
    Life life{shop};
    begin(life, a_minute());
    EXPECT_FALSE(life.status().drift->of_bar);
    ASSERT_TRUE(life.abort("enough"));
    life.run(1s);
    const auto id = begin(life, a_minute(true));
    ASSERT_TRUE(*id && **id);
    EXPECT_TRUE(life.status().drift->of_bar);
    life.run(70s);
    for (const std::string& path : shop.run_files()) {
        const auto file = read_run_file_contents(path);
        ASSERT_TRUE(file);
        const bool of_bar = file->run.run_id == **id;
        EXPECT_EQ(file->run.kind, TestKind::drift);
        EXPECT_EQ(std::get<DriftSetup>(file->attachments.setup).of_bar, of_bar);
        EXPECT_EQ(file->run.laser.instrument, of_bar ? "ballbar" : "laser");
        EXPECT_EQ(file->run.channels.front().instrument, of_bar ? "ballbar" : "laser");
        EXPECT_EQ(file->run.laser.vacuum_wavelength.si() == 0, of_bar);
        if (!of_bar) continue;
        const auto drift = evaluate_drift(file->run, std::get<DriftSetup>(file->attachments.setup));
        ASSERT_TRUE(drift) << describe(drift.error());
        EXPECT_NEAR(drift->eve.range, 2.5, 0.03);
    }
}

TEST_F(StationBarDrifts, RefusesWhatCannotBeATestOfTheBar) {
    {
        Life life{shop};
        DriftRequest request = a_minute(true);
        request.place_mm = 900;
        EXPECT_EQ(refusal(life, request).field, "place_mm");
        request = a_minute(true);
        request.interval = 100ms; // shorter than the window of a reading
        EXPECT_EQ(refusal(life, request).field, "interval");
        life.bar->quality = Quality::signal_error;
        life.run(100ms);
        EXPECT_EQ(refusal(life, a_minute(true)).fault, Fault::signal_error);
        life.bar->silent = true;
        life.run(3s);
        const Error silent = refusal(life, a_minute(true));
        EXPECT_NE(silent.detail.find("the ballbar (ballbar) sends nothing"), std::string::npos)
            << silent.detail;
    }
    leave_out_the_axis();
    {
        Life alone{shop};
        const Error no_axis = refusal(alone, a_minute(false));
        EXPECT_EQ(no_axis.field, "of");
        EXPECT_NE(no_axis.detail.find("--of ballbar"), std::string::npos) << no_axis.detail;
    }
    EXPECT_TRUE(shop.run_files().empty());
}

TEST_F(StationBarDrifts, OfTooFewReadingsForAMeanIsRefused) {
    leave_out_the_axis();
    Life life{shop};
    life.bar->send_every = 500ms; // one within the window of 0.5 s
    life.run(5s);
    const Error slow = refusal(life, a_minute());
    EXPECT_EQ(slow.fault, Fault::refused);
    EXPECT_NE(slow.detail.find("sends 2 readings a second"), std::string::npos) << slow.detail;
    EXPECT_TRUE(shop.run_files().empty());
}

TEST_F(StationBarDrifts, WithoutABallbarThereIsNone) {
    Shop other;
    Life life{other};
    const Error refused = refusal(life, a_minute(true));
    EXPECT_EQ(refused.field, "of");
    EXPECT_NE(refused.detail.find("[ballbar]"), std::string::npos) << refused.detail;
}

TEST_F(StationBarDrifts, ALostZeroEndsItAndSaysSo) {
    leave_out_the_axis();
    Life life{shop};
    begin(life, a_minute());
    life.run(10s);
    ++life.bar->epoch; // a counter behind a glass scale was switched off and on
    life.run(5s);
    EXPECT_EQ(life.status().drift->state, "incomplete");
    EXPECT_NE(life.status().drift->sentence.find("lost its zero"), std::string::npos);
    EXPECT_FALSE(contents().run.complete);
}

TEST_F(StationBarDrifts, WhatTheBarDoesNotTellIsMissingAndCounted) {
    leave_out_the_axis();
    Life life{shop};
    begin(life, a_minute());
    life.run(10s);
    life.bar->silent = true;
    life.run(10s);
    life.bar->silent = false;
    life.bar->quality = Quality::signal_error; // out of its range
    life.run(10s);
    life.bar->quality = Quality::good;
    life.run(40s);
    const DriftView view = *life.status().drift;
    EXPECT_EQ(view.state, "complete");
    EXPECT_NEAR(view.missing, 20, 1);
    EXPECT_EQ(view.taken + view.missing, 60);
    const RunFileContents file = contents();
    EXPECT_EQ(evaluate_drift(file.run, std::get<DriftSetup>(file.attachments.setup))->missing,
              view.missing);
}

TEST_F(StationBarDrifts, CirclesWaitForItsEndAndItForTheirs) {
    leave_out_the_axis();
    Life life{shop};
    begin(life, a_minute());
    EXPECT_EQ(arm_circles(life).error().fault, Fault::busy);
    life.run(70s);
    ASSERT_TRUE(arm_circles(life));
    EXPECT_EQ(refusal(life, a_minute()).fault, Fault::busy);
}

TEST_F(StationBarDrifts, ADaemonThatWentAwayClosesItAsIncomplete) {
    leave_out_the_axis();
    {
        Life life{shop};
        begin(life, a_minute());
        life.run(10s);
    }
    Life again{shop};
    const RunFileContents file = contents();
    EXPECT_TRUE(file.closed);
    EXPECT_FALSE(file.run.complete);
    EXPECT_NE(file.run.closing_reason.find("Nobody watched the resting ballbar"), std::string::npos)
        << file.run.closing_reason;
}

TEST_F(StationBarDrifts, FeedsTheBudgetOfLaterCirclesWithItsName) {
    leave_out_the_axis();
    shop.config.circular->eve_run = "latest";
    Life life{shop};
    const auto refused = arm_circles(life);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::not_found);
    for (const char* words : {"circular.uncertainty.eve_run = \"latest\"",
                              "ballbar ballbar/ballbar", "'axiscal drift --of ballbar' makes one"})
        EXPECT_NE(refused.error().detail.find(words), std::string::npos) << refused.error().detail;
    const auto id = begin(life, a_minute());
    life.run(70s);
    EXPECT_FALSE(arm_circles(life)) << "complete, but not evaluated yet";
    store_figures(shop.run_files().at(0), 2.5);
    const auto armed = arm_circles(life);
    ASSERT_TRUE(armed) << describe(armed.error());
    for (const std::string& path : shop.run_files()) {
        const auto file = read_run_file_contents(path);
        ASSERT_TRUE(file) << describe(file.error());
        if (std::holds_alternative<DriftSetup>(file->attachments.setup)) continue;
        const auto* circular = std::get_if<CircularSetup>(&file->attachments.setup);
        ASSERT_TRUE(circular && circular->uncertainty.eve_um);
        EXPECT_NEAR(*circular->uncertainty.eve_um, 2.5, 1e-9);
        EXPECT_EQ(file->attachments.eve_source, **id);
        EXPECT_FALSE(file->run.uncertainty);
    }
}

TEST_F(StationBarDrifts, WithRefusedReadingsFeedsNothingAndSaysWhy) {
    leave_out_the_axis();
    shop.config.circular->eve_run = "latest";
    Life life{shop};
    begin(life, a_minute());
    life.run(70s);
    store_figures(shop.run_files().at(0), 2.5, 3);
    const auto refused = arm_circles(life);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::refused);
    EXPECT_NE(refused.error().detail.find("3 of its readings"), std::string::npos);
    EXPECT_NE(refused.error().detail.find("'axiscal drift --of ballbar'"), std::string::npos);
}

TEST_F(StationBarDrifts, AndATestOfTheAxisAreNotEachOthersSource) {
    shop.config.circular->eve_run = shop.config.eve_run = "latest";
    shop.config.axis.name = "XY"; // as the plane: the name alone tells nothing
    Life life{shop};
    DriftRequest of_axis = a_minute(false);
    of_axis.duration = 5min; // as long as a run
    begin(life, of_axis);
    life.run(5min + 10s);
    store_figures(shop.run_files().at(0), 1.25);
    EXPECT_EQ(arm_circles(life).error().fault, Fault::not_found);
    const auto of_bar = begin(life, a_minute(true));
    life.run(70s);
    for (const std::string& path : shop.run_files())
        if (read_run_file(path)->run_id == **of_bar) store_figures(path, 2.5);
    ASSERT_TRUE(life.arm());
    const auto newest = read_run_file_contents(life.status().run->file);
    ASSERT_TRUE(newest && newest->run.uncertainty);
    EXPECT_NEAR(newest->run.uncertainty->eve->in(um), 1.25, 1e-9);
    ASSERT_TRUE(life.abort("enough"));
    life.run(1s);
    ASSERT_TRUE(arm_circles(life));
    const auto circles = read_run_file_contents(life.status().run->file);
    ASSERT_TRUE(circles && std::holds_alternative<CircularSetup>(circles->attachments.setup));
    const auto& stated = std::get<CircularSetup>(circles->attachments.setup).uncertainty;
    EXPECT_NEAR(stated.eve_um.value_or(0), 2.5, 1e-9);
}

TEST_F(StationBarDrifts, OfAnotherBarIsNotItsOwn) {
    leave_out_the_axis();
    shop.config.circular->eve_run = "latest";
    {
        Life life{shop};
        begin(life, a_minute());
        life.run(70s);
        store_figures(shop.run_files().at(0), 2.5);
        ASSERT_TRUE(arm_circles(life));
        ASSERT_TRUE(life.abort("enough"));
        life.run(1s);
    }
    shop.config.instruments.back().name = "short bar";
    shop.config.ballbar->instrument = shop.config.circular->setup.bar_instrument = "short bar";
    Life again{shop};
    const auto refused = arm_circles(again);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::not_found);
    EXPECT_NE(refused.error().detail.find("short bar/ballbar"), std::string::npos);
}

} // namespace
} // namespace axiscal::testing::station_bar_drift_test
