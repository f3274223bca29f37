#include "acquisition/publish/publisher.hpp"

#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace axiscal {
namespace {

using testing::ScratchFolder;
using testing::write_bytes;

struct Heard final : PublisherListener {
    std::vector<std::string> lines;
    void published(const PublishReceipt& receipt) override {
        lines.push_back("published " + receipt.run_id);
    }
    void waiting(const std::string& run_id, const Error&) override {
        lines.push_back("waiting " + run_id);
    }
    void destination_back() override { lines.emplace_back("back"); }
    void progress() override {}
};

struct Post {
    ScratchFolder scratch;
    std::string outbox = scratch.file("outbox"), destination = scratch.file("share");
    Heard heard;
    Publisher publisher{{outbox, destination, std::chrono::seconds{1}}, heard};
    std::size_t pass_at(int second) {
        return publisher.pass(MonotonicTime{std::chrono::seconds{second}}, 0);
    }
};

using Lines = std::vector<std::string>;

TEST(Publisher, SaysOnceThatTheDestinationIsGoneAndOnceThatItIsBack) {
    Post post;
    ASSERT_TRUE(stage_entry(post.outbox, "run-1", {{"a", "x"}}));
    for (int second = 0; second < 200; ++second)
        EXPECT_EQ(post.pass_at(second), 1U);
    EXPECT_EQ(post.heard.lines, Lines{"waiting "});
    std::filesystem::create_directory(post.destination);
    for (int second = 200; second < 217; ++second)
        post.pass_at(second); // 16 s at most
    EXPECT_EQ(post.heard.lines, (Lines{"waiting ", "back", "published run-1"}));
    EXPECT_TRUE(std::filesystem::exists(post.scratch.file("published/run-1/receipt.json")));
    EXPECT_TRUE(list_entries(post.outbox).empty());
}

TEST(Publisher, LetsOneBadEntryNotHoldTheOthers) {
    Post post;
    std::filesystem::create_directory(post.destination);
    std::filesystem::create_directories(post.outbox + "/empty");
    ASSERT_TRUE(stage_entry(post.outbox, "run-1", {{"a", "x"}}));
    EXPECT_EQ(post.pass_at(0), 1U);
    EXPECT_EQ(post.pass_at(100), 1U);
    EXPECT_EQ(post.heard.lines, (Lines{"waiting empty", "published run-1"}));
}

TEST(Publisher, OnlyMovesAnEntryThatHasItsReceiptAlready) {
    Post post;
    std::filesystem::create_directory(post.destination);
    ASSERT_TRUE(stage_entry(post.outbox, "run-1", {{"a", "x"}, {"receipt.json", "{}"}}));
    EXPECT_EQ(post.pass_at(0), 0U);
    EXPECT_FALSE(std::filesystem::exists(post.destination + "/run-1"));
    EXPECT_TRUE(std::filesystem::exists(post.scratch.file("published/run-1/a")));
}

} // namespace
} // namespace axiscal
