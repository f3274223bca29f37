// What the publisher makes in a folder that passes its group on, under the mask of its service.
#include "acquisition/publish/folder_destination.hpp"
#include "tests/support/scratch_folder.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal::folder_group_test {
namespace {

struct stat about(const std::string& path) {
    struct stat found {};
    EXPECT_EQ(::stat(path.c_str(), &found), 0) << path;
    return found;
}

TEST(FolderDestination, ResultsAreReadByTheGroupOfAFolderThatPassesItOn) {
    testing::ScratchFolder scratch;
    constexpr gid_t nobody_else = 54321;
    const gid_t readers = ::geteuid() == 0 ? nobody_else : ::getegid();
    ASSERT_EQ(::chown(scratch.path().c_str(), ::geteuid(), readers), 0);
    ASSERT_EQ(::chmod(scratch.path().c_str(), 02750), 0);
    const std::string source = scratch.path() + "/certificate.pdf";
    std::ofstream{source} << "%PDF";
    const mode_t before = ::umask(0027); // of axiscal-publish.service
    FolderDestination destination{scratch.path()};
    const auto made = destination.make_folder("run-1");
    const auto written = destination.write_and_read_back(source, "run-1/certificate.pdf", {});
    ::umask(before);
    ASSERT_TRUE(made && written);
    for (const auto& [name, needed] :
         {std::pair{"/run-1", S_IRGRP | S_IXGRP}, std::pair{"/run-1/certificate.pdf", S_IRGRP}}) {
        const struct stat found = about(scratch.path() + name);
        EXPECT_EQ(found.st_gid, readers) << name;
        EXPECT_EQ(found.st_mode & static_cast<mode_t>(needed), static_cast<mode_t>(needed)) << name;
        EXPECT_EQ(found.st_mode & S_IRWXO, 0U) << name << " is for nobody else";
    }
}

} // namespace
} // namespace axiscal::folder_group_test
