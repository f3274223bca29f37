#include "drivers/framing/checksum.hpp"
#include "drivers/framing/line_framer.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace axiscal::framing_test {
namespace {

struct Fed {
    std::vector<std::string> lines;
    std::uint64_t oversized = 0;
    bool operator==(const Fed&) const = default;
};
Fed feed(LineFramer& framer, std::string_view text) {
    Fed fed;
    fed.oversized = framer.feed(std::as_bytes(std::span{text}),
                                [&](std::string_view line) { fed.lines.emplace_back(line); });
    return fed;
}
std::vector<std::string> lines_of(LineFramer& framer, std::string_view text) {
    return feed(framer, text).lines;
}

TEST(LineFramer, SplitsAtLineFeedAndDropsTheReturn) {
    LineFramer framer{80};
    EXPECT_EQ(lines_of(framer, "one\r\ntwo\nthr"), (std::vector<std::string>{"one", "two"}));
    EXPECT_EQ(lines_of(framer, "ee\r"), (std::vector<std::string>{}));
    EXPECT_EQ(lines_of(framer, "\n"), (std::vector<std::string>{"three"}));
}

TEST(LineFramer, DropsTheLineItWasOpenedIn) {
    LineFramer framer{80, true};
    EXPECT_EQ(lines_of(framer, "38 0 0 5 0 0"), (std::vector<std::string>{}));
    EXPECT_EQ(lines_of(framer, " 1\r\nwhole\r\n"), (std::vector<std::string>{"whole"}));
}

TEST(LineFramer, DropsAnOversizedLineWholeAndGoesOn) {
    LineFramer framer{8};
    EXPECT_EQ(lines_of(framer, "12345678\n"), (std::vector<std::string>{"12345678"}));
    EXPECT_EQ(feed(framer, "123456789\nnext\n"), (Fed{{"next"}, 1}));
    EXPECT_EQ(feed(framer, std::string(100, 'x')), (Fed{{}, 1}));
    EXPECT_EQ(feed(framer, std::string(100, 'x') + "\nlast\n"), (Fed{{"last"}, 0}));
}

TEST(LineFramer, GivesTheSameLinesHoweverTheBytesAreCut) {
    std::string text;
    for (int i = 0; i < 300; ++i)
        text += std::string(static_cast<std::size_t>(i % 37), 'a') + "\r\n";
    LineFramer whole{32};
    const Fed expected = feed(whole, text);
    std::mt19937 random{7};
    std::uniform_int_distribution<std::size_t> cut{1, 50};
    for (int trial = 0; trial < 50; ++trial) {
        LineFramer framer{32};
        Fed found;
        for (std::string_view rest = text; !rest.empty();) {
            const auto piece = rest.substr(0, cut(random));
            rest.remove_prefix(piece.size());
            const Fed fed = feed(framer, piece);
            found.lines.insert(found.lines.end(), fed.lines.begin(), fed.lines.end());
            found.oversized += fed.oversized;
        }
        ASSERT_EQ(found, expected);
    }
}

TEST(Crc16Xmodem, GivesTheCataloguedCheckValue) {
    EXPECT_EQ(crc16_xmodem("123456789"), 0x31C3);
    EXPECT_EQ(crc16_xmodem(""), 0);
}

} // namespace
} // namespace axiscal::framing_test
