// The thread that reads files which block: the loop goes on meanwhile, answers come in order, and
// it ends with requests still open.
#include "drivers/link/blocking_files.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/threads/link_bench.hpp"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal {
namespace {

using Answer = Result<FileText>;

Task<bool> a_turn_of_the_loop() {
    co_return true;
}

class BlockingFilesTest : public ::testing::Test {
protected:
    std::string write(const std::string& name, const std::string& text) {
        std::ofstream{folder.file(name)} << text;
        return folder.file(name);
    }
    testing::ScratchFolder folder;
    testing::LinkBench bench;
    std::unique_ptr<BlockingFiles> files =
        std::make_unique<BlockingFiles>(bench.loop.get_executor());
};

TEST_F(BlockingFilesTest, AFileThatBlocksHoldsTheLoopUpForNothing) {
    const std::string slow = folder.file("slow");
    ASSERT_EQ(::mkfifo(slow.c_str(), 0600), 0);
    const int writer = ::open(slow.c_str(), O_RDWR | O_CLOEXEC); // reading it waits for a byte
    std::optional<Answer> first, second;
    bench.begin(files->read(slow), first);
    bench.begin(files->read(write("quick", "t=23125")), second);
    EXPECT_TRUE(bench.wait(a_turn_of_the_loop()));
    EXPECT_FALSE(first || second);
    ASSERT_EQ(::write(writer, "YES", 3), 3);
    ASSERT_TRUE(testing::loop_until(bench.loop, [&] { return first && second; }));
    EXPECT_EQ((*first)->text, "YES");
    EXPECT_EQ((*second)->text, "t=23125");
    EXPECT_GE((*second)->begun_at, (*first)->read_at);
    ::close(writer);
}

TEST_F(BlockingFilesTest, AMissingFileIsToldByItsName) {
    const auto answer = bench.wait(files->read(folder.file("none")));
    ASSERT_FALSE(answer);
    EXPECT_EQ(answer.error().fault, Fault::not_found);
    EXPECT_NE(answer.error().detail.find("none"), std::string::npos);
}

TEST_F(BlockingFilesTest, EndsWithRequestsThatNobodyAnswered) {
    const std::string path = write("often", "t=1");
    std::vector<std::optional<Answer>> answers(100);
    for (auto& answer : answers)
        bench.begin(files->read(path), answer);
    ASSERT_TRUE(testing::loop_until(bench.loop, [&] { return answers.front().has_value(); }));
    files.reset();
    bench.loop.restart();
    bench.loop.poll(); // what was on its way arrives
    for (const auto& answer : answers) {
        EXPECT_TRUE(!answer || answer->has_value());
    }
}

} // namespace
} // namespace axiscal
