#include "analysis/uncertainty/budget.hpp"

#include "analysis/conformity/verdict.hpp"
#include "tests/unit/analysis/reference_data.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace axiscal::budget_test {
namespace {

using nlohmann::json;

std::optional<double> optional_of(const json& request, const char* key) {
    if (!request.contains(key)) return std::nullopt;
    return request.at(key).get<double>();
}

/// The reference's own names; an entry without a length is taken for a rotary or drift-only one.
UncertaintyStatement statement_of(const json& request) {
    UncertaintyStatement s;
    s.device_U = optional_of(request, "U_device");
    s.device_k = optional_of(request, "k_device");
    s.device_width = optional_of(request, "width_device");
    s.length_m = optional_of(request, "L_m");
    s.misalignment_mm = optional_of(request, "width_misalign_mm");
    s.misalignment_rad = optional_of(request, "delta_rad");
    s.alpha_um_per_m_K = optional_of(request, "alpha_um_mK");
    s.temperature_width_K = optional_of(request, "width_theta_K");
    s.temperature_offset_K = optional_of(request, "delta_T_K");
    s.alpha_width_um_per_m_K = optional_of(request, "width_alpha_um_mK");
    s.eve = optional_of(request, "EVE");
    if (request.value("eve_model", "mean") == "difference") s.eve_model = EveModel::difference;
    return s;
}

/// Everything stated, sizes of a good workshop.
UncertaintyStatement workshop() {
    UncertaintyStatement s;
    s.device_U = 1.2;
    s.device_k = 2;
    s.length_m = 1.75;
    s.misalignment_mm = 1;
    s.alpha_um_per_m_K = 12;
    s.temperature_width_K = 0.7;
    s.temperature_offset_K = 1;
    s.alpha_width_um_per_m_K = 2;
    s.eve = 1.7;
    return s;
}

double u_of(const UncertaintyBudget& budget, const std::string& key) {
    const ParameterUncertainty* found = budget.find(key);
    return found ? found->u : std::nan("");
}

TEST(UncertaintyBudget, ReproducesEveryEntryOfTheReference) {
    const std::map<std::string, UncertaintyTerm> terms{
        {"device", UncertaintyTerm::device},
        {"misalignment", UncertaintyTerm::misalignment},
        {"M_M", UncertaintyTerm::machine_temperature},
        {"E_M", UncertaintyTerm::machine_expansion},
        {"EVE", UncertaintyTerm::environment}};
    const std::map<std::string, std::string> keys{
        {"R_uni", "R_forward"}, {"B", "B"}, {"R", "R"}, {"E", "E"}, {"M", "M"}, {"A", "A"}};
    int entries = 0;
    const json reference = test::reference_json("uncertainty_thermal.json");
    for (const json& entry : reference.at("uncertainty")) {
        SCOPED_TRACE(entry.at("id"));
        const auto budget = make_budget(statement_of(entry.at("request")),
                                        entry.at("request").at("n").get<int>(), 11);
        ASSERT_TRUE(budget) << budget.error().field << budget.error().detail;
        for (const auto& [name, u] : entry.at("recomputed").at("u").items()) {
            const Contribution* term = budget->find(terms.at(name));
            // the reference takes 1 - cos directly, which leaves it 11 digits
            EXPECT_NEAR(term ? term->u : 0, u.get<double>(), 2e-11 * u.get<double>()) << name;
        }
        for (const auto& [name, U] : entry.at("recomputed").at("U").items())
            EXPECT_NEAR(budget->find(keys.at(name))->expanded, U.get<double>(), 1e-13) << name;
        ++entries;
    }
    EXPECT_EQ(entries, 5);
}

TEST(UncertaintyBudget, EachTermHasItsClosedForm) {
    const double root_12 = std::sqrt(12.0);
    UncertaintyStatement s = workshop();
    auto budget = make_budget(s, 5, 11);
    ASSERT_TRUE(budget);
    const auto u = [&](UncertaintyTerm term) { return budget->find(term)->u; };
    EXPECT_DOUBLE_EQ(u(UncertaintyTerm::device), 0.6);
    EXPECT_DOUBLE_EQ(u(UncertaintyTerm::misalignment), 1 / (2 * 1.75) / root_12);
    EXPECT_DOUBLE_EQ(u(UncertaintyTerm::machine_temperature), 12 * 1.75 * 0.7 / root_12);
    EXPECT_DOUBLE_EQ(u(UncertaintyTerm::machine_expansion), 1.75 * 2 / root_12);
    EXPECT_DOUBLE_EQ(u(UncertaintyTerm::environment), 1.7 / root_12);
    s.device_alpha_um_per_m_K = 10;
    s.device_temperature_width_K = 0.5;
    s.device_alpha_width_um_per_m_K = 1;
    s.device_temperature_offset_K = -2;
    budget = make_budget(s, 5, 11);
    ASSERT_TRUE(budget);
    EXPECT_DOUBLE_EQ(u(UncertaintyTerm::device_temperature), 10 * 1.75 * 0.5 / root_12);
    EXPECT_DOUBLE_EQ(u(UncertaintyTerm::device_expansion), 1.75 * 2 / root_12);
}

TEST(UncertaintyBudget, AngleAndOffsetOfTheBeamAgreeWhereBothAreSmall) {
    UncertaintyStatement by_offset = workshop(), by_angle = workshop();
    by_angle.misalignment_mm.reset();
    by_angle.misalignment_rad = std::atan(1.0 / 1750);
    const double offset = make_budget(by_offset, 5, 11)->find(UncertaintyTerm::misalignment)->u;
    const double angle = make_budget(by_angle, 5, 11)->find(UncertaintyTerm::misalignment)->u;
    EXPECT_NEAR(angle / offset, 1, 1e-6); // next order: delta^2
    EXPECT_NE(angle, offset);
}

TEST(UncertaintyBudget, EveryUIsTwiceItsStandardUncertaintyAndItsSquareTheSumOfSquares) {
    std::mt19937_64 random{5};
    std::uniform_real_distribution<double> size{0, 3};
    for (int trial = 0; trial < 300; ++trial) {
        UncertaintyStatement s = workshop();
        for (auto* field :
             {&s.device_U, &s.misalignment_mm, &s.alpha_um_per_m_K, &s.temperature_width_K,
              &s.temperature_offset_K, &s.alpha_width_um_per_m_K, &s.eve})
            *field = size(random);
        if (trial % 2) s.eve_model = EveModel::difference;
        const auto budget = make_budget(s, 2 + trial % 8, 3 + trial % 20, trial % 3 ? 2 : 3);
        ASSERT_TRUE(budget);
        EXPECT_EQ(budget->parameters.size(), uncertain_parameters().size());
        for (const ParameterUncertainty& figure : budget->parameters) {
            double square = 0;
            for (const Contribution& term : budget->contributions) {
                const double factor = term.term == UncertaintyTerm::environment ? figure.environment
                                                                                : figure.systematic;
                square += factor * factor * term.u * term.u;
            }
            EXPECT_NEAR(figure.u, std::sqrt(square), 1e-12 * (1 + figure.u)) << figure.key;
            EXPECT_DOUBLE_EQ(figure.expanded, 2 * figure.u) << figure.key;
        }
        EXPECT_LE(u_of(*budget, "M"), u_of(*budget, "E"));
        EXPECT_LE(u_of(*budget, "E"), u_of(*budget, "A"));
        EXPECT_LE(u_of(*budget, "B_mean"), u_of(*budget, "B"));
        EXPECT_LE(u_of(*budget, "R_forward"), u_of(*budget, "R"));
    }
}

TEST(UncertaintyBudget, RepeatabilityAndReversalAreBlindToWhatIsCommonToTheSession) {
    UncertaintyStatement s = workshop();
    s.eve = 0;
    const auto budget = make_budget(s, 5, 11);
    for (const char* key : {"R", "R_forward", "R_backward", "B", "B_mean"})
        EXPECT_EQ(u_of(*budget, key), 0) << key;
    EXPECT_GT(u_of(*budget, "E"), 1);
    EXPECT_EQ(u_of(*budget, "E"), u_of(*budget, "A"));
}

TEST(UncertaintyBudget, SourceFormulaOfRExceedsStrictPropagationByAThird) {
    const auto budget = make_budget(workshop(), 5, 11);
    const ParameterUncertainty* two_way = budget->find("R");
    ASSERT_TRUE(two_way && two_way->strict_u);
    const double u_eve = 1.7 / std::sqrt(12.0);
    EXPECT_NEAR(two_way->u, std::sqrt(4.4) * u_eve, 1e-14);
    EXPECT_NEAR(*two_way->strict_u, std::sqrt(2.4) * u_eve, 1e-14);
    EXPECT_NEAR(two_way->u / *two_way->strict_u, 1.354, 5e-4);
}

TEST(UncertaintyBudget, EditionWithThreeSigmaWidensTheSpreadAlone) {
    const auto two = make_budget(workshop(), 5, 11, 2), three = make_budget(workshop(), 5, 11, 3);
    EXPECT_DOUBLE_EQ(u_of(*three, "R_forward"), 1.5 * u_of(*two, "R_forward"));
    EXPECT_EQ(u_of(*three, "B"), u_of(*two, "B"));
    EXPECT_EQ(u_of(*three, "E"), u_of(*two, "E"));
    EXPECT_EQ(three->find("R_forward")->status, "R");
}

TEST(UncertaintyBudget, OneApproachHasNoSpreadHenceNoRAndNoA) {
    const auto budget = make_budget(workshop(), 1, 11);
    for (const char* key : {"A", "A_forward", "A_backward", "R", "R_forward", "R_backward"})
        EXPECT_FALSE(budget->find(key)) << key;
    EXPECT_TRUE(budget->find("E"));
    EXPECT_DOUBLE_EQ(u_of(*budget, "B"), 1.7 / std::sqrt(6.0));
}

TEST(UncertaintyBudget, NamesWhatIsNotStated) {
    UncertaintyStatement linear, rotary;
    linear.eve = 1;
    rotary.axis_kind = AxisKind::rotary;
    rotary.device_width = 2;
    EXPECT_EQ(make_budget(linear, 5, 11)->not_stated,
              (std::vector<std::string>{"device", "misalignment", "machine_temperature",
                                        "machine_expansion"}));
    EXPECT_EQ(make_budget(rotary, 5, 8)->not_stated, std::vector<std::string>{"environment"});
    EXPECT_TRUE(make_budget(workshop(), 5, 11)->not_stated.empty());
}

std::string refused_field(const UncertaintyStatement& statement, int n = 5) {
    const auto budget = make_budget(statement, n, 11);
    return budget ? "accepted" : budget.error().field;
}

TEST(UncertaintyBudgetRefuses, WhatIsIncompleteTwiceOrOfTheOtherAxis) {
    const auto with = [](auto change) {
        UncertaintyStatement s = workshop();
        change(s);
        return refused_field(s);
    };
    EXPECT_EQ(with([](auto& s) { s.device_k.reset(); }), "k");
    EXPECT_EQ(with([](auto& s) { s.device_U.reset(); }), "device_U_um");
    EXPECT_EQ(with([](auto& s) { s.device_k = 0; }), "k");
    EXPECT_EQ(with([](auto& s) { s.device_k = 1e-300; }), "k");
    EXPECT_EQ(with([](auto& s) { s.length_m = 1e-300; }), "length_m");
    EXPECT_EQ(with([](auto& s) { s.device_width = 1; }), "device_width_um");
    EXPECT_EQ(with([](auto& s) { s.length_m.reset(); }), "length_m");
    EXPECT_EQ(with([](auto& s) { s.length_m = 0; }), "length_m");
    EXPECT_EQ(with([](auto& s) { s.misalignment_rad = 1e-3; }), "misalignment_rad");
    EXPECT_EQ(with([](auto& s) { s.misalignment_mm = 176; }), "misalignment_mm");
    EXPECT_EQ(with([](auto& s) { s.alpha_um_per_m_K.reset(); }), "expansion_per_K");
    EXPECT_EQ(with([](auto& s) { s.temperature_offset_K.reset(); }), "temperature_offset_K");
    EXPECT_EQ(with([](auto& s) { s.eve = -1; }), "eve_um");
    EXPECT_EQ(with([](auto& s) { s.eve = std::nan(""); }), "eve_um");
    EXPECT_EQ(with([](auto& s) { s.eve = HUGE_VAL; }), "eve_um");
    EXPECT_EQ(with([](auto& s) { s.axis_kind = AxisKind::rotary; }), "length_m");
    EXPECT_EQ(refused_field(workshop(), 0), "n");
    UncertaintyStatement rotary;
    rotary.axis_kind = AxisKind::rotary;
    rotary.device_width = -1;
    EXPECT_EQ(refused_field(rotary), "device_width_arcsec");
}

TEST(Verdict, ProvesOnlyWhatLiesBeyondTheUncertainty) {
    // ISO 14253-1: conformity up to limit - g, non-conformity above limit + g
    EXPECT_EQ(verdict_of(8, 10, 2), Verdict::pass);
    EXPECT_EQ(verdict_of(std::nextafter(8.0, 9), 10, 2), Verdict::not_provable);
    EXPECT_EQ(verdict_of(12, 10, 2), Verdict::not_provable);
    EXPECT_EQ(verdict_of(std::nextafter(12.0, 13), 10, 2), Verdict::fail);
    EXPECT_EQ(verdict_of(10, 10, 0), Verdict::pass);
    EXPECT_EQ(verdict_of(std::nextafter(10.0, 11), 10, 0), Verdict::fail);
    EXPECT_EQ(name_of(Verdict::not_provable), "not_provable");
}

TEST(Verdict, NoValueIsProvenBothWays) {
    std::mt19937_64 random{6};
    std::uniform_real_distribution<double> number{0, 10};
    for (int i = 0; i < 2000; ++i) {
        const double value = number(random), limit = number(random), U = number(random);
        const Verdict verdict = verdict_of(value, limit, U);
        if (verdict == Verdict::pass) {
            EXPECT_LE(value + U, limit + 1e-14);
        }
        if (verdict == Verdict::fail) {
            EXPECT_GE(value - U, limit - 1e-14);
        }
        if (verdict == Verdict::not_provable) {
            EXPECT_NE(verdict_of(value, limit, 0) == Verdict::pass,
                      verdict_of(value, limit, 0) == Verdict::fail);
            EXPECT_LE(std::fabs(value - limit), U + 1e-14);
        }
    }
}

} // namespace
} // namespace axiscal::budget_test
