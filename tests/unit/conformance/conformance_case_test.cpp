#include "tools/axiscal/conformance/conformance_case.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace axiscal::conformance_case_test {
namespace {

using nlohmann::json;

json good_file() {
    return json::parse(
        R"({"id":"one","title":"t","origin":"closed_form","source":"s","derivation":"derivations/x.py",
        "case":{"analysis":"positioning"},"scale":2,
        "expect":[{"at":"/a/0","value":1.5,"tolerance":1e-12,"reason":"rounding"},
                  {"at":"/b","value":0,"tolerance":0,"reason":"exact","scale":5},
                  {"at":"/c","equals":"text"},{"at":"/d","equals":true},{"at":"/e","absent":true}]})");
}

std::string refused_field(const json& file) {
    const auto read = read_conformance_case(file.dump(), "one");
    return read ? "accepted" : read.error().field;
}

TEST(ConformanceCase, IsReadWithItsExpectations) {
    const auto read = read_conformance_case(good_file().dump(), "one");
    ASSERT_TRUE(read) << read.error().field << read.error().detail;
    EXPECT_EQ(read->origin, "closed_form");
    EXPECT_EQ(read->input, good_file().at("case"));
    ASSERT_EQ(read->expect.size(), 5u);
    EXPECT_EQ(read->expect[0].value, 1.5);
    EXPECT_EQ(read->expect[0].scale, 2) << "the case's scale";
    EXPECT_EQ(read->expect[1].scale, 5) << "its own";
    EXPECT_EQ(read->expect[2].kind, Expectation::Kind::equal);
    EXPECT_EQ(read->expect[4].kind, Expectation::Kind::absent);
}

TEST(ConformanceCase, NamesThePlaceOfEveryMistake) {
    const auto with = [](const char* pointer, const json& value) {
        json file = good_file();
        file[json::json_pointer{pointer}] = value;
        return refused_field(file);
    };
    EXPECT_EQ(with("/id", "two"), "id");
    EXPECT_EQ(with("/title", ""), "title");
    EXPECT_EQ(with("/origin", "our own output"), "origin");
    EXPECT_EQ(with("/source", 3), "source");
    EXPECT_EQ(with("/derivation", ""), "derivation");
    EXPECT_EQ(with("/case", "text"), "case");
    EXPECT_EQ(with("/scale", -1), "scale");
    EXPECT_EQ(with("/expect", json::array()), "expect");
    EXPECT_EQ(with("/expect/0/at", "no pointer"), "expect[0].at");
    EXPECT_EQ(with("/expect/1/at", "/a/0"), "expect[1].at") << "the same place twice";
    EXPECT_EQ(with("/expect/0/value", "1.5"), "expect[0].value");
    EXPECT_EQ(with("/expect/0/tolerance", -1e-9), "expect[0].tolerance");
    EXPECT_EQ(with("/expect/0/reason", ""), "expect[0].reason");
    EXPECT_EQ(with("/expect/0/equals", "x"), "expect[0]") << "number and text at once";
    EXPECT_EQ(with("/expect/2/equals", 1.5), "expect[2].equals");
    EXPECT_EQ(with("/expect/4/absent", false), "expect[4].absent");
    EXPECT_EQ(with("/expect/3/tolerances", 1), "expect[3].tolerances");
    EXPECT_EQ(with("/expectation", 1), "expectation");
}

TEST(ConformanceCase, AFigureWithoutToleranceOrReasonIsNone) {
    for (const char* key : {"tolerance", "reason", "at"}) {
        json file = good_file();
        file["expect"][0].erase(key);
        EXPECT_EQ(refused_field(file), std::string{"expect[0]."} + key);
    }
    for (const char* key : {"id", "title", "origin", "source", "derivation", "case", "expect"}) {
        json file = good_file();
        file.erase(key);
        EXPECT_EQ(refused_field(file), key);
    }
}

TEST(ConformanceCase, APublishedFigureNeedsNoDerivation) {
    json file = good_file();
    file["origin"] = "published";
    file.erase("derivation");
    EXPECT_EQ(refused_field(file), "accepted");
}

TEST(ConformanceCase, BrokenTextIsToldWithItsPlace) {
    const auto broken = read_conformance_case("{\"id\":\n \"one\",,}", "one");
    ASSERT_FALSE(broken);
    EXPECT_EQ(broken.error().field, "json");
    EXPECT_NE(broken.error().detail.find("line 2"), std::string::npos) << broken.error().detail;
    const auto twice = read_conformance_case(R"({"id":"one","id":"one"})", "one");
    ASSERT_FALSE(twice);
    EXPECT_EQ(twice.error().field, "id");
    EXPECT_FALSE(read_conformance_case("", "one"));
    EXPECT_FALSE(read_conformance_case("[]", "one"));
}

} // namespace
} // namespace axiscal::conformance_case_test
