#include "tools/axiscal/imports/foreign_text.hpp"

#include <gtest/gtest.h>

#include <string>

namespace axiscal::imports_test {
namespace {

using namespace std::string_literals;

void expect_text(std::string_view bytes, std::string_view utf8, TextEncoding encoding) {
    const auto read = foreign_text(bytes);
    ASSERT_TRUE(read) << describe(read.error());
    EXPECT_EQ(read->utf8, utf8);
    EXPECT_EQ(read->encoding, encoding) << name_of(read->encoding);
}

// Bytes by the code charts: GB 2312 (zhong 4-54, guo 2-90), ISO 8859-1.
TEST(ForeignText, IsReadInEachOfFourEncodings) {
    expect_text("Machine:MC", "Machine:MC", TextEncoding::utf8);
    expect_text("\xef\xbb\xbfM\xc3\xbcller", "Müller", TextEncoding::utf8);
    expect_text("\xff\xfeM\0\xfc\0"s, "Mü", TextEncoding::utf16);
    expect_text("\xd6\xd0\xb9\xfa 1", "中国 1", TextEncoding::gbk);
    expect_text("M\xfcller 20 \xb0"
                "C",
                "Müller 20 °C", TextEncoding::latin1);
}

TEST(ForeignText, IsReadToItsEndHoweverLongItIs) {
    std::string bytes, utf8;
    for (int i = 0; i < 5000; ++i)
        bytes += "\xd6\xd0", utf8 += "中";
    expect_text(bytes, utf8, TextEncoding::gbk);
}

TEST(ForeignText, OfBytesThatAreNoneIsRefused) {
    EXPECT_EQ(foreign_text("a\0b"s).error().field, "file");
    EXPECT_FALSE(foreign_text("\xff\xfe\x00\xd8"s));
}

} // namespace
} // namespace axiscal::imports_test
