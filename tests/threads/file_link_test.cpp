// Links of files which block: the loop goes on meanwhile, and it ends with readings still open.
#include "drivers/wire/file_link.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/threads/link_bench.hpp"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal {
namespace {

using Answer = Result<TimedBytes>;

std::string text_of(const Answer& answer) {
    std::string text;
    for (const std::byte byte : answer->bytes)
        text += std::to_integer<char>(byte);
    return text;
}

Task<bool> a_turn_of_the_loop() {
    co_return true;
}

class FileLinksTest : public ::testing::Test {
protected:
    void write(const std::string& name, const std::string& text) {
        std::ofstream{folder.file(name)} << text;
    }
    void name(ByteLink& link, const std::string& file) {
        std::vector<std::byte> bytes;
        for (const char one : file)
            bytes.push_back(static_cast<std::byte>(one));
        EXPECT_TRUE(bench.wait(link.write_all(std::move(bytes), bench.soon())));
    }
    testing::ScratchFolder folder;
    testing::LinkBench bench;
    std::unique_ptr<FileLinks> files = std::make_unique<FileLinks>(bench.loop.get_executor());
    std::unique_ptr<ByteLink> link = files->open(folder.path());
};

TEST_F(FileLinksTest, AFileThatBlocksHoldsUpNeitherTheLoopNorAnotherLink) {
    const std::string slow = folder.file("slow");
    ASSERT_EQ(::mkfifo(slow.c_str(), 0600), 0);
    const int writer = ::open(slow.c_str(), O_RDWR | O_CLOEXEC); // reading it waits for a byte
    const auto other = files->open(folder.path());
    write("quick", "t=23125");
    name(*link, "slow");
    name(*other, "quick");
    std::optional<Answer> blocked;
    bench.begin(link->read_some(bench.soon()), blocked);
    EXPECT_EQ(text_of(bench.wait(other->read_some(bench.soon()))), "t=23125");
    EXPECT_FALSE(blocked);
    ASSERT_EQ(::write(writer, "YES", 3), 3);
    ASSERT_TRUE(testing::loop_until(bench.loop, [&] { return blocked.has_value(); }));
    EXPECT_EQ(text_of(*blocked), "YES");
    ::close(writer);
}

TEST_F(FileLinksTest, ReadsOneFileAfterTheOther) {
    const std::string slow = folder.file("slow");
    ASSERT_EQ(::mkfifo(slow.c_str(), 0600), 0);
    const int writer = ::open(slow.c_str(), O_RDWR | O_CLOEXEC);
    write("quick", "t=23125");
    std::optional<Answer> first, second;
    name(*link, "slow");
    bench.begin(link->read_some(bench.soon()), first);
    EXPECT_TRUE(bench.wait(a_turn_of_the_loop()));
    name(*link, "quick");
    bench.begin(link->read_some(bench.soon()), second);
    EXPECT_TRUE(bench.wait(a_turn_of_the_loop()));
    EXPECT_FALSE(first || second);
    ASSERT_EQ(::write(writer, "YES", 3), 3);
    ASSERT_TRUE(testing::loop_until(bench.loop, [&] { return first && second; }));
    EXPECT_EQ(text_of(*first), "YES");
    EXPECT_EQ(text_of(*second), "t=23125");
    EXPECT_GE((*second)->read_at, (*first)->read_at);
    ::close(writer);
}

TEST_F(FileLinksTest, AMissingFileIsToldByItsName) {
    name(*link, "none");
    const auto answer = bench.wait(link->read_some(bench.soon()));
    ASSERT_FALSE(answer);
    EXPECT_EQ(answer.error().fault, Fault::not_found);
    EXPECT_NE(answer.error().detail.find("none"), std::string::npos);
}

TEST_F(FileLinksTest, EndWithReadingsThatNobodyAnswered) {
    write("often", "t=1");
    name(*link, "often");
    std::vector<std::optional<Answer>> answers(100);
    for (auto& answer : answers)
        bench.begin(link->read_some(bench.soon()), answer);
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
