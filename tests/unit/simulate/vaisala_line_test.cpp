// Expected messages: the user's guide's default reply; checksums computed by hand from their
// definition.
#include "wire/vaisala_line.hpp"

#include <gtest/gtest.h>

namespace axiscal::simulate::vaisala_line_test {
namespace {

const VaisalaAir air{1013.2, 31.1, 38.3};

TEST(VaisalaLine, SendsTheReplyOfTheUsersGuide) {
    VaisalaTransmitter transmitter;
    std::string typed = "send\r";
    EXPECT_EQ(transmitter.answer(typed, air), "send\r\nP=1013.2 hPa T= 31.1 'C RH= 38.3 %RH\r\n>");
}

TEST(VaisalaLine, FormatsAsFormTellsItWithTheChecksumOfTheMessageSoFar) {
    EXPECT_EQ(vaisala_message(R"("P= 1013.2 hPa T= 31.1 'C RH= 38.3 %RH" CSX \r \n)", air),
              "P= 1013.2 hPa T= 31.1 'C RH= 38.3 %RH35\r\n");
    EXPECT_EQ(vaisala_message(R"("P= 1013.2 hPa T= 31.1 'C RH= 38.3 %RH" CS4)", air),
              "P= 1013.2 hPa T= 31.1 'C RH= 38.3 %RH07EB");
    EXPECT_EQ(vaisala_message(R"(6.2 "P=" P " " U6 "|")", air), "P=  1013.20 hPa   |");
}

TEST(VaisalaLine, TakesANewFormatAndWaitsForTheEndOfACommand) {
    VaisalaTransmitter transmitter;
    std::string typed = "form 3.1 T U3\rse";
    EXPECT_EQ(transmitter.answer(typed, air), "form 3.1 T U3\r\nOK\r\n>");
    typed += "nd\r";
    EXPECT_EQ(transmitter.answer(typed, air), "send\r\n 31.1'C >");
}

} // namespace
} // namespace axiscal::simulate::vaisala_line_test
