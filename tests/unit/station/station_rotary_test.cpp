// A rotary axis at the station: behind an indexing table with the interferometer's readings, and
// before an autocollimator whose readings are typed, or captured where it is an instrument.
#include "analysis/certificate.hpp"
#include "analysis/drift/run_drift.hpp"
#include "station_bench.hpp"

#include <cmath>
#include <numbers>

namespace axiscal::station_rotary_test {
namespace {

using namespace testing;

constexpr double rad = std::numbers::pi / 180, arm_mm = 32.61, step_deg = 5;

/// Five targets over a quarter turn, once from each side: ten points.
void make_rotary(Shop& shop) {
    CycleConfig& cycle = shop.config.cycle;
    cycle.axis_kind = AxisKind::rotary;
    cycle.travel_low = mm(-3);
    cycle.travel_high = mm(95);
    cycle.interval.reset();
    cycle.target_count.reset();
    cycle.first_target.reset();
    cycle.seed.reset();
    cycle.targets = std::vector<Length>{mm(0), mm(31.2), mm(62.9), mm(70), mm(90)};
    cycle.overrun = mm(1);
    cycle.datum = mm(-2);
    cycle.near_tolerance = mm(0.2);
    cycle.approaches = 1;
    shop.config.capture.spread_limit = mm(1.0 / 3600);
    shop.config.capture.fastest = metre_per_second(50); // the table of this bench turns at once
    shop.config.axis.material_temperature.clear();
    AngleConfig& angle = shop.config.axis.angle.emplace();
    angle.setup.step_deg = step_deg;
    angle.setup.arm = mm(arm_mm);
    angle.artefact.name = "indexing table";
    angle.artefact.serial = "T-7";
    shop.axis.speed_mm_per_s = 50;
}

/// The axis with two seconds of arc of lost motion each way, and the table on it.
class TableShop : public Shop {
public:
    TableShop() {
        make_rotary(*this);
        axis.go(-2, now);
        reading_m = [this](MonotonicTime at) {
            const double rest = axis.at(at) + error_deg + 2 - position * step_deg;
            return arm_mm * 1e-3 * std::sin(rest * rad) * (1 + 2.7e-4);
        };
    }
    int position = 0;
    double error_deg = 0;
};

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
        const auto checks = life.station->preflight(request).value();
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
    const auto checks = life.station->preflight({}).value();
    const auto papers = std::ranges::find(checks, "certificates", &PreflightRecord::name);
    EXPECT_FALSE(papers->passed);
    EXPECT_NE(papers->verdict.find("indexing table was due for calibration on 1969-12-31"),
              std::string::npos)
        << papers->verdict;
}

/// Eight faces over a turn; the readings are typed.
class PolygonShop : public Shop {
public:
    PolygonShop() {
        make_rotary(*this);
        config.cycle.travel_low = mm(-2);
        config.cycle.travel_high = mm(362);
        config.cycle.overrun = mm(2);
        config.cycle.datum.reset();
        config.cycle.targets = std::vector<Length>{};
        for (int face = 0; face < 8; ++face)
            config.cycle.targets->push_back(mm(45 * face));
        config.axis.laser = config.axis.air_temperature = {};
        config.axis.air_pressure = config.axis.air_humidity = {};
        RotarySetup& setup = config.axis.angle->setup;
        setup.method = AngleMethod::polygon;
        setup.step_deg = 45;
        setup.range_deg = 0.1;
        setup.arm = {};
        setup.deviations_arcsec = {0, 1, -2, 0, 0, 0, 0, 0.5};
        config.axis.angle->artefact.name = "polygon";
    }
    /// An axis that leads by 3 seconds of arc, seen through the polygon.
    [[nodiscard]] double arcsec_at(const PlannedPoint& point) const {
        const auto& faces = config.axis.angle->setup.deviations_arcsec;
        return 3.0 * static_cast<int>(point.direction) +
               faces[static_cast<std::size_t>(point.target_index)];
    }
};

TEST(StationRotary, APolygonsReadingsAreTyped) {
    PolygonShop shop;
    Life life{shop};
    EXPECT_EQ(life.station->type_reading(1).error().fault, Fault::no_run_armed);
    const auto armed = life.arm();
    ASSERT_TRUE(armed) << describe(armed.error());
    for (const PlannedPoint& point : shop.plan().points) {
        const auto typed = life.station->type_reading(shop.arcsec_at(point));
        ASSERT_TRUE(typed) << point.step << " " << describe(typed.error());
        life.run(200ms);
    }
    life.run_until([&] { return !life.status().run_open; });
    const RunRecord run = read_run_file(shop.run_files().front()).value();
    EXPECT_TRUE(run.complete);
    EXPECT_EQ(run.points.front().origin, TriggerOrigin::manual);
    const auto certificate = make_certificate(run, "hash");
    ASSERT_TRUE(certificate) << describe(certificate.error());
    EXPECT_NEAR(*certificate->result.parameters.E, 6.0 / 3600, 1e-12);
    EXPECT_NEAR(*certificate->result.parameters.M, 0, 1e-12);
    EXPECT_NEAR(*certificate->result.parameters.B_mean, 6.0 / 3600, 1e-12);
}

TEST(StationRotary, ATypedReadingAnswersTheControlThatAsks) {
    PolygonShop shop;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    life.ask(Life::request_for(shop.plan().points[0], 1));
    life.run(1s);
    EXPECT_EQ(life.port->done, 0);
    const auto beyond = life.station->type_reading(400); // 0.111 degrees
    ASSERT_FALSE(beyond);
    EXPECT_EQ(beyond.error().fault, Fault::outside_window);
    life.ask(Life::request_for(shop.plan().points[0], 1));
    ASSERT_TRUE(life.station->type_reading(3));
    life.run(1s);
    EXPECT_EQ(life.port->done, 1);
}

TEST(StationRotary, AControlThatNobodyAnswersIsRefusedInTime) {
    PolygonShop shop;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    life.ask(Life::request_for(shop.plan().points[0], 1));
    life.run(shop.config.capture.timeout + 1s);
    ASSERT_FALSE(life.port->refusals.empty());
    EXPECT_EQ(life.port->refusals.front().second, Fault::not_still);
}

TEST(StationRotary, WhatWasTypedIsNotGoneOnWithAfterARestart) {
    PolygonShop shop;
    {
        Life life{shop};
        ASSERT_TRUE(life.arm());
        ASSERT_TRUE(life.station->type_reading(3));
        life.run(1s);
    }
    const Life again{shop};
    EXPECT_FALSE(again.status().run_open);
    EXPECT_EQ(again.notes_with("was typed before a restart"), 1);
}

/// A drift test of 20 s, once a second, where the axis stands.
std::optional<Result<std::string>> test_drift(Life& life) {
    DriftRequest request;
    request.duration = 20s;
    request.interval = 1s;
    const auto answer = std::make_shared<std::optional<Result<std::string>>>();
    boost::asio::co_spawn(
        life.scheduler.loop(), life.station->drift(request),
        [answer](std::exception_ptr, Result<std::string> r) { *answer = std::move(r); });
    life.run(25s);
    return *answer;
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
    ASSERT_TRUE(file && file->attachments.drift);
    const auto drift = evaluate_drift(file->run, *file->attachments.drift);
    ASSERT_TRUE(drift) << describe(drift.error());
    // 19 intervals; the bench's index is 2.7e-4, the air's 2.65e-4.
    EXPECT_NEAR(drift->eve.range, 1.9, 1e-4);
    EXPECT_NEAR(drift->slope_per_h.value(), 360, 0.01);
    const std::string document = R"({"unit":"arcsec","parameters":{"E_VE":{"value":1.9}}})";
    ASSERT_TRUE(store_result(path, {sha256_hex(document), document}));
    shop.reading_m = [](MonotonicTime) { return 0.0; };
    const auto armed = life.arm();
    ASSERT_TRUE(armed) << describe(armed.error());
    for (const std::string& one : shop.run_files()) {
        const auto run = read_run_file_contents(one).value();
        if (run.attachments.drift) continue;
        EXPECT_NEAR(run.run.uncertainty.value().eve->in(mm)*3600, 1.9, 1e-9);
        EXPECT_EQ(run.attachments.eve_source, **id);
    }
}

TEST(StationRotary, TypedReadingsAreNotRecordedAgainstTime) {
    PolygonShop shop;
    Life life{shop};
    const auto answer = test_drift(life);
    ASSERT_TRUE(answer && !*answer);
    EXPECT_EQ(answer->error().fault, Fault::refused);
    EXPECT_NE(answer->error().detail.find("uncertainty.eve"), std::string::npos);
}

TEST(StationRotary, AStationWithAnInterferometerTakesNoTypedReading) {
    TableShop shop;
    Life life{shop};
    EXPECT_EQ(life.station->type_reading(1).error().fault, Fault::bad_request);
}

/// The bench's first instrument is the autocollimator, its reading in seconds of arc: it sees the
/// face that is nearest.
class CollimatorShop : public PolygonShop {
public:
    CollimatorShop() {
        config.axis.angle->autocollimator = {"laser", "angle"};
        config.cycle.datum = mm(-2);
        first_channel = {"angle", ChannelKind::angle};
        reading_m = [this](MonotonicTime at) { return shown_arcsec(at); };
    }
    [[nodiscard]] double shown_arcsec(MonotonicTime at) const {
        const double face = std::round(axis.at(at) / 45);
        const auto& faces = config.axis.angle->setup.deviations_arcsec;
        return (axis.at(at) - 45 * face) * 3600 + error_arcsec +
               faces[static_cast<std::size_t>(face)] + (sway_arcsec ? sway_arcsec(at) : 0.0);
    }
    double error_arcsec = 0; ///< of the axis, where it stands
    std::function<double(MonotonicTime)> sway_arcsec;
};

/// Drives to the face; on the way no light comes back.
void drive_to_face(Life& life, CollimatorShop& shop, const PlannedPoint& point) {
    const double target = shop.plan().targets[static_cast<std::size_t>(point.target_index)].in(mm);
    const int side = static_cast<int>(point.direction);
    life.laser->quality = Quality::beam_lost;
    for (const double stop : {target - 2 * side, target}) {
        const Duration needed = shop.axis.time_to(stop, life.scheduler.now());
        shop.axis.go(stop, life.scheduler.now());
        life.run(needed + 50ms);
    }
    shop.error_arcsec = 3.0 * side;
    life.laser->quality = Quality::good;
}

bool take_face(Life& life, CollimatorShop& shop, const PlannedPoint& point, int request) {
    drive_to_face(life, shop, point);
    const auto sequence = static_cast<std::uint16_t>(request);
    life.ask(Life::request_for(point, sequence));
    for (int i = 0; i < 40 && life.port->done != sequence && life.port->refusals.empty(); ++i)
        life.run(100ms);
    return life.port->done == sequence;
}

bool take_face(Life& life, CollimatorShop& shop, int step) {
    return take_face(life, shop, shop.plan().points[static_cast<std::size_t>(step)], step + 1);
}

void take_every_face(Life& life, CollimatorShop& shop) {
    const int steps = static_cast<int>(shop.plan().points.size());
    for (int step = 0; step < steps; ++step)
        ASSERT_TRUE(take_face(life, shop, step)) << step << " " << life.status().run->last_sentence;
    life.run_until([&] { return !life.status().run_open; });
}

TEST(StationRotary, AnAutocollimatorReadsTheFacesByItself) {
    CollimatorShop shop;
    Life life{shop};
    const auto armed = life.arm();
    ASSERT_TRUE(armed) << describe(armed.error());
    ASSERT_NO_FATAL_FAILURE(take_every_face(life, shop));
    const RunRecord run = read_run_file(shop.run_files().front()).value();
    EXPECT_TRUE(run.complete);
    EXPECT_TRUE(life.status().axis.reads_angle);
    EXPECT_EQ(run.laser.instrument, "laser"); // the bench's name of the autocollimator
    EXPECT_EQ(run.points.front().origin, TriggerOrigin::cnc);
    EXPECT_GE(run.points.front().n, shop.config.capture.minimum_samples);
    const auto certificate = make_certificate(run, "hash");
    ASSERT_TRUE(certificate) << describe(certificate.error());
    // The axis leads by 3 seconds of arc each way; what the polygon adds is certified.
    constexpr double bound_deg = 1e-9;
    EXPECT_NEAR(*certificate->result.parameters.E, 6.0 / 3600, bound_deg);
    EXPECT_NEAR(*certificate->result.parameters.M, 0, bound_deg);
    EXPECT_NEAR(*certificate->result.parameters.B_mean, 6.0 / 3600, bound_deg);
}

TEST(StationRotary, AReadAutocollimatorHasNoDriftTestAndIsNotSaidToBeTyped) {
    CollimatorShop shop;
    Life life{shop};
    const auto answer = test_drift(life);
    ASSERT_TRUE(answer && !*answer);
    EXPECT_EQ(answer->error().fault, Fault::refused);
    const std::string& said = answer->error().detail;
    EXPECT_NE(said.find("before a polygon is not supported"), std::string::npos) << said;
    EXPECT_NE(said.find("state uncertainty.eve"), std::string::npos) << said;
    EXPECT_EQ(said.find("typed"), std::string::npos) << said;
}

RevisionRequest again_of_target_2() {
    RevisionRequest request;
    request.selection.target = 2;
    request.reason = "coolant on the face";
    return request;
}

TEST(StationRotary, FacesAreTakenAgainAfterTheRunWasClosedThoughNoneIsInSight) {
    CollimatorShop shop;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    ASSERT_NO_FATAL_FAILURE(take_every_face(life, shop));
    life.laser->quality = Quality::beam_lost; // the axis stands between two faces
    life.run(2s);
    const auto answer = life.retake(again_of_target_2());
    ASSERT_TRUE(answer) << describe(answer.error());
    ASSERT_EQ(answer->points.size(), 2U);
    int request = answer->last_request;
    for (const RetakeAnswer::Point& point : answer->points)
        ASSERT_TRUE(take_face(life, shop, point.planned, ++request))
            << life.status().run->last_sentence;
    life.run_until([&] { return !life.status().run_open; });
    EXPECT_EQ(life.status().run->state, "complete");
    const auto file = read_run_file_contents(shop.run_files().front()).value();
    EXPECT_EQ(file.revisions.superseded.size(), 2U);
}

TEST(StationRotary, NoFaceIsTakenAgainWhileTheAutocollimatorIsSilent) {
    CollimatorShop shop;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    ASSERT_NO_FATAL_FAILURE(take_every_face(life, shop));
    life.laser->silent = true;
    life.run(20s);
    const auto answer = life.retake(again_of_target_2());
    ASSERT_FALSE(answer);
    EXPECT_EQ(answer.error().fault, Fault::link_timeout);
    EXPECT_NE(answer.error().detail.find("autocollimator"), std::string::npos)
        << answer.error().detail;
}

TEST(StationRotary, ATypedReadingIsTakenAgainAfterTheRunWasClosed) {
    PolygonShop shop;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    for (const PlannedPoint& point : shop.plan().points) {
        ASSERT_TRUE(life.station->type_reading(shop.arcsec_at(point))) << point.step;
        life.run(200ms);
    }
    life.run_until([&] { return !life.status().run_open; });
    life.run(2s);
    const auto answer = life.retake(again_of_target_2());
    ASSERT_TRUE(answer) << describe(answer.error());
    for (const RetakeAnswer::Point& point : answer->points) {
        ASSERT_TRUE(life.station->type_reading(shop.arcsec_at(point.planned)));
        life.run(200ms);
    }
    life.run_until([&] { return !life.status().run_open; });
    EXPECT_EQ(life.status().run->state, "complete");
}

TEST(StationRotary, TheAutocollimatorsChannelAndItsCertificateStandInTheRunFile) {
    CollimatorShop shop;
    ChannelConfig stated;
    stated.channel = "angle";
    stated.calibration.certificate_number = "AC-7";
    stated.calibration.due_on = "2027-03-02";
    shop.config.instruments[0].channels.push_back(stated);
    Life life{shop};
    ASSERT_TRUE(life.arm());
    const auto run = read_run_file(shop.run_files().front());
    ASSERT_TRUE(run) << describe(run.error());
    ASSERT_EQ(run->calibrations.size(), 1U);
    EXPECT_EQ(run->calibrations[0].certificate_number, "AC-7");
    EXPECT_EQ(run->calibrations[0].due_on, "2027-03-02");
    const auto channel =
        std::ranges::find(run->channels, run->calibrations[0].channel, &ChannelRecord::id);
    ASSERT_NE(channel, run->channels.end());
    EXPECT_EQ(channel->kind, ChannelKind::angle);
    EXPECT_EQ(channel->instrument, run->laser.instrument);
}

TEST(StationRotary, AFaceThatDoesNotStandStillIsRefusedInSecondsOfArc) {
    CollimatorShop shop;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    drive_to_face(life, shop, shop.plan().points[0]);
    shop.sway_arcsec = [](MonotonicTime at) { // two seconds of arc each way, in 0.4 s
        return 2 * std::sin(5 * std::numbers::pi * seconds_of(at - MonotonicTime{}));
    };
    life.ask(Life::request_for(shop.plan().points[0], 1));
    life.run(shop.config.capture.timeout + 1s);
    ASSERT_FALSE(life.port->refusals.empty());
    EXPECT_EQ(life.port->refusals.front().second, Fault::not_still);
    const std::string said = life.status().run->last_sentence;
    EXPECT_NE(said.find("its readings spread over 4 arcsec"), std::string::npos) << said;
    EXPECT_NE(said.find(", 1 arcsec and "), std::string::npos) << said; // the limit
}

TEST(StationRotary, WithoutAFaceThePointIsRefusedAndTheRunGoesOn) {
    CollimatorShop shop;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    drive_to_face(life, shop, shop.plan().points[0]);
    life.laser->quality = Quality::beam_lost;
    life.ask(Life::request_for(shop.plan().points[0], 1));
    life.run(shop.config.capture.timeout + 1s);
    ASSERT_FALSE(life.port->refusals.empty());
    EXPECT_EQ(life.port->refusals.front().second, Fault::not_still);
    EXPECT_NE(life.status().run->last_sentence.find("it shows no face"), std::string::npos)
        << life.status().run->last_sentence;
    EXPECT_TRUE(life.status().run_open);
    life.port->refusals.clear();
    EXPECT_TRUE(take_face(life, shop, 0)) << life.status().run->last_sentence;
}

TEST(StationRotary, AReadingBeyondTheRangeIsRefused) {
    CollimatorShop shop;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    drive_to_face(life, shop, shop.plan().points[0]);
    shop.error_arcsec = 400; // 0.111 degrees
    life.ask(Life::request_for(shop.plan().points[0], 1));
    life.run(shop.config.capture.timeout + 1s);
    ASSERT_FALSE(life.port->refusals.empty());
    EXPECT_EQ(life.port->refusals.front().second, Fault::outside_window);
}

TEST(StationRotary, TakesNoTypedReadingWhereTheAutocollimatorIsRead) {
    CollimatorShop shop;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    const auto typed = life.station->type_reading(1);
    ASSERT_FALSE(typed);
    EXPECT_EQ(typed.error().fault, Fault::bad_request);
    EXPECT_NE(typed.error().detail.find("'axiscal trigger'"), std::string::npos);
}

TEST(StationRotary, PreflightWantsAnAutocollimatorThatAnswersButNoFaceYet) {
    CollimatorShop shop;
    Life life{shop};
    const auto instruments = [&] {
        const auto checks = life.station->preflight({}).value();
        return *std::ranges::find(checks, "instruments", &PreflightRecord::name);
    };
    life.laser->quality = Quality::beam_lost; // between two faces
    life.run(20s);
    EXPECT_TRUE(instruments().passed) << instruments().verdict;
    life.laser->silent = true;
    life.run(20s);
    EXPECT_FALSE(instruments().passed);
    EXPECT_NE(instruments().verdict.find("the autocollimator does not answer"), std::string::npos)
        << instruments().verdict;
    EXPECT_EQ(life.arm().error().fault, Fault::link_timeout);
}

/// Of the run: what the certificate prints of its instruments.
int events_with(const Shop& shop, const std::string& words) {
    const RunRecord run = read_run_file(shop.run_files().front()).value();
    return static_cast<int>(std::ranges::count_if(run.events, [&](const EventRecord& event) {
        return event.kind == EventKind::instrument && event.text.find(words) != words.npos;
    }));
}

TEST(StationRotary, AnAutocollimatorThatComesBackWithoutAFaceSaysSoAndThenThatItSeesOne) {
    CollimatorShop shop;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    life.laser->silent = true;
    life.run(20s);
    EXPECT_EQ(life.notes_with("laser is unavailable."), 1); // the bench's name of it
    life.laser->quality = Quality::beam_lost;
    life.laser->silent = false;
    life.run(20s);
    EXPECT_EQ(life.notes_with("laser answers, and sees no face."), 1);
    EXPECT_EQ(life.notes_with("laser sees a face."), 0);
    life.laser->quality = Quality::good;
    life.run(20s);
    EXPECT_EQ(life.notes_with("laser sees a face."), 1);
    EXPECT_EQ(life.notes_with("faulty"), 0);
    EXPECT_EQ(events_with(shop, "laser answers, and sees no face."), 1);
    EXPECT_EQ(events_with(shop, "laser sees a face."), 1);
}

TEST(StationRotary, NothingIsToldOfAnAutocollimatorOnTheWayFromFaceToFace) {
    CollimatorShop shop;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    const std::vector<std::string> told = life.status().notes;
    for (int face = 0; face < 3; ++face) {
        life.laser->quality = Quality::beam_lost; // long enough to be found faulty
        life.run(20s);
        EXPECT_EQ(life.status().instruments.front().state, InstrumentState::faulty);
        life.laser->quality = Quality::good;
        life.run(20s);
        EXPECT_EQ(life.status().instruments.front().state, InstrumentState::available);
    }
    EXPECT_EQ(life.status().notes, told);
}

TEST(StationRotary, WhatAnAutocollimatorReadIsNotGoneOnWithAfterARestart) {
    CollimatorShop shop;
    {
        Life life{shop};
        ASSERT_TRUE(life.arm());
        ASSERT_TRUE(take_face(life, shop, 0));
    }
    const Life again{shop};
    EXPECT_FALSE(again.status().run_open);
    EXPECT_EQ(again.notes_with("was read before a restart"), 1);
}

} // namespace
} // namespace axiscal::station_rotary_test
