#pragma once
// Writes run files, changes them from outside and hears what is told of them.

#include "acquisition/runfile/run_file.hpp"
#include "tests/unit/runfile/random_run.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <string>

namespace axiscal::testing {

/// Writes a random run and returns what was written.
inline RunRecord
write_run(const std::string& path, RandomRun& random, int points, bool close = true) {
    RunRecord run = random.header();
    auto writer = RunFileWriter::create(path, run).value();
    for (int step = 0; step < points; ++step) {
        RunBatch batch;
        batch.environment = random.environment();
        if (random.pick(2) == 0) batch.events.push_back(random.event());
        if (random.pick(9) == 0) batch.datum = random.datum();
        batch.point = random.point(step);
        EXPECT_TRUE(writer.write(batch));
        run.environment.insert(run.environment.end(), batch.environment.begin(),
                               batch.environment.end());
        run.events.insert(run.events.end(), batch.events.begin(), batch.events.end());
        if (batch.datum) run.datums.push_back(*batch.datum);
        run.points.push_back(*batch.point);
    }
    if (!close) return run;
    run.complete = random.pick(2) == 0;
    run.closing_reason = "done";
    run.closed = random.tie();
    EXPECT_TRUE(writer.close(run.complete, run.closing_reason, run.closed));
    return run;
}

inline void run_sql(const std::string& path, const std::string& sql) {
    sqlite3* connection = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &connection), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(connection, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(connection);
    sqlite3_close(connection);
}

/// "accepted" where nothing is told.
inline std::string refusal_of(const std::string& path) {
    const auto read = read_run_file(path);
    if (read) return "accepted";
    EXPECT_EQ(read.error().fault, Fault::bad_run_file);
    return read.error().detail;
}

} // namespace axiscal::testing
