// Who may reach the socket: its group and nobody else.
#include "acquisition/console/listening.hpp"

#include <boost/asio/io_context.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <grp.h>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace axiscal::listening_test {
namespace {

constexpr const char* nobodys_group = "no-such-group-here";

struct Group {
    gid_t id;
    std::string name;
};

std::vector<gid_t> groups_that_may_be_given() {
    std::vector<gid_t> all(static_cast<std::size_t>(std::max(::getgroups(0, nullptr), 0)));
    all.resize(static_cast<std::size_t>(
        std::max(::getgroups(static_cast<int>(all.size()), all.data()), 0)));
    if (::geteuid() == 0) // root gives to anybody
        if (const group* foreign = ::getgrnam("daemon")) all.push_back(foreign->gr_gid);
    all.push_back(::getegid());
    return all;
}

/// One that a new file of this process would not have by itself; its own where there is no other.
Group another_group() {
    const auto all = groups_that_may_be_given();
    const auto named_and_foreign = [](gid_t id) {
        return id != ::getegid() && ::getgrgid(id) != nullptr;
    };
    const auto found = std::ranges::find_if(all, named_and_foreign);
    const gid_t id = found != all.end() ? *found : ::getegid();
    const group* entry = ::getgrgid(id);
    return {id, entry != nullptr ? entry->gr_name : ""};
}

class SocketDoor : public ::testing::Test {
protected:
    void SetUp() override {
        char name[] = "/tmp/axiscal-socket-XXXXXX";
        folder = ::mkdtemp(name);
        config.socket_path = folder / "door.sock";
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    [[nodiscard]] struct stat rights() const {
        struct stat info {};
        EXPECT_EQ(::stat(config.socket_path.c_str(), &info), 0);
        return info;
    }

    boost::asio::io_context loop;
    boost::asio::local::stream_protocol::acceptor acceptor{loop};
    std::filesystem::path folder;
    ConsoleConfig config;
};

TEST_F(SocketDoor, BelongsToTheConfiguredGroupAndIsShutForOthers) {
    const Group wanted = another_group();
    config.group = wanted.name;
    const auto opened = listen(acceptor, config);
    ASSERT_TRUE(opened) << describe(opened.error());
    EXPECT_EQ(rights().st_gid, wanted.id) << wanted.name;
    EXPECT_EQ(rights().st_mode & 07777U, 0660U);
    EXPECT_TRUE(S_ISSOCK(rights().st_mode));
}

TEST_F(SocketDoor, KeepsTheGroupOfTheProcessWhereNoneIsNamed) {
    config.group.clear();
    const auto opened = listen(acceptor, config);
    ASSERT_TRUE(opened);
    EXPECT_EQ(rights().st_gid, ::getegid());
    EXPECT_EQ(rights().st_mode & 07777U, 0660U);
}

TEST_F(SocketDoor, HasThatModeUnderAnyUmask) {
    config.group.clear();
    const mode_t before = ::umask(0);
    const auto opened = listen(acceptor, config);
    const mode_t after = ::umask(before);
    ASSERT_TRUE(opened);
    EXPECT_EQ(rights().st_mode & 07777U, 0660U);
    EXPECT_EQ(after, 0U) << "the umask of the process was changed";
}

TEST_F(SocketDoor, NamesAnUnknownGroupItsPlaceAndTheWayOutAndLeavesNoSocket) {
    config.group = nobodys_group;
    const auto refused = listen(acceptor, config);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::io);
    const std::string told = describe(refused.error());
    for (const std::string& word : {std::string{nobodys_group}, std::string{"[console] group"},
                                    config.socket_path, std::string{"systemd-sysusers"}})
        EXPECT_NE(told.find(word), std::string::npos) << told;
    EXPECT_FALSE(std::filesystem::exists(config.socket_path));
}

// A second daemon with another state directory took the socket of the first one away.
TEST_F(SocketDoor, IsNotTakenFromWhoAnswersThere) {
    config.group.clear();
    const auto first = listen(acceptor, config);
    ASSERT_TRUE(first) << describe(first.error());
    boost::asio::local::stream_protocol::acceptor other{loop};
    const auto second = listen(other, config);
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().fault, Fault::busy);
    EXPECT_NE(second.error().detail.find(config.socket_path), std::string::npos);
    EXPECT_TRUE(S_ISSOCK(rights().st_mode));
}

TEST_F(SocketDoor, ReplacesWhatAKilledDaemonLeft) {
    config.group.clear();
    {
        boost::asio::local::stream_protocol::acceptor killed{loop};
        killed.open();
        killed.bind({config.socket_path});
        killed.listen();
    } // closed, and its file stays
    const auto opened = listen(acceptor, config);
    ASSERT_TRUE(opened) << describe(opened.error());
    EXPECT_EQ(rights().st_mode & 07777U, 0660U);
}

TEST_F(SocketDoor, LeavesAFileOrALinkAtItsPathAlone) {
    config.group.clear();
    const std::string notes = folder / "notes.txt";
    std::ofstream{notes} << "feeds";
    for (const std::string& path : {notes, std::string{folder / "link.sock"}}) {
        if (path != notes) std::filesystem::create_symlink(notes, path);
        config.socket_path = path;
        const auto refused = listen(acceptor, config);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().fault, Fault::refused);
        EXPECT_NE(refused.error().detail.find(path), std::string::npos);
        EXPECT_TRUE(std::filesystem::exists(std::filesystem::symlink_status(path)));
    }
    EXPECT_EQ(std::filesystem::file_size(notes), 5U);
}

TEST_F(SocketDoor, AtItsEndTakesAwayItsOwnFileAlone) {
    config.group.clear();
    {
        const auto opened = listen(acceptor, config);
        ASSERT_TRUE(opened);
    }
    EXPECT_FALSE(std::filesystem::exists(config.socket_path));
    boost::asio::local::stream_protocol::acceptor later{loop};
    auto moved_aside = listen(later, config);
    ASSERT_TRUE(moved_aside);
    std::filesystem::rename(config.socket_path, config.socket_path + ".old");
    std::ofstream{config.socket_path} << "of somebody else";
    *moved_aside = SocketFile{};
    EXPECT_TRUE(std::filesystem::exists(config.socket_path));
}

TEST(TcpDoor, NamesThePlaceOfAnAddressThatIsNotOfThisComputer) {
    boost::asio::io_context loop;
    boost::asio::ip::tcp::acceptor tcp{loop};
    ConsoleConfig config;
    config.host = "192.0.2.77"; // RFC 5737: of no computer
    config.port = 8470;
    const auto refused = listen(tcp, config);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::io);
    EXPECT_NE(refused.error().detail.find("192.0.2.77:8470"), std::string::npos);
    EXPECT_FALSE(tcp.is_open()) << "it is tried again";
}

} // namespace
} // namespace axiscal::listening_test
