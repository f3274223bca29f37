#include "acquisition/publish/share.hpp"

#include "acquisition/publish/folder_destination.hpp"
#include "acquisition/runfile/digest.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/publish/staged_entry.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <filesystem>
#include <random>
#include <sys/wait.h>
#include <unistd.h>

namespace axiscal::share_test {
namespace {

using testing::OutboxFile;
using testing::read_bytes;
using testing::ScratchFolder;
using testing::stage_entry;
using testing::write_bytes;

constexpr std::int64_t published_at = 1'795'255'200'000'000'000; // 2026-11-21T10:00:00Z

std::string random_bytes(std::size_t size, unsigned seed) {
    std::mt19937 random{seed};
    std::string bytes(size, '\0');
    for (auto& byte : bytes)
        byte = static_cast<char>(random());
    return bytes;
}

struct Share {
    ScratchFolder scratch;
    std::string outbox = scratch.file("outbox"), destination = scratch.file("share");
    Share() { std::filesystem::create_directory(destination); }
    OutboxEntry entry(const std::vector<OutboxFile>& files) const {
        EXPECT_TRUE(stage_entry(outbox, "run-1", files));
        return read_entry(outbox, "run-1").value();
    }
    [[nodiscard]] Result<PublishReceipt> copy(const OutboxEntry& entry) const {
        FolderDestination folder{destination};
        return copy_entry(entry, {folder, mark_of(outbox)}, published_at);
    }
    [[nodiscard]] std::string at(const std::string& name) const { return destination + "/" + name; }
};

TEST(Share, ReceivesEveryFileUnderItsRun) {
    const Share share;
    const auto big = random_bytes(700'000, 1);
    const auto receipt = share.copy(share.entry({{"a.json", "{}"}, {"b.pdf", big}})).value();
    EXPECT_EQ(receipt.folder, share.at("run-1"));
    EXPECT_EQ(receipt.published_utc, "2026-11-21T10:00:00Z");
    EXPECT_EQ(read_bytes(share.at("run-1/b.pdf")), big);
    const auto json = nlohmann::json::parse(receipt_json(receipt));
    EXPECT_EQ(json["files"][1]["sha256"], sha256_hex(big));
    EXPECT_EQ(json["files"][1]["bytes"], 700'000);
    const std::filesystem::directory_iterator all{share.at("run-1")};
    EXPECT_EQ(std::distance(begin(all), end(all)), 2); // no .part left
}

TEST(Share, TakesTheSameContentAgainAsPublished) {
    const Share share;
    const auto entry = share.entry({{"a", "same"}});
    EXPECT_EQ(share.copy(entry)->folder, share.at("run-1"));
    EXPECT_EQ(share.copy(entry)->folder, share.at("run-1"));
    EXPECT_FALSE(std::filesystem::exists(share.at("run-1-2")));
}

TEST(Share, KeepsOtherContentAndTakesAnotherName) {
    const Share share;
    for (const std::string taken : {"run-1", "run-1-2"}) {
        std::filesystem::create_directory(share.at(taken));
        write_bytes(share.at(taken + "/a"), "somebody else's " + taken);
    }
    EXPECT_EQ(share.copy(share.entry({{"a", "ours"}}))->folder, share.at("run-1-3"));
    EXPECT_EQ(read_bytes(share.at("run-1/a")), "somebody else's run-1");
    EXPECT_EQ(read_bytes(share.at("run-1-2/a")), "somebody else's run-1-2");
    EXPECT_EQ(read_bytes(share.at("run-1-3/a")), "ours");
}

TEST(Share, GoesAroundAFileThatBearsTheRunsName) {
    const Share share;
    write_bytes(share.at("run-1"), "a file");
    EXPECT_EQ(share.copy(share.entry({{"a", "ours"}}))->folder, share.at("run-1-2"));
}

TEST(Share, IsNotMadeWhereItIsMissing) {
    const Share share;
    const auto entry = share.entry({{"a", "x"}});
    std::filesystem::remove(share.destination);
    const auto copied = share.copy(entry);
    EXPECT_TRUE(is_share_lost(copied.error()));
    EXPECT_NE(copied.error().detail.find(share.destination), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(share.destination));
}

TEST(Share, SweepsItsOwnUnfinishedFilesAndNobodyElses) {
    const Share share;
    std::filesystem::create_directory(share.at("run-1"));
    const auto own = share.at("run-1/.a." + mark_of(share.outbox) + ".part");
    const auto foreign = share.at("run-1/.a.00000000.part");
    write_bytes(own, "half a fi");
    write_bytes(foreign, "another station is at work");
    EXPECT_EQ(share.copy(share.entry({{"a", "ours"}}))->folder, share.at("run-1"));
    EXPECT_FALSE(std::filesystem::exists(own));
    EXPECT_EQ(read_bytes(foreign), "another station is at work");
}

TEST(Share, SweepsAlsoTheFolderThatItGoesAround) {
    const Share share;
    std::filesystem::create_directory(share.at("run-1"));
    const auto own = share.at("run-1/.a." + mark_of(share.outbox) + ".part");
    write_bytes(own, "half a fi");
    write_bytes(share.at("run-1/a"), "somebody else's");
    EXPECT_EQ(share.copy(share.entry({{"a", "ours"}}))->folder, share.at("run-1-2"));
    EXPECT_FALSE(std::filesystem::exists(own));
}

TEST(Share, TakesANameOfOtherCaseForTaken) {
    const Share share;
    std::filesystem::create_directory(share.at("run-1"));
    write_bytes(share.at("run-1/A.JSON"), "somebody else's");
    EXPECT_EQ(share.copy(share.entry({{"a.json", "ours"}}))->folder, share.at("run-1-2"));
    EXPECT_EQ(read_bytes(share.at("run-1/A.JSON")), "somebody else's");
}

/// Copies while somebody writes "theirs" to the given path as soon as `there` has come.
Result<PublishReceipt> copy_beside_somebody(const Share& share,
                                            const OutboxEntry& entry,
                                            const std::string& there,
                                            const std::string& path) {
    FolderDestination folder{share.destination};
    const Progress somebody = [&] {
        if (std::filesystem::exists(there) && !std::filesystem::exists(path))
            write_bytes(path, "theirs");
    };
    return copy_entry(entry, {folder, mark_of(share.outbox), somebody}, published_at);
}

TEST(Share, GoesAroundANameThatIsTakenWhileItWrites) {
    const Share share;
    const auto copied = copy_beside_somebody(share, share.entry({{"a", "ours"}}), share.at("run-1"),
                                             share.at("run-1/a"));
    ASSERT_TRUE(copied) << describe(copied.error());
    EXPECT_EQ(copied->folder, share.at("run-1-2"));
    EXPECT_EQ(read_bytes(share.at("run-1/a")), "theirs");
    EXPECT_EQ(read_bytes(share.at("run-1-2/a")), "ours");
    const std::filesystem::directory_iterator all{share.at("run-1")};
    EXPECT_EQ(std::distance(begin(all), end(all)), 1); // no .part left
}

TEST(Share, PutsAllFilesOfAResultIntoOneFolderWhenTheSecondNameIsTaken) {
    const Share share;
    const auto entry = share.entry({{"a", "ours a"}, {"b", "ours b"}});
    const auto copied =
        copy_beside_somebody(share, entry, share.at("run-1/a"), share.at("run-1/b"));
    ASSERT_TRUE(copied) << describe(copied.error());
    EXPECT_EQ(copied->folder, share.at("run-1-2"));
    EXPECT_EQ(read_bytes(share.at("run-1/b")), "theirs");
    EXPECT_EQ(read_bytes(share.at("run-1/a")), "ours a"); // nothing is deleted
    EXPECT_EQ(read_bytes(share.at("run-1-2/a")), "ours a");
    EXPECT_EQ(read_bytes(share.at("run-1-2/b")), "ours b");
}

/// A share that gives back other bytes than it took, or takes no name.
class ForgetfulDestination final : public Destination {
public:
    explicit ForgetfulDestination(std::string gives_back)
        : gives_back_{std::move(gives_back)} {}
    std::vector<std::string> renamed;
    bool every_name_is_taken = false;
    [[nodiscard]] std::string place() const override { return "forgetful"; }
    Result<void> check() override { return {}; }
    Result<bool> make_folder(const std::string&) override { return true; }
    Result<std::vector<std::string>> names_in(const std::string&) override {
        return std::vector<std::string>{};
    }
    Result<std::string> sha256_of(const std::string&, const Progress&) override { return {}; }
    Result<std::string>
    write_and_read_back(const std::string&, const std::string&, const Progress&) override {
        return sha256_hex(gives_back_);
    }
    Result<void> move_to_free_name(const std::string&, const std::string& to) override {
        renamed.push_back(to);
        if (every_name_is_taken) return fail(Fault::refused, to + " exists already");
        return {};
    }
    Result<void> remove_file(const std::string&) override { return {}; }
    Result<void> sync_folder(const std::string&) override { return {}; }

private:
    std::string gives_back_;
};

TEST(Share, GivesNoFinalNameToBytesThatCameBackWrong) {
    const Share share;
    ForgetfulDestination forgetful{"other bytes"};
    const auto copied =
        copy_entry(share.entry({{"a", "ours"}}), {forgetful, mark_of(share.outbox)}, published_at);
    EXPECT_EQ(copied.error().fault, Fault::checksum);
    EXPECT_TRUE(forgetful.renamed.empty());
}

TEST(Share, TellsOfANameThatIsTakenEachTimeInsteadOfWritingForEver) {
    const Share share;
    ForgetfulDestination forgetful{"ours"};
    forgetful.every_name_is_taken = true;
    const auto copied =
        copy_entry(share.entry({{"a", "ours"}}), {forgetful, mark_of(share.outbox)}, published_at);
    EXPECT_EQ(copied.error().fault, Fault::refused);
    EXPECT_EQ(copied.error().detail, "run-1/a exists already");
    EXPECT_EQ(forgetful.renamed.size(), 3U);
}

/// Copies in a child that kills itself at the given progress call; false when it came to the end.
bool killed_while_copying(const Share& share, const OutboxEntry& entry, int kill_at) {
    const pid_t pid = ::fork();
    if (pid == 0) {
        int calls = 0;
        FolderDestination folder{share.destination};
        const Progress killer = [&] {
            if (++calls == kill_at) ::kill(::getpid(), SIGKILL);
        };
        const auto copied =
            copy_entry(entry, {folder, mark_of(share.outbox), killer}, published_at);
        ::_exit(copied ? 0 : 1);
    }
    int status = 0;
    ::waitpid(pid, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) || status == 0);
    return WIFSIGNALED(status);
}

TEST(Share, NeverShowsAHalfFileWhereverTheCopyIsKilled) {
    const Share share;
    const std::vector<OutboxFile> files{
        {"a", random_bytes(600'000, 2)}, {"b", random_bytes(1'200'000, 3)}, {"c", "short"}};
    const auto entry = share.entry(files);
    int kills = 0;
    for (bool killed = true; killed; ++kills) {
        std::filesystem::remove_all(share.at("run-1"));
        killed = killed_while_copying(share, entry, kills + 1);
        for (const auto& [name, content] : files)
            if (const auto path = share.at("run-1/" + name); std::filesystem::exists(path)) {
                EXPECT_TRUE(read_bytes(path) == content) << name << " after kill " << kills;
            }
        EXPECT_EQ(share.copy(entry)->folder, share.at("run-1")); // and it goes on from there
        for (const auto& [name, content] : files) {
            EXPECT_TRUE(read_bytes(share.at("run-1/" + name)) == content);
        }
        const std::filesystem::directory_iterator all{share.at("run-1")};
        EXPECT_EQ(std::distance(begin(all), end(all)), 3); // no .part left
    }
    EXPECT_GT(kills, 10); // the copy has that many places to die
}

} // namespace
} // namespace axiscal::share_test
