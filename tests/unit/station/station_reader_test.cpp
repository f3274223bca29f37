// Somebody looks into the run file while it is to be closed: it is no fault of the disk.
#include "tests/unit/station/station_bench.hpp"

#include <sqlite3.h>

namespace axiscal::testing::station_reader_test {
namespace {

/// A shell of sqlite3 whose query stands still.
class Shell {
public:
    explicit Shell(const std::string& path) {
        EXPECT_EQ(sqlite3_open_v2(path.c_str(), &file_, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
        EXPECT_EQ(sqlite3_prepare_v2(file_, "SELECT * FROM plan_point", -1, &query_, nullptr),
                  SQLITE_OK);
        EXPECT_EQ(sqlite3_step(query_), SQLITE_ROW);
    }
    ~Shell() {
        sqlite3_finalize(query_);
        sqlite3_close(file_);
    }
    Shell(const Shell&) = delete;
    Shell& operator=(const Shell&) = delete;

private:
    sqlite3* file_ = nullptr;
    sqlite3_stmt* query_ = nullptr;
};

TEST(StationWhoseRunFileIsRead, SaysSoAndFinishesTheRunWhenTheReaderHasEnded) {
    Shop shop;
    shop.shorten();
    Life life{shop};
    ASSERT_TRUE(life.arm());
    for (int step = 0; step < 9; ++step)
        ASSERT_TRUE(life.take(step)) << step;
    const std::string path = shop.run_files().at(0);
    {
        const Shell shell{path};
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
