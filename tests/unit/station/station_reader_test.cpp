// Somebody looks into the run file while it is to be closed: it is no fault of the disk.
#include "tests/unit/station/file_shell.hpp"
#include "tests/unit/station/station_bench.hpp"

namespace axiscal::testing::station_reader_test {
namespace {

TEST(StationWhoseRunFileIsRead, SaysSoAndFinishesTheRunWhenTheReaderHasEnded) {
    Shop shop;
    shop.shorten();
    Life life{shop};
    ASSERT_TRUE(life.arm());
    for (int step = 0; step < 9; ++step)
        ASSERT_TRUE(life.take(step)) << step;
    const std::string path = shop.run_files().at(0);
    {
        const FileShell shell{path};
        ASSERT_TRUE(life.take(9));
        life.run(2s);
        EXPECT_EQ(life.notes_with("is closed and safe. " + path + " is read by"), 1);
        EXPECT_EQ(life.notes_with("disk"), 0);
        EXPECT_TRUE(read_run_file_contents(path).value().closed);
        EXPECT_EQ(life.notes_with("is complete."), 0) << "its certificate would name other bytes";
    }
    life.run(2s);
    EXPECT_EQ(life.notes_with("is complete."), 1);
    EXPECT_FALSE(std::filesystem::exists(path + "-wal"));
    EXPECT_EQ(life.status().run->state, "complete");
}

} // namespace
} // namespace axiscal::testing::station_reader_test
