// A run's id, which is a file, a folder and a share's name, of whatever people call their things.
#include "acquisition/measurement/run_header.hpp"

#include "acquisition/runfile/run_store.hpp"
#include "analysis/quantity/valid_text.hpp"
#include "tests/support/scratch_folder.hpp"

#include <algorithm>
#include <cctype>
#include <gtest/gtest.h>
#include <random>

namespace axiscal::run_header_test {
namespace {

constexpr std::int64_t ten_o_clock_ns = 1'795'255'200'000'000'000; // 2026-11-21T10:00:00Z

TEST(RunId, OfUsualNamesIsStationInstantAndAxis) {
    EXPECT_EQ(run_id_of("bench", "X", ten_o_clock_ns), "bench-20261121T100000Z-X");
    EXPECT_EQ(run_id_of("bay 3", "X", ten_o_clock_ns), "bay-3-20261121T100000Z-X");
    EXPECT_EQ(run_id_of("../../out", "C/1", ten_o_clock_ns), "out-20261121T100000Z-C-1");
    EXPECT_EQ(run_id_of("", "Ω", ten_o_clock_ns), "station-20261121T100000Z-axis");
}

// The store finds the newest run by the last instant in a name: an axis may not bear another one.
TEST(RunId, IsAPlainNameWhoseLastInstantIsTheRuns) {
    std::mt19937 dice{20261121};
    const std::string instant = instant_in_name(ten_o_clock_ns);
    for (int i = 0; i < 20'000; ++i) {
        std::string names[2];
        for (std::string& name : names) {
            name.resize(dice() % 70);
            for (char& byte : name)
                byte = static_cast<char>(dice() % 256);
        }
        if (dice() % 4 == 0) names[1] = "20991231T235959Z";
        const int nth = 1 + static_cast<int>(dice() % 1000);
        const std::string id = run_id_of(names[0], names[1], ten_o_clock_ns, nth);
        ASSERT_TRUE(std::ranges::all_of(id, [](unsigned char c) {
            return c < 0x80 && (std::isalnum(c) != 0 || c == '_' || c == '-');
        })) << id;
        ASSERT_NE(id.front(), '-');
        ASSERT_LE(id.size() + std::string_view{"-drift"}.size(), longest_run_id);
        ASSERT_NE(id.find(instant), std::string::npos) << id;
        const std::string behind = id.substr(id.find(instant) + instant.size());
        std::size_t longest = 0;
        for (std::size_t at = 0; at < behind.size(); at = behind.find('-', at + 1))
            longest = std::max(longest, std::min(behind.find('-', at + 1), behind.size()) - at - 1);
        ASSERT_LT(longest, instant.size()) << id;
    }
}

TEST(RunId, OfTheSameSecondIsCountedOnPastWhatIsStored) {
    const testing::ScratchFolder scratch;
    StationConfig config;
    config.station = "bench";
    config.state_directory = scratch.path();
    const auto next = [&](const std::string& ending = "") {
        return free_run_id(config, "X", ten_o_clock_ns, ending);
    };
    EXPECT_EQ(next(), "bench-20261121T100000Z-X") << "without any folder";
    for (const char* folder : {"runs", "outbox", "published"})
        std::filesystem::create_directories(scratch.file(folder));
    std::ofstream{scratch.file("runs/" + next() + ".axiscal")};
    EXPECT_EQ(next(), "bench-20261121T100000Z-2-X");
    std::filesystem::create_directory(scratch.file("outbox/" + next()));
    EXPECT_EQ(next(), "bench-20261121T100000Z-3-X");
    std::filesystem::create_directory(scratch.file("outbox/." + next() + ".staging"));
    std::filesystem::create_directory(scratch.file("published/bench-20261121T100000Z-4-X"));
    EXPECT_EQ(next(), "bench-20261121T100000Z-5-X");
    EXPECT_EQ(next("-drift"), "bench-20261121T100000Z-X-drift");
}

} // namespace
} // namespace axiscal::run_header_test
