#include "acquisition/station/certificate_writer.hpp"

#include "drivers/asio_scheduler.hpp"
#include "tests/unit/station/report_script.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/io_context.hpp>
#include <gtest/gtest.h>

#include <optional>

namespace axiscal::testing {
namespace {

class ReportProgram : public ::testing::Test {
protected:
    Result<std::string> answer_of(const std::string& program) {
        boost::asio::io_context loop;
        AsioScheduler scheduler{loop};
        std::optional<Result<std::string>> answer;
        boost::asio::co_spawn(
            loop, write_certificate(scheduler, program, "run.axiscal", "outbox"),
            [&](std::exception_ptr, Result<std::string> got) { answer = std::move(got); });
        loop.run();
        return *answer;
    }
    Result<std::string> said(const std::string& body) {
        return answer_of(report_script(scratch, body));
    }
    ScratchFolder scratch;
};

TEST_F(ReportProgram, ItsLastLineNamesTheEntry) {
    EXPECT_EQ(said(R"(echo noise; echo "{\"entry\":\"$3/$1\"}")"), "outbox/run.axiscal");
}

TEST_F(ReportProgram, FailsWithItsOwnLastWords) {
    const auto answer = said("echo early >&2; echo 'no font' >&2; exit 3");
    ASSERT_FALSE(answer);
    EXPECT_NE(answer.error().detail.find("no font"), std::string::npos);
}

TEST_F(ReportProgram, KilledIsAFailure) {
    EXPECT_FALSE(said(R"(echo "{\"entry\":\"x\"}"; kill -9 $$)"));
}

TEST_F(ReportProgram, SayingSomethingElseIsAFailure) {
    for (const char* words :
         {"echo done", "echo '[]'", "echo '{}'", "echo '{\"entry\":3}'", "true"})
        EXPECT_FALSE(said(words)) << words;
}

TEST_F(ReportProgram, MissingIsToldByName) {
    const auto answer = answer_of(scratch.file("nothing-here"));
    ASSERT_FALSE(answer);
    EXPECT_NE(answer.error().detail.find("nothing-here"), std::string::npos);
}

TEST_F(ReportProgram, TalkingWithoutEndIsEnded) {
    EXPECT_FALSE(said("yes"));
}

} // namespace
} // namespace axiscal::testing
