#include "analysis/positioning/positioning_accuracy.hpp"
#include "reference_data.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace axiscal::positioning_accuracy_test {
namespace {

using test::Rows;

/// Closed-form answers: a few roundings of numbers below 16.
constexpr double closed_form = 1e-12;

PositioningResult evaluate_hand_case(const nlohmann::json& hand) {
    const auto& request = hand.at("request");
    return evaluate_positioning(test::at_20C(request.at("targets"), request.at("fwd").get<Rows>(),
                                             request.at("bwd").get<Rows>()),
                                "ISO 230-2", request.value("cover", 2.0));
}

std::map<std::string, std::optional<double>> by_reference_key(const PositioningParameters& p) {
    return {{"A", p.A},
            {"A_fwd", p.A_forward},
            {"A_bwd", p.A_backward},
            {"E", p.E},
            {"E_fwd", p.E_forward},
            {"E_bwd", p.E_backward},
            {"R", p.R},
            {"R_fwd", p.R_forward},
            {"R_bwd", p.R_backward},
            {"M", p.M},
            {"B", p.B},
            {"B_mean", p.B_mean}};
}

TEST(PositioningAccuracy, GivesTheClosedFormAxisFiguresOfEveryHandCase) {
    const auto file = test::reference_json("iso230_2_hand.json");
    ASSERT_EQ(file.at("cases").size(), 5u);
    for (const auto& hand : file.at("cases")) {
        SCOPED_TRACE(hand.at("id"));
        const auto ours = by_reference_key(evaluate_hand_case(hand).parameters);
        for (const auto& [key, exact] : hand.at("exact").at("axis").items()) {
            ASSERT_TRUE(ours.at(key).has_value()) << key;
            EXPECT_NEAR(*ours.at(key), exact.get<double>(), closed_form) << key;
        }
    }
}

TEST(PositioningAccuracy, GivesTheClosedFormTableOfEveryHandCase) {
    const auto file = test::reference_json("iso230_2_hand.json");
    for (const auto& hand : file.at("cases")) {
        SCOPED_TRACE(hand.at("id"));
        const auto rows = evaluate_hand_case(hand).positions;
        const auto& exact = hand.at("exact");
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const auto expect = [&](const char* key, const std::optional<double>& ours) {
                if (exact.contains(key)) {
                    EXPECT_NEAR(*ours, exact.at(key).at(i).get<double>(), closed_form) << key;
                }
            };
            expect("B", rows[i].reversal);
            expect("R", rows[i].repeatability);
            expect("s_fwd", rows[i].s_forward);
            expect("s_bwd", rows[i].s_backward);
        }
    }
}

TEST(PositioningAccuracy, OneApproachGivesTheReducedListWithReasons) {
    const auto file = test::reference_json("iso230_2_hand.json");
    const auto& hand = file.at("cases").at(3);
    ASSERT_EQ(hand.at("id"), "hand4_long_axis");
    const auto result = evaluate_hand_case(hand);
    const auto ours = by_reference_key(result.parameters);
    for (const auto& key : hand.at("exact").at("absent"))
        EXPECT_FALSE(ours.at(key.get<std::string>()).has_value()) << key;
    EXPECT_EQ(result.not_evaluated.size(), 6u);
    for (const char* key : {"A", "A_forward", "A_backward", "R", "R_forward", "R_backward"})
        EXPECT_NE(result.not_evaluated.at(key).find("one approach"), std::string::npos);
    EXPECT_FALSE(result.positions[0].s_forward.has_value());
    EXPECT_FALSE(result.positions[0].repeatability.has_value());
}

