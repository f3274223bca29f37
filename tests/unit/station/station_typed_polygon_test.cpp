// A rotary axis at the station, before a polygon whose readings are typed.
#include "analysis/positioning/positioning_certificate.hpp"
#include "rotary_bench.hpp"
#include "tests/support/full_disk.hpp"

#include <optional>

namespace axiscal::station_typed_polygon_test {
namespace {

using namespace testing;

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

TEST(StationRotary, OnAFullDiskWhatWasTypedIsClosedWhenThereIsRoom) {
    PolygonShop shop;
    {
        Life life{shop};
        ASSERT_TRUE(life.arm());
        ASSERT_TRUE(life.station->type_reading(3));
        life.run(1s);
    }
    std::optional<Life> again;
    {
        const FullDisk full;
        again.emplace(shop);
        again->run(30s);
        EXPECT_EQ(again->port->runs, 0) << "its file is still open";
        EXPECT_EQ(again->notes_with("cannot be taken over yet"), 1);
    }
    again->run_until([&] { return again->port->runs == 1; });
    EXPECT_TRUE(summarize_run_file(shop.run_files().at(0))->closed);
    EXPECT_EQ(again->notes_with("was typed before a restart"), 1);
}

TEST(StationRotary, TypedReadingsAreNotRecordedAgainstTime) {
    PolygonShop shop;
    Life life{shop};
    const auto answer = test_drift(life);
    ASSERT_TRUE(answer && !*answer);
    EXPECT_EQ(answer->error().fault, Fault::refused);
    EXPECT_NE(answer->error().detail.find("uncertainty.eve"), std::string::npos);
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

} // namespace
} // namespace axiscal::station_typed_polygon_test
