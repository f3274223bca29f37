// termios(3): "\377 \0 X" of a byte X with a wrong parity or a broken frame, "\377 \377" of a good
// FF.
#include "drivers/wire/parity_marks.hpp"

#include "drivers/framing/byte_order.hpp"
#include "drivers/wire/serial_link.hpp"
#include "tests/support/pty_pair.hpp"

#include <gtest/gtest.h>
#include <termios.h>
#include <unistd.h>

namespace axiscal::parity_marks_test {
namespace {

TEST(ParityMarks, LeaveGoodBytesAlone) {
    ParityMarks marks;
    EXPECT_EQ(marks.undo(bytes_of({'-', '5', 0, 0xFE, '\n'})), bytes_of({'-', '5', 0, 0xFE, '\n'}));
    EXPECT_EQ(marks.undo(bytes_of({1, 0xFF, 0xFF, 2})), bytes_of({1, 0xFF, 2}));
}

TEST(ParityMarks, SpoilAByteThatCameWrong) {
    ParityMarks marks;
    EXPECT_EQ(marks.undo(bytes_of({'1', 0xFF, 0, '2', '3'})), bytes_of({'1', 0xFF, '3'}));
    EXPECT_EQ(marks.undo(bytes_of({0xFF, 0, 0xFF, '3'})), bytes_of({0xFF, '3'}));
    EXPECT_EQ(marks.undo(bytes_of({0xFF, 0, 0, '3'})), bytes_of({0xFF, '3'})); // a break
}

TEST(ParityMarks, MayBeCutAnywhere) {
    const auto marked = bytes_of({'1', 0xFF, 0, '2', 0xFF, 0xFF, '3', 0xFF, 0, '\n', 'x'});
    const auto whole = ParityMarks{}.undo(marked);
    EXPECT_EQ(whole, bytes_of({'1', 0xFF, 0xFF, '3', 0xFF, 'x'}));
    for (std::size_t cut = 0; cut <= marked.size(); ++cut) {
        ParityMarks marks;
        auto got = marks.undo(std::span{marked}.first(cut));
        const auto rest = marks.undo(std::span{marked}.subspan(cut));
        got.insert(got.end(), rest.begin(), rest.end());
        EXPECT_EQ(got, whole) << cut;
    }
}

// A pty has no parity bits: what can be seen of it is what was asked for.
TEST(SerialLine, ChecksItsParityWhereItHasOne) {
    for (const char parity : {'N', 'E', 'O'}) {
        testing::PtyPair pty;
        LinkSettings settings;
        settings.path = pty.path;
        settings.data_bits = 7;
        settings.parity = parity;
        const int tty = open_tty(settings).value();
        termios line{};
        ASSERT_EQ(::tcgetattr(tty, &line), 0);
        EXPECT_EQ((line.c_iflag & INPCK) != 0, parity != 'N');
        EXPECT_EQ((line.c_iflag & PARMRK) != 0, parity != 'N');
        EXPECT_EQ(line.c_iflag & (IGNPAR | ISTRIP), 0U);
        ::close(tty);
    }
}

} // namespace
} // namespace axiscal::parity_marks_test
