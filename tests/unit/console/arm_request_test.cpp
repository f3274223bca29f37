// The order to arm as JSON: which kind of test it is of, and what that kind alone is told.
#include "acquisition/console/api_json.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

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

std::string why_not(const std::string& body) {
    const auto order = arm_request_from_json(body);
    EXPECT_FALSE(order) << body;
    return order ? "" : describe(order.error());
}

TEST(ArmRequest, SaysOfEachFieldWhatItWants) {
    EXPECT_EQ(why_not(R"({"datum_mm":"abc"})"),
              "The request is refused. [datum_mm] must be a number: where the axis stands");
    EXPECT_EQ(why_not(R"({"seed":-1})"), "The request is refused. [seed] must be a whole number "
                                         "from 0 on: the part program has it in its first line");
    EXPECT_EQ(why_not(R"({"datum_by_cnc":1})"),
              "The request is refused. [datum_by_cnc] must be true or false");
    EXPECT_EQ(why_not(R"({"pass":7})"), "The request is refused. [pass] must be a text");
}

/// The certificate prints each of them: what nobody reads to its end has no room there.
TEST(ArmRequest, TextThatIsPrintedHasRoomForAThousandBytes) {
    for (const auto& [object, name] :
         {std::pair{"statements", "control_compensation"}, std::pair{"overrides", "soak"},
          std::pair{"options", "mirror"}}) {
        const auto body = [&, object = object, name = name](std::size_t bytes) {
            return std::string{"{\""} + object + "\":{\"" + name + "\":\"" +
                   std::string(bytes, 'x') + "\"}}";
        };
        EXPECT_TRUE(arm_request_from_json(body(1000))) << name;
        EXPECT_EQ(why_not(body(1001)), std::string{"The request is refused. ["} + object + "." +
                                           name + "] has 1001 bytes, and there is room for 1000");
    }
}

TEST(RevisionRequest, SaysOfEachFieldWhatItWants) {
    const auto why = [](const std::string& body) {
        const auto order = revision_request_from_json(body);
        return order ? "" : describe(order.error());
    };
    EXPECT_EQ(why(R"({"target":-1})"),
              "The request is refused. [target] must be a whole number from 0 to 100000");
    EXPECT_EQ(why(R"({"direction":"up"})"),
              "The request is refused. [direction] must be positive or negative");
    EXPECT_EQ(why(R"({"reason":7})"), "The request is refused. [reason] must be a text");
    EXPECT_EQ(why(R"({"reason":")" + std::string(1001, 'x') + R"("})"),
              "The request is refused. [reason] has 1001 bytes, and there is room for 1000");
}

/// Each order has fields of its own.
TEST(RevisionRequest, SaysOfAFieldOfAnotherOrderThatItIsUnknown) {
    const auto revision = revision_request_from_json(R"({"pass":"whole"})");
    ASSERT_FALSE(revision);
    EXPECT_EQ(describe(revision.error()), "The request is refused. [pass] is unknown; known are "
                                          "target, direction, cycle, reason, by");
    EXPECT_TRUE(
        why_not(R"({"target":1})").starts_with("The request is refused. [target] is unknown"));
}

} // namespace
} // namespace axiscal::arm_request_test
