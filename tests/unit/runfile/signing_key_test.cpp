#include "acquisition/runfile/signing_key.hpp"

#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sys/stat.h>

namespace axiscal::signing_key_test {
namespace {

using testing::ScratchFolder;

constexpr const char *one_machine = "0123456789abcdef0123456789abcdef",
                     *other_machine = "fedcba9876543210fedcba9876543210";

std::string content_of(const std::string& path) {
    std::ifstream file{path, std::ios::binary};
    return {std::istreambuf_iterator<char>{file}, {}};
}

void write(const std::string& path, const std::string& content) {
    std::ofstream{path, std::ios::binary | std::ios::trunc} << content;
}

mode_t mode_of(const std::string& path) {
    struct stat found {};
    EXPECT_EQ(::stat(path.c_str(), &found), 0) << path;
    return found.st_mode & 07777U;
}

TEST(StationKey, IsMadeAtTheFirstStartForItsOwnerAlone) {
    const ScratchFolder state;
    const mode_t before = ::umask(0);
    const auto first = open_station_key(state.path(), one_machine);
    ::umask(before);
    ASSERT_TRUE(first) << describe(first.error());
    EXPECT_EQ(mode_of(state.file("signing.key")), 0600U);
    EXPECT_EQ(mode_of(state.file("public-keys.pem")), 0644U);
    EXPECT_NE(first->news.find("public-keys.pem"), std::string::npos);
    EXPECT_FALSE(first->warns);
    EXPECT_EQ(content_of(state.file("public-keys.pem")), to_pem(first->key->public_key()));
    EXPECT_EQ(content_of(state.file("signing.key")).find(one_machine), std::string::npos)
        << "machine-id(5): the id itself is told to nobody";
}

TEST(StationKey, StaysTheSameOverRestarts) {
    const ScratchFolder state;
    const auto first = open_station_key(state.path(), one_machine);
    const auto second = open_station_key(state.path(), one_machine);
    ASSERT_TRUE(first && second);
    EXPECT_EQ(first->key->seed(), second->key->seed());
    EXPECT_EQ(second->news, "");
    EXPECT_EQ(read_station_key(state.path(), one_machine).value()->seed(), first->key->seed());
}

TEST(StationKey, OfTwoStationsAreTwo) {
    const ScratchFolder state, other;
    EXPECT_NE(open_station_key(state.path(), one_machine)->key->seed(),
              open_station_key(other.path(), one_machine)->key->seed());
}

TEST(StationKey, IsANewOneOnAnotherMachineAndTheOldPublicKeyStays) {
    const ScratchFolder state;
    const auto old = open_station_key(state.path(), one_machine);
    ASSERT_TRUE(old);
    EXPECT_FALSE(read_station_key(state.path(), other_machine).value()) << "not its own";
    const auto fresh = open_station_key(state.path(), other_machine);
    ASSERT_TRUE(fresh);
    EXPECT_NE(old->key->seed(), fresh->key->seed());
    EXPECT_TRUE(fresh->warns);
    EXPECT_NE(fresh->news.find("machine-id of this computer has changed"), std::string::npos);
    EXPECT_NE(fresh->news.find(short_name_of(old->key->public_key())), std::string::npos);
    EXPECT_NE(fresh->news.find(short_name_of(fresh->key->public_key())), std::string::npos);
    EXPECT_EQ(public_keys_of(content_of(state.file("public-keys.pem"))).value(),
              (std::vector{old->key->public_key(), fresh->key->public_key()}));
    EXPECT_EQ(mode_of(state.file("signing.key")), 0600U);
}

TEST(StationKey, IsNotMadeWithoutAMachineId) {
    const ScratchFolder state;
    const auto station = open_station_key(state.path(), "");
    ASSERT_TRUE(station);
    EXPECT_FALSE(station->key);
    EXPECT_TRUE(station->warns);
    EXPECT_NE(station->news.find("systemd-machine-id-setup"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(state.file("signing.key")));
}

TEST(StationKey, OfAMachineNobodyKnowsIsNotUsedAndNotReplaced) {
    const ScratchFolder state;
    const auto known = open_station_key(state.path(), one_machine);
    ASSERT_TRUE(known);
    EXPECT_FALSE(open_station_key(state.path(), "")->key);
    EXPECT_FALSE(read_station_key(state.path(), "").value());
    EXPECT_EQ(open_station_key(state.path(), one_machine)->key->seed(), known->key->seed());
}

TEST(MachineId, IsThirtyTwoDigitsOrUnknown) {
    const ScratchFolder scratch;
    const auto read = [&](const std::string& text) {
        write(scratch.file("machine-id"), text);
        return read_machine_id(scratch.file("machine-id"));
    };
    EXPECT_EQ(read(std::string{one_machine} + "\n"), one_machine);
    for (const char* none :
         {"", "\n", "uninitialized\n", "00000000000000000000000000000000\n",
          "0123456789abcdef0123456789abcde\n", "no id, but as long as one is....\n"})
        EXPECT_EQ(read(none), "") << none;
    EXPECT_EQ(read_machine_id(scratch.file("nothing")), "");
}

TEST(StationKey, ThatOthersMayReadIsRefusedWithTheWayOut) {
    for (const mode_t mode : {0640U, 0604U, 0660U, 0601U}) {
        const ScratchFolder state;
        ASSERT_TRUE(open_station_key(state.path(), one_machine));
        const std::string path = state.file("signing.key");
        ASSERT_EQ(::chmod(path.c_str(), mode), 0);
        for (const auto& refused : {open_station_key(state.path(), one_machine).error(),
                                    read_station_key(state.path(), one_machine).error()}) {
            EXPECT_EQ(refused.fault, Fault::refused);
            EXPECT_NE(refused.detail.find("chmod 600 " + path), std::string::npos)
                << refused.detail;
        }
        ASSERT_EQ(::chmod(path.c_str(), 0600), 0);
        EXPECT_TRUE(open_station_key(state.path(), one_machine));
    }
}

TEST(StationKey, ThatIsNoneIsRefusedAndLeftAsItIs) {
    const ScratchFolder state;
    ASSERT_TRUE(open_station_key(state.path(), one_machine));
    const std::string path = state.file("signing.key"), whole = content_of(path);
    for (const std::string& content :
         {std::string{}, whole.substr(0, whole.size() - 1), whole + "\n", "x" + whole.substr(1),
          whole.substr(0, whole.size() - 2) + "G\n", std::string{"token\n"}}) {
        write(path, content);
        const auto refused = open_station_key(state.path(), one_machine);
        ASSERT_FALSE(refused) << content;
        EXPECT_NE(refused.error().detail.find("is no signing key: put it back from a backup"),
                  std::string::npos);
        EXPECT_EQ(content_of(path), content);
    }
}

TEST(StationKey, ThatIsALinkIsRefused) {
    const ScratchFolder state, elsewhere;
    ASSERT_TRUE(open_station_key(elsewhere.path(), one_machine));
    std::filesystem::create_symlink(elsewhere.file("signing.key"), state.file("signing.key"));
    EXPECT_FALSE(open_station_key(state.path(), one_machine));
}

} // namespace
} // namespace axiscal::signing_key_test
