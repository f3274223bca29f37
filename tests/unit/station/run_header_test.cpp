// A run's id, which is a file, a folder and a share's name, of whatever people call their things.
#include "acquisition/station/run_header.hpp"

#include "acquisition/journal/run_store.hpp"
#include "analysis/quantity/valid_text.hpp"

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
        const std::string id = run_id_of(names[0], names[1], ten_o_clock_ns);
        ASSERT_TRUE(std::ranges::all_of(id, [](unsigned char c) {
            return c < 0x80 && (std::isalnum(c) != 0 || c == '_' || c == '-');
        })) << id;
        ASSERT_NE(id.front(), '-');
        ASSERT_LE(id.size() + std::string_view{"-drift"}.size(), longest_run_id);
        ASSERT_NE(id.find(instant), std::string::npos) << id;
        ASSERT_LT(id.size() - id.find(instant) - instant.size(), instant.size() + 1) << id;
    }
}

} // namespace
} // namespace axiscal::run_header_test
