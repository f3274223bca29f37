#include "acquisition/console/certificate_facts.hpp"

#include <gtest/gtest.h>

#include <string>

namespace axiscal::certificate_facts_test {
namespace {

const std::string whole = R"({"format":"axiscal.result/1","standard":"ISO 230-2:2014","unit":"mm",
"parameters":{"A":{"value":0.0164,"expanded_uncertainty":{"value":0.0024,"k":2},"budget":{"u":[1,2]}},
 "R":{"value":0.0046},"B_mean":{"value":-0.0024}},
"positions":[{"target":0.0}],
"verdict":"fail",
"verdicts":[{"parameter":"R","value":0.0046,"U":0.0012,"limit":0.004,"verdict":"fail","reason":null}],
"tolerances":{"name":"shop","rule":"simple"},
"completeness":{"status":"complete"},
"certificate":{"number":"C-7","replaces":null},
"run":{"id":"demo-1","started":"2026-01-02T08:15:00Z","result_digest":"ab",
 "set_aside":[{"why":"excluded"},{"why":"superseded"}],"deviations":{"forward":[[1]]}}})";

std::string with(std::string text, const std::string& what, const std::string& by) {
    return text.replace(text.find(what), what.size(), by);
}

TEST(CertificateFacts, AreThoseOfTheDocument) {
    const auto facts = facts_of_certificate(whole);
    ASSERT_TRUE(facts) << describe(facts.error());
    EXPECT_EQ(facts->run_id, "demo-1");
    EXPECT_EQ(facts->started_utc, "2026-01-02T08:15:00Z");
    EXPECT_EQ(facts->result_digest, "ab");
    EXPECT_EQ(facts->number, "C-7");
    EXPECT_EQ(facts->standard + " " + facts->unit, "ISO 230-2:2014 mm");
    EXPECT_EQ(facts->verdict, "fail");
    EXPECT_EQ(facts->limits + " " + facts->rule, "shop simple");
    EXPECT_EQ(facts->left_out, 1U);
}

TEST(CertificateFacts, TheFiguresWithALimitComeFirstAndNoneTwice) {
    const auto facts = facts_of_certificate(whole);
    ASSERT_TRUE(facts);
    ASSERT_EQ(facts->figures.size(), 3U);
    EXPECT_EQ(facts->figures[0].parameter, "R");
    EXPECT_EQ(facts->figures[0].verdict, "fail");
    EXPECT_EQ(facts->figures[0].expanded_uncertainty, 0.0012);
    EXPECT_EQ(facts->figures[1].parameter, "A");
    EXPECT_EQ(facts->figures[1].expanded_uncertainty, 0.0024);
    EXPECT_EQ(facts->figures[1].limit, std::nullopt);
    EXPECT_EQ(facts->figures[2].verdict, "");
}

TEST(CertificateFacts, APartialResultGivesNoVerdict) {
    const auto facts = facts_of_certificate(with(whole, "\"complete\"", "\"partial\""));
    ASSERT_TRUE(facts);
    EXPECT_TRUE(facts->partial);
    EXPECT_EQ(facts->verdict, "");
}

TEST(CertificateFacts, WhatHasAnotherTypeCountsAsNotThere) {
    const auto facts = facts_of_certificate(
        R"({"run":{"id":"x","set_aside":7},"verdict":1,"verdicts":{"a":2},"parameters":[1],"unit":[]})");
    ASSERT_TRUE(facts) << describe(facts.error());
    EXPECT_EQ(facts->verdict + facts->unit, "");
    EXPECT_TRUE(facts->figures.empty());
}

TEST(CertificateFacts, WhatIsNoCertificateIsRefusedWithAReason) {
    for (const std::string& text :
         {std::string{}, std::string{"[]"}, std::string{"{}"}, whole + "x", whole.substr(0, 200),
          with(whole, "demo-1", ""), std::string(100'000, '['), with(whole, "demo-1", "\xff")}) {
        const auto facts = facts_of_certificate(text);
        ASSERT_FALSE(facts) << text.substr(0, 40);
        EXPECT_EQ(facts.error().fault, Fault::bad_case);
        EXPECT_FALSE(facts.error().detail.empty());
    }
}

TEST(CertificateFacts, TextsAndListsAreBounded) {
    std::string parameters;
    for (int i = 0; i < 100; ++i)
        parameters += "\"p" + std::to_string(i) + "\":{\"value\":1},";
    const auto facts =
        facts_of_certificate(R"({"run":{"id":"x"},"standard":")" + std::string(1000, 's') +
                             "\",\"parameters\":{" + parameters + R"("last":{"value":1}}})");
    ASSERT_TRUE(facts) << describe(facts.error());
    EXPECT_EQ(facts->standard.size(), 300U);
    EXPECT_EQ(facts->figures.size(), 40U);
}

} // namespace
} // namespace axiscal::certificate_facts_test
