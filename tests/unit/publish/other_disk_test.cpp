// `published` leads to another disk, or the share's file system knows fewer calls than others.

#include "acquisition/publish/folder_destination.hpp"
#include "acquisition/publish/publisher.hpp"
#include "acquisition/runfile/digest.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/publish/denied_calls.hpp"
#include "tests/unit/publish/staged_entry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <sys/wait.h>
#include <unistd.h>

namespace axiscal::other_disk_test {
namespace {

namespace fs = std::filesystem;
using testing::DeniedCalls;
using testing::read_bytes;
using testing::ScratchFolder;
using testing::stage_entry;
using testing::write_bytes;

using Names = std::vector<std::string>;

Names names_in(const std::string& folder) {
    Names names;
    for (const auto& one : fs::directory_iterator{folder})
        names.push_back(one.path().filename().string());
    std::ranges::sort(names);
    return names;
}

/// The archive is a link to what the kernel takes for another disk.
struct Archive {
    ScratchFolder scratch;
    std::string outbox = scratch.file("state/outbox"), published = scratch.file("state/published");
    std::string big = std::string(600'000, 'b');
    DeniedCalls calls;
    Archive() {
        fs::create_directories(scratch.file("state"));
        fs::create_directories(scratch.file("big/published"));
        fs::create_directory_symlink(scratch.file("big/published"), published);
        calls.from = outbox;
        calls.to = published;
        calls.rename_to_free = EXDEV;
        calls.rename = EXDEV;
    }
    [[nodiscard]] OutboxEntry entry(const std::string& run_id) const {
        EXPECT_TRUE(stage_entry(outbox, run_id, {{"a", big}, {"b", "x"}, {"receipt.json", "{}"}}));
        return read_entry(outbox, run_id).value();
    }
    [[nodiscard]] Names archived() const { return names_in(scratch.file("big/published")); }
    void expect_whole(const std::string& run_id) const {
        EXPECT_EQ(names_in(published + "/" + run_id), (Names{"a", "b", "receipt.json"}));
        EXPECT_TRUE(read_bytes(published + "/" + run_id + "/a") == big);
        EXPECT_EQ(read_bytes(published + "/" + run_id + "/receipt.json"), "{}");
    }
};

TEST(Outbox, MovesAnEntryToAnArchiveOnAnotherDisk) {
    const Archive archive;
    EXPECT_EQ(archive_entry(archive.entry("run-1")).value(), archive.published + "/run-1");
    archive.expect_whole("run-1");
    EXPECT_EQ(archive.archived(), Names{"run-1"});
    EXPECT_EQ(names_in(archive.outbox), Names{});
}

TEST(Outbox, KeepsAnotherEntryOfTheNameInTheArchiveOnAnotherDisk) {
    const Archive archive;
    fs::create_directory(archive.published + "/run-1");
    for (const std::string name : {"a", "b", "receipt.json"})
        write_bytes(archive.published + "/run-1/" + name, "of another time");
    EXPECT_EQ(archive_entry(archive.entry("run-1")).value(), archive.published + "/run-1-2");
    archive.expect_whole("run-1-2");
    EXPECT_EQ(read_bytes(archive.published + "/run-1/a"), "of another time");
}

TEST(Outbox, LeavesAnEntryWhereItIsWhileTheOtherDiskIsFull) {
    Archive archive;
    const auto entry = archive.entry("run-1");
    archive.calls.sync = ENOSPC;
    const auto moved = archive_entry(entry);
    ASSERT_FALSE(moved);
    EXPECT_EQ(moved.error().cause, std::errc::no_space_on_device);
    EXPECT_FALSE(is_share_lost(moved.error())); // other results may go on to the share
    archive.calls.sync = 0;
    EXPECT_EQ(read_entry(archive.outbox, "run-1")->files, (Names{"a", "b"}));
    EXPECT_EQ(archive_entry(entry).value(), archive.published + "/run-1");
    EXPECT_EQ(archive.archived(), Names{"run-1"});
}

/// Archives in a child that dies on its way; false when it came to the end.
template <class Killer> bool killed_while_archiving(Archive& archive, Killer killer) {
    const auto entry = archive.entry("run-1");
    const pid_t pid = ::fork();
    if (pid == 0) ::_exit(archive_entry(entry, killer()) ? 0 : 1);
    int status = 0;
    ::waitpid(pid, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) || status == 0);
    return WIFSIGNALED(status);
}

/// As the publisher finds it when it starts anew.
void expect_moved_once(const Archive& archive) {
    if (entry_names(archive.outbox) == Names{"run-1"}) {
        const auto left = read_entry(archive.outbox, "run-1").value();
        EXPECT_TRUE(left.has_receipt);
        EXPECT_EQ(left.files, (Names{"a", "b"}));
        EXPECT_TRUE(archive_entry(left));
    }
    archive.expect_whole("run-1");
    EXPECT_TRUE(archive_entry(archive.entry("run-2"))); // what lay about is swept by the next one
    EXPECT_EQ(archive.archived(), (Names{"run-1", "run-2"}));
    EXPECT_EQ(names_in(archive.outbox), Names{});
}

TEST(Outbox, LosesAndDoublesNothingWhereverTheMoveToAnotherDiskIsCut) {
    int cuts = 0;
    for (bool cut = true; cut; ++cuts) {
        Archive archive;
        cut = killed_while_archiving(archive, [&] {
            archive.calls.die_at = cuts + 1;
            return Progress{};
        });
        expect_moved_once(archive);
    }
    EXPECT_GT(cuts, 8); // rename, 3 files, folder, rename, archive, outbox, rename, outbox
}

TEST(Outbox, LosesAndDoublesNothingWhereverTheCopyToAnotherDiskIsCut) {
    int cuts = 0;
    for (bool cut = true; cut; ++cuts) {
        Archive archive;
        cut = killed_while_archiving(archive, [&] {
            return Progress{[calls = 0, cuts]() mutable {
                if (++calls == cuts + 1) ::kill(::getpid(), SIGKILL);
            }};
        });
        expect_moved_once(archive);
    }
    EXPECT_GT(cuts, 5);
}

struct Told final : PublisherListener {
    std::vector<std::string> lines;
    void published(const PublishReceipt& receipt) override { lines.push_back(receipt.run_id); }
    void waiting(const std::string& run_id, const Error& why) override {
        lines.push_back(run_id + ": " + publishing_text(why));
    }
    void destination_back() override { lines.emplace_back("back"); }
    void progress() override { ++moves; }
    int moves = 0; ///< of bytes: hashing, copying, reading back
};

/// A share whose file system answers as rclone, davfs2 or vboxsf do.
struct Post {
    ScratchFolder scratch;
    std::string share = scratch.file("share"), outbox = scratch.file("state/outbox");
    DeniedCalls calls;
    Told told;
    int second = 0;
    FolderDestination destination{share, {scratch.file("mountinfo"), scratch.file("fstab"), {}}};
    Publisher publisher{{outbox, std::chrono::seconds{1}},
                        {[this] { return MonotonicTime{std::chrono::seconds{second}}; },
                         [] { return std::int64_t{0}; }},
                        destination,
                        told};
    Post(int rename_to_free, int link) {
        fs::create_directory(share);
        write_bytes(scratch.file("mountinfo"),
                    "20 1 8:1 / / rw - ext4 /dev/sda1 rw\n30 20 0:50 / " +
                        fs::canonical(share).string() + " rw - fuse.rclone far: rw\n");
        EXPECT_TRUE(stage_entry(outbox, "run-1", {{"a", "ours a"}, {"b", "ours b"}}));
        calls.to = share;
        calls.rename_to_free = rename_to_free;
        calls.link = link;
    }
    std::size_t pass() {
        second += 100;
        return publisher.pass();
    }
    [[nodiscard]] std::string at(const std::string& path) const { return share + "/" + path; }
};

TEST(Share, TakesResultsWhereItsFileSystemKnowsNeitherSuchARenameNorLinks) {
    const std::vector<std::pair<int, int>> answers{{EINVAL, EPERM},   {ENOSYS, EPERM},
                                                   {EINVAL, ENOTSUP}, {EINVAL, ENOSYS},
                                                   {EINVAL, EMLINK},  {EPERM, EPERM}};
    for (const auto& [rename_to_free, link] : answers) {
        Post post{rename_to_free, link};
        EXPECT_EQ(post.pass(), 0U);
        EXPECT_EQ(post.told.lines, Names{"run-1"});
        EXPECT_EQ(names_in(post.at("run-1")), (Names{"a", "b"}));
        EXPECT_EQ(read_bytes(post.at("run-1/b")), "ours b");
        EXPECT_TRUE(fs::exists(post.scratch.file("state/published/run-1/receipt.json")));
    }
}

TEST(Share, OverwritesNothingWhereItCanOnlyLookAndRename) {
    Post post{EINVAL, EPERM};
    FolderDestination& folder = post.destination;
    write_bytes(post.at("part"), "ours");
    write_bytes(post.at("taken"), "theirs");
    fs::create_symlink("nowhere", post.at("dangling"));
    for (const std::string name : {"taken", "dangling"})
        EXPECT_EQ(folder.move_to_free_name("part", name).error().fault, Fault::refused) << name;
    EXPECT_EQ(read_bytes(post.at("taken")), "theirs");
    EXPECT_EQ(read_bytes(post.at("part")), "ours");
    EXPECT_TRUE(fs::is_symlink(post.at("dangling")));
}

TEST(Share, NamesItsFileSystemAndTheWayOutWhereNoNameCanBeTaken) {
    Post post{EINVAL, EPERM};
    post.calls.rename = EPERM;
    EXPECT_EQ(post.pass(), 1U);
    ASSERT_EQ(post.told.lines.size(), 1U);
    for (const std::string word : {post.share.c_str(), "fuse.rclone", "smb://"})
        EXPECT_NE(post.told.lines[0].find(word), std::string::npos) << post.told.lines[0];
    EXPECT_FALSE(fs::exists(post.at("run-1/a")));
}

TEST(Share, CopiesNothingAnewWhileNoNameCanBeTaken) {
    Post post{EINVAL, EPERM};
    post.calls.rename = EPERM;
    post.pass();
    const int moves = post.told.moves;
    for (int tries = 0; tries < 10; ++tries)
        EXPECT_EQ(post.pass(), 1U);
    EXPECT_EQ(post.told.moves, moves);
    EXPECT_EQ(post.told.lines.size(), 1U); // and told once
    post.calls.rename = 0;
    EXPECT_EQ(post.pass(), 0U);
    EXPECT_EQ(names_in(post.at("run-1")), (Names{"a", "b"}));
    EXPECT_EQ(read_bytes(post.at("run-1/a")), "ours a");
    EXPECT_EQ(post.told.lines.size(), 3U); // back, published
}

TEST(Share, GoesAroundANameThatWasTakenWhileNoneCouldBe) {
    Post post{EINVAL, EPERM};
    post.calls.rename = EPERM;
    post.pass();
    write_bytes(post.at("run-1/a"), "theirs");
    post.calls.rename = 0;
    EXPECT_EQ(post.pass(), 0U);
    EXPECT_EQ(names_in(post.at("run-1")), Names{"a"}); // no .part left
    EXPECT_EQ(read_bytes(post.at("run-1/a")), "theirs");
    EXPECT_EQ(read_bytes(post.at("run-1-2/a")), "ours a");
}

} // namespace
} // namespace axiscal::other_disk_test
