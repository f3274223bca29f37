#include "config/share_address.hpp"

#include <gtest/gtest.h>

namespace axiscal::share_address_test {
namespace {

TEST(ShareAddress, HasServerShareAndFolder) {
    const auto address =
        parse_share_address("smb://fs1.plant.example/quality/axis tests/2026/").value();
    EXPECT_EQ(address.server, "fs1.plant.example");
    EXPECT_EQ(address.port, 445);
    EXPECT_EQ(address.share, "quality");
    EXPECT_EQ(address.folder, "axis tests/2026");
    EXPECT_EQ(address_text(address), "smb://fs1.plant.example/quality/axis tests/2026");
}

TEST(ShareAddress, MayNameAPort) {
    const auto address = parse_share_address("smb://127.0.0.1:1445/results").value();
    EXPECT_EQ(address.port, 1445);
    EXPECT_EQ(address.folder, "");
    EXPECT_EQ(address_text(address), "smb://127.0.0.1:1445/results");
}

TEST(ShareAddress, IsRefusedWithAWayOut) {
    for (const char* text :
         {"smb://", "smb://server", "smb://server/", "smb:///share", "smb://a b/share",
          "smb://server:0/share", "smb://server:x/share", "smb://server:70000/share",
          "smb://server:/share", "smb://server/../share", "smb://server/sha%20re",
          "smb://server/a:b", "smb://server/a\nb", "SMB://server/share", "\\\\server\\share"}) {
        const auto address = parse_share_address(text);
        ASSERT_FALSE(address) << text;
        EXPECT_NE(address.error().detail.find("smb://server/share/folder"), std::string::npos)
            << text;
        EXPECT_TRUE(is_share_address(text)) << text;
    }
    EXPECT_FALSE(is_share_address("/mnt/share"));
    EXPECT_FALSE(is_share_address(""));
}

TEST(ShareAddress, TakesNoPasswordAndRepeatsNone) {
    const auto address = parse_share_address("smb://user:secret@server/share");
    ASSERT_FALSE(address);
    EXPECT_NE(address.error().detail.find("publish.credentials"), std::string::npos);
    EXPECT_EQ(address.error().detail.find("secret"), std::string::npos);
}

} // namespace
} // namespace axiscal::share_address_test
