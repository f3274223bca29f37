// Evaluations beside ISO 230-2, against closed forms by hand.

#include "analysis/positioning/slope.hpp"
#include "analysis/positioning/styles.hpp"
#include "reference_data.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace axiscal::positioning_styles_test {
namespace {

using Figures = std::map<std::string, double>;

Figures parameters_of(const StyleResult& result) {
    Figures figures;
    for (const auto& [name, value] : result.parameters)
        figures[name] = value;
    return figures;
}

/// Table hand1 of the reference: exact sums.
RunAt20C hand_table() {
    return test::at_20C({0, 100, 200}, {{-1, 0, 1, 2, 3}, {2, 3, 3, 3, 4}, {-2, -2, -2, -2, -2}},
                        {{-3, -2, -1, 0, 1}, {2, 4, 4, 4, 6}, {-6, -6, -6, -6, -6}});
}

RunAt20C one_way(const RunAt20C& run) {
    return test::at_20C(run.targets(), run.forward(), {});
}

void expect_figures(const StyleResult& result, const Figures& expected) {
    const Figures got = parameters_of(result);
    EXPECT_EQ(got.size(), expected.size());
    for (const auto& [name, value] : expected)
        EXPECT_NEAR(got.at(name), value, 1e-14) << name;
}

TEST(Vdi3441, GivesTheExactFiguresOfTheHandCase) {
    const auto exact = test::reference_json("iso230_2_hand.json").at("vdi3441_hand1_exact");
    const Figures got = parameters_of(evaluate_vdi_3441(hand_table()));
    EXPECT_EQ(got.size(), exact.size());
    for (const auto& [name, value] : exact.items())
        EXPECT_NEAR(got.at(name), value.get<double>(), 1e-14) << name;
}

TEST(Vdi3441, OneApproachGivesMeansAndReversalsAlone) {
    const auto run = test::at_20C({0, 1}, {{1}, {4}}, {{3}, {3}});
    const auto result = evaluate_vdi_3441(run);
    expect_figures(result, {{"Pa", 1.5}, {"U_max", 2}, {"U_mean", 1.5}});
    EXPECT_TRUE(result.not_evaluated.contains("P"));
    EXPECT_TRUE(evaluate_vdi_3441(one_way(run)).parameters.empty());
}

TEST(RawRanges, AreTheRangesOfTheReadingsThemselves) {
    expect_figures(evaluate_raw_ranges(hand_table()), {{"A_raw", 12},
                                                       {"A_raw_forward", 6},
                                                       {"A_raw_backward", 12},
                                                       {"R_raw", 6},
                                                       {"R_raw_forward", 4},
                                                       {"R_raw_backward", 4}});
    const auto result = evaluate_raw_ranges(one_way(hand_table()));
    expect_figures(result, {{"A_raw_forward", 6}, {"R_raw_forward", 4}});
    EXPECT_TRUE(result.not_evaluated.contains("A_raw"));
}

TEST(RawRanges, OneApproachHasNoRangeAtATarget) {
    const auto result = evaluate_raw_ranges(test::at_20C({0, 1}, {{1}, {4}}, {{3}, {3}}));
    expect_figures(result, {{"A_raw", 3}, {"A_raw_forward", 3}, {"A_raw_backward", 0}});
    EXPECT_TRUE(result.not_evaluated.contains("R_raw_forward"));
}

TEST(AsmeB5541992Style, AddsTheReversalToTheRawRanges) {
    const auto got = parameters_of(evaluate_asme_b554_1992(hand_table()));
    EXPECT_EQ(got.at("R_raw"), 6);
    EXPECT_EQ(got.at("B"), 4);
    EXPECT_NEAR(got.at("B_mean"), 5.0 / 3, 1e-15);
}

TEST(NmtbaStyle, GivesHalfWidthsOfThreeDeviations) {
    // s: sqrt(2.5), sqrt(0.5), 0 upwards; sqrt(2.5), sqrt(2), 0 downwards; |B| 2, 1, 4
    const double a = 3 * std::sqrt(2.5), b = 3 * std::sqrt(0.5), c = 3 * std::sqrt(2.0);
    expect_figures(evaluate_nmtba(hand_table(), true), {{"accuracy", 3.5 + c + 0.5},
                                                        {"accuracy_forward", 1 + a},
                                                        {"accuracy_backward", 4 + c},
                                                        {"repeatability", a + 1},
                                                        {"repeatability_forward", a},
                                                        {"repeatability_backward", a}});
    EXPECT_GT(1 + a, 3 + b);
}

TEST(NmtbaStyle, WithoutOffsetTakesTheMeanOfAllMeansOut) {
    // the means 0, 3.5, -4 have the mean -1/6
    const double a = 3 * std::sqrt(2.5), c = 3 * std::sqrt(2.0), offset = -1.0 / 6;
    const auto got = parameters_of(evaluate_nmtba(hand_table(), false));
    EXPECT_NEAR(got.at("accuracy"), 3.5 - offset + c + 0.5, 1e-14);
    EXPECT_NEAR(got.at("accuracy_forward"), 1 - offset + a, 1e-14);
    EXPECT_NEAR(got.at("repeatability"), a + 1, 1e-14);
}

TEST(JisB6330Style, LooksAtBothEndsAndTheMiddle) {
    // unsorted on purpose; the middle of 0..400 is the target at 190
    const auto run = test::at_20C({400, 0, 190, 300}, {{7, 1}, {0, 1}, {2, 5}, {90, 0}},
                                  {{1, 3}, {4, 4}, {0, 10}, {0, 99}});
    const auto result = evaluate_jis_b_6330(run);
    expect_figures(result, {{"positioning", 90},
                            {"repeatability", 5},
                            {"repeatability_forward", 3},
                            {"repeatability_backward", 5},
                            {"lost_motion", 3.5}});
    ASSERT_EQ(result.notes.size(), 1u);
    EXPECT_NE(result.notes[0].find("asks for 7"), std::string::npos);
}

TEST(JisB6330Style, FewerThanThreeTargetsGiveThePositioningAlone) {
    const auto result = evaluate_jis_b_6330(test::at_20C({0, 1}, {{1, 2}, {4, 4}}, {}));
    expect_figures(result, {{"positioning", 3}});
    EXPECT_EQ(result.not_evaluated.size(), 4u);
}

TEST(MeanSlope, OfALineIsItsSlope) {
    const auto run = test::at_20C({400, 100, 250}, {{9}, {3}, {6}}, {{7}, {1}, {4}});
    const auto slope = slope_of_means(evaluate_positioning(run).positions).value();
    EXPECT_NEAR(slope.least_squares, 0.02, 1e-17);
    EXPECT_NEAR(slope.end_points, 0.02, 1e-17);
    EXPECT_TRUE(slope.of_both_directions);
}

TEST(MeanSlope, LeastSquaresAndEndPointsDifferOnACurve) {
    // x = 0, 1, 4, 9 at 0..3: least squares 3, end points 3; with 10 at the end 3.3 and 10/3
    const auto run = test::at_20C({0, 1, 2, 3}, {{0}, {1}, {4}, {10}}, {});
    const auto slope = slope_of_means(evaluate_positioning(run).positions).value();
    EXPECT_NEAR(slope.least_squares, 3.3, 1e-15);
    EXPECT_NEAR(slope.end_points, 10.0 / 3, 1e-15);
    EXPECT_FALSE(slope.of_both_directions);
}

TEST(MeanSlope, NeedsTwoTargets) {
    const auto run = test::at_20C({5}, {{1}}, {});
    EXPECT_FALSE(slope_of_means(evaluate_positioning(run).positions));
}

// ---- laws -----------------------------------------------------------------------------------

class StyleLaws : public testing::Test {
protected:
    std::mt19937_64 random{230402};
    std::normal_distribution<double> noise{0, 0.01};

