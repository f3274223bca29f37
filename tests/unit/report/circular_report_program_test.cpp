// The program as the daemon starts it for a circular test: a closed run file in, an outbox entry
// out.

#include "acquisition/runfile/digest.hpp"
#include "pdf_tools.hpp"
#include "tests/unit/documents/written_circle.hpp"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <sys/wait.h>

namespace axiscal::circular_report_program_test {
namespace {

using testing::read_bytes;
using testing::ScratchFolder;

class CircularReportProgram : public ::testing::Test {
protected:
    /// The line that the program prints.
    nlohmann::json start(const std::string& arguments) {
        const std::string command =
            "'" AXISCAL_REPORT_PROGRAM "' " + arguments + " >'" + folder_.file("out") + "'";
        const int status = std::system(command.c_str());
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
        return nlohmann::json::parse(read_bytes(folder_.file("out")), nullptr, false);
    }
    ScratchFolder folder_;
};

TEST_F(CircularReportProgram, StagesTheCertificateOfACircularRun) {
    test::DrivenBar bar = test::bar_of_the_shop();
    const std::string run = test::write_circles(folder_, bar, bar.drive());
    const auto staged = start(run + " --outbox " + folder_.file("outbox"));
    ASSERT_TRUE(staged.is_object());
    EXPECT_EQ(staged.at("entry"), folder_.file("outbox/bay3-circle"));
    const auto document = nlohmann::json::parse(read_bytes(staged.at("json")));
    EXPECT_EQ(document.at("standard"), "ISO 230-4");
    EXPECT_EQ(document.at("run").at("run_file_sha256"),
              sha256_of_file(staged.at("run_file")).value());
    EXPECT_EQ(document.at("run").at("result_digest"), read_stored_result(run)->digest);
    const std::string words = test::text_of(staged.at("pdf"));
    for (const char* told : {"Calibration certificate", "Milling shop", "arc of 220", "QB-7"})
        EXPECT_NE(words.find(told), std::string::npos) << told;
    const auto again = start(run + " --to " + folder_.file("again"));
    ASSERT_TRUE(again.is_object());
    for (const char* key : {"json", "csv", "pdf"})
        EXPECT_TRUE(read_bytes(staged.at(key)) == read_bytes(again.at(key))) << key;
}

} // namespace
} // namespace axiscal::circular_report_program_test
