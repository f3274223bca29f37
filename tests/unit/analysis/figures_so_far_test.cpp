// How a run stands so far, by tables of real axes that were published, and by its words.
#include "analysis/positioning/figures_so_far.hpp"
#include "reference_data.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace axiscal::figures_so_far_test {
namespace {

constexpr double print_um = 3e-2;    // positions and results are printed to 1e-5 mm
constexpr double rounding_um = 1e-8; // a few roundings of metres

/// A published run: header with its plan, and its points in the order of a standard cycle.
struct Published {
    RunRecord header;
    std::vector<ShownReading> readings;
    nlohmann::json set;
};

Direction way_of(bool forward) {
    return forward ? Direction::positive : Direction::negative;
}

Published published(std::size_t nth) {
    Published run;
    run.set = test::reference_json("iso230_2_ess_reports.json").at("sets").at(nth);
    const auto targets = run.set.at("targets").get<std::vector<double>>();
    const auto forward = run.set.at("positions_fwd").get<test::Rows>();
    const auto backward = run.set.at("positions_bwd").get<test::Rows>();
    for (const double target : targets)
        run.header.plan.targets.push_back(mm(target));
    run.header.plan.approaches = static_cast<int>(forward.front().size());
    for (int approach = 0; approach < run.header.plan.approaches; ++approach)
        for (const bool up : {true, false})
            for (std::size_t i = 0; i < targets.size(); ++i) {
                const double at = (up ? forward : backward)[i][static_cast<std::size_t>(approach)];
                const int step = static_cast<int>(run.readings.size());
                run.readings.push_back(
                    {{step, static_cast<int>(i), way_of(up), approach}, mm(at - targets[i])});
            }
    return run;
}

void agree(Published& run, std::vector<ToleranceLimit> limits, const std::string& unit = "um") {
    run.header.tolerances.emplace();
    run.header.tolerances->unit = unit;
    run.header.tolerances->rule = DecisionRule::iso_14253_1_2017;
    run.header.tolerances->limits = std::move(limits);
}

std::optional<double> figure_of(const FiguresSoFar& shown, const std::string& name) {
    const auto found = std::ranges::find(shown.figures, name, &NamedFigure::name);
    return found == shown.figures.end() ? std::nullopt : std::optional{found->value};
}

std::vector<ShownReading> first(const Published& run, std::size_t count) {
    return {run.readings.begin(), run.readings.begin() + static_cast<std::ptrdiff_t>(count)};
}

TEST(FiguresSoFar, OfAllPointsAreTheFiguresOfThePublishedAxes) {
    const std::vector<std::pair<const char*, const char*>> names{
        {"A", "A"}, {"A_fwd", "A_forward"},  {"E", "E"}, {"M", "M"},
        {"R", "R"}, {"R_bwd", "R_backward"}, {"B", "B"}, {"B_mean", "B_mean"}};
    for (std::size_t nth = 0; nth < 5; ++nth) {
        const Published run = published(nth);
        SCOPED_TRACE(run.set.at("id"));
        const FiguresSoFar shown = figures_so_far(run.header, run.readings);
        for (const auto& [theirs, ours] : names) {
            ASSERT_TRUE(figure_of(shown, ours)) << ours;
            EXPECT_NEAR(*figure_of(shown, ours),
                        run.set["recomputed"]["axis"][theirs].get<double>() * 1000, rounding_um);
        }
        EXPECT_EQ(shown.points_per_target, 5);
        EXPECT_EQ(shown.standard, "ISO 230-2:2014");
        EXPECT_NEAR(shown.reversal_max_um.value(), *figure_of(shown, "B"), rounding_um);
    }
}

TEST(FiguresSoFar, MeanAndTwoSOfEachTargetAgreeWithThePublishedTable) {
    const Published run = published(0);
    const FiguresSoFar shown = figures_so_far(run.header, run.readings);
    const auto& table = run.set.at("published");
    ASSERT_EQ(shown.targets.size(), 9U);
    for (std::size_t i = 0; i < shown.targets.size(); ++i) {
        const TargetSoFar& target = shown.targets[i];
        EXPECT_NEAR(target.nominal_mm, run.set["targets"][i].get<double>(), 1e-9);
        const double mean = table["mean_bwd"][i].get<double>() * 1000;
        const double s = table["s_bwd"][i].get<double>() * 1000;
        EXPECT_EQ(target.negative.points, 5);
        EXPECT_NEAR(target.negative.mean_um.value(), mean, print_um);
        EXPECT_NEAR(target.negative.low_um.value(), mean - 2 * s, 3 * print_um);
        EXPECT_NEAR(target.negative.high_um.value(), mean + 2 * s, 3 * print_um);
        EXPECT_NEAR(target.positive.mean_um.value(), table["mean_fwd"][i].get<double>() * 1000,
                    print_um);
    }
}

TEST(FiguresSoFar, AFirstPointHasAMeanAndNoBounds) {
    const Published run = published(0);
    const FiguresSoFar shown = figures_so_far(run.header, first(run, 1));
    EXPECT_EQ(shown.targets[0].positive.points, 1);
    EXPECT_NEAR(shown.targets[0].positive.mean_um.value(), -18.52, rounding_um);
    EXPECT_FALSE(shown.targets[0].positive.low_um);
    EXPECT_FALSE(shown.targets[0].negative.mean_um);
    EXPECT_FALSE(shown.targets[1].positive.mean_um);
    EXPECT_EQ(shown.deviation_range_um, 0);
    EXPECT_FALSE(shown.reversal_max_um);
}

TEST(FiguresSoFar, AreNoneBeforeEachTargetHasTwoPointsInEachDirection) {
    const Published run = published(0);
    const FiguresSoFar before = figures_so_far(run.header, first(run, 4 * 9 - 1));
    EXPECT_TRUE(before.figures.empty());
    EXPECT_EQ(before.points_per_target, 1);
    EXPECT_TRUE(before.deviation_range_um && before.reversal_max_um);
    const FiguresSoFar after = figures_so_far(run.header, first(run, 4 * 9));
    EXPECT_EQ(after.points_per_target, 2);
    EXPECT_TRUE(figure_of(after, "A") && figure_of(after, "R"));
}

TEST(FiguresSoFar, WhereOneApproachIsPlannedOneIsEnoughForWhatNeedsNoSpread) {
    Published run = published(0);
    run.header.plan.approaches = 1;
    const FiguresSoFar shown = figures_so_far(run.header, first(run, 2 * 9));
    EXPECT_TRUE(figure_of(shown, "E") && figure_of(shown, "B"));
    EXPECT_FALSE(figure_of(shown, "A"));
}

TEST(FiguresSoFar, InOneDirectionNeedNoOther) {
    Published run = published(0);
    run.header.plan.bidirectional = false;
    std::erase_if(run.readings, [](const ShownReading& reading) {
        return reading.planned.direction == Direction::negative;
    });
    const FiguresSoFar shown = figures_so_far(run.header, run.readings);
    EXPECT_NEAR(figure_of(shown, "A_forward").value(), 108.41645719582325, rounding_um);
    EXPECT_FALSE(figure_of(shown, "A"));
    EXPECT_FALSE(shown.reversal_max_um);
}

TEST(FiguresSoFar, NothingMeasuredIsNoNumberAtAll) {
    const Published run = published(0);
    const FiguresSoFar shown = figures_so_far(run.header, {});
    EXPECT_EQ(shown.targets.size(), 9U);
    EXPECT_FALSE(shown.deviation_range_um || shown.reversal_max_um);
    EXPECT_TRUE(shown.figures.empty());
    EXPECT_EQ(shown.standing, Standing::not_judged);
}

TEST(FiguresSoFar, OutsideALimitIsToldWithBothNumbersAndNeverAsAVerdict) {
    Published run = published(0); // A 135.26, R 55.16
    agree(run, {{"A", {}, 120}, {"R", {}, 60}});
    const FiguresSoFar shown = figures_so_far(run.header, run.readings);
    ASSERT_EQ(shown.limits.size(), 2U);
    EXPECT_EQ(shown.limits[0].standing, Standing::outside);
    EXPECT_NEAR(shown.limits[0].limit_um.value(), 120, rounding_um);
    EXPECT_NEAR(shown.limits[0].value_um.value(), 135.262389906784, rounding_um);
    EXPECT_EQ(shown.limits[0].sentence, "A 135.3 of 120.0 um so far");
    EXPECT_EQ(shown.limits[1].standing, Standing::inside);
    EXPECT_EQ(shown.standing, Standing::outside);
    EXPECT_EQ(shown.sentence, "So far already outside: A 135.3 of 120.0 um.");
}

TEST(FiguresSoFar, InsideEveryLimitIsInsideSoFar) {
    Published run = published(0);
    agree(run, {{"A", {}, 140}, {"R", {}, 60}});
    const FiguresSoFar shown = figures_so_far(run.header, run.readings);
    EXPECT_EQ(shown.standing, Standing::inside);
    EXPECT_EQ(shown.sentence, "So far inside the limits.");
}

TEST(FiguresSoFar, ALimitThatCannotBeJudgedKeepsTheWholeFromBeingInside) {
    Published run = published(0);
    agree(run, {{"A", {}, 140}, {"P", {}, 60}, {"R", 10, 60}}); // 40 mm of travel
    const FiguresSoFar shown = figures_so_far(run.header, run.readings);
    EXPECT_EQ(shown.standing, Standing::not_judged);
    EXPECT_EQ(shown.sentence, "So far inside 1 of 3 limits; the others are not judged.");
    EXPECT_EQ(shown.limits[1].sentence, "P not judged so far: the figure was not evaluated");
    EXPECT_FALSE(shown.limits[2].limit_um);
    run.header.standards = {"ISO 230-2:2014", "VDI/DGQ 3441"};
    EXPECT_NE(figures_so_far(run.header, run.readings).limits[1].standing, Standing::not_judged);
}

TEST(FiguresSoFar, BeforeThereAreFiguresALimitSaysWhatIsMissing) {
    Published run = published(0);
    agree(run, {{"A", {}, 120}});
    const FiguresSoFar shown = figures_so_far(run.header, first(run, 9));
    EXPECT_EQ(shown.limits[0].standing, Standing::not_judged);
    EXPECT_NEAR(shown.limits[0].limit_um.value(), 120, rounding_um);
    EXPECT_EQ(shown.limits[0].sentence,
              "A not judged so far: each target needs 2 points in each direction");
    EXPECT_EQ(shown.sentence, "So far not judged: each target needs 2 points in each direction.");
}

TEST(FiguresSoFar, WithoutLimitsNothingIsJudged) {
    const Published run = published(0);
    const FiguresSoFar shown = figures_so_far(run.header, run.readings);
    EXPECT_TRUE(shown.limits.empty());
    EXPECT_EQ(shown.standing, Standing::not_judged);
    EXPECT_EQ(shown.sentence, "So far not judged: no limits were agreed on.");
}

TEST(FiguresSoFar, NumbersThatDifferAreNotShownAsTheSame) {
    Published run = published(0);
    agree(run, {{"A", {}, 135.26}});
    const FiguresSoFar shown = figures_so_far(run.header, run.readings);
    EXPECT_EQ(shown.limits[0].standing, Standing::outside);
    EXPECT_EQ(shown.limits[0].sentence, "A 135.262 of 135.260 um so far");
}

TEST(FiguresSoFar, OfARotaryAxisAreThousandthsOfADegreeAndLimitsAreToldInTheirUnit) {
    Published run = published(0);
    run.header.plan.axis_kind = AxisKind::rotary;
    run.header.rotary.emplace();
    agree(run, {{"A", {}, 400}}, "arcsec"); // A 0.13526 deg
    const FiguresSoFar shown = figures_so_far(run.header, run.readings);
    EXPECT_NEAR(figure_of(shown, "A").value(), 135.26238990678408, rounding_um);
    EXPECT_NEAR(shown.limits[0].limit_um.value(), 400.0 / 3.6, rounding_um);
    EXPECT_EQ(shown.limits[0].sentence, "A 486.9 of 400.0 arcsec so far");
}

TEST(FiguresSoFar, TheBasisSaysWhatTheDeviationsLack) {
    Published run = published(0);
    const auto basis = [&run] { return figures_so_far(run.header, run.readings).basis; };
    EXPECT_NE(basis().find("without dead path and cosine error, without U"), std::string::npos);
    run.header.scale.emplace();
    EXPECT_NE(basis().find("machine and scale"), std::string::npos);
    run.header.rotary.emplace();
    EXPECT_NE(basis().find("not brought to 20 °C"), std::string::npos);
    run.header.rotary->method = AngleMethod::polygon;
    EXPECT_NE(basis().find("polygon"), std::string::npos);
    EXPECT_TRUE(basis().starts_with("as shown at the machine: ")) << basis();
}

} // namespace
} // namespace axiscal::figures_so_far_test
