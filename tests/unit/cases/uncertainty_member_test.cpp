#include "tests/support/source_dir.hpp"
#include "tests/unit/cases/asked.hpp"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace axiscal::uncertainty_member_test {
namespace {

using nlohmann::json;

json good_case() {
    return json::parse(R"({"analysis":"positioning","standard":"ISO 230-2:2014",
        "axis":{"name":"X","kind":"linear"},"unit":"mm","readings":"deviations",
        "targets":[0,900,1750],
        "forward":[[-0.001,0,0.001,0.002,0.003],[0.002,0.003,0.003,0.003,0.004],[0.1,0.1,0.1,0.1,0.1]],
        "backward":[[-0.003,-0.002,-0.001,0,0.001],[0.002,0.004,0.004,0.004,0.006],[0.09,0.09,0.09,0.09,0.09]],
        "uncertainty":{"device_U_um":1.2,"k":2,"length_m":1.75,"misalignment_mm":1,"expansion_per_K":1.2e-05,
          "temperature_width_K":0.7,"temperature_offset_K":1,"expansion_width_per_K":2e-06,"eve_um":1.7}})");
}

json rotary_case() {
    json request = good_case();
    request["axis"]["kind"] = "rotary";
    request["unit"] = "deg";
    request["uncertainty"] = {{"device_width_arcsec", 2}, {"eve_arcsec", 0.5}};
    return request;
}

using test::answer_to;

std::string refusal_of(const json& request) {
    const CaseAnswer answer = analyze_cases(request.dump());
    EXPECT_EQ(answer.exit_code, 3);
    return answer.error_line;
}

double expanded(const json& answer, const std::string& key) {
    const json& parameter = answer.at("parameters").at(key);
    EXPECT_EQ(parameter.at("expanded_uncertainty").at("k"), 2);
    return parameter.at("expanded_uncertainty").at("value").get<double>();
}

/// The member of the contract for a request of the reference file.
json member_of(const json& request) {
    const std::map<std::string, std::string> contract{
        {"U_device", "device_U_um"},
        {"k_device", "k"},
        {"width_device", "device_width_um"},
        {"L_m", "length_m"},
        {"width_misalign_mm", "misalignment_mm"},
        {"delta_rad", "misalignment_rad"},
        {"alpha_um_mK", "expansion_per_K"},
        {"width_theta_K", "temperature_width_K"},
        {"delta_T_K", "temperature_offset_K"},
        {"width_alpha_um_mK", "expansion_width_per_K"},
        {"EVE", "eve_um"},
        {"n", "n"},
        {"eve_model", "eve_model"}};
    json member;
    for (const auto& [key, value] : request.items())
        if (key != "task") member[contract.at(key)] = value;
    for (const char* per_K : {"expansion_per_K", "expansion_width_per_K"}) // um/(m K) there
        if (member.contains(per_K)) member[per_K] = member[per_K].get<double>() * 1e-6;
    return member;
}

TEST(UncertaintyMember, GivesEveryUOfTheReferenceInTheUnitOfTheCase) {
    const std::map<std::string, std::string> keys{{"R_uni", "R_backward"}, {"B", "B"}, {"R", "R"},
                                                  {"E", "E_forward"},      {"M", "M"}, {"A", "A"}};
    std::ifstream file{test::source_dir() + "/tests/reference/uncertainty_thermal.json"};
    const json reference = json::parse(file);
    for (const json& entry : reference.at("uncertainty")) {
        SCOPED_TRACE(entry.at("id"));
        json request = good_case();
        request["uncertainty"] = member_of(entry.at("request"));
        for (const auto& [unit, um] :
             std::map<std::string, double>{{"mm", 1e3}, {"um", 1}, {"m", 1e6}}) {
            request["unit"] = unit;
            const json answer = answer_to(request);
            for (const auto& [name, U] : entry.at("recomputed").at("U").items())
                EXPECT_NEAR(expanded(answer, keys.at(name)) * um, U.get<double>(), 1e-13) << name;
        }
    }
}

TEST(UncertaintyMember, RotaryAxisIsStatedInArcsecondsAndAnsweredInDegrees) {
    const json answer = answer_to(rotary_case());
    // the reference's rotary entry
    EXPECT_NEAR(expanded(answer, "A") * 3600, 1.2974333637352378, 1e-13);
    EXPECT_NEAR(expanded(answer, "R") * 3600, 0.6055300708194984, 1e-13);
    EXPECT_EQ(answer.at("budget").at("source"), "after ISO 230-2 annex A, rotary axis");
    EXPECT_TRUE(answer.at("budget").at("not_stated").empty());
}

