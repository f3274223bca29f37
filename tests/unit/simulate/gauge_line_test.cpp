// Expected bytes: the makers' manuals (ND 281B page 47; QM-Height 6.2.2; Sylvac opto RS).
#include "wire/gauge_line.hpp"

#include <gtest/gtest.h>

namespace axiscal::simulate::gauge_line_test {
namespace {

TEST(GaugeLine, HeidenhainHasTenPlacesWithBlanksInFront) {
    EXPECT_EQ(heidenhain_record(-5.23), "-    5.2300  = \r\n");
    std::string typed = "\x02";
    EXPECT_EQ(gauge_answer("nd-28x", typed, 0.5), "+    0.5000  = \r\n");
    EXPECT_EQ(typed, "");
}

TEST(GaugeLine, MitutoyoIsThirteenBytesAsPrintedInTheManual) {
    EXPECT_EQ(mitutoyo_record(0.123), "01A+0000.123\r");
    EXPECT_EQ(mitutoyo_record(0.123).size(), 13U);
}

TEST(GaugeLine, SylvacEchoesEachCommand) {
    std::string typed = "?\rSET?\rOU";
    EXPECT_EQ(gauge_answer("sylvac", typed, 12.345),
              "?\r+012.345\rSET?\rMM RES3 REF1 NOR CHA+ B1\r");
    EXPECT_EQ(typed, "OU"); // half a command waits for its end
}

} // namespace
} // namespace axiscal::simulate::gauge_line_test
