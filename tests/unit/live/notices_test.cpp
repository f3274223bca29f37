#include "acquisition/live/notices.hpp"

#include "drivers/loop/virtual_scheduler.hpp"

#include <gtest/gtest.h>

namespace axiscal::notices_test {
namespace {

struct Board {
    VirtualScheduler scheduler;
    Doorbell bell{scheduler.executor()};
    Notices notices{scheduler, bell};
    /// The last one without its time.
    [[nodiscard]] std::string newest() const {
        const std::string& last = notices.last().back();
        return last.substr(last.find(' ') + 1);
    }
};

TEST(Notices, KeepsTheLastTwentyWithTheirTimes) {
    Board board;
    for (int i = 1; i <= 25; ++i)
        board.notices.note("sentence " + std::to_string(i));
    ASSERT_EQ(board.notices.last().size(), 20U);
    EXPECT_EQ(board.notices.last().front(),
              iso8601_utc(board.scheduler.clock_tie().utc_ns) + " sentence 6");
    EXPECT_EQ(board.newest(), "sentence 25");
}

TEST(Notices, SaysTheSameOfThePortAgainOnlyAfterItWorked) {
    Board board;
    board.notices.note_port(Fault::io, "192.168.1.1:502 is taken");
    const std::string said = board.notices.port();
    EXPECT_NE(said.find("192.168.1.1:502 is taken"), std::string::npos);
    EXPECT_EQ(board.newest(), "Trigger port: " + said);
    board.notices.note_port(Fault::io, "192.168.1.1:502 is taken");
    EXPECT_EQ(board.notices.last().size(), 1U);
    board.notices.port_works();
    EXPECT_EQ(board.notices.port(), "");
    board.notices.note_port(Fault::io, "192.168.1.1:502 is taken");
    EXPECT_EQ(board.notices.last().size(), 2U);
}

TEST(Notices, SaysARefusalThatRepeatsItselfOnce) {
    Board board;
    const Error why{Fault::not_still, "the axis moves", {}, {}};
    for (int i = 0; i < 200; ++i)
        board.notices.note_refusal(7, why);
    EXPECT_EQ(board.notices.last().size(), 1U);
    EXPECT_EQ(board.newest(), "Request 7 is refused: " + describe(why));
    board.notices.note_refusal(8, why);
    EXPECT_EQ(board.notices.last().size(), 2U);
    board.notices.nothing_refused();
    board.notices.note_refusal(8, why);
    EXPECT_EQ(board.notices.last().size(), 3U);
}

TEST(Notices, MakesWhatAClientSentPrintable) {
    Board board;
    board.notices.note("a client said \xff\xfe");
    EXPECT_EQ(board.newest().find('\xff'), std::string::npos);
}

} // namespace
} // namespace axiscal::notices_test