TEST(UncertaintyMember, ChangesNoFigureOfTheCase) {
    json without = good_case();
    without.erase("uncertainty");
    const json plain = answer_to(without), full = answer_to(good_case());
    EXPECT_EQ(plain.at("positions"), full.at("positions"));
    for (const auto& [key, parameter] : plain.at("parameters").items()) {
        EXPECT_EQ(parameter.at("value"), full.at("parameters").at(key).at("value")) << key;
        EXPECT_TRUE(full.at("parameters").at(key).contains("expanded_uncertainty")) << key;
    }
    EXPECT_FALSE(plain.contains("budget"));
}

TEST(UncertaintyMember, BudgetOfEachParameterAddsUpToItsU) {
    const json answer = answer_to(good_case());
    for (const auto& [key, parameter] : answer.at("parameters").items()) {
        double square = 0;
        for (const json& term : parameter.at("budget").at("terms")) {
            EXPECT_FALSE(term.at("formula").get<std::string>().empty());
            EXPECT_FALSE(term.at("status").get<std::string>().empty());
            square += std::pow(term.at("factor").get<double>() * term.at("u").get<double>(), 2);
        }
        EXPECT_NEAR(2 * std::sqrt(square), expanded(answer, key), 1e-15) << key;
    }
    EXPECT_EQ(answer.at("budget").at("terms").size(), 5u);
    EXPECT_EQ(answer.at("parameters").at("R").at("budget").at("terms").size(), 1u);
}

TEST(UncertaintyMember, OldNamesOfTheExpansionAreRefusedWithTheNewOne) {
    json request = good_case();
    request["uncertainty"].erase("expansion_per_K");
    request["uncertainty"]["alpha_um_per_m_K"] = 1.17e-5;
    const auto answer = analyze_cases(request.dump());
    EXPECT_NE(answer.exit_code, 0);
    EXPECT_EQ(answer.error_line,
              "refused: uncertainty.alpha_um_per_m_K: is not a key of a case; it is called "
              "'expansion_per_K': 11.7 um/(m K) are 1.17e-5");
    request = good_case();
    request["uncertainty"]["expansion_per_K"] = 11.7;
    EXPECT_EQ(test::refused_field(request), "uncertainty.expansion_per_K");
}

TEST(UncertaintyMember, NIsThatOfTheReadingsWhateverIsStated) {
    json request = good_case();
    const json of_the_rows = answer_to(request).at("parameters");
    for (const int n : {1, 5, 17}) {
        request["uncertainty"]["n"] = n;
        EXPECT_EQ(answer_to(request).at("parameters"), of_the_rows) << n;
    }
}

TEST(UncertaintyMember, LengthIsTheSpanOfTheTargetsUnlessStated) {
    json request = good_case();
    const json stated = answer_to(request);
    request["uncertainty"].erase("length_m");
    EXPECT_EQ(answer_to(request).at("parameters"), stated.at("parameters"));
    request["uncertainty"]["length_m"] = 3.5;
    EXPECT_GT(expanded(answer_to(request), "E"), 1.9 * expanded(stated, "E"));
}

TEST(UncertaintyMember, TargetUncertaintyIsMetOrNot) {
    json request = good_case();
    request["uncertainty"]["target_uncertainty"] = {{"A", 0.02}, {"B", 0.0001}};
    const json parameters = answer_to(request).at("parameters");
    EXPECT_EQ(parameters.at("A").at("target_uncertainty"), json({{"value", 0.02}, {"met", true}}));
    EXPECT_EQ(parameters.at("B").at("target_uncertainty").at("met"), false);
    EXPECT_FALSE(parameters.at("M").contains("target_uncertainty"));
}

