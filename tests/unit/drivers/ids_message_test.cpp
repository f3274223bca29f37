// Literal messages in the layout of the maker's public wrappers.
#include "drivers/laser/ids_message.hpp"
#include "tests/support/made_instrument.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace axiscal::ids_message_test {
namespace {

TEST(IdsMessage, AsksAsTheMakersProgramsDo) {
    EXPECT_EQ(ids_request("com.attocube.ids.displacement.getAxesDisplacement", {}, 1),
              R"({"jsonrpc":"2.0","method":"com.attocube.ids.displacement.getAxesDisplacement",)"
              R"("params":[],"id":1,"api":2})"
              "\n");
    EXPECT_NE(ids_request("m", {-1}, 7).find(R"("params":[-1],"id":7)"), std::string::npos);
}

TEST(IdsMessage, ReadsPicometresAndTheErrorNumberBeforeThem) {
    const auto reply = parse_ids_reply(R"({"jsonrpc":"2.0","result":[0,123456,-42,0],"id":1})");
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->id, 1);
    EXPECT_EQ(reply->error_number, 0);
    EXPECT_EQ(whole_number_of(*reply, 0), 123456);
    EXPECT_EQ(whole_number_of(*reply, 1), -42);
    EXPECT_EQ(whole_number_of(*reply, 3), std::nullopt);
}

TEST(IdsMessage, KeepsEveryPicometreOfFiveMetres) {
    // 5 m are 5e12 pm; a float would lose the last digits.
    const auto reply = parse_ids_reply(R"({"result":[0,5000000000001],"id":1})");
    EXPECT_EQ(whole_number_of(reply.value(), 0), 5000000000001);
}

TEST(IdsMessage, TellsARefusalFromNonsense) {
    const auto unknown =
        parse_ids_reply(R"({"id":1,"error":{"code":-32601,"message":"Method not found"}})");
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().fault, Fault::refused);
    EXPECT_NE(unknown.error().detail.find("Method not found"), std::string::npos);
    for (const char* line :
         {"", "{", "[]", "null", R"({"result":[0]})", R"({"id":"1","result":[0]})",
          R"({"id":1,"result":0})", R"({"id":1,"result":[]})", R"({"id":1,"result":["0"]})",
          R"({"id":1,"result":[0,[1]]})", R"({"id":1,"result":[0,null]})", R"({"id":1})"})
        EXPECT_EQ(parse_ids_reply(line).error().fault, Fault::bad_frame) << line;
}

TEST(IdsMessage, TakesANumberForASerialNumberToo) {
    EXPECT_EQ(text_of(parse_ids_reply(R"({"id":1,"result":[0,4711]})").value(), 0), "4711");
    EXPECT_EQ(text_of(parse_ids_reply(R"({"id":1,"result":[0]})").value(), 0), "");
}

TEST(IdsAir, IsLeftToThisProgramOrRefused) {
    const double air = 1.000271345;
    EXPECT_EQ(correction_of_its_own({2, 1.0, true}), "");
    EXPECT_EQ(correction_of_its_own({0, 1.0, false}), "");
    // Corrected twice:
    EXPECT_NE(correction_of_its_own({0, air, true}).find("1.000271345"), std::string::npos);
    EXPECT_NE(correction_of_its_own({1, air, false}), "");
    EXPECT_NE(correction_of_its_own({2, air, false}), "");
    EXPECT_NE(correction_of_its_own({0, 1.0, true}), ""); // soon
    EXPECT_NE(correction_of_its_own({2, std::nan(""), false}), "");
}

TEST(Ids, WantsItStatedWhoCorrectsForAir) {
    const std::string keys =
        "link = \"tcp:127.0.0.1:9090\"\nfastest = \"1 m/s\"\nwavelength = \"1530 nm\"\n";
    const auto here = testing::instrument("ids3010", keys + "air = \"corrected here\"\n");
    ASSERT_TRUE(here->optics());
    EXPECT_DOUBLE_EQ(here->optics()->vacuum_wavelength.in(nm), 1530);
    for (const std::string air : {"", "air = \"corrected by the device\"\n"}) {
        const auto made = testing::make_instrument("ids3010", keys + air);
        ASSERT_EQ(made.refusals.size(), 1U) << air;
        EXPECT_EQ(made.refusals[0].key, "air");
    }
}

} // namespace
} // namespace axiscal::ids_message_test
