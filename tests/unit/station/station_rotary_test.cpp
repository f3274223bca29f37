// A rotary axis at the station, behind an indexing table with the interferometer's readings.
#include "analysis/drift/run_drift.hpp"
#include "analysis/positioning/positioning_certificate.hpp"
#include "rotary_bench.hpp"

namespace axiscal::station_rotary_test {
namespace {

using namespace testing;

/// As the part program does: to the begin of the approach, the table is turned, then the approach.
void drive_behind_table(Life& life, TableShop& shop, const PlannedPoint& point, int off = 0) {
    const double target = shop.plan().targets[static_cast<std::size_t>(point.target_index)].in(mm);
    const int side = static_cast<int>(point.direction);
    const auto go = [&](double to_deg) {
        const Duration needed = shop.axis.time_to(to_deg, life.scheduler.now());
        shop.axis.go(to_deg, life.scheduler.now());
        life.run(needed + 50ms);
    };
    go(target - side);
    shop.position = static_cast<int>(std::lround((target + 2) / step_deg)) + off;
    life.run(200ms);
    shop.error_deg = side * 2.0 / 3600;
    go(target);
}

bool take_behind_table(Life& life, TableShop& shop, int step) {
    const PlannedPoint point = shop.plan().points[static_cast<std::size_t>(step)];
    drive_behind_table(life, shop, point);
    const auto sequence = static_cast<std::uint16_t>(step + 1);
    life.ask(Life::request_for(point, sequence));
    for (int i = 0; i < 40 && life.port->done != sequence && life.port->refusals.empty(); ++i)
        life.run(100ms);
    return life.port->done == sequence;
}

TEST(StationRotary, MeasuresBehindATableThatIsTurnedBackAtEachTarget) {
    TableShop shop;
    Life life{shop};
    ArmRequest request;
    request.statements["run_out"] = "6 um";
    const auto armed = life.arm(request);
    ASSERT_TRUE(armed) << describe(armed.error());
    for (int step = 0; step < 10; ++step)
        ASSERT_TRUE(take_behind_table(life, shop, step))
            << step << " " << life.status().run->last_sentence;
    life.run_until([&] { return !life.status().run_open; });
    ASSERT_EQ(shop.run_files().size(), 1U);
    const RunRecord run = read_run_file(shop.run_files().front()).value();
    ASSERT_TRUE(run.rotary);
    EXPECT_EQ(run.rotary->run_out, "6 um");
    EXPECT_EQ(run.instruments.back().serial, "T-7");
    EXPECT_GE(run.points.front().approach_travel, mm(0.9));
    const auto certificate = make_certificate(run, "hash");
    ASSERT_TRUE(certificate) << describe(certificate.error());
    // The bench's index is 2.7e-4, the air's 2.65e-4: 5e-6 of a rest of 2.5 degrees is 0.05".
    constexpr double bound_deg = 0.06 / 3600;
    for (const auto& row : certificate->deviations.forward())
        EXPECT_NEAR(row[0], 2.0 / 3600, bound_deg);
    EXPECT_NEAR(*certificate->result.parameters.B_mean, 4.0 / 3600, bound_deg);
}

TEST(StationRotary, ATableOneStepOffIsRefusedAndNamed) {
    TableShop shop;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    ASSERT_TRUE(take_behind_table(life, shop, 0));
    const PlannedPoint point = shop.plan().points[1];
    drive_behind_table(life, shop, point, -1);
    life.ask(Life::request_for(point, 2));
    life.run(3s);
    ASSERT_FALSE(life.port->refusals.empty());
    EXPECT_EQ(life.port->refusals.front().second, Fault::outside_window);
    EXPECT_NE(life.status().run->last_sentence.find("1 step short"), std::string::npos)
        << life.status().run->last_sentence;
}

TEST(StationRotary, ShowsAPositionNearTheNextTargetOnly) {
    TableShop shop;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    EXPECT_FALSE(life.status().axis.position_mm); // at the datum, 2 degrees from the first target
    drive_behind_table(life, shop, shop.plan().points[0]);
    ASSERT_TRUE(life.status().axis.position_mm);
    EXPECT_NEAR(*life.status().axis.position_mm, 2.0 / 3600, 0.1 / 3600);
    EXPECT_FALSE(life.status().axis.reads_angle);
    EXPECT_NEAR(*life.port->status.measured_mm, 2.0 / 3600, 0.1 / 3600);
}

TEST(StationRotary, AsksForTheRunOutOfTheSetUp) {
    TableShop shop;
    Life life{shop};
    const auto run_out = [&](const ArmRequest& request) {
        const auto checks = life.preflight(request).value();
        return *std::ranges::find(checks, "run_out", &PreflightRecord::name);
    };
    EXPECT_TRUE(run_out({}).warning);
    EXPECT_NE(run_out({}).verdict.find("--state-that run_out="), std::string::npos);
    ArmRequest request;
    request.statements["run_out"] = "6 um";
    EXPECT_FALSE(run_out(request).warning);
}

TEST(StationRotary, AnArtefactThatIsPastItsDateBlocks) {
    TableShop shop;
    shop.config.axis.angle->artefact.due_on = "1969-12-31"; // the bench's calendar begins after it
    Life life{shop};
    const auto checks = life.preflight({}).value();
    const auto papers = std::ranges::find(checks, "certificates", &PreflightRecord::name);
    EXPECT_FALSE(papers->passed);
    EXPECT_NE(papers->verdict.find("indexing table was due for calibration on 1969-12-31"),
              std::string::npos)
        << papers->verdict;
}

TEST(StationRotary, ADriftTestGivesEveInSecondsOfArcToLaterBudgets) {
    TableShop shop;
    shop.config.eve_run = "latest";
    const MonotonicTime since = shop.now;
    shop.reading_m = [since](MonotonicTime at) { // it creeps by 0.1 second of arc in a second
        return arm_mm * 1e-3 * std::sin(0.1 * seconds_of(at - since) / 3600 * rad) * (1 + 2.7e-4);
    };
    Life life{shop};
    const auto id = test_drift(life);
    ASSERT_TRUE(id && *id) << (id ? describe(id->error()) : "");
    EXPECT_EQ(life.status().drift->place_mm, -2) << "at the datum, unless said otherwise";
    const std::string path = shop.run_files().at(0);
    const auto file = read_run_file_contents(path);
    ASSERT_TRUE(file && std::holds_alternative<DriftSetup>(file->attachments.setup));
    const auto drift = evaluate_drift(file->run, std::get<DriftSetup>(file->attachments.setup));
    ASSERT_TRUE(drift) << describe(drift.error());
    // 19 intervals; the bench's index is 2.7e-4, the air's 2.65e-4.
    EXPECT_NEAR(drift->eve.range, 1.9, 1e-4);
    EXPECT_NEAR(drift->slope_per_h.value(), 360, 0.01);
    const std::string document = R"({"unit":"arcsec","parameters":{"E_VE":{"value":1.9}}})";
    ASSERT_TRUE(store_result(path, {sha256_hex(document), document}));
    shop.reading_m = [](MonotonicTime) { return 0.0; };
    ArmRequest request;
    request.overrides["eve"] = "the run takes longer than the test";
    const auto armed = life.arm(request);
    ASSERT_TRUE(armed) << describe(armed.error());
    for (const std::string& one : shop.run_files()) {
        const auto run = read_run_file_contents(one).value();
        if (std::holds_alternative<DriftSetup>(run.attachments.setup)) continue;
        EXPECT_NEAR(run.run.uncertainty.value().eve->in(mm)*3600, 1.9, 1e-9);
        EXPECT_EQ(run.attachments.eve_source, **id);
    }
}

TEST(StationRotary, AStationWithAnInterferometerTakesNoTypedReading) {
    TableShop shop;
    Life life{shop};
    EXPECT_EQ(life.station->type_reading(1).error().fault, Fault::bad_request);
}

} // namespace
} // namespace axiscal::station_rotary_test
