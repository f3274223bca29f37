#include "acquisition/publish/mount_points.hpp"

#include "acquisition/publish/folder_destination.hpp"
#include "acquisition/publish/publisher.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/publish/staged_entry.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace axiscal::mount_points_test {
namespace {

using testing::ScratchFolder;
using testing::stage_entry;
using testing::write_bytes;

/// A PC whose files of the system say what a test writes. Its disk is device 8:1, mounted at "/".
struct Pc {
    ScratchFolder scratch;
    std::string root = std::filesystem::canonical(scratch.path()).string();
    MountPlaces places{root + "/mountinfo", root + "/fstab", {root + "/units"}};
    std::string list = "20 1 8:1 / / rw,relatime shared:1 - ext4 /dev/sda1 rw\n";
    Pc() {
        std::filesystem::create_directories(at("units"));
        std::filesystem::create_directories(at("mnt/quality/axiscal"));
        mounted("");
        write_bytes(places.fstab, "UUID=1 / ext4 defaults 0 1\nUUID=2 none swap sw 0 0\n");
    }
    [[nodiscard]] std::string at(const std::string& path) const { return root + "/" + path; }
    void mounted(const std::string& more) const { write_bytes(places.mounted, list + more); }
    /// "server:/quality", of another device.
    void mount(const std::string& point) const {
        mounted("30 20 0:50 / " + point + " rw - nfs4 server:/quality rw\n");
    }
    void fstab_names(const std::string& point) const {
        write_bytes(places.fstab, "# shares\nserver:/quality " + point + " nfs4 soft,nofail 0 0\n");
    }
    [[nodiscard]] std::string away(const std::string& folder) const {
        const auto absent = absent_mount(folder, places);
        return absent ? absent->point : "";
    }
};

TEST(MountPoints, OfFstabIsAwayUntilSomethingIsMountedThere) {
    const Pc pc;
    pc.fstab_names(pc.at("mnt/quality"));
    EXPECT_EQ(pc.away(pc.at("mnt/quality")), pc.at("mnt/quality"));
    pc.mount(pc.at("mnt/quality"));
    EXPECT_EQ(pc.away(pc.at("mnt/quality")), "");
}

TEST(MountPoints, IsAwayForFoldersBelowItAndForNoOthers) {
    const Pc pc;
    pc.fstab_names(pc.at("mnt/quality") + "/");
    EXPECT_EQ(pc.away(pc.at("mnt/quality/axiscal")), pc.at("mnt/quality"));
    EXPECT_EQ(pc.away(pc.at("mnt/quality/not/made/yet/")), pc.at("mnt/quality"));
    EXPECT_EQ(pc.away(pc.at("mnt/quality-2")), "");
    EXPECT_EQ(pc.away(pc.at("mnt")), "");
}

TEST(MountPoints, OfASystemdUnitIsNamedWithTheUnit) {
    const Pc pc;
    const auto unit = pc.at("units/quality.mount");
    write_bytes(unit, "[Unit]\nWhere=/elsewhere\n[Mount]\nWhat=server:/quality\nWhere = " +
                          pc.at("mnt/quality") + "\nType=nfs4\n");
    const auto absent = absent_mount(pc.at("mnt/quality/axiscal"), pc.places);
    ASSERT_TRUE(absent);
    EXPECT_EQ(absent->named_in, unit);
    EXPECT_EQ(absent->way_out, "sudo systemctl start 'quality.mount'");
    pc.mount(pc.at("mnt/quality"));
    EXPECT_FALSE(absent_mount(pc.at("mnt/quality/axiscal"), pc.places));
}

TEST(MountPoints, MayHaveBlanksInTheirNames) {
    const Pc pc;
    std::filesystem::create_directories(pc.at("mnt/of bay\\3"));
    pc.fstab_names(pc.at("mnt/of\\040bay\\1343"));
    const auto absent = absent_mount(pc.at("mnt/of bay\\3"), pc.places);
    ASSERT_TRUE(absent);
    EXPECT_EQ(absent->way_out, "sudo mount '" + pc.at("mnt/of bay\\3") + "'");
    pc.mount(pc.at("mnt/of\\040bay\\1343"));
    EXPECT_EQ(pc.away(pc.at("mnt/of bay\\3")), "");
}

TEST(MountPoints, AreFoundBehindLinks) {
    const Pc pc;
    pc.fstab_names(pc.at("mnt/quality"));
    std::filesystem::create_symlink(pc.at("mnt"), pc.at("shares"));
    EXPECT_EQ(pc.away(pc.at("shares/quality/axiscal")), pc.at("mnt/quality"));
    pc.fstab_names(pc.at("shares/quality"));
    EXPECT_EQ(pc.away(pc.at("shares/quality/axiscal")), pc.at("shares/quality"));
    pc.mount(pc.at("mnt/quality")); // as the kernel writes it
    EXPECT_EQ(pc.away(pc.at("shares/quality/axiscal")), "");
}

TEST(MountPoints, AnAutomountThatDidNotComeIsAway) {
    const Pc pc;
    pc.fstab_names(pc.at("mnt/quality"));
    const auto autofs = "29 20 0:49 / " + pc.at("mnt/quality") + " rw - autofs systemd-1 rw\n";
    pc.mounted(autofs);
    EXPECT_EQ(pc.away(pc.at("mnt/quality")), pc.at("mnt/quality"));
    pc.mounted(autofs + "30 29 0:50 / " + pc.at("mnt/quality") + " rw - nfs4 server:/q rw\n");
    EXPECT_EQ(pc.away(pc.at("mnt/quality")), "");
}

// What ReadWritePaths=/mnt of the service makes of a folder of the PC's own disk.
TEST(MountPoints, AFolderBoundOverItselfIsNoMount) {
    Pc pc;
    pc.fstab_names(pc.at("mnt"));
    const auto bound = [&](const std::string& root) {
        return "40 20 8:1 " + root + " " + pc.at("mnt") + " rw - ext4 /dev/sda1 rw\n";
    };
    pc.mounted(bound(pc.at("mnt")));
    EXPECT_EQ(pc.away(pc.at("mnt/quality")), pc.at("mnt"));
    pc.mounted(bound("/srv/quality")); // a bind of another folder, as fstab says
    EXPECT_EQ(pc.away(pc.at("mnt/quality")), "");
    pc.list = "20 1 0:25 /@root / rw - btrfs /dev/sda1 rw\n"; // of a subvolume
    pc.mounted("40 20 0:25 /@root" + pc.at("mnt") + " " + pc.at("mnt") + " rw - btrfs /dev/sda1\n");
    EXPECT_EQ(pc.away(pc.at("mnt/quality")), pc.at("mnt"));
}

TEST(MountPoints, AShareBelowOrUnderABoundFolderIsMounted) {
    const Pc pc;
    pc.fstab_names(pc.at("mnt/quality"));
    pc.mounted("40 20 8:1 " + pc.at("mnt") + " " + pc.at("mnt") + " rw - ext4 /dev/sda1 rw\n" +
               "41 40 0:50 / " + pc.at("mnt/quality") + " rw - nfs4 server:/quality rw\n");
    EXPECT_EQ(pc.away(pc.at("mnt/quality")), "");
    pc.fstab_names(pc.at("mnt")); // the sandbox lays its bind over the share
    pc.mounted("30 20 0:50 / " + pc.at("mnt") + " rw - nfs4 server:/quality rw\n" +
               "40 30 0:50 / " + pc.at("mnt") + " rw - nfs4 server:/quality rw\n");
    EXPECT_EQ(pc.away(pc.at("mnt/quality")), "");
}

TEST(MountPoints, NothingCountsAsMountedWhereTheListCannotBeRead) {
    const Pc pc;
    pc.fstab_names(pc.at("mnt/quality"));
    std::filesystem::remove(pc.places.mounted);
    EXPECT_EQ(pc.away(pc.at("mnt/quality")), pc.at("mnt/quality"));
    EXPECT_EQ(pc.away(pc.at("elsewhere")), "");
}

TEST(MountPoints, TheFileSystemOfAFolderIsThatOfTheInnermostMount) {
    const Pc pc;
    pc.mount(pc.at("mnt/quality"));
    EXPECT_EQ(file_system_of(pc.at("mnt/quality/axiscal"), pc.places), "nfs4");
    EXPECT_EQ(file_system_of(pc.at("mnt/quality-2"), pc.places), "ext4");
    EXPECT_EQ(file_system_of(pc.at("mnt"), {pc.at("none"), "", {}}), "");
}

TEST(MountPoints, OfThisPcAreRead) {
    EXPECT_NE(file_system_of("/"), "");
    EXPECT_FALSE(absent_mount("/"));
}

struct Told final : PublisherListener {
    std::vector<std::string> lines;
    void published(const PublishReceipt& receipt) override { lines.push_back(receipt.run_id); }
    void waiting(const std::string& run_id, const Error& why) override {
        lines.push_back(run_id + ": " + publishing_text(why));
    }
    void destination_back() override { lines.emplace_back("back"); }
    void progress() override {
        if (as_bytes_move) as_bytes_move();
    }
    std::function<void()> as_bytes_move;
};

/// Results of a PC go to the folder of its share.
struct Post {
    Pc pc;
    std::string point = pc.at("mnt/quality"), outbox = pc.at("outbox");
    Told told;
    int second = 0;
    FolderDestination destination{point, pc.places};
    Publisher publisher{{outbox, std::chrono::seconds{1}},
                        {[this] { return MonotonicTime{std::chrono::seconds{second}}; },
                         [] { return std::int64_t{0}; }},
                        destination,
                        told};
    Post() {
        pc.fstab_names(point);
        EXPECT_TRUE(stage_entry(outbox, "run-1", {{"a", "x"}}));
    }
    std::size_t pass() {
        second += 100;
        return publisher.pass();
    }
    [[nodiscard]] bool has(const std::string& path) const {
        return std::filesystem::exists(pc.at(path));
    }
};

TEST(Share, WaitsWhileItsMountPointIsEmpty) {
    Post post;
    EXPECT_EQ(post.pass(), 1U);
    ASSERT_EQ(post.told.lines.size(), 1U);
    EXPECT_EQ(post.told.lines[0], ": The share is away: nothing is mounted at " + post.point +
                                      ", a mount point of " + post.pc.places.fstab +
                                      "; mount it: sudo mount " + post.point);
    EXPECT_FALSE(post.has("mnt/quality/run-1"));
    EXPECT_FALSE(post.has("outbox/run-1/receipt.json"));
    EXPECT_FALSE(post.has("published"));
    post.pc.mount(post.point);
    EXPECT_EQ(post.pass(), 0U);
    EXPECT_EQ(post.told.lines.size(), 3U); // and back, and published
    EXPECT_TRUE(post.has("mnt/quality/run-1/a"));
    EXPECT_TRUE(post.has("published/run-1/receipt.json"));
}

TEST(Share, WritesNoReceiptWhenItGoesAwayWhileItIsWritten) {
    Post post;
    post.pc.mount(post.point);
    post.told.as_bytes_move = [&] {
        if (post.has("mnt/quality/run-1")) post.pc.mounted("");
    };
    EXPECT_EQ(post.pass(), 1U);
    EXPECT_TRUE(post.has("mnt/quality/run-1/a"));
    EXPECT_FALSE(post.has("outbox/run-1/receipt.json"));
    EXPECT_FALSE(post.has("published"));
    post.told.as_bytes_move = {};
    post.pc.mount(post.point);
    EXPECT_EQ(post.pass(), 0U);
    EXPECT_FALSE(post.has("mnt/quality/run-1-2"));
}

/// An entry that is on the share; its archive is what a test makes of `published`.
struct Archived {
    Pc pc;
    std::string outbox = pc.at("state/outbox"), published = pc.at("state/published");
    OutboxEntry entry;
    Archived() {
        EXPECT_TRUE(stage_entry(outbox, "run-1", {{"a", "x"}, {"receipt.json", "{}"}}));
        entry = read_entry(outbox, "run-1").value();
    }
    [[nodiscard]] Result<std::string> archive() const { return archive_entry(entry, {}, pc.places); }
    /// The entry stays until the disk is there.
    void expect_waiting_for(const std::string& point) const {
        const auto moved = archive();
        ASSERT_FALSE(moved);
        EXPECT_EQ(moved.error().detail,
                  "it is on the share but cannot move to published: nothing is mounted at " + point +
                      ", a mount point of " + pc.places.fstab + "; mount it: sudo mount " + point);
        EXPECT_TRUE(std::filesystem::exists(outbox + "/run-1/a"));
        EXPECT_FALSE(std::filesystem::exists(published + "/run-1"));
    }
    void expect_archived_once_mounted(const std::string& point) const {
        pc.mount(point);
        const auto moved = archive();
        ASSERT_TRUE(moved) << describe(moved.error());
        EXPECT_TRUE(std::filesystem::exists(published + "/run-1/a"));
        EXPECT_FALSE(std::filesystem::exists(outbox + "/run-1"));
    }
};

TEST(Outbox, KeepsAnEntryWhileTheDiskOfItsArchiveIsNotMounted) {
    const Archived at_home;
    std::filesystem::create_directory(at_home.published);
    at_home.pc.fstab_names(at_home.published);
    at_home.expect_waiting_for(at_home.published);
    at_home.expect_archived_once_mounted(at_home.published);

    const Archived linked;
    const std::string point = linked.pc.at("mnt/quality");
    linked.pc.fstab_names(point);
    std::filesystem::create_directory_symlink(point, linked.published);
    linked.expect_waiting_for(point);
    linked.expect_archived_once_mounted(point);
}

TEST(Outbox, KeepsAnEntryWhileItsArchiveIsALinkToNothing) {
    const Archived archived;
    const std::string place = archived.pc.at("mnt/quality/published");
    std::filesystem::create_directory_symlink(place, archived.published);
    const auto moved = archived.archive();
    ASSERT_FALSE(moved);
    EXPECT_EQ(moved.error().detail,
              "it is on the share but cannot move to published: " + archived.published +
                  " is a link to " + place +
                  ", which is not there: mount that disk or make the folder");
    archived.pc.fstab_names(archived.pc.at("mnt/quality"));
    archived.expect_waiting_for(archived.pc.at("mnt/quality"));
    std::filesystem::create_directory(place);
    archived.expect_archived_once_mounted(archived.pc.at("mnt/quality"));
}

TEST(Outbox, OfAStateDirectoryThatIsNotMountedIsArchivedBesideItself) {
    const Archived archived;
    archived.pc.fstab_names(archived.pc.at("state"));
    const auto moved = archived.archive();
    EXPECT_TRUE(moved) << describe(moved.error());
}

} // namespace
} // namespace axiscal::mount_points_test
