#pragma once
// A reader of a run file that holds up its closing. Tests only.

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <string>

namespace axiscal::testing {

/// A shell of sqlite3 whose query stands still.
class FileShell {
public:
    explicit FileShell(const std::string& path) {
        EXPECT_EQ(sqlite3_open_v2(path.c_str(), &file_, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
        EXPECT_EQ(sqlite3_prepare_v2(file_, "SELECT * FROM sqlite_schema", -1, &query_, nullptr),
                  SQLITE_OK);
        EXPECT_EQ(sqlite3_step(query_), SQLITE_ROW);
    }
    ~FileShell() {
        sqlite3_finalize(query_);
        sqlite3_close(file_);
    }
    FileShell(const FileShell&) = delete;
    FileShell& operator=(const FileShell&) = delete;

private:
    sqlite3* file_ = nullptr;
    sqlite3_stmt* query_ = nullptr;
};

} // namespace axiscal::testing
