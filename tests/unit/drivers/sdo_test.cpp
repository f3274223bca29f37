// Literal frames of CANopen's service data objects: CiA 301, 7.2.4, and the makers' tables.
#include "drivers/canopen/sdo.hpp"

#include <gtest/gtest.h>

namespace axiscal::sdo_test {
namespace {

using Step = SdoTransfer::Step;

std::string text_of(const std::vector<std::byte>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
std::vector<std::byte> bytes(std::initializer_list<unsigned> numbers) {
    const CanFrame frame = plain_frame(0, numbers);
    return {frame.bytes().begin(), frame.bytes().end()};
}
CanFrame reply(std::initializer_list<unsigned> numbers, std::uint32_t id = 0x5FD) {
    return plain_frame(id, numbers);
}

TEST(Sdo, AsksForAnObject) {
    EXPECT_EQ(SdoTransfer::read(125, {0x1A00, 2}).request(),
              plain_frame(0x67D, {0x40, 0x00, 0x1A, 0x02, 0, 0, 0, 0}));
}

TEST(Sdo, TakesFourTwoAndOneByteInOneFrame) {
    auto type = SdoTransfer::read(125, {0x1000, 0});
    EXPECT_EQ(type.take(reply({0x43, 0x00, 0x10, 0x00, 0x94, 0x01, 0x02, 0x00})), Step::done);
    EXPECT_EQ(type.content(), bytes({0x94, 0x01, 0x02, 0x00}));
    auto beat = SdoTransfer::read(125, {0x1017, 0});
    EXPECT_EQ(beat.take(reply({0x4B, 0x17, 0x10, 0x00, 0xE8, 0x03, 0, 0})), Step::done);
    EXPECT_EQ(beat.content(), bytes({0xE8, 0x03}));
    auto digits = SdoTransfer::read(125, {0x6132, 1});
    EXPECT_EQ(digits.take(reply({0x4F, 0x32, 0x61, 0x01, 0x02, 0, 0, 0})), Step::done);
    EXPECT_EQ(digits.content(), bytes({0x02}));
    auto unsized = SdoTransfer::read(125, {0x1000, 0}); // the size is not told: all four
    EXPECT_EQ(unsized.take(reply({0x42, 0x00, 0x10, 0x00, 1, 2, 3, 4})), Step::done);
    EXPECT_EQ(unsized.content(), bytes({1, 2, 3, 4}));
}

TEST(Sdo, TakesALongObjectInSegments) {
    auto name = SdoTransfer::read(125, {0x1008, 0});
    EXPECT_EQ(name.take(reply({0x41, 0x08, 0x10, 0x00, 0x0A, 0, 0, 0})), Step::more);
    EXPECT_EQ(name.request(), plain_frame(0x67D, {0x60, 0, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(name.take(reply({0x00, 'C', 'A', 'N', 't', 'r', 'a', 'n'})), Step::more);
    EXPECT_EQ(name.request(), plain_frame(0x67D, {0x70, 0, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(name.take(reply({0x19, 's', ' ', 'T', 0, 0, 0, 0})), Step::done);
    EXPECT_EQ(text_of(name.content()), "CANtrans T");
}

TEST(Sdo, RefusesSegmentsOutOfOrderAndOfAnotherLength) {
    const auto begun = [] {
        auto name = SdoTransfer::read(125, {0x1008, 0});
        EXPECT_EQ(name.take(reply({0x41, 0x08, 0x10, 0x00, 0x0A, 0, 0, 0})), Step::more);
        return name;
    };
    auto toggled = begun();
    EXPECT_EQ(toggled.take(reply({0x10, 1, 2, 3, 4, 5, 6, 7})).error().fault, Fault::bad_frame);
    auto cut = begun();
    EXPECT_EQ(cut.take(reply({0x01, 1, 2, 3, 4, 5, 6, 7})).error().fault, Fault::bad_frame);
    auto endless = SdoTransfer::read(125, {0x1008, 0});
    EXPECT_EQ(endless.take(reply({0x41, 0x08, 0x10, 0x00, 0, 0, 0, 0x80})).error().fault,
              Fault::bad_frame);
    auto long_one = SdoTransfer::read(125, {0x1008, 0}); // tells no length and never ends
    EXPECT_EQ(long_one.take(reply({0x40, 0x08, 0x10, 0x00, 0, 0, 0, 0})), Step::more);
    Result<Step> step = Step::more;
    for (unsigned i = 0; step && i < 1000; ++i)
        step = long_one.take(reply({i % 2 << 4U, 1, 2, 3, 4, 5, 6, 7}));
    ASSERT_FALSE(step);
    EXPECT_EQ(step.error().fault, Fault::bad_frame);
}

TEST(Sdo, WritesOneTwoAndFourBytes) {
    EXPECT_EQ(SdoTransfer::write(127, {0x1800, 2}, 0xFE, 1).request(),
              plain_frame(0x67F, {0x2F, 0x00, 0x18, 0x02, 0xFE, 0, 0, 0}));
    EXPECT_EQ(SdoTransfer::write(127, {0x1017, 0}, 1000, 2).request(),
              plain_frame(0x67F, {0x2B, 0x17, 0x10, 0x00, 0xE8, 0x03, 0, 0}));
    // "save", as the manuals print it
    auto save = SdoTransfer::write(127, {0x1010, 1}, 0x65766173, 4);
    EXPECT_EQ(save.request(), plain_frame(0x67F, {0x23, 0x10, 0x10, 0x01, 0x73, 0x61, 0x76, 0x65}));
    EXPECT_EQ(save.take(reply({0x60, 0x10, 0x10, 0x01, 0, 0, 0, 0}, 0x5FF)), Step::done);
}

TEST(Sdo, TellsWhyTheNodeRefuses) {
    auto transfer = SdoTransfer::read(125, {0x1804, 1});
    const auto step = transfer.take(reply({0x80, 0x04, 0x18, 0x01, 0x00, 0x00, 0x02, 0x06}));
    ASSERT_FALSE(step);
    EXPECT_EQ(step.error().fault, Fault::refused);
    EXPECT_EQ(step.error().detail, "node 125 refuses 0x1804:01: no such object (0x06020000)");
}

TEST(Sdo, PassesOverWhatIsNoAnswerToItsQuestion) {
    auto transfer = SdoTransfer::read(125, {0x1000, 0});
    CanFrame remote = reply({0x43, 0x00, 0x10, 0x00, 1, 2, 3, 4});
    remote.remote = true;
    CanFrame extended = reply({0x43, 0x00, 0x10, 0x00, 1, 2, 3, 4});
    extended.extended = true;
    for (const CanFrame& frame :
         {reply({0x43, 0x00, 0x10, 0x00, 1, 2, 3, 4}, 0x5FF), // another node
          reply({0x43, 0x18, 0x10, 0x01, 1, 2, 3, 4}),        // another object
          reply({0x80, 0x18, 0x10, 0x01, 0, 0, 2, 6}),        // another object is refused
          plain_frame(0x1FD, {1, 2, 3, 4, 5}), remote, extended})
        EXPECT_EQ(transfer.take(frame), Step::ignored);
}

TEST(Sdo, RefusesAnswersThatCannotBeOne) {
    for (const CanFrame& frame : {reply({0x43, 0x00, 0x10, 0x00, 1, 2, 3}),       // seven bytes
                                  reply({0x60, 0x00, 0x10, 0x00, 0, 0, 0, 0}),    // to a write
                                  reply({0xC0, 0x00, 0x10, 0x00, 0, 0, 0, 0})}) { // block transfer
        auto transfer = SdoTransfer::read(125, {0x1000, 0});
        const auto step = transfer.take(frame);
        ASSERT_FALSE(step);
        EXPECT_EQ(step.error().fault, Fault::bad_frame);
    }
    auto write = SdoTransfer::write(125, {0x1017, 0}, 1000, 2);
    EXPECT_FALSE(write.take(reply({0x4B, 0x17, 0x10, 0x00, 0, 0, 0, 0})));
}

} // namespace
} // namespace axiscal::sdo_test
