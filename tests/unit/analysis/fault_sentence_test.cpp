// What a fault is told as: its sentence, and what goes on from there.
#include "analysis/quantity/result.hpp"

#include <gtest/gtest.h>

namespace axiscal::fault_sentence_test {
namespace {

TEST(FaultSentence, GoesOnAfterAColonInADetailThatBeginsSmall) {
    EXPECT_EQ(describe({Fault::refused, "the code is wrong; 4 tries left", {}, {}}),
              "This is not allowed here: the code is wrong; 4 tries left");
    EXPECT_EQ(describe({Fault::refused, "Nobody may.", {}, {}}),
              "This is not allowed here. Nobody may.");
}

TEST(FaultSentence, HasOneColonAtMost) {
    EXPECT_EQ(describe({Fault::checksum, "Line 3.", {}, {}}),
              "The instrument's message arrived damaged: check cable and baud rate. Line 3.");
    EXPECT_EQ(describe({Fault::bad_request, "is not JSON", {}, "body"}),
              "The request is refused. [body] is not JSON");
}

} // namespace
} // namespace axiscal::fault_sentence_test
