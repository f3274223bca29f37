// Expected replies: the layout of the maker's public wrappers.
#include "wire/ids_device.hpp"

#include <gtest/gtest.h>

namespace axiscal::simulate::ids_device_test {
namespace {

using Json = nlohmann::json;

std::string asking(const std::string& method, const std::string& parameters = "[]") {
    return R"({"jsonrpc":"2.0","method":")" + method + R"(","params":)" + parameters +
           R"(,"id":5,"api":2})";
}

Json result(IdsDevice& device, const std::string& method, const IdsReading& now) {
    return Json::parse(device.answer(asking(method, "[0]"), now))["result"];
}

TEST(IdsDevice, AnswersPicometresBehindTheErrorNumber) {
    IdsDevice device;
    IdsReading now;
    now.vacuum_mm[0] = 0.000123456;
    const std::string reply =
        device.answer(asking("com.attocube.ids.displacement.getAxisDisplacement", "[0]"), now);
    EXPECT_TRUE(reply.ends_with("}\r\n"));
    EXPECT_EQ(Json::parse(reply), Json::parse(R"({"jsonrpc":"2.0","result":[0,123456],"id":5})"));
    device.beam = false;
    EXPECT_NE(result(device, "getAxisDisplacement", now)[0], 0);
}

TEST(IdsDevice, DividesByItsIndexWhenItFollowsItsUnit) {
    IdsDevice device;
    device.compensation_mode = 0;
    IdsReading now;
    now.vacuum_mm[0] = 1000.27;
    now.index = 1.00027;
    EXPECT_EQ(result(device, "getAxisDisplacement", now)[1], 1'000'000'000'000);
    EXPECT_EQ(result(device, "getRefractiveIndexForCompensation", now)[1], 1.00027);
}

TEST(IdsDevice, TellsItsContrastInPermilleBeforeTheBaseline) {
    IdsDevice device;
    IdsReading now;
    now.contrast_percent = 41.37;
    const Json told = result(device, "getAxisSignalQuality", now);
    EXPECT_EQ(told[0], 0);
    EXPECT_EQ(told[1], 414);
    device.beam = false;
    EXPECT_LT(result(device, "getAxisSignalQuality", now)[1], 10);
}

TEST(IdsDevice, KnowsNoOtherMethodsAndNoOtherLayout) {
    IdsDevice device;
    EXPECT_EQ(Json::parse(device.answer(asking("com.attocube.ids.nothing"), {}))["error"]["code"],
              -32601);
    EXPECT_TRUE(
        Json::parse(device.answer(R"({"method":"getCurrentMode","id":1})", {})).contains("error"));
}

TEST(IdsDevice, TakesRequestsWithoutTerminator) {
    std::string pending = R"({"a":{"b":1}}{"c":2})"
                          "\n{\"d\"";
    const auto requests = take_requests(pending);
    ASSERT_EQ(requests.size(), 2U);
    EXPECT_EQ(requests[0], R"({"a":{"b":1}})");
    EXPECT_EQ(pending, "\n{\"d\"");
}

} // namespace
} // namespace axiscal::simulate::ids_device_test
