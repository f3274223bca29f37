#include "tools/axiscal/conformance/judge.hpp"
#include "tools/axiscal/conformance/report.hpp"

#include <gtest/gtest.h>

namespace axiscal::judge_test {
namespace {

ConformanceCase asked_for(std::vector<Expectation> expect) {
    ConformanceCase asked;
    asked.id = "one";
    asked.origin = "published";
    asked.expect = std::move(expect);
    return asked;
}

Expectation number(std::string at, double value, double tolerance, double scale = 0) {
    Expectation out;
    out.at = std::move(at);
    out.value = value;
    out.tolerance = tolerance;
    out.scale = scale;
    out.reason = "because";
    return out;
}

Expectation equal(std::string at, nlohmann::json value) {
    Expectation out;
    out.at = std::move(at);
    out.kind = Expectation::Kind::equal;
    out.equals = std::move(value);
    return out;
}

Expectation absent(std::string at) {
    Expectation out;
    out.at = std::move(at);
    out.kind = Expectation::Kind::absent;
    return out;
}

FigureVerdict judged(Expectation wanted, const std::string& answer) {
    const CaseVerdict verdict = judge_answer(asked_for({std::move(wanted)}), answer);
    EXPECT_EQ(verdict.failure, "");
    EXPECT_EQ(verdict.passed(), verdict.figures.at(0).agrees);
    return verdict.figures.at(0);
}

TEST(Digits, AreCountedFromTheLargerOfFigureAndScale) {
    EXPECT_NEAR(digits_of_agreement(1.001, 1, 0), 3, 1e-9);
    EXPECT_NEAR(digits_of_agreement(-99.9, -100, 0), 3, 1e-9);
    EXPECT_NEAR(digits_of_agreement(0.001, 0, 10), 4, 1e-9) << "of the scale";
    EXPECT_NEAR(digits_of_agreement(0.001, 0, 0), 3, 1e-9) << "of one unit";
    EXPECT_EQ(digits_of_agreement(2, 2, 0), most_digits);
    EXPECT_EQ(digits_of_agreement(500, 1, 0), 0) << "never negative";
}

TEST(Judge, AToleranceIsAbsoluteAndItsEdgeBelongsToIt) {
    EXPECT_TRUE(judged(number("/a", 2, 0.5), R"({"a":2.5})").agrees);
    EXPECT_TRUE(judged(number("/a", 2, 0.5), R"({"a":1.5})").agrees);
    const auto off = judged(number("/a", 2, 0.5), R"({"a":2.6})");
    EXPECT_FALSE(off.agrees);
    for (const char* word : {"2.6", "expected 2", "tolerance 0.5", "because"})
        EXPECT_NE(off.complaint.find(word), std::string::npos) << off.complaint;
    EXPECT_TRUE(judged(number("/a", 3, 0), R"({"a":3})").agrees);
    EXPECT_FALSE(judged(number("/a", 3, 0), R"({"a":3.0000000000000004})").agrees);
}

TEST(Judge, WhatIsNoNumberDisagreesAndSaysWhatItIs) {
    EXPECT_NE(judged(number("/a", 2, 1e9), R"({"a":"2"})").complaint.find("string"),
              std::string::npos);
    EXPECT_NE(judged(number("/a", 2, 1e9), R"({"a":null})").complaint.find("null"),
              std::string::npos);
    EXPECT_EQ(judged(number("/a", 2, 1e9), R"({"a":NaN})").complaint, "is NaN");
    EXPECT_EQ(judged(number("/a", 2, 1e9), R"({"a":-Infinity})").complaint, "is -Infinity");
    EXPECT_EQ(judged(number("/a", 2, 1e9), R"({"b":2})").complaint, "is not in the answer");
    EXPECT_EQ(judged(number("/a/1", 2, 1e9), R"({"a":[2]})").complaint, "is not in the answer");
    EXPECT_EQ(judged(number("/a/x", 2, 1e9), R"({"a":[2]})").complaint, "is not in the answer");
    EXPECT_EQ(judged(number("/a/x", 2, 1e9), R"([1])").complaint, "is not in the answer");
    EXPECT_EQ(judged(number("/a/0", 2, 1e9), "3").complaint, "is not in the answer");
}

TEST(Judge, TextsBooleansAndWholeNumbersMustBeEqual) {
    EXPECT_TRUE(judged(equal("/a", "outer"), R"({"a":"outer"})").agrees);
    EXPECT_FALSE(judged(equal("/a", "outer"), R"({"a":"inner"})").agrees);
    EXPECT_TRUE(judged(equal("/a", true), R"({"a":true})").agrees);
    EXPECT_FALSE(judged(equal("/a", true), R"({"a":1})").agrees);
    EXPECT_TRUE(judged(equal("/a", 4), R"({"a":4})").agrees);
    EXPECT_FALSE(judged(equal("/a", 4), R"({})").agrees);
}

TEST(Judge, WhatTheDataDoNotAllowMustNotStandThere) {
    EXPECT_TRUE(judged(absent("/p/R"), R"({"p":{}})").agrees);
    EXPECT_TRUE(judged(absent("/p/R"), R"({})").agrees);
    EXPECT_FALSE(judged(absent("/p/R"), R"({"p":{"R":0}})").agrees);
    EXPECT_FALSE(judged(absent("/p/R"), R"({"p":{"R":null}})").agrees);
}

TEST(Judge, AnAnswerThatIsNoResultFailsTheCaseByName) {
    for (const char* garbage : {"", "Traceback", "{\"a\":", "{} {}", "\xff\xfe"}) {
        const CaseVerdict verdict = judge_answer(asked_for({number("/a", 1, 1)}), garbage);
        EXPECT_FALSE(verdict.passed()) << garbage;
        EXPECT_NE(verdict.failure.find("no result"), std::string::npos) << verdict.failure;
        EXPECT_NE(text_of_verdict(verdict, true).find("FAILED  one"), std::string::npos);
    }
}

TEST(Tally, CountsCasesByOriginAndEveryFigure) {
    ConformanceCase other = asked_for({number("/a", 1, 0), number("/b", 1, 0)});
    other.origin = "two_ways";
    const Tally tally =
        tally_of({judge_answer(asked_for({number("/a", 1, 0)}), R"({"a":1})"),
                  judge_answer(other, R"({"a":1,"b":2})"), judge_silence(other, "crashed")});
    EXPECT_EQ(text_of_tally(tally),
              "3 cases (1 published, 0 third_party_program, 0 closed_form, 2 two_ways), 5 figures: "
              "2 agree, 3 disagree; 1 cases passed, 2 failed\n");
    EXPECT_FALSE(tally.all_agree());
}

TEST(Report, BriefTellsOnlyWhatDisagrees) {
    const auto verdict =
        judge_answer(asked_for({number("/a", 1, 0), number("/b", 1, 0)}), R"({"a":1,"b":2})");
    const std::string brief = text_of_verdict(verdict, true),
                      whole = text_of_verdict(verdict, false);
    EXPECT_EQ(brief.find("/a"), std::string::npos);
    EXPECT_NE(brief.find("DISAGREES  /b"), std::string::npos) << brief;
    EXPECT_NE(whole.find("exact"), std::string::npos) << whole;
    const auto passed = judge_answer(asked_for({number("/a", 1, 0)}), R"({"a":1})");
    EXPECT_EQ(text_of_verdict(passed, true), "");
}

TEST(Report, JsonHoldsEveryFigureWithItsDigits) {
    const auto document = json_of_verdicts(
        {judge_answer(asked_for({number("/a", 1, 0.1), absent("/c")}), R"({"a":1.01})")}, "p");
    EXPECT_EQ(document.at("format"), "axiscal.conformance/1");
    const auto& figure = document.at("cases").at(0).at("figures").at(0);
    EXPECT_NEAR(figure.at("digits").get<double>(), 2, 1e-9);
    EXPECT_EQ(figure.at("got"), 1.01);
    EXPECT_EQ(document.at("summary").at("passed"), 1);
}

} // namespace
} // namespace axiscal::judge_test