TEST(UncertaintyMember, SimulationStandsBesideTheFormulasUnlessDeclined) {
    json request = good_case();
    const json simulated = answer_to(request);
    EXPECT_EQ(simulated.at("monte_carlo").at("trials"), 100'000);
    EXPECT_EQ(simulated.at("monte_carlo").at("seed"), 1);
    for (const auto& [key, parameter] : simulated.at("parameters").items()) {
        const json& drawn = parameter.at("monte_carlo");
        EXPECT_GT(drawn.at("u"), 0) << key;
        for (const char* interval : {"interval_95", "shortest_95"}) {
            EXPECT_LT(drawn.at(interval)[0], drawn.at("mean")) << key;
            EXPECT_GT(drawn.at(interval)[1], drawn.at("mean")) << key;
        }
    }
    request["uncertainty"]["monte_carlo"] = {{"trials", 100'000}, {"seed", 1}};
    EXPECT_EQ(answer_to(request), simulated);
    request["uncertainty"]["monte_carlo"]["seed"] = 2;
    EXPECT_NE(answer_to(request), simulated);
    request["uncertainty"]["monte_carlo"] = false;
    const json declined = answer_to(request);
    EXPECT_FALSE(declined.contains("monte_carlo"));
    EXPECT_FALSE(declined.at("parameters").at("A").contains("monte_carlo"));
    EXPECT_EQ(declined.at("budget"), simulated.at("budget"));
}

TEST(UncertaintyMember, SaysByHowMuchTheSourceFormulaOfRIsConservative) {
    const json answer = answer_to(good_case());
    const json& two_way = answer.at("parameters").at("R");
    const double ratio = two_way.at("budget").at("u").get<double>() /
                         two_way.at("monte_carlo").at("u").get<double>();
    const std::string percent = std::to_string(std::lround((ratio - 1) * 100)) + " % above";
    const std::string remarks = answer.at("monte_carlo").at("remarks").dump();
    EXPECT_NE(remarks.find(percent), std::string::npos) << remarks;
    EXPECT_GT(ratio, 1.2);
}

TEST(UncertaintyMember, AnswersOrRefusesWhateverNumbersComeAndNeverGivesNaN) {
    for (json request : {good_case(), rotary_case()}) {
        request["uncertainty"]["monte_carlo"] = {{"trials", 1000}, {"seed", 1}};
        request["uncertainty"]["target_uncertainty"] = {{"A", 0.01}};
        test::expect_numbers_in_numbers_out(request);
    }
}

TEST(UncertaintyMemberRefuses, ByTheFieldAsItWasWritten) {
    const auto with = [](const std::string& key, const json& value) {
        json request = good_case();
        request["uncertainty"][key] = value;
        return refusal_of(request);
    };
    const auto starts = [](const std::string& line, const std::string& field) {
        EXPECT_TRUE(line.starts_with("refused: uncertainty" + field + ": ")) << line;
    };
    starts(with("eve_um", -1), ".eve_um");
    starts(with("eve_um", "1"), ".eve_um");
    starts(with("eve", 1), ".eve");
    starts(with("eve_arcsec", 1), ".eve_arcsec");
    starts(with("device_width_um", 1), ".device_width_um");
    starts(with("n", 2.5), ".n");
    starts(with("n", 0), ".n");
    starts(with("eve_model", "both"), ".eve_model");
    starts(with("target_uncertainty", {{"Z", 1}}), ".target_uncertainty.Z");
    starts(with("target_uncertainty", {{"A", -1}}), ".target_uncertainty.A");
    starts(with("length_m", 0), ".length_m");
    starts(with("monte_carlo", true), ".monte_carlo");
    starts(with("monte_carlo", {{"trial", 2000}}), ".monte_carlo.trial");
    starts(with("monte_carlo", {{"trials", 999}}), ".monte_carlo.trials");
    starts(with("monte_carlo", {{"trials", 2000.5}}), ".monte_carlo.trials");
    starts(with("monte_carlo", {{"seed", -1}}), ".monte_carlo.seed");
    starts(with("monte_carlo", {{"seed", 1e300}}), ".monte_carlo.seed");
    json request = good_case();
    request["uncertainty"].erase("k");
    starts(refusal_of(request), ".k");
    request["uncertainty"] = 5;
    starts(refusal_of(request), "");
    request = rotary_case();
    request["uncertainty"]["length_m"] = 1;
    starts(refusal_of(request), ".length_m");
    request = rotary_case();
    request["uncertainty"]["eve_deg"] = 0.1;
    starts(refusal_of(request), ".eve_deg");
    request["uncertainty"] = {{"device_U_deg", 0.1}};
    starts(refusal_of(request), ".k");
}

TEST(UncertaintyMemberRefuses, AnUnitOfTheOtherKindOfAxisWithTheOneToTake) {
    json request = rotary_case();
    request["uncertainty"] = {{"device_width_um", 2}};
    EXPECT_EQ(refusal_of(request),
              "refused: uncertainty.device_width_um: is a length; a rotary axis takes "
              "'device_width_arcsec' or 'device_width_deg'");
    request = good_case();
    request["uncertainty"] = {{"eve_deg", 2}};
    EXPECT_EQ(refusal_of(request),
              "refused: uncertainty.eve_deg: is an angle; a linear axis takes 'eve_um'");
}

TEST(UncertaintyMember, OfARotaryAxisMayBeStatedInDegrees) {
    json request = rotary_case();
    const json in_seconds = answer_to(request);
    request["uncertainty"] = {{"device_width_deg", 2.0 / 3600}, {"eve_deg", 0.5 / 3600}};
    const json in_degrees = answer_to(request);
    for (const auto& [key, parameter] : in_seconds.at("parameters").items())
        EXPECT_NEAR(in_degrees.at("parameters").at(key).at("budget").at("u").get<double>(),
                    parameter.at("budget").at("u").get<double>(), 1e-18)
            << key;
}

} // namespace
} // namespace axiscal::uncertainty_member_test