TEST(PositioningAccuracy, UnidirectionalRunGivesForwardFiguresOnly) {
    // deviations -1 0 1 2 3 at one target (mean 1, s = sqrt(2.5)) and 4 4 4 4 4 at the other
    const auto result =
        evaluate_positioning(test::at_20C({0, 100}, {{-1, 0, 1, 2, 3}, {4, 4, 4, 4, 4}}, {}));
    EXPECT_DOUBLE_EQ(*result.parameters.E_forward, 3);
    EXPECT_DOUBLE_EQ(*result.parameters.R_forward, 4 * std::sqrt(2.5));
    // 1 + 2 s = 4.16 lies above 4, so that target alone spans the band
    EXPECT_DOUBLE_EQ(*result.parameters.A_forward, 4 * std::sqrt(2.5));
    for (const char* key :
         {"A", "A_backward", "E", "E_backward", "M", "R", "R_backward", "B", "B_mean"})
        EXPECT_NE(result.not_evaluated.at(key).find("unidirectional"), std::string::npos) << key;
    EXPECT_EQ(result.not_evaluated.size(), 9u);
    EXPECT_FALSE(result.positions[0].mean.has_value());
    EXPECT_FALSE(result.positions[0].reversal.has_value());
}

// ---- tables of real axes, published with known defects ------------------------

/// Positions and results are printed to 1e-5 mm; the file allows three of them.
constexpr double print_mm = 3e-5;

PositioningResult evaluate_published(const nlohmann::json& set) {
    const auto targets = set.at("targets").get<std::vector<double>>();
    return evaluate_positioning(
        test::at_20C(targets, test::minus_targets(set.at("positions_fwd").get<Rows>(), targets),
                     test::minus_targets(set.at("positions_bwd").get<Rows>(), targets)));
}

class PublishedAxes : public testing::Test {
protected:
    nlohmann::json sets = test::reference_json("iso230_2_ess_reports.json").at("sets");
    void SetUp() override { ASSERT_EQ(sets.size(), 5u); }
};

TEST_F(PublishedAxes, TableOfEveryTargetAgreesWithinItsPrint) {
    for (const auto& set : sets) {
        SCOPED_TRACE(set.at("id"));
        const auto& published = set.at("published");
        const auto rows = evaluate_published(set).positions;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            EXPECT_NEAR(rows[i].mean_forward, published["mean_fwd"][i], print_mm);
            EXPECT_NEAR(*rows[i].mean_backward, published["mean_bwd"][i], print_mm);
            EXPECT_NEAR(*rows[i].mean, published["mean_bi"][i], print_mm);
            EXPECT_NEAR(*rows[i].reversal, published["B_i"][i], print_mm);
            EXPECT_NEAR(*rows[i].s_forward, published["s_fwd"][i], print_mm);
            EXPECT_NEAR(*rows[i].s_backward, published["s_bwd"][i], print_mm);
            EXPECT_NEAR(*rows[i].repeatability_forward, published["R_fwd_i"][i], print_mm);
            EXPECT_NEAR(*rows[i].repeatability_backward, published["R_bwd_i"][i], print_mm);
            EXPECT_NEAR(*rows[i].repeatability, published["R_i"][i], print_mm);
        }
    }
}

TEST_F(PublishedAxes, AxisFiguresAgreeButForThePublishedEAndR) {
    for (const auto& set : sets) {
        SCOPED_TRACE(set.at("id"));
        auto ours = by_reference_key(evaluate_published(set).parameters);
        ours["B_avg"] = ours["B_mean"];
        for (const auto& [key, value] : set.at("published").at("axis").items()) {
            if (key == "E" || key == "R") continue;
            EXPECT_NEAR(*ours.at(key), value.get<double>(), print_mm) << key;
        }
        for (const auto& [key, value] : set.at("recomputed").at("axis").items())
            EXPECT_NEAR(*ours.at(key), value.get<double>(), 1e-12) << key;
    }
}

