// Expected texts: the DS18B20 data sheet's table of temperatures and its power-on scratchpad.
#include "wire/simulated_w1.hpp"

#include <gtest/gtest.h>

namespace axiscal::simulate::w1_face_test {
namespace {

TEST(W1Slave, IsTheScratchpadOfTheDataSheetWithItsCrc) {
    // Power-on: 50 05 .. 1c, as every DS18B20 shows it.
    EXPECT_EQ(w1_slave_text(85), "50 05 4b 46 7f ff 0c 10 1c : crc=1c YES\n"
                                 "50 05 4b 46 7f ff 0c 10 1c t=85000\n");
    EXPECT_TRUE(w1_slave_text(-55).starts_with("90 fc ")); // FC90 hex
    EXPECT_TRUE(w1_slave_text(25.0625).starts_with("91 01 "));
    EXPECT_TRUE(w1_slave_text(25.0625).ends_with(" t=25062\n"));
}

} // namespace
} // namespace axiscal::simulate::w1_face_test
