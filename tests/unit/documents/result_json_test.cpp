#include "acquisition/documents/positioning/result_json.hpp"
#include "acquisition/documents/result_digest.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace axiscal::result_json_test {
namespace {

using Rows = std::vector<std::vector<double>>;
using Json = nlohmann::ordered_json;

PositioningResult evaluate(std::vector<double> targets, Rows forward, Rows backward) {
    return evaluate_positioning(
        declare_at_20C({std::move(targets), std::move(forward), std::move(backward), "mm"}, "test")
            .value());
}

std::vector<std::string> keys_of(const Json& object) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items())
        keys.push_back(key);
    return keys;
}

TEST(ResultJson, FullResultHasExactlyTheKeysOfTheContract) {
    const Json document = result_to_json(evaluate({0, 10}, {{1, 2}, {3, 4}}, {{0, 1}, {2, 2}}));
    EXPECT_EQ(keys_of(document),
              (std::vector<std::string>{"format", "standard", "unit", "compensation", "parameters",
                                        "positions"}));
    EXPECT_EQ(document.at("format"), "axiscal.result/1");
    EXPECT_EQ(document.at("standard"), "ISO 230-2:2014");
    EXPECT_EQ(document.at("unit"), "mm");
    EXPECT_EQ(document.at("compensation"), "already_at_20C");
    EXPECT_EQ(
        keys_of(document.at("parameters")),
        (std::vector<std::string>{"A", "A_forward", "A_backward", "E", "E_forward", "E_backward",
                                  "M", "R", "R_forward", "R_backward", "B", "B_mean"}));
    for (const auto& figure : document.at("parameters"))
        EXPECT_EQ(keys_of(figure), std::vector<std::string>{"value"});
    ASSERT_EQ(document.at("positions").size(), 2u);
    EXPECT_EQ(
        keys_of(document.at("positions")[1]),
        (std::vector<std::string>{"target", "mean_forward", "mean_backward", "mean", "B",
                                  "s_forward", "s_backward", "R_forward", "R_backward", "R"}));
}

TEST(ResultJson, FiguresStandUnderTheirOwnKeys) {
    // one target, deviations 4 and 1 each way, n = 1: reversal 3, mean 2.5
    const Json document = result_to_json(evaluate({7, 9}, {{4}, {4}}, {{1}, {1}}));
    EXPECT_EQ(document.at("parameters").at("B").at("value"), 3.0);
    EXPECT_EQ(document.at("parameters").at("B_mean").at("value"), 3.0);
    EXPECT_EQ(document.at("parameters").at("E").at("value"), 3.0);
    EXPECT_EQ(document.at("parameters").at("M").at("value"), 0.0);
    const Json& row = document.at("positions")[0];
    EXPECT_EQ(row.at("target"), 7.0);
    EXPECT_EQ(row.at("mean_forward"), 4.0);
    EXPECT_EQ(row.at("mean_backward"), 1.0);
    EXPECT_EQ(row.at("mean"), 2.5);
    EXPECT_EQ(row.at("B"), 3.0);
}

TEST(ResultJson, WhatIsNotEvaluatedIsAbsentWithAReason) {
    const Json document = result_to_json(evaluate({0}, {{1}}, {}));
    EXPECT_EQ(keys_of(document.at("parameters")), std::vector<std::string>{"E_forward"});
    EXPECT_EQ(keys_of(document.at("positions")[0]),
              (std::vector<std::string>{"target", "mean_forward"}));
    const auto absent = keys_of(document.at("not_evaluated"));
    EXPECT_EQ(std::set(absent.begin(), absent.end()),
              (std::set<std::string>{"A", "A_forward", "A_backward", "E", "E_backward", "M", "R",
                                     "R_forward", "R_backward", "B", "B_mean"}));
    EXPECT_FALSE(document.at("not_evaluated").at("R").get<std::string>().empty());
}

TEST(ResultJson, EveryDoubleComesBackExactly) {
    std::mt19937_64 random{7};
    std::uniform_real_distribution<double> mantissa{-1, 1};
    std::uniform_int_distribution<int> exponent{-300, 30};
    for (int trial = 0; trial < 20000; ++trial) {
        PositioningResult result;
        const double value = std::ldexp(mantissa(random), exponent(random));
        result.parameters.M = value;
        const auto read = Json::parse(result_to_json(result).dump());
        ASSERT_EQ(read.at("parameters").at("M").at("value").get<double>(), value);
    }
}

TEST(ResultDigest, IsTheHashOfTheDocumentedBytes) {
    // SHA-256 of the bytes written out by hand with another language's struct packing
    EXPECT_EQ(result_digest(evaluate({0, 10}, {{0.5}, {-0.25}}, {})),
              "29de91735b7a31d49eeca783aedd5b848f43845b0b3f0b55f4ec98cab3b78503");
}

} // namespace
} // namespace axiscal::result_json_test
