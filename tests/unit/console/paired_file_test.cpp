#include "acquisition/console/paired_file.hpp"

#include "acquisition/console/paired_text.hpp"

#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <sys/stat.h>

namespace axiscal::paired_file_test {
namespace {

using testing::read_bytes;
using testing::ScratchFolder;
using testing::write_bytes;

std::vector<PairedBrowser> two() {
    return {{std::string(64, 'a'), "tablet 2", 1'795'000'000'000'000'000, {}},
            {std::string(64, 'b'), "Werkzeug, Müller", 1'795'000'000'000'000'000,
             1'795'100'000'000'000'000}};
}

TEST(PairedFile, IsReadAsItWasWritten) {
    const ScratchFolder scratch;
    const std::string path = scratch.file("paired-browsers");
    ASSERT_TRUE(write_paired(path, {}));
    EXPECT_TRUE(read_paired(path).value().empty());
    ASSERT_TRUE(write_paired(path, two()));
    EXPECT_EQ(read_paired(path).value(), two());
}

TEST(PairedFile, IsForItsOwnerAlone) {
    const ScratchFolder scratch;
    const std::string path = scratch.file("paired-browsers");
    ASSERT_TRUE(write_paired(path, two()));
    struct stat info {};
    ASSERT_EQ(::stat(path.c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777U, 0600U);
    for (const mode_t wrong : {0640U, 0602U, 0666U}) {
        ASSERT_EQ(::chmod(path.c_str(), wrong), 0);
        EXPECT_EQ(read_paired(path).error().fault, Fault::refused) << std::oct << wrong;
    }
    ASSERT_TRUE(write_paired(path, two()));
    EXPECT_TRUE(read_paired(path)) << "it is written anew with the right mode";
}

TEST(PairedFile, ThatIsNotThereYetNamesNobody) {
    const ScratchFolder scratch;
    EXPECT_TRUE(read_paired(scratch.file("paired-browsers")).value().empty());
}

TEST(PairedFile, ThatIsALinkAFolderOrAPipeIsRefused) {
    const ScratchFolder scratch;
    ASSERT_TRUE(write_paired(scratch.file("real"), two()));
    std::filesystem::create_symlink("real", scratch.file("link"));
    std::filesystem::create_directory(scratch.file("folder"));
    ASSERT_EQ(::mkfifo(scratch.file("pipe").c_str(), 0600), 0);
    for (const char* name : {"link", "folder", "pipe"}) {
        const auto refused = read_paired(scratch.file(name));
        ASSERT_FALSE(refused) << name;
        EXPECT_NE(refused.error().detail.find(scratch.file(name)), std::string::npos);
    }
}

TEST(PairedFile, ThatIsDamagedAnywhereNamesNobodyAndSaysSo) {
    const ScratchFolder scratch;
    const std::string path = scratch.file("paired-browsers");
    ASSERT_TRUE(write_paired(path, two()));
    const std::string whole = read_bytes(path);
    const std::size_t first_line = whole.find('\n') + 1;
    const std::size_t second = whole.find('\n', first_line) + 1;
    for (std::size_t length = 0; length < whole.size(); ++length) {
        if (length == first_line || length == second) continue; // whole lines are whole
        write_bytes(path, whole.substr(0, length));
        const auto refused = read_paired(path);
        ASSERT_FALSE(refused) << length;
        EXPECT_EQ(refused.error().fault, Fault::refused);
        EXPECT_NE(refused.error().detail.find("is damaged: line "), std::string::npos);
    }
}

TEST(PairedFile, ThatHoldsMoreThanThereCanBeIsRefused) {
    std::vector<PairedBrowser> many(most_paired, two().front());
    EXPECT_EQ(paired_of_text(paired_text(many)).value().size(), most_paired);
    many.push_back(two().front());
    EXPECT_FALSE(paired_of_text(paired_text(many)));
}

TEST(PairedFile, NumbersAndNamesThatNobodyWroteAreRefused) {
    const std::string begin = "axiscal paired browsers 1\n" + std::string(64, 'a');
    for (const char* rest : {" 7 - \n", " -7 - t\n", " 07 - t\n", " 9999999999999999999 - t\n",
                             " 7 x t\n", " 7  - t\n", " 7 - t\xff\n", " 7 - t\x01\n", " 7 -\n"})
        EXPECT_FALSE(paired_of_text(begin + rest)) << rest;
    EXPECT_FALSE(paired_of_text(begin + " 7 - " + std::string(81, 't') + "\n"));
    EXPECT_TRUE(paired_of_text(begin + " 7 - " + std::string(80, 't') + "\n"));
}

TEST(RandomBytesOfTheKernel, AreOthersEachTime) {
    std::array<std::uint8_t, 32> one{}, other{};
    ASSERT_TRUE(random_bytes(one) && random_bytes(other));
    EXPECT_NE(one, other);
}

} // namespace
} // namespace axiscal::paired_file_test
