#include "acquisition/publish/smb/share_account.hpp"

#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <sys/stat.h>

namespace axiscal::share_account_test {
namespace {

using testing::ScratchFolder;
using testing::write_bytes;

constexpr const char* lines =
    "# the quality share\nusername=axiscal\r\npassword= a=b#c \ndomain=SHOP\n";

TEST(ShareAccount, IsReadAsMountReadsIt) {
    const auto account = parse_share_account(lines, "file").value();
    EXPECT_EQ(account.user, "axiscal");
    EXPECT_EQ(account.password, " a=b#c "); // everything behind the first '='
    EXPECT_EQ(account.domain, "SHOP");
}

TEST(ShareAccount, NamesTheLineItDoesNotKnowAndNeverItsText) {
    const auto refused = parse_share_account("username=a\npasswort=secret\n", "the-file").error();
    EXPECT_NE(refused.detail.find("the-file:2"), std::string::npos) << refused.detail;
    EXPECT_EQ(refused.detail.find("secret"), std::string::npos) << refused.detail;
    EXPECT_FALSE(parse_share_account("username=a\n", "f"));
    EXPECT_FALSE(parse_share_account("password=a\n", "f"));
    EXPECT_FALSE(parse_share_account("", "f"));
}

TEST(ShareAccount, OfAFileThatOthersMayReadIsRefused) {
    const ScratchFolder scratch;
    const auto file = scratch.file("account");
    write_bytes(file, lines);
    for (const unsigned mode : {0600U, 0400U}) {
        ASSERT_EQ(::chmod(file.c_str(), mode), 0);
        EXPECT_TRUE(read_share_account(file)) << mode;
    }
    for (const unsigned mode : {0640U, 0604U, 0620U, 0660U, 0666U, 0610U}) {
        ASSERT_EQ(::chmod(file.c_str(), mode), 0);
        const auto account = read_share_account(file);
        ASSERT_FALSE(account) << mode;
        EXPECT_EQ(account.error().fault, Fault::refused);
        EXPECT_NE(account.error().detail.find("chmod 600 " + file), std::string::npos);
    }
}

TEST(ShareAccount, IsNoLinkNoFolderAndNotEndless) {
    const ScratchFolder scratch;
    const auto file = scratch.file("account");
    write_bytes(file, lines);
    ASSERT_EQ(::chmod(file.c_str(), 0600), 0);
    std::filesystem::create_symlink(file, scratch.file("link"));
    EXPECT_FALSE(read_share_account(scratch.file("link")));
    EXPECT_FALSE(read_share_account(scratch.path()));
    EXPECT_EQ(read_share_account(scratch.file("none")).error().fault, Fault::io);
    write_bytes(file, std::string(5000, 'x'));
    EXPECT_EQ(read_share_account(file).error().fault, Fault::bad_configuration);
}

TEST(ShareAccount, ComesFromTheServiceManagerWhereNoFileIsNamed) {
    const ScratchFolder scratch;
    ::unsetenv("CREDENTIALS_DIRECTORY"); // NOLINT(concurrency-mt-unsafe)
    EXPECT_EQ(read_share_account("").error().fault, Fault::bad_configuration);
    write_bytes(scratch.file("share.credentials"), lines);
    ::setenv("CREDENTIALS_DIRECTORY", scratch.path().c_str(), 1); // NOLINT(concurrency-mt-unsafe)
    EXPECT_EQ(read_share_account("")->user, "axiscal");
    ::unsetenv("CREDENTIALS_DIRECTORY"); // NOLINT(concurrency-mt-unsafe)
}

} // namespace
} // namespace axiscal::share_account_test
