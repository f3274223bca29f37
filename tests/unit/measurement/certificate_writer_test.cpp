#include "acquisition/measurement/certificate_writer.hpp"

#include "drivers/loop/asio_scheduler.hpp"
#include "tests/support/report_script.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/io_context.hpp>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <optional>

namespace axiscal::testing::certificate_writer_test {
namespace {

class ReportProgram : public ::testing::Test {
protected:
    Result<WrittenCertificate> written(const std::string& program,
                                       std::chrono::milliseconds limit = longest_drawing) {
        boost::asio::io_context loop;
        AsioScheduler scheduler{loop};
        std::optional<Result<WrittenCertificate>> answer;
        boost::asio::co_spawn(
            loop, write_certificate(scheduler, program, "run.axiscal", "outbox", limit),
            [&](std::exception_ptr, Result<WrittenCertificate> got) { answer = std::move(got); });
        loop.run();
        return *answer;
    }
    Result<std::string> answer_of(const std::string& program,
                                  std::chrono::milliseconds limit = longest_drawing) {
        AXISCAL_TRY(const WrittenCertificate certificate, written(program, limit));
        return certificate.entry;
    }
    Result<std::string> said(const std::string& body) {
        return answer_of(report_script(scratch, body));
    }
    ScratchFolder scratch;
};

TEST_F(ReportProgram, ItsLastLineNamesTheEntry) {
    EXPECT_EQ(said(R"(echo noise; echo "{\"entry\":\"$3/$1\"}")"), "outbox/run.axiscal");
}

TEST_F(ReportProgram, ItsFirstLineIsTheVerdictWhereItIsOne) {
    const auto verdict = [&](const std::string& first) {
        const auto certificate = written(
            report_script(scratch, "echo '" + first + "'; echo '{\"entry\":\"outbox/run\"}'"));
        return certificate ? certificate->verdict : describe(certificate.error());
    };
    EXPECT_EQ(verdict(R"({"parameter":"R","value":4.6,"verdict":"fail"})"), "R: fail");
    for (const char* none :
         {"noise", "[]", R"({"parameter":"R"})", R"({"parameter":1,"verdict":"fail"})"})
        EXPECT_EQ(verdict(none), "") << none;
}

TEST_F(ReportProgram, ItsLastLineSaysWhatIsWrongWithTheSetUp) {
    const auto found = [&](const std::string& setup) {
        const auto certificate =
            written(report_script(scratch, "echo '{\"entry\":\"outbox/run\"" + setup + "}'"));
        return certificate ? certificate->setup_findings
                           : std::vector{describe(certificate.error())};
    };
    EXPECT_EQ(found(R"(,"setup":["Set-up: one.",7,"Set-up: two."])"),
              (std::vector<std::string>{"Set-up: one.", "Set-up: two."}));
    for (const char* none : {"", R"(,"setup":[])", R"(,"setup":"one")"})
        EXPECT_TRUE(found(none).empty()) << none;
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

// The program itself hangs; and a child of it, which holds the pipe when it is gone. Where neither
// is killed, this waits for an hour, and ctest ends it.
TEST_F(ReportProgram, HangingIsKilledAtTheLimit) {
    const std::string child = scratch.file("child");
    for (const std::string& body :
         {std::string{"exec sleep 3600"}, "sleep 3600 & echo $! >'" + child + "'; wait"}) {
        const auto answer = answer_of(report_script(scratch, body), std::chrono::milliseconds{300});
        ASSERT_FALSE(answer);
        EXPECT_EQ(answer.error().fault, Fault::io);
        EXPECT_NE(answer.error().detail.find("has not finished after 0.3 s"), std::string::npos)
            << answer.error().detail;
    }
    // It would keep what it inherited of this test for an hour. On a busy computer it may not be
    // there yet when the limit is over.
    if (pid_t left = 0; std::ifstream{child} >> left) ::kill(left, SIGKILL);
}

TEST_F(ReportProgram, HasTwoMinutesInTheDaemon) {
    EXPECT_EQ(longest_drawing, std::chrono::minutes{2});
}

} // namespace
} // namespace axiscal::testing::certificate_writer_test
