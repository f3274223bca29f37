#include "acquisition/publish/smb/wire_watch.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cerrno>
#include <string>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

namespace axiscal::wire_watch_test {
namespace {

/// One frame as libsmbclient sends it: its length, then a header that begins with `mark` and has
/// the command where MS-SMB2 2.2.1.2 puts it.
class WireWatch : public ::testing::Test {
protected:
    void SetUp() override {
        ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends_.data()), 0);
    }
    ~WireWatch() override {
        forbid_readable_frames(false);
        allow_file_frames(any_number);
        ::close(ends_[0]);
        ::close(ends_[1]);
    }

    bool leaves(const std::string& mark, char command) {
        std::string length(4, '\0'), header = mark + std::string(60, '\0');
        header[12] = command;
        const std::array<iovec, 2> parts{iovec{length.data(), length.size()},
                                         iovec{header.data(), header.size()}};
        const ssize_t put = ::writev(ends_[0], parts.data(), parts.size());
        EXPECT_TRUE(put == 68 || errno == EPROTO);
        return put == 68;
    }

    // MS-SMB2 2.2.1.2 and 2.2.41.
    const std::string readable = "\xFESMB", encrypted = "\xFDSMB";
    const char create = 5, close = 6, set_info = 17, echo = 13;

private:
    std::array<int, 2> ends_{-1, -1};
};

TEST_F(WireWatch, LetsNoMoreFramesOutThanWereAllowed) {
    const auto before = smb_frames();
    allow_file_frames(3);
    EXPECT_TRUE(leaves(readable, create));
    EXPECT_TRUE(leaves(encrypted, '\x7A'));
    EXPECT_TRUE(leaves(readable, close));
    EXPECT_FALSE(leaves(readable, create));
    EXPECT_FALSE(leaves(encrypted, '\x7A'));
    EXPECT_EQ(smb_frames().held_back, before.held_back + 2);
    EXPECT_EQ(smb_frames().encrypted, before.encrypted + 1);
    allow_file_frames(any_number);
    EXPECT_TRUE(leaves(readable, create));
}

/// The library keeps a line alive by them whenever it likes.
TEST_F(WireWatch, DoesNotCountWhatKeepsTheLineAlive) {
    allow_file_frames(1);
    EXPECT_TRUE(leaves(readable, echo));
    EXPECT_TRUE(leaves(readable, set_info));
    EXPECT_TRUE(leaves(readable, echo));
    EXPECT_FALSE(leaves(readable, set_info));
}

TEST_F(WireWatch, HoldsBackReadableFramesAboutFilesOnceTheyAreForbidden) {
    forbid_readable_frames(true);
    EXPECT_FALSE(leaves(readable, create));
    EXPECT_TRUE(leaves(readable, echo));
    EXPECT_TRUE(leaves(encrypted, '\x7A'));
}

} // namespace
} // namespace axiscal::wire_watch_test
