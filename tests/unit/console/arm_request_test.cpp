// The order to arm as JSON: which kind of test it is of, and what that kind alone is told.
#include "acquisition/console/api_json.hpp"

#include <gtest/gtest.h>

namespace axiscal::arm_request_test {
namespace {

ArmRequest order_of_pass(const std::string& pass) {
    auto order = arm_request_from_json(R"({"pass":")" + pass + R"("})");
    EXPECT_TRUE(order);
    return order ? *std::move(order) : ArmRequest{};
}

std::string field_of(const std::string& body) {
    const auto order = arm_request_from_json(body);
    EXPECT_FALSE(order) << body;
    return order ? "" : order.error().field;
}

TEST(ArmRequest, APassThatIsTheNameOfAKindIsOfThatKind) {
    for (const TestKind kind : all_test_kinds) {
        const std::string name{name_of(kind)};
        EXPECT_EQ(order_of_pass(name).kind, kind) << name;
        EXPECT_EQ(order_of_pass(name).pass, name);
    }
}

TEST(ArmRequest, AnyOtherPassIsOneOfTheAxis) {
    for (const char* const pass : {"whole", "stretch", "Circular", ""}) {
        EXPECT_EQ(order_of_pass(pass).kind, TestKind::positioning) << pass;
        EXPECT_EQ(order_of_pass(pass).pass, pass);
    }
    EXPECT_EQ(arm_request_from_json("{}")->kind, TestKind::positioning);
}

TEST(ArmRequest, OptionsAreTextsByName) {
    const auto order = arm_request_from_json(R"({"options":{"mirror":"reversed"}})");
    ASSERT_TRUE(order);
    EXPECT_EQ(order->options.at("mirror"), "reversed");
    EXPECT_EQ(field_of(R"({"options":"reversed"})"), "options");
    EXPECT_EQ(field_of(R"({"options":{"mirror":1}})"), "options.mirror");
    EXPECT_EQ(field_of(R"({"overrides":{"soak":1}})"), "overrides.soak");
}

} // namespace
} // namespace axiscal::arm_request_test
