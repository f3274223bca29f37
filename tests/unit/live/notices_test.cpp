#include "acquisition/live/notices.hpp"

#include "drivers/loop/virtual_scheduler.hpp"

#include <gtest/gtest.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

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

/// Of each line that is logged while it lives, what it is about.
class Log {
public:
    Log()
        : before_{spdlog::default_logger()} {
        spdlog::set_default_logger(std::make_shared<spdlog::logger>("notices", sink_));
    }
    ~Log() { spdlog::set_default_logger(before_); }
    Log(const Log&) = delete;
    Log& operator=(const Log&) = delete;
    [[nodiscard]] LogFacts last() const { return sink_->seen.back(); }

private:
    struct Sink final : spdlog::sinks::base_sink<std::mutex> {
        void sink_it_(const spdlog::details::log_msg& /*message*/) override {
            seen.push_back(LogAbout::of_this_thread());
        }
        void flush_() override {}
        std::vector<LogFacts> seen;
    };
    std::shared_ptr<Sink> sink_ = std::make_shared<Sink>();
    std::shared_ptr<spdlog::logger> before_;
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

TEST(Notices, TellTheLogTheFaultAndTheInstrumentOfASentenceAndNothingOfTheNextLine) {
    const Log log;
    Board board;
    board.notices.note("laser: no beam", {Fault::beam_lost, {}, "laser"});
    EXPECT_EQ(log.last().fault, Fault::beam_lost);
    EXPECT_EQ(log.last().instrument, "laser");
    EXPECT_EQ(log.last().run, "");
    spdlog::info("another word");
    EXPECT_FALSE(log.last().any());
    board.notices.note_refusal(7, Error{Fault::not_still, "the axis moves", {}, {}});
    EXPECT_EQ(log.last().fault, Fault::not_still);
    board.notices.note_port(Fault::io, "192.168.1.1:502 is taken");
    EXPECT_EQ(log.last().fault, Fault::io);
}

TEST(Notices, TellTheLogTheRunThatIsOpenUnlessTheSentenceIsAboutAnother) {
    const Log log;
    Board board;
    std::string open = "run-1";
    board.notices.ask_for_run([&open] { return open; });
    board.notices.note("a point");
    EXPECT_EQ(log.last().run, "run-1");
    board.notices.note("a certificate", {Fault::none, "run-0"});
    EXPECT_EQ(log.last().run, "run-0");
    open.clear();
    board.notices.note("rest");
    EXPECT_EQ(log.last().run, "");
}

} // namespace
} // namespace axiscal::notices_test
