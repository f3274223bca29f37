#include "acquisition/measurement/certificates.hpp"

#include "acquisition/live/notices.hpp"
#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/loop/doorbell.hpp"
#include "tests/support/report_script.hpp"
#include "tests/support/scratch_folder.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/io_context.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <exception>
#include <optional>
#include <string>
#include <vector>

namespace axiscal::testing::certificates_test {
namespace {

class CertificatesOfRuns : public ::testing::Test {
protected:
    Result<std::string> made_by(const std::string& body) {
        Certificates certificates{scheduler, notices, report_script(scratch, body), "outbox"};
        std::optional<Result<std::string>> answer;
        boost::asio::co_spawn(
            loop, certificates.make("run-1", "run-1.axiscal"),
            [&answer](std::exception_ptr, Result<std::string> got) { answer = std::move(got); });
        loop.restart();
        loop.run();
        unanswered = certificates.unanswered_of("run-1");
        EXPECT_TRUE(certificates.unanswered_of("another run").empty());
        return *answer;
    }
    [[nodiscard]] bool told(const std::string& words) const {
        return std::ranges::any_of(notices.last(), [&](const std::string& sentence) {
            return sentence.find(words) != std::string::npos;
        });
    }
    std::vector<OpenFinding> unanswered;
    ScratchFolder scratch;
    boost::asio::io_context loop;
    AsioScheduler scheduler{loop};
    Doorbell bell{scheduler.executor()};
    Notices notices{scheduler, bell};
};

TEST_F(CertificatesOfRuns, AreToldWithVerdictAndFindings) {
    const auto entry = made_by(R"(echo '{"parameter":"R","verdict":"fail"}'
echo "{\"entry\":\"$3/run-1\",\"setup\":[\"Set-up: one.\"]}")");
    EXPECT_EQ(entry, "outbox/run-1");
    EXPECT_TRUE(told("Verdict on R: fail. Certificate written: outbox/run-1"));
    EXPECT_TRUE(told("Set-up: one."));
}

TEST_F(CertificatesOfRuns, KeepWhatNobodyAnsweredAndLeaveOutWhatHasNoName) {
    ASSERT_TRUE(made_by(R"(echo "{\"entry\":\"$3/run-1\",\"to_answer\":[7,{\"seen\":\"x\"},\
{\"error\":\"growth\",\"seen\":\"It grows.\",\"probably\":\"It is cold.\",\"look_at\":7}]}")"));
    ASSERT_EQ(unanswered.size(), 1U);
    EXPECT_EQ(unanswered[0].error, "growth");
    EXPECT_EQ(unanswered[0].seen, "It grows.");
    EXPECT_EQ(unanswered[0].look_at, "");
}

TEST_F(CertificatesOfRuns, ThatCannotBeMadeAreToldWithTheWayOut) {
    const auto entry = made_by("echo 'no font'; exit 3");
    ASSERT_FALSE(entry);
    EXPECT_NE(entry.error().detail.find("no font"), std::string::npos);
    EXPECT_TRUE(told("No certificate for run run-1: "));
    EXPECT_TRUE(told("'axiscal export run-1.axiscal' tries again."));
}

} // namespace
} // namespace axiscal::testing::certificates_test
