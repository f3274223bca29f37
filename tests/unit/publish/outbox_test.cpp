#include "acquisition/publish/outbox.hpp"

#include "acquisition/runfile/run_file.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/publish/staged_entry.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <sys/stat.h>

namespace axiscal::outbox_test {
namespace {

using testing::read_bytes;
using testing::ScratchFolder;
using testing::stage_entry;
using testing::write_bytes;

std::string outbox_in(const ScratchFolder& scratch) {
    return scratch.file("outbox");
}

TEST(Outbox, ShowsAnEntryOnlyOnceItIsFinished) {
    const ScratchFolder scratch;
    const auto staging = begin_entry(outbox_in(scratch), "run-1").value();
    write_bytes(staging + "/certificate.json", "{}");
    write_bytes(staging + "/certificate.csv", "a;b");
    EXPECT_TRUE(entry_names(outbox_in(scratch)).empty());
    const auto folder = finish_entry(outbox_in(scratch), "run-1").value();
    ASSERT_EQ(entry_names(outbox_in(scratch)), std::vector<std::string>{"run-1"});
    const auto entry = read_entry(outbox_in(scratch), "run-1").value();
    EXPECT_EQ(entry.run_id, "run-1");
    EXPECT_EQ(entry.folder, folder);
    EXPECT_EQ(entry.files, (std::vector<std::string>{"certificate.csv", "certificate.json"}));
    EXPECT_EQ(read_bytes(folder + "/certificate.json"), "{}");
}

TEST(Outbox, StartsAnewAfterACrashWhileStaging) {
    const ScratchFolder scratch;
    write_bytes(begin_entry(outbox_in(scratch), "run-1").value() + "/half", "x");
    const auto folder = stage_entry(outbox_in(scratch), "run-1", {{"whole", "y"}}).value();
    EXPECT_FALSE(std::filesystem::exists(folder + "/half"));
    EXPECT_EQ(read_bytes(folder + "/whole"), "y");
}

// A station that starts knows by this folder that a certificate is still to be made. It was removed and
// made anew: killed in between, a complete run never got its certificate.
TEST(Outbox, BeginningAnewKeepsTheFolderThatSaysSo) {
    const ScratchFolder scratch;
    const std::string staging = begin_entry(outbox_in(scratch), "run-1").value();
    struct stat before {}, after {};
    ASSERT_EQ(::stat(staging.c_str(), &before), 0);
    write_bytes(staging + "/certificate.pdf", "half");
    std::filesystem::create_directory(staging + "/odd");
    EXPECT_EQ(begin_entry(outbox_in(scratch), "run-1").value(), staging);
    ASSERT_EQ(::stat(staging.c_str(), &after), 0);
    EXPECT_EQ(after.st_ino, before.st_ino);
    EXPECT_TRUE(std::filesystem::is_empty(staging));
}

TEST(Outbox, NeverReplacesAWaitingEntry) {
    const ScratchFolder scratch;
    const auto folder = stage_entry(outbox_in(scratch), "run-1", {{"a", "first"}}).value();
    const auto again = stage_entry(outbox_in(scratch), "run-1", {{"a", "second"}});
    EXPECT_EQ(again.error().fault, Fault::refused);
    EXPECT_EQ(read_bytes(folder + "/a"), "first");
}

TEST(Outbox, RefusesNamesThatLeaveTheFolder) {
    const ScratchFolder scratch;
    for (const std::string name : {"", "..", "../x", "a/b", ".hidden", "a b", "a\nb"})
        EXPECT_EQ(begin_entry(outbox_in(scratch), name).error().fault, Fault::bad_request) << name;
}

// A run file may come from elsewhere, or bear the name of a station of before this rule: "bay 3".
TEST(Outbox, TakesTheCertificateOfARunHoweverItsIdIsWritten) {
    const ScratchFolder scratch;
    std::mt19937 dice{20261121};
    std::vector<std::string> ids{"bay 3-20261121T100000Z-X",
                                 "../../out",
                                 "hall3/bay2",
                                 "",
                                 ".",
                                 "CON",
                                 "nul",
                                 "a.",
                                 "\xFF\xC0",
                                 "%2e%2e",
                                 std::string(5000, 'x'),
                                 std::string(1, '\0')};
    for (int i = 0; i < 200; ++i) {
        ids.emplace_back(dice() % 80, ' ');
        for (char& byte : ids.back())
            byte = static_cast<char>(dice() % 256);
    }
    for (const std::string& id : ids) {
        RunSummary run;
        run.run_id = id;
        run.closings = 2;
        const auto staging = begin_entry(outbox_in(scratch), certificate_name(run));
        ASSERT_TRUE(staging) << ::testing::PrintToString(id);
        EXPECT_EQ(std::filesystem::path(*staging).parent_path(), outbox_in(scratch));
    }
}

TEST(Outbox, RefusesLinksAndFoldersInAnEntry) {
    const ScratchFolder scratch;
    const auto staging = begin_entry(outbox_in(scratch), "run-1").value();
    std::filesystem::create_symlink("/etc/passwd", staging + "/certificate.json");
    EXPECT_EQ(finish_entry(outbox_in(scratch), "run-1").error().fault, Fault::refused);
    std::filesystem::remove(staging + "/certificate.json");
    std::filesystem::create_directory(staging + "/more");
    EXPECT_EQ(finish_entry(outbox_in(scratch), "run-1").error().fault, Fault::refused);
}

TEST(Outbox, LetsNothingGoWithoutAReceipt) {
    const ScratchFolder scratch;
    const auto folder = stage_entry(outbox_in(scratch), "run-1", {{"a", "x"}}).value();
    const auto before = read_entry(outbox_in(scratch), "run-1").value();
    EXPECT_EQ(archive_entry(before).error().fault, Fault::refused);
    write_bytes(folder + "/receipt.json", "{}");
    const auto after = read_entry(outbox_in(scratch), "run-1").value();
    EXPECT_TRUE(after.has_receipt);
    EXPECT_EQ(after.files, std::vector<std::string>{"a"});
    EXPECT_EQ(archive_entry(after).value(), scratch.file("published/run-1"));
    EXPECT_TRUE(entry_names(outbox_in(scratch)).empty());
}

TEST(Outbox, ArchivesASecondEntryOfTheSameNameBesideTheFirst) {
    const ScratchFolder scratch;
    for (const std::string place : {"published/run-1", "published/run-1-2"}) {
        stage_entry(outbox_in(scratch), "run-1", {{"a", "x"}, {"receipt.json", "{}"}}).value();
        const auto entry = read_entry(outbox_in(scratch), "run-1").value();
        EXPECT_EQ(archive_entry(entry).value(), scratch.file(place));
    }
}

} // namespace
} // namespace axiscal::outbox_test
