// What the station closes bears its signature; that its key changed is told.
#include "acquisition/runfile/run_signature.hpp"
#include "tests/unit/station/station_bench.hpp"

#include <algorithm>

namespace axiscal::testing::station_sign_test {
namespace {

class StationSigns : public ::testing::Test {
protected:
    void SetUp() override {
        shop.shorten();
        shop.key.key = key;
    }
    [[nodiscard]] SignatureReport judged() const {
        return check_signatures(shop.run_files().at(0), std::vector{key->public_key()}).value();
    }
    [[nodiscard]] bool events_tell(const std::string& words) const {
        const auto events = read_run_file(shop.run_files().at(0)).value().events;
        return std::ranges::any_of(events, [&](const EventRecord& event) {
            return event.text.find(words) != std::string::npos;
        });
    }
    std::shared_ptr<const SecretKey> key =
        std::make_shared<const SecretKey>(SecretKey::Seed{1, 2, 3});
    Shop shop;
};

TEST_F(StationSigns, ACompleteRunAndEachLaterClosingOfIt) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    EXPECT_EQ(judged().verdict, SignatureVerdict::absent) << "it is open";
    for (int step = 0; step < 10; ++step)
        ASSERT_TRUE(life.take(step)) << step;
    life.run(2s);
    ASSERT_EQ(life.status().run->state, "complete");
    EXPECT_EQ(judged().verdict, SignatureVerdict::good) << judged().sentence;
    RevisionRequest request;
    request.selection.target = 2;
    request.reason = "coolant";
    ASSERT_TRUE(life.retake(request));
    ASSERT_TRUE(life.abort("not after all"));
    life.run(2s);
    const auto contents = read_run_file_contents(shop.run_files().at(0)).value();
    EXPECT_EQ(contents.revisions.closings, 2);
    EXPECT_EQ(judged().verdict, SignatureVerdict::good) << judged().sentence;
}

TEST_F(StationSigns, ARunThatWasAborted) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    ASSERT_TRUE(life.abort("the door"));
    life.run(2s);
    EXPECT_EQ(judged().verdict, SignatureVerdict::good) << judged().sentence;
}

TEST_F(StationSigns, ARunThatTheLastDaemonLeftOpen) {
    {
        Life life{shop};
        ASSERT_TRUE(life.arm());
        ASSERT_TRUE(life.take(0));
    }
    shop.laser_serial = "another";
    Life life{shop};
    life.run(20s);
    EXPECT_TRUE(read_run_file_contents(shop.run_files().at(0))->closed);
    EXPECT_EQ(judged().verdict, SignatureVerdict::good) << judged().sentence;
}

TEST_F(StationSigns, AndTellsThatTheKeyIsAnotherInNotesAndInTheEventsOfTheNextRun) {
    shop.key.news = "The machine-id of this computer has changed.";
    shop.key.warns = true;
    Life life{shop};
    EXPECT_EQ(life.notes_with("machine-id"), 1);
    ASSERT_TRUE(life.arm());
    EXPECT_TRUE(events_tell("The machine-id of this computer has changed."));
}

TEST_F(StationSigns, AndTellsAFirstKeyInNotesAlone) {
    shop.key.news = "Runs are signed by a new key.";
    Life life{shop};
    EXPECT_EQ(life.notes_with("new key"), 1);
    ASSERT_TRUE(life.arm());
    EXPECT_FALSE(events_tell("new key"));
}

} // namespace
} // namespace axiscal::testing::station_sign_test