    RunAt20C random_run() {
        const auto m = std::uniform_int_distribution<std::size_t>{3, 12}(random);
        const auto n = std::uniform_int_distribution<std::size_t>{2, 7}(random);
        std::vector<double> targets;
        test::Rows up(m), down(m);
        for (std::size_t i = 0; i < m; ++i) {
            targets.push_back(100 * static_cast<double>(i) + 10 * noise(random));
            for (auto* rows : {&up, &down})
                for (std::size_t j = 0; j < n; ++j)
                    (*rows)[i].push_back(noise(random));
        }
        return test::at_20C(targets, up, down);
    }

    template <class Change> static RunAt20C changed(const RunAt20C& run, Change change) {
        auto up = run.forward(), down = run.backward();
        for (auto* rows : {&up, &down})
            for (auto& row : *rows)
                for (double& x : row)
                    x = change(x);
        return test::at_20C(run.targets(), up, down);
    }

    static constexpr std::array all{PositioningFigures::vdi_3441,
                                    PositioningFigures::raw_ranges,
                                    PositioningFigures::asme_b554_1992,
                                    PositioningFigures::nmtba_with_offset,
                                    PositioningFigures::nmtba_without_offset,
                                    PositioningFigures::jis_b_6330};
};

TEST_F(StyleLaws, ConstantAddedToEveryReadingChangesNothingButNmtbaWithOffset) {
    for (int trial = 0; trial < 200; ++trial) {
        const auto run = random_run();
        const auto moved = changed(run, [](double x) { return x + 4; });
        for (const auto figures : all) {
            if (figures == PositioningFigures::nmtba_with_offset) continue;
            const auto before = evaluate_style(figures, run).parameters;
            const auto after = evaluate_style(figures, moved).parameters;
            for (std::size_t i = 0; i < before.size(); ++i) // adding 4 rounds to 5e-16
                EXPECT_NEAR(before[i].value, after[i].value, 2e-14) << before[i].name;
        }
    }
}

TEST_F(StyleLaws, PowerOfTwoScalesEveryFigureExactly) {
    for (int trial = 0; trial < 200; ++trial) {
        const auto run = random_run();
        const auto scaled = changed(run, [](double x) { return x * 1024; });
        for (const auto figures : all) {
            const auto before = evaluate_style(figures, run).parameters;
            const auto after = evaluate_style(figures, scaled).parameters;
            for (std::size_t i = 0; i < before.size(); ++i)
                EXPECT_EQ(before[i].value * 1024, after[i].value) << before[i].name;
        }
        const auto slope = slope_of_means(evaluate_positioning(run).positions).value();
        const auto steep = slope_of_means(evaluate_positioning(scaled).positions).value();
        EXPECT_EQ(slope.least_squares * 1024, steep.least_squares);
        EXPECT_EQ(slope.end_points * 1024, steep.end_points);
    }
}

TEST_F(StyleLaws, OrderOfTheTargetsDoesNotMatter) {
    for (int trial = 0; trial < 200; ++trial) {
        const auto run = random_run();
        auto targets = run.targets();
        auto up = run.forward(), down = run.backward();
        std::ranges::reverse(targets);
        std::ranges::reverse(up);
        std::ranges::reverse(down);
        const auto turned = test::at_20C(targets, up, down);
        for (const auto figures : all) {
            const auto before = evaluate_style(figures, run).parameters;
            const auto after = evaluate_style(figures, turned).parameters;
            for (std::size_t i = 0; i < before.size(); ++i)
                EXPECT_NEAR(before[i].value, after[i].value, 1e-15) << before[i].name;
        }
        const auto slope = slope_of_means(evaluate_positioning(run).positions).value();
        const auto other = slope_of_means(evaluate_positioning(turned).positions).value();
        EXPECT_EQ(slope.end_points, other.end_points);
        EXPECT_NEAR(slope.least_squares, other.least_squares, 1e-17);
    }
}

TEST_F(StyleLaws, SwappedDirectionsSwapTheFiguresOfOneDirection) {
    for (int trial = 0; trial < 200; ++trial) {
        const auto run = random_run();
        const auto swapped = test::at_20C(run.targets(), run.backward(), run.forward());
        for (const auto figures : all) {
            const auto before = parameters_of(evaluate_style(figures, run));
            const auto after = parameters_of(evaluate_style(figures, swapped));
            for (const auto& [name, value] : before) {
                if (name == "positioning") continue; // of the first forward pass by definition
                if (name == "B_mean") {
                    EXPECT_EQ(value, -after.at(name));
                    continue;
                }
                std::string other = name;
                if (name.ends_with("_forward"))
                    other.replace(name.size() - 7, 7, "backward");
                else if (name.ends_with("_backward"))
                    other.replace(name.size() - 8, 8, "forward");
                EXPECT_NEAR(value, after.at(other), 1e-17) << name;
            }
        }
    }
}

TEST_F(StyleLaws, RawRangesAreBoundedByEachOther) {
    for (int trial = 0; trial < 200; ++trial) {
        const auto p = parameters_of(evaluate_raw_ranges(random_run()));
        EXPECT_GE(p.at("A_raw"), std::max(p.at("A_raw_forward"), p.at("A_raw_backward")));
        EXPECT_GE(p.at("R_raw"), std::max(p.at("R_raw_forward"), p.at("R_raw_backward")));
        EXPECT_GE(p.at("A_raw"), p.at("R_raw"));
    }
}

} // namespace
} // namespace axiscal::positioning_styles_test
