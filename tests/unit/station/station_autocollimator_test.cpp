// A rotary axis at the station, before a polygon whose faces an autocollimator reads.
#include "analysis/positioning/positioning_certificate.hpp"
#include "rotary_bench.hpp"

namespace axiscal::station_autocollimator_test {
namespace {

using namespace testing;

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
        const auto checks = life.preflight({}).value();
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
} // namespace axiscal::station_autocollimator_test