TEST_F(PublishedAxes, PublishedEIsWrongBecauseItTakesTheLargerOfTheTwoMinima) {
    for (const auto& set : sets) {
        SCOPED_TRACE(set.at("id"));
        const auto result = evaluate_published(set);
        double high = -1e9, low_forward = 1e9, low_backward = 1e9;
        for (const auto& row : result.positions) {
            high = std::max({high, row.mean_forward, *row.mean_backward});
            low_forward = std::min(low_forward, row.mean_forward);
            low_backward = std::min(low_backward, *row.mean_backward);
        }
        const double published = set.at("published").at("axis").at("E");
        EXPECT_NEAR(published, high - std::max(low_forward, low_backward), print_mm);
        EXPECT_NEAR(*result.parameters.E, high - std::min(low_forward, low_backward), 1e-12);
        EXPECT_GT(*result.parameters.E, published + print_mm);
    }
}

TEST_F(PublishedAxes, PublishedRIsWrongWhereItIsOnlyAUnidirectionalOne) {
    int wrong = 0;
    for (const auto& set : sets) {
        SCOPED_TRACE(set.at("id"));
        const auto parameters = evaluate_published(set).parameters;
        const double published = set.at("published").at("axis").at("R");
        const double nearer = std::min(std::fabs(published - *parameters.R_forward),
                                       std::fabs(published - *parameters.R_backward));
        EXPECT_LT(nearer, print_mm) << "the publishing tool prints a unidirectional R";
        double largest = 0;
        for (const double printed_row : set.at("published").at("R_i"))
            largest = std::max(largest, printed_row);
        EXPECT_NEAR(*parameters.R, largest, print_mm) << "its own table holds the right R";
        if (*parameters.R > published + print_mm) ++wrong;
    }
    EXPECT_EQ(wrong, 4);
}

// ---- the door -------------------------------------------------------------------------------

Error refusal_of(DeviationTable table) {
    auto result = declare_at_20C(std::move(table), "test");
    return result ? Error{Fault::none, "", {}, ""} : result.error();
}

TEST(DeclareAt20C, KeepsTheReasonAsProvenance) {
    EXPECT_EQ(declare_at_20C({{0}, {{1}}, {}, "mm"}, "measured at 20 degC")->provenance(),
              "already_at_20C: measured at 20 degC");
    EXPECT_EQ(declare_at_20C({{0}, {{1}}, {}, "mm"}, "").error().field, "compensation");
}

TEST(DeclareAt20C, NamesTheFieldOfEveryRefusal) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    const auto field = [](DeviationTable table) {
        const Error error = refusal_of(std::move(table));
        EXPECT_EQ(error.fault, Fault::bad_case);
        return error.field;
    };
    EXPECT_EQ(field({{}, {}, {}, "mm"}), "targets");
    EXPECT_EQ(field({{0, nan}, {{1}, {1}}, {}, "mm"}), "targets[1]");
    EXPECT_EQ(field({{5, 0, 5}, {{1}, {1}, {1}}, {}, "mm"}), "targets[2]");
    EXPECT_EQ(field({{0, 1}, {}, {}, "mm"}), "forward");
    EXPECT_EQ(field({{0, 1}, {{1}}, {}, "mm"}), "forward");
    EXPECT_EQ(field({{0, 1}, {{}, {}}, {}, "mm"}), "forward[0]");
    EXPECT_EQ(field({{0, 1}, {{1, 2}, {1}}, {}, "mm"}), "forward[1]");
    EXPECT_EQ(field({{0, 1, 2}, {{1, 2}, {1, 2}, {1, nan}}, {}, "mm"}), "forward[2][1]");
    EXPECT_EQ(field({{0, 1}, {{1}, {1}}, {{1}}, "mm"}), "backward");
    EXPECT_EQ(field({{0, 1}, {{1}, {1}}, {{1}, {1, 2}}, "mm"}), "backward[1]");
    EXPECT_EQ(field({{0, 1}, {{1}, {1}}, {{-infinity}, {1}}, "mm"}), "backward[0][0]");
    EXPECT_EQ(field({{0, 1}, {{1}, {1e13}}, {}, "mm"}), "forward[1][0]");
}

} // namespace
} // namespace axiscal::positioning_accuracy_test
