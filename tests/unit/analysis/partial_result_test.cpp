// What a run gives that was not closed as complete. Expected figures are worked by hand from
// deviations of whole micrometres; a scale at 20 degC with no expansion keeps them exact.

#include "analysis/positioning/positioning_certificate.hpp"
#include "analysis/record/skipped_step.hpp"
#include "simulated_run.hpp"
#include "stated_uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>

namespace axiscal::partial_result_test {
namespace {

using test::at_seconds;

constexpr double near_mm = 1e-11; // of readings around 1 m stored as double
const double root_2 = std::sqrt(2.0);

RunPlan plan_of(int approaches, bool two_ways, CycleKind cycle) {
    RunPlan plan;
    plan.targets = {mm(0), mm(100), mm(200)};
    plan.approaches = approaches;
    plan.bidirectional = two_ways;
    plan.cycle = cycle;
    std::vector<PlannedPoint> points;
    for (int j = 0; j < approaches; ++j)
        for (const Direction way : {Direction::positive, Direction::negative})
            for (int k = 0; k < 3; ++k)
                if (two_ways || way == Direction::positive)
                    points.push_back({0, way == Direction::positive ? k : 2 - k, way, j});
    if (cycle == CycleKind::step) std::ranges::stable_sort(points, {}, &PlannedPoint::target_index);
    for (PlannedPoint& point : points)
        point.step = static_cast<int>(&point - points.data());
    plan.points = std::move(points);
    return plan;
}

/// Micrometres, by target, direction, approach.
double deviation_um(const PlannedPoint& at) {
    static const std::map<std::pair<int, Direction>, std::vector<double>> table{
        {{0, Direction::positive}, {1, 3, 2}},  {{0, Direction::negative}, {-1, 1, 7}},
        {{1, Direction::positive}, {4, 6, 5}},  {{1, Direction::negative}, {3, 3, 7}},
        {{2, Direction::positive}, {8, 10, 7}}, {{2, Direction::negative}, {4, 6, 7}}};
    return table.at({at.target_index, at.direction})[static_cast<std::size_t>(at.approach)];
}

/// The first `taken` points of the plan, then somebody aborted.
RunRecord aborted_run(std::size_t taken, RunPlan plan) {
    test::Truth truth;
    truth.material_C = [](double) { return 20.0; };
    RunRecord run = test::simulated_run(truth);
    run.plan = std::move(plan);
    run.scale = ScaleSetup{um(0.1), per_kelvin(0), {}, {}, {4}};
    run.material.coefficient = per_kelvin(0);
    std::vector<PointRecord> points;
    for (const PlannedPoint& planned : run.plan.points) {
        if (points.size() == taken) break;
        PointRecord point = run.points[points.size()];
        point.step = planned.step;
        point.planned = planned;
        const Length target = run.plan.targets[static_cast<std::size_t>(planned.target_index)];
        point.reading = run.datums[0].reading + target + um(deviation_um(planned));
        points.push_back(point);
    }
    run.points = std::move(points);
    run.complete = false;
    run.closing_reason = "aborted by the operator: a chip in the beam";
    run.statements.certificate_number = "K-17";
    return run;
}

RunRecord aborted_run(std::size_t taken) {
    return aborted_run(taken, plan_of(3, true, CycleKind::standard));
}

bool says(const std::vector<std::string>& remarks, const std::string& words) {
    return std::ranges::any_of(
        remarks, [&](const std::string& text) { return text.find(words) != std::string::npos; });
}

void expect_sums(const Completeness& completeness) {
    std::size_t left_out = 0;
    for (const LeftOut& entry : completeness.left_out)
        left_out += entry.approaches.size();
    EXPECT_EQ(static_cast<std::size_t>(completeness.used) + left_out,
              static_cast<std::size_t>(completeness.expected));
}

// 14 of 18: up 3, 3, 2 and down 2, 2, 2 readings. Means up 2, 5, 9, down 0, 3, 5; s up 1, 1, r2,
// down r2, 0, r2 with r2 the square root of 2.
TEST(PartialResult, CountsEachTargetAndDirectionWithTheReadingsThatItHas) {
    const auto partial = make_certificate(aborted_run(14), "");
    ASSERT_TRUE(partial) << describe(partial.error());
    const PositioningParameters& p = partial->result.parameters;
    EXPECT_NEAR(*p.B, 0.004, near_mm);
    EXPECT_NEAR(*p.B_mean, 0.008 / 3, near_mm);
    EXPECT_NEAR(*p.E_forward, 0.007, near_mm);
    EXPECT_NEAR(*p.E_backward, 0.005, near_mm);
    EXPECT_NEAR(*p.E, 0.009, near_mm);
    EXPECT_NEAR(*p.M, 0.006, near_mm);
    EXPECT_NEAR(*p.R_forward, 0.004 * root_2, near_mm);
    EXPECT_NEAR(*p.R_backward, 0.004 * root_2, near_mm);
    EXPECT_NEAR(*p.R, 0.004 + 0.004 * root_2, near_mm);
    EXPECT_NEAR(*p.A_forward, 0.009 + 0.002 * root_2, near_mm);
    EXPECT_NEAR(*p.A_backward, 0.005 + 0.004 * root_2, near_mm);
    EXPECT_NEAR(*p.A, 0.009 + 0.004 * root_2, near_mm);
    EXPECT_TRUE(partial->result.not_evaluated.empty());
}

TEST(PartialResult, NamesEveryPlannedReadingThatIsInNoFigure) {
    const auto partial = make_certificate(aborted_run(14), "");
    ASSERT_TRUE(partial);
    const Completeness& completeness = partial->completeness;
    EXPECT_TRUE(completeness.partial());
    EXPECT_EQ(completeness.expected, 18);
    EXPECT_EQ(completeness.used, 14);
    ASSERT_EQ(completeness.left_out.size(), 4U); // P1 down, P2 down, P3 up, P3 down: the third
    EXPECT_EQ(completeness.left_out[0].target_index, 0);
    EXPECT_EQ(completeness.left_out[0].direction, Direction::negative);
    EXPECT_EQ(completeness.left_out[0].approaches, std::vector<int>{2});
    EXPECT_EQ(completeness.left_out[0].why,
              "not measured: aborted by the operator: a chip in the beam");
    EXPECT_FALSE(completeness.left_out[0].target_omitted);
    EXPECT_TRUE(says(partial->remarks, "Partial result: 14 of 18 planned readings"));
    expect_sums(completeness);
}

TEST(PartialResult, BearsNoNumberNoVerdictAndNoDueDate) {
    RunRecord run = aborted_run(14);
    run.statements.next_due = "2027-01-01";
    run.uncertainty = test::stated_uncertainty();
    run.uncertainty->targets = {{"A", um(1)}};
    const auto partial = make_certificate(run, "");
    ASSERT_TRUE(partial);
    EXPECT_EQ(partial->run.statements.certificate_number, "");
    EXPECT_EQ(partial->next_due, "");
    EXPECT_EQ(target_uncertainty_of(partial->run, "A"), nullptr);
}

// P1 was reached from below alone: it is in no figure. P2: 4 up, 3 down. P3: 8 up, 4 down.
TEST(PartialResult, OmitsATargetThatWasReachedFromOneSideAlone) {
    const auto partial = make_certificate(aborted_run(5), "");
    ASSERT_TRUE(partial) << describe(partial.error());
    const PositioningParameters& p = partial->result.parameters;
    EXPECT_EQ(partial->completeness.used, 4);
    EXPECT_EQ(partial->completeness.targets, (std::vector<int>{1, 2}));
    EXPECT_EQ(partial->deviations.targets(), (std::vector<double>{100, 200}));
    EXPECT_NEAR(*p.B, 0.004, near_mm);
    EXPECT_NEAR(*p.E_forward, 0.004, near_mm);
    EXPECT_NEAR(*p.E, 0.005, near_mm);
    EXPECT_NEAR(*p.M, 0.0025, near_mm);
    EXPECT_FALSE(p.A || p.A_forward || p.R || p.R_forward || p.R_backward);
    EXPECT_EQ(partial->result.not_evaluated.at("R"),
              "P2 ↑ has one reading: no standard deviation, hence no R and no A");
    const LeftOut& unused = partial->completeness.left_out.at(0);
    EXPECT_EQ(unused.approaches, std::vector<int>{0});
    EXPECT_EQ(unused.why, "its target has no reading in the negative direction");
    EXPECT_TRUE(unused.target_omitted);
    EXPECT_TRUE(says(partial->remarks, "Targets in no figure: P1."));
    expect_sums(partial->completeness);
}

// Up 3 readings each but down one: the cell with one reading takes R and A from all.
TEST(PartialResult, GivesNoSpreadWhereOneTargetAndDirectionHasOneReading) {
    const auto partial = make_certificate(aborted_run(9), "");
    ASSERT_TRUE(partial);
    EXPECT_FALSE(partial->result.parameters.R_forward || partial->result.parameters.A);
    EXPECT_TRUE(partial->result.parameters.E && partial->result.parameters.B);
    EXPECT_EQ(partial->result.not_evaluated.at("A"),
              "P1 ↓ has one reading: no standard deviation, hence no R and no A");
}

TEST(PartialResult, OfTheFirstSweepIsThatOfOneDirection) {
    const auto partial = make_certificate(aborted_run(2), "");
    ASSERT_TRUE(partial) << describe(partial.error());
    const PositioningParameters& p = partial->result.parameters;
    EXPECT_NEAR(*p.E_forward, 0.003, near_mm);
    EXPECT_FALSE(p.E || p.M || p.B || p.B_mean || p.E_backward || p.R_forward);
    EXPECT_EQ(partial->result.not_evaluated.at("M"), "no target has a reading in both directions");
    EXPECT_EQ(partial->completeness.used, 2);
    expect_sums(partial->completeness);
}

// The step cycle ends within P2: P1 alone is whole. A range over one target is no range.
TEST(PartialResult, OfOneTargetHasNoRangeOverTargets) {
    const auto partial = make_certificate(aborted_run(7, plan_of(3, true, CycleKind::step)), "");
    ASSERT_TRUE(partial) << describe(partial.error());
    const PositioningParameters& p = partial->result.parameters;
    EXPECT_FALSE(p.E || p.E_forward || p.M || p.A || p.A_backward);
    EXPECT_EQ(partial->result.not_evaluated.at("M"),
              "readings of one target alone: there is no range over targets");
    // up 1, 3, 2 and down -1, 1, 7: B = 2 - 7/3, R up = 4 * 1
    EXPECT_NEAR(*p.B, 0.001 / 3, near_mm);
    EXPECT_NEAR(*p.R_forward, 0.004, near_mm);
    EXPECT_TRUE(says(partial->remarks, "Targets in no figure: P2, P3."));
}

TEST(PartialResult, OfATestFromOneSideKeepsItsKind) {
    const auto partial =
        make_certificate(aborted_run(8, plan_of(3, false, CycleKind::standard)), "");
    ASSERT_TRUE(partial) << describe(partial.error());
    EXPECT_EQ(partial->completeness.expected, 9);
    EXPECT_EQ(partial->completeness.used, 8);
    EXPECT_NEAR(*partial->result.parameters.R_forward, 0.004 * root_2, near_mm);
    EXPECT_NEAR(*partial->result.parameters.E_forward, 0.007, near_mm);
    EXPECT_EQ(partial->result.not_evaluated.at("B"),
              "no backward approaches: the test is unidirectional");
}

// A long axis takes one approach each way: without it there is no R in a whole run either.
TEST(PartialResult, OfALongAxisGivesWhatOneApproachGives) {
    const auto partial =
        make_certificate(aborted_run(5, plan_of(1, true, CycleKind::standard)), "");
    ASSERT_TRUE(partial);
    EXPECT_NEAR(*partial->result.parameters.M, 0.0025, near_mm);
    EXPECT_EQ(partial->result.not_evaluated.at("R"),
              "one approach per direction: no standard deviation, hence no R and no A");
}

TEST(PartialResult, NamesASkippedPoint) {
    RunRecord run = aborted_run(18);
    run.closing_reason = "1 of the points were skipped.";
    run.points.erase(run.points.begin() + 4); // P2 down, first
    run.events.push_back({EventKind::skipped, at_seconds(200), 0, skip_text(4), Fault::none, 5});
    const auto partial = make_certificate(run, "");
    ASSERT_TRUE(partial) << describe(partial.error());
    EXPECT_EQ(partial->completeness.used, 17);
    ASSERT_EQ(partial->completeness.left_out.size(), 1U);
    EXPECT_EQ(partial->completeness.left_out[0].why, "skipped by the CNC");
    EXPECT_EQ(partial->completeness.left_out[0].approaches, std::vector<int>{0});
    EXPECT_EQ(partial->deviations.backward()[1].size(), 2U);
    EXPECT_NEAR(partial->result.positions[1].mean_backward.value(), 0.005, near_mm); // of 3, 7
}

TEST(PartialResult, OmitsATargetWhoseLastReadingIsExcluded) {
    RunRecord run = aborted_run(6); // one each way
    RunRevisions revisions;
    revisions.exclusions.push_back({4, at_seconds(400), 0, "coolant"}); // P2 down
    const auto partial = make_certificate(run, revisions, "");
    ASSERT_TRUE(partial) << describe(partial.error());
    EXPECT_EQ(partial->completeness.targets, (std::vector<int>{0, 2}));
    EXPECT_TRUE(std::ranges::any_of(partial->completeness.left_out, [](const LeftOut& entry) {
        return entry.target_index == 1 && entry.why == "excluded: coolant";
    }));
    EXPECT_NEAR(*partial->result.parameters.E_forward, 0.007, near_mm);
    expect_sums(partial->completeness);
}

TEST(PartialResult, OfACompleteRunThereIsNone) {
    RunRecord run = aborted_run(18);
    run.complete = true;
    RunRevisions revisions;
    revisions.exclusions.push_back({17, at_seconds(900), 0, "coolant"}); // P1 down, last
    const auto whole = make_certificate(run, revisions, "");
    ASSERT_TRUE(whole) << describe(whole.error());
    EXPECT_FALSE(whole->completeness.partial());
    EXPECT_EQ(whole->completeness.used, 17);
    ASSERT_EQ(whole->completeness.left_out.size(), 1U);
    EXPECT_EQ(whole->completeness.left_out[0].why, "excluded: coolant");
    EXPECT_EQ(whole->run.statements.certificate_number, "K-17");
    EXPECT_FALSE(says(whole->remarks, "Partial"));
}

// U(R up) = 2 * 2k u_EVE / sqrt(n - 1), here k = 2, n = 2; U(B_mean) = 2 u_EVE sqrt(2 / (n m)).
TEST(PartialResult, TakesTheFewestReadingsAndTheTargetsInUseForTheBudget) {
    RunRecord run = aborted_run(14);
    run.uncertainty = test::stated_uncertainty();
    auto partial = make_certificate(run, "");
    ASSERT_TRUE(partial && partial->uncertainty.budget);
    const double eve = 1.7 / std::sqrt(12.0);
    EXPECT_NEAR(partial->uncertainty.budget->find("R_forward")->expanded, 8 * eve, 1e-12);
    EXPECT_NEAR(partial->uncertainty.budget->find("B_mean")->expanded, 2 * eve * std::sqrt(2.0 / 6),
                1e-12);
    EXPECT_NEAR(*partial->uncertainty.budget->length_m, 0.2, 1e-12);
    EXPECT_FALSE(partial->uncertainty.simulation) << "it would draw the same n of each";
    run = aborted_run(5);
    run.uncertainty = test::stated_uncertainty();
    partial = make_certificate(run, ""); // P2 and P3
    ASSERT_TRUE(partial && partial->uncertainty.budget);
    EXPECT_NEAR(*partial->uncertainty.budget->length_m, 0.1, 1e-12);
    EXPECT_EQ(partial->uncertainty.budget->find("R"), nullptr);
}

TEST(PartialResult, IsSimulatedWhereEveryTargetAndDirectionHasTheSameNumber) {
    RunRecord run = aborted_run(12); // two each way
    run.uncertainty = test::stated_uncertainty();
    run.uncertainty->device_U = {};
    run.uncertainty->device_U.fixed = um(0.5);
    run.scale->standard_uncertainty = per_kelvin(1e-6);
    run.scale->temperature_width = kelvin(0.5);
    const auto partial = make_certificate(run, "");
    ASSERT_TRUE(partial);
    ASSERT_TRUE(partial->uncertainty.simulation);
    EXPECT_NE(partial->uncertainty.simulation->find("R"), nullptr);
}

TEST(PartialResult, CanBeNoneWithoutAReadingOrUnderTwoDatums) {
    RunRecord run = aborted_run(0);
    EXPECT_EQ(make_certificate(run, "").error().fault, Fault::incomplete_run);
    EXPECT_NE(make_certificate(run, "").error().detail.find("a chip in the beam"),
              std::string::npos);
    run = aborted_run(7);
    run.points[3].datum_id = "serial/1/1";
    EXPECT_EQ(make_certificate(run, "").error().fault, Fault::datum_lost);
    run = aborted_run(7);
    run.points[3] = run.points[2];
    EXPECT_EQ(make_certificate(run, "").error().fault, Fault::bad_run_file);
    run = aborted_run(7);
    run.points[3].planned.target_index = 0;
    EXPECT_EQ(make_certificate(run, "").error().fault, Fault::bad_run_file);
}

TEST(PartialResult, OfAnOpenRunEndsWithItsLastReading) {
    RunRecord run = aborted_run(14); // the fourteenth window ends at 100 + 13 * 20 + 1 s
    run.closed = {};
    const auto partial = make_certificate(run, "");
    ASSERT_TRUE(partial);
    EXPECT_EQ(partial->finished_utc, "2026-01-01T00:06:01Z");
}

} // namespace
} // namespace axiscal::partial_result_test
