#include "analysis/positioning/positioning_certificate.hpp"
#include "reference_data.hpp"
#include "simulated_run.hpp"
#include "stated_uncertainty.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace axiscal::certificate_test {
namespace {

using test::at_seconds;
using test::simulated_run;

constexpr std::int64_t second_ns = 1'000'000'000;

bool holds(const std::vector<std::string>& remarks, const std::string& words) {
    return std::ranges::any_of(
        remarks, [&](const std::string& text) { return text.find(words) != std::string::npos; });
}

TEST(Certificate, EvaluatesTheRunAndKeepsItsHash) {
    const auto certificate = make_certificate(simulated_run({}), "abc123");
    ASSERT_TRUE(certificate.has_value());
    EXPECT_EQ(certificate->run_file_sha256, "abc123");
    EXPECT_TRUE(certificate->result_digest.empty());
    EXPECT_TRUE(certificate->preliminary);
    EXPECT_EQ(certificate->result.standard, "ISO 230-2:2014");
    EXPECT_EQ(certificate->result.unit, "mm");
    EXPECT_EQ(certificate->result.approaches, 5);
    // the truth has a reversal of 3 um everywhere; the air index of the truth differs by < 4e-8
    EXPECT_NEAR(*certificate->result.parameters.B_mean, 0.003, 4e-5);
    EXPECT_TRUE(certificate->remarks.empty());
}

TEST(Certificate, DatesComeFromTheRunAlone) {
    RunRecord run = simulated_run({});
    run.opened.utc_ns = 1'582'934'400 * second_ns; // 2020-02-29T00:00:00Z
    run.closed.utc_ns = 1'582'938'000 * second_ns; // 2020-02-29T01:00:00Z
    auto certificate = make_certificate(run, "");
    EXPECT_EQ(certificate->started_utc, "2020-02-29T00:00:00Z");
    EXPECT_EQ(certificate->finished_utc, "2020-02-29T01:00:00Z");
    EXPECT_EQ(certificate->issued_on, "2020-02-29");
    EXPECT_EQ(certificate->next_due, "2021-02-28") << "there is no 29 February 2021";
    run.opened.utc_ns = 1'582'848'000 * second_ns; // 2020-02-28T00:00:00Z
    run.closed.utc_ns = 1'582'851'600 * second_ns; // 2020-02-28T01:00:00Z
    EXPECT_EQ(make_certificate(run, "")->next_due, "2021-02-28");
    run.statements.next_due = "2022-06-30";
    EXPECT_EQ(make_certificate(run, "")->next_due, "2022-06-30");
    run.statements.next_due = "none"; // ISO/IEC 17025:2017, 7.8.4.3
    EXPECT_EQ(make_certificate(run, "")->next_due, "");
}

TEST(Certificate, SummarisesTheEnvironmentOfEveryChannel) {
    test::Truth truth;
    truth.material_C = [](double s) { return 21 + s / 1000; };
    RunRecord run = simulated_run(truth);
    run.channels.push_back(
        {6, "beam", "laser", "", ChannelKind::strength, Medium::none, 0}); // not environment
    const auto certificate = make_certificate(run, "");
    ASSERT_EQ(certificate->environment.size(), 5u);
    const EnvironmentSummary& left = certificate->environment[3];
    EXPECT_EQ(left.channel, "scale left");
    EXPECT_EQ(left.place, "x = 0");
    EXPECT_EQ(left.readings, 233); // 0 .. 2320 s every 10 s
    EXPECT_DOUBLE_EQ(left.first, 20.75);
    EXPECT_DOUBLE_EQ(left.last, 20.75 + 2.32);
    EXPECT_DOUBLE_EQ(left.minimum, 20.75);
    EXPECT_DOUBLE_EQ(left.maximum, 20.75 + 2.32);
    ASSERT_EQ(certificate->traces.size(), 5u);
    EXPECT_EQ(certificate->traces[3].values.size(), 233u);
    EXPECT_DOUBLE_EQ(certificate->traces[3].seconds.front(), -99); // first window begins at 99 s
}

TEST(Certificate, RemarksTellInterruptionsManualAndSkippedPoints) {
    RunRecord run = simulated_run({});
    run.plan.remark = "The 2000 mm stretch was declined: axis is used in full.";
    run.plan.cycle = CycleKind::step;
    run.points[3].origin = run.points[8].origin = TriggerOrigin::manual;
    run.events.push_back(
        {EventKind::interrupted, at_seconds(600), 0, "power failed", Fault::none, 0});
    run.events.push_back({EventKind::resumed, at_seconds(1200), 0, "after 600 s", Fault::none, 0});
    run.events.push_back({EventKind::skipped, at_seconds(1300), 0, "request 7", Fault::none, 7});
    const auto remarks = make_certificate(run, "")->remarks;
    EXPECT_TRUE(holds(remarks, "stretch was declined"));
    EXPECT_TRUE(holds(remarks, "Step cycle"));
    EXPECT_TRUE(holds(remarks, "interrupted at 2026-01-01T00:10:00Z: power failed"));
    EXPECT_TRUE(holds(remarks, "resumed at 2026-01-01T00:20:00Z: after 600 s"));
    EXPECT_TRUE(holds(remarks, "Skipped at 2026-01-01T00:21:40Z: request 7"));
    EXPECT_TRUE(holds(remarks, "2 of 110 points were captured by hand (steps 4, 9)"));
}

TEST(Certificate, RemarksOnAirOutsideTheFormula) {
    test::Truth truth;
    truth.pressure_Pa = [](double) { return 59000.0; };
    EXPECT_TRUE(holds(make_certificate(simulated_run(truth), "")->remarks, "60..120 kPa"));
}

TEST(Certificate, OfARunThatWasNotClosedAsCompleteIsAPartialResult) {
    RunRecord run = simulated_run({});
    run.complete = false;
    run.closing_reason = "aborted by the operator";
    const auto certificate = make_certificate(run, ""); // all 110 points are there
    ASSERT_TRUE(certificate.has_value());
    EXPECT_TRUE(certificate->completeness.partial());
    EXPECT_EQ(certificate->completeness.used, 110);
    EXPECT_TRUE(holds(certificate->remarks, "It is no calibration certificate"));
}

// ---- readings that were taken again or left out -----------------------------------------------

PointRecord& reading_of(RunRecord& run, int target, Direction direction, int approach) {
    return *std::ranges::find_if(run.points, [&](const PointRecord& point) {
        return point.planned.target_index == target && point.planned.direction == direction &&
               point.planned.approach == approach;
    });
}

/// Each approach of the truth lies 0.2 um above the one before it.
RunRecord stated_run() {
    RunRecord run = simulated_run({});
    run.uncertainty = test::stated_uncertainty();
    return run;
}

TEST(Certificate, OfAnExcludedReadingUsesTheReadingsThatRemain) {
    RunRecord run = stated_run();
    RunRevisions revisions;
    revisions.exclusions.push_back({reading_of(run, 2, Direction::positive, 4).step,
                                    at_seconds(900), 0, "somebody leaned on the table"});
    const auto whole = make_certificate(run, "");
    const auto certificate = make_certificate(run, revisions, "");
    ASSERT_TRUE(certificate) << describe(certificate.error());
    EXPECT_EQ(certificate->deviations.forward()[2].size(), 4U);
    // s of 0, 0.2, 0.4, 0.6 um, then of 0 .. 0.8 um
    EXPECT_NEAR(*certificate->result.positions[2].s_forward, 0.0002 * std::sqrt(5.0 / 3), 1e-7);
    EXPECT_NEAR(*whole->result.positions[2].s_forward, 0.0002 * std::sqrt(2.5), 1e-7);
    EXPECT_NEAR(whole->result.positions[2].mean_forward -
                    certificate->result.positions[2].mean_forward,
                0.0001, 1e-7);
    ASSERT_EQ(certificate->set_aside.size(), 1U);
    EXPECT_FALSE(certificate->set_aside[0].superseded);
    EXPECT_TRUE(
        holds(certificate->remarks, "Readings excluded: 1 (P3 ↑ 5: somebody leaned on the table)"));
    EXPECT_TRUE(holds(certificate->remarks, "remain (s with n - 1)"));
    EXPECT_TRUE(holds(certificate->remarks, "has 4 readings. ISO 230-2 asks for five"));
}

// U of the repeatability is 2 * 2 k u_EVE / sqrt(n - 1): 4 u_EVE for n = 5, 8 / sqrt(3) for 4.
TEST(Certificate, TheBudgetTakesTheReadingsThatRemainForN) {
    RunRecord run = stated_run();
    RunRevisions revisions;
    revisions.exclusions.push_back(
        {reading_of(run, 7, Direction::negative, 0).step, at_seconds(900), 0, "coolant"});
    const auto certificate = make_certificate(run, revisions, "");
    ASSERT_TRUE(certificate && certificate->uncertainty.budget);
    const double eve = 1.7 / std::sqrt(12.0);
    EXPECT_EQ(certificate->uncertainty.budget->approaches, 4);
    EXPECT_NEAR(certificate->uncertainty.budget->find("R_forward")->expanded,
                8 / std::sqrt(3.0) * eve, 1e-12);
    EXPECT_NEAR(certificate->uncertainty.budget->find("B")->expanded, 2 * eve * std::sqrt(0.5),
                1e-12);
    EXPECT_TRUE(holds(certificate->remarks, "the budget is made with n = 4"));
    EXPECT_FALSE(certificate->uncertainty.simulation) << "it would draw five of each";
    EXPECT_FALSE(holds(make_certificate(run, "")->remarks, "the budget is made"));
}

TEST(Certificate, OfAReplacedReadingShowsItAndUsesTheNewOne) {
    RunRecord run = stated_run();
    const PointRecord good = reading_of(run, 2, Direction::positive, 4);
    RunRevisions revisions;
    PointRecord bad = good;
    bad.reading += mm(0.05);
    revisions.superseded.push_back(bad);
    revisions.exclusions.push_back({bad.step, at_seconds(900), 0, "doubtful"});
    reading_of(run, 2, Direction::positive, 4).step = 110;
    revisions.retakes.push_back(
        {1, at_seconds(2290), 0, "coolant on the mirror", {{110, good.planned.step}}});
    const auto certificate = make_certificate(run, revisions, "");
    ASSERT_TRUE(certificate) << describe(certificate.error());
    EXPECT_EQ(certificate->deviations.forward()[2].size(), 5U);
    ASSERT_EQ(certificate->set_aside.size(), 1U);
    const SetAside& aside = certificate->set_aside[0];
    EXPECT_TRUE(aside.superseded);
    EXPECT_NEAR(aside.deviation - certificate->deviations.forward()[2][4], 0.05, 2e-5);
    EXPECT_TRUE(holds(certificate->remarks, "Readings replaced by new ones: 1 (P3 ↑ 5: coolant on "
                                            "the mirror (excluded before: doubtful))"));
    EXPECT_FALSE(holds(certificate->remarks, "asks for five"));
}

TEST(Certificate, OfARunPlannedWithFewerThanFiveApproachesSaysSo) {
    RunRecord run = simulated_run({});
    run.plan.approaches = 3;
    std::erase_if(run.plan.points, [](const PlannedPoint& point) { return point.approach >= 3; });
    std::erase_if(run.points, [](const PointRecord& point) { return point.planned.approach >= 3; });
    const auto certificate = make_certificate(run, "");
    ASSERT_TRUE(certificate) << describe(certificate.error());
    EXPECT_TRUE(holds(certificate->remarks, "has 3 readings. ISO 230-2 asks for five"));
}

TEST(Certificate, PrintsEachOverrideAndEachWarningOfThePreFlightChecks) {
    RunRevisions revisions;
    revisions.preflight = {{"soak", false, false, "Wait.", "the customer waits"},
                           {"drift", true, false, "Calm.", ""},
                           {"certificates", true, true, "laser has no certificate_number.", ""}};
    const auto remarks = make_certificate(simulated_run({}), revisions, "")->remarks;
    EXPECT_TRUE(holds(remarks, "\"soak\" failed: Wait. Reason given: the customer waits."));
    EXPECT_TRUE(holds(remarks, "\"certificates\": laser has no certificate_number."));
    EXPECT_FALSE(holds(remarks, "Calm"));
}

/// The air of the simulated run has 22 degC throughout.
TEST(MakeCertificate, NamesReadingsBeyondTheTableOfAChannelAndADateThatIsPast) {
    RunRecord run = simulated_run({});
    run.opened.utc_ns = 1'767'225'600'000'000'000; // 2026-01-01
    ChannelCalibration own;
    own.channel = 1, own.corrections = {{15, 0.1}, {25, 0.1}}, own.due_on = "2026-01-01";
    run.calibrations = {own};
    const auto unnamed = make_certificate(run, "");
    EXPECT_FALSE(holds(unnamed->remarks, "table of its certificate"));
    EXPECT_FALSE(holds(unnamed->remarks, "was due on"));
    EXPECT_TRUE(unnamed->environment.at(0).by_table);
    EXPECT_FALSE(unnamed->environment.at(1).by_table);
    run.calibrations[0].corrections = {{15, 0.1}, {21.5, 0.1}}; // as recorded, 21.6 is its end
    run.calibrations[0].due_on = "2025-12-31";
    const auto remarks = make_certificate(run, "")->remarks;
    EXPECT_TRUE(holds(remarks, "readings lie beyond the table of its certificate"));
    EXPECT_TRUE(holds(remarks, "its certificate was due on 2025-12-31"));
}

/// Recorded values bear their correction: a table in the run file changes no figure.
TEST(MakeCertificate, AppliesNoTableASecondTime) {
    RunRecord run = simulated_run({});
    const auto before = canonical_bytes(make_certificate(run, "")->result);
    for (int channel = 1; channel <= 5; ++channel) {
        run.calibrations.emplace_back().channel = channel;
        run.calibrations.back().corrections = {{0, 0.5}, {200'000, 0.7}};
    }
    EXPECT_EQ(canonical_bytes(make_certificate(run, "")->result), before);
}

// ---- canonical bytes ------------------------------------------------------------------------

TEST(CanonicalBytes, StandInTheDocumentedOrder) {
    const auto bytes =
        canonical_bytes(evaluate_positioning(test::at_20C({0, 10}, {{0.5}, {-0.25}}, {})));
    // head 19; k, n, E_forward, m, 2 targets, 2 means: 8 figures of 9; 11 + 2 * 8 absent of 1
    ASSERT_EQ(bytes.size(), 19u + 8 * 9 + 27);
    EXPECT_EQ(static_cast<char>(bytes[0]), 'a');
    EXPECT_EQ(bytes[19], std::byte{1});
    EXPECT_EQ(bytes[26], std::byte{0x00}); // 2.0 = 40 00 .. 00
    EXPECT_EQ(bytes[27], std::byte{0x40});
    EXPECT_EQ(bytes[37], std::byte{0});    // A is absent
    EXPECT_EQ(bytes[41], std::byte{1});    // E_forward
    EXPECT_EQ(bytes[48], std::byte{0xe8}); // 0.75 = 3f e8 00 .. 00
    EXPECT_EQ(bytes[49], std::byte{0x3f});
}

TEST(CanonicalBytes, ChangeWithTheLastBitOfAnyFigure) {
    const auto result = make_certificate(simulated_run({}), "")->result;
    const auto bytes = canonical_bytes(result);
    PositioningResult other = result;
    *other.parameters.R = std::nextafter(*other.parameters.R, 1);
    EXPECT_NE(canonical_bytes(other), bytes);
    other = result;
    *other.positions.back().s_backward = std::nextafter(*other.positions.back().s_backward, 1);
    EXPECT_NE(canonical_bytes(other), bytes);
    other = result;
    other.parameters.A.reset();
    EXPECT_NE(canonical_bytes(other), bytes);
    EXPECT_EQ(canonical_bytes(result), bytes);
}

} // namespace
} // namespace axiscal::certificate_test
