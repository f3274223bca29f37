#include "acquisition/publish/folder_destination.hpp"
#include "acquisition/publish/publisher.hpp"

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/publish/staged_entry.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace axiscal::publisher_test {
namespace {

using testing::ScratchFolder;
using testing::stage_entry;
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

/// A folder whose server can be taken away; counts what is asked of it.
class ShakyDestination final : public Destination {
public:
    explicit ShakyDestination(std::string root)
        : folder_{std::move(root)} {}
    std::optional<Error> answer; ///< to everything that writes
    int writes = 0, checks = 0;

    [[nodiscard]] std::string place() const override { return folder_.place(); }
    Result<void> check() override { return ++checks, folder_.check(); }
    Result<bool> make_folder(const std::string& path) override {
        ++writes;
        if (answer) return tl::unexpected<Error>(*answer);
        return folder_.make_folder(path);
    }
    Result<std::vector<std::string>> names_in(const std::string& folder) override {
        return folder_.names_in(folder);
    }
    Result<std::string> sha256_of(const std::string& path, const Progress& progress) override {
        return folder_.sha256_of(path, progress);
    }
    Result<std::string> write_and_read_back(const std::string& source,
                                            const std::string& path,
                                            const Progress& progress) override {
        return folder_.write_and_read_back(source, path, progress);
    }
    Result<void> move_to_free_name(const std::string& from, const std::string& to) override {
        return folder_.move_to_free_name(from, to);
    }
    Result<void> remove_file(const std::string& path) override { return folder_.remove_file(path); }
    Result<void> sync_folder(const std::string& path) override { return folder_.sync_folder(path); }

private:
    FolderDestination folder_;
};

/// What second hands did: claims every other entry, and ends when it is waited for.
struct SecondsWork {
    class Hand final : public UploadHelper {
    public:
        Hand(SecondsWork& work, std::vector<std::string> run_ids)
            : work_{work}
            , run_ids_{std::move(run_ids)} {}
        ~Hand() override { ++work_.ended; }
        std::optional<std::size_t> claim() override {
            if (next_ % 2 == 1) claim_of_the_second();
            return next_ < run_ids_.size() ? std::optional{next_++} : std::nullopt;
        }
        void wait() override {
            ++work_.waited_for;
            for (const std::string& run_id : work_.claimed)
                if (work_.does) work_.does(run_id);
        }

    private:
        void claim_of_the_second() {
            if (next_ < run_ids_.size()) work_.claimed.push_back(run_ids_[next_++]);
        }
        SecondsWork& work_;
        std::vector<std::string> run_ids_;
        std::size_t next_ = 0;
    };
    std::unique_ptr<UploadHelper> begin(const std::vector<std::string>& run_ids) {
        ++begun;
        return std::make_unique<Hand>(*this, run_ids);
    }
    int begun = 0, waited_for = 0, ended = 0;
    std::vector<std::string> claimed;
    std::function<void(const std::string&)> does; ///< with each of them
};

struct Post {
    ScratchFolder scratch;
    std::string outbox = scratch.file("outbox"), destination = scratch.file("share");
    Heard heard;
    int second = 0;
    ShakyDestination share{destination};
    SecondsWork upload_worker;
    Publisher publisher{{outbox, std::chrono::seconds{1},
                         [this](const auto& run_ids) { return upload_worker.begin(run_ids); }},
                        {[this] { return MonotonicTime{std::chrono::seconds{second}}; },
                         [] { return std::int64_t{0}; }},
                        share,
                        heard};
    std::size_t pass_at(int now) {
        second = now;
        return publisher.pass();
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
    EXPECT_TRUE(entry_names(post.outbox).empty());
}

TEST(Publisher, AsksALostShareOnceAPassHoweverManyResultsWait) {
    Post post;
    std::filesystem::create_directory(post.destination);
    for (int run = 100; run < 200; ++run)
        ASSERT_TRUE(stage_entry(post.outbox, "run-" + std::to_string(run), {{"a", "x"}}));
    post.share.answer = share_lost("frozen").value();
    EXPECT_EQ(post.pass_at(0), 100U);
    EXPECT_EQ(post.share.writes, 1);
    for (int second = 1; second <= 100; ++second)
        post.pass_at(second);
    EXPECT_EQ(post.share.writes, 10); // at 0 1 3 7 15 31 47 63 79 95 s: doubling up to 16 s
    EXPECT_EQ(post.heard.lines, Lines{"waiting "});
    post.share.answer.reset();
    EXPECT_EQ(post.pass_at(120), 0U);
    EXPECT_EQ(post.heard.lines.size(), 102U); // waiting, back, 100 published
    EXPECT_EQ(post.heard.lines.at(1), "back");
}

TEST(Publisher, ASlowRefusalDoesNotShortenThePause) {
    Post post;
    std::filesystem::create_directory(post.destination);
    ASSERT_TRUE(stage_entry(post.outbox, "run-1", {{"a", "x"}}));
    post.share.answer = share_lost("frozen").value();
    post.pass_at(0);
    EXPECT_EQ(post.publisher.next_due(), MonotonicTime{std::chrono::seconds{1}});
    post.share.answer->detail = "still frozen";
    post.pass_at(10); // its pause of 2 s counts from the end of the attempt
    EXPECT_EQ(post.publisher.next_due(), MonotonicTime{std::chrono::seconds{12}});
}

TEST(Publisher, TouchesNoShareWhileNothingWaits) {
    Post post;
    std::filesystem::create_directory(post.destination);
    for (int second = 0; second < 100; ++second)
        EXPECT_EQ(post.pass_at(second), 0U);
    EXPECT_EQ(post.share.checks, 0);
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

Lines many(Post& post, int count) {
    std::filesystem::create_directory(post.destination);
    Lines run_ids;
    for (int run = 100; run < 100 + count; ++run) {
        run_ids.push_back("run-" + std::to_string(run));
        EXPECT_TRUE(stage_entry(post.outbox, run_ids.back(), {{"a", "x"}}));
    }
    return run_ids;
}

TEST(Publisher, LeavesASecondHandWhatItClaims) {
    Post post;
    const Lines all = many(post, 17);
    post.upload_worker.does = [&](const std::string& run_id) {
        std::filesystem::remove_all(post.outbox + "/" + run_id);
    };
    EXPECT_EQ(post.pass_at(0), 0U);
    Lines own, claimed;
    for (std::size_t i = 0; i < all.size(); ++i)
        (i % 2 == 0 ? own : claimed).push_back((i % 2 == 0 ? "published " : "") + all[i]);
    EXPECT_EQ(post.upload_worker.claimed, claimed);
    EXPECT_EQ(post.heard.lines, own);
    EXPECT_EQ(post.upload_worker.waited_for, 1);
}

TEST(Publisher, DoesItselfWhatTheSecondHandLeaves) {
    Post post;
    many(post, 16);
    EXPECT_EQ(post.pass_at(0), 0U);
    EXPECT_EQ(post.upload_worker.claimed.size(), 8U);
    EXPECT_EQ(post.heard.lines.size(), 16U);
    EXPECT_EQ(post.heard.lines.back(), "published run-115");
}

TEST(Publisher, ClaimsNoMoreOnceTheShareIsLostButWaitsForTheSecondHand) {
    Post post;
    many(post, 20);
    post.share.answer = share_lost("frozen").value();
    EXPECT_EQ(post.pass_at(0), 20U);
    EXPECT_EQ(post.share.writes, 1);
    EXPECT_EQ(post.upload_worker.waited_for, 1);
}

TEST(Publisher, EndsTheSecondHandWhereTheDestinationIsNotThere) {
    Post post;
    many(post, 16);
    std::filesystem::remove_all(post.destination);
    EXPECT_EQ(post.pass_at(0), 16U);
    EXPECT_EQ(post.upload_worker.begun, 1);
    EXPECT_EQ(post.upload_worker.ended, 1);
    EXPECT_EQ(post.upload_worker.waited_for, 0);
}

TEST(Publisher, TroubleAndFewEntriesNeedNoSecondHand) {
    Post few;
    many(few, 15);
    EXPECT_EQ(few.pass_at(0), 0U);
    EXPECT_EQ(few.upload_worker.begun, 0);
    Post troubled;
    std::filesystem::create_directories(troubled.outbox + "/empty");
    many(troubled, 4);
    EXPECT_EQ(troubled.pass_at(0), 1U);
    for (int run = 200; run < 230; ++run)
        ASSERT_TRUE(stage_entry(troubled.outbox, "run-" + std::to_string(run), {{"a", "x"}}));
    EXPECT_EQ(troubled.pass_at(1), 1U);
    EXPECT_EQ(troubled.upload_worker.begun, 0);
}

} // namespace
} // namespace axiscal::publisher_test
