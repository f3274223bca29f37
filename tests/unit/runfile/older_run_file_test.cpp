// Which tables a run file may lack: those of a kind of test that came after format 1, all together.
#include "acquisition/runfile/run_file.hpp"

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/runfile/random_run.hpp"
#include "tests/unit/runfile/written_run.hpp"

#include <gtest/gtest.h>

#include <string>

namespace axiscal::older_run_file_test {
namespace {

using testing::RandomRun;
using testing::refusal_of;
using testing::run_sql;
using testing::ScratchFolder;
using testing::write_run;

constexpr const char* other_tables = "the tables are not those of a run file";

/// A closed run of three points, changed from outside.
std::string written(const ScratchFolder& scratch, const std::string& change) {
    const auto path = scratch.file(sha256_hex(change) + ".axiscal");
    RandomRun random{41};
    write_run(path, random, 3);
    run_sql(path, change);
    return path;
}

TEST(OlderRunFile, HasAllTablesOfFormatOne) {
    const ScratchFolder scratch;
    for (const std::string change :
         {"DROP TABLE drift", "DROP TABLE probing; DROP TABLE probing_touch",
          "DROP TABLE circular; DROP TABLE circular_bar; DROP TABLE circular_uncertainty",
          "DROP TABLE rotary; DROP TABLE rotary_deviation"}) {
        const auto path = written(scratch, change);
        EXPECT_EQ(refusal_of(path), path + ": " + other_tables) << change;
    }
}

} // namespace
} // namespace axiscal::older_run_file_test
