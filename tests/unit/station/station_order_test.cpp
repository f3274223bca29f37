// Who ordered what was decided about a run stands in its file and in the log.
#include "tests/unit/station/station_bench.hpp"

#include <algorithm>

namespace axiscal::testing::station_order_test {
namespace {

const Orderer jo{"socket", 1000, "jo", "Jo Miller"}, screen{"token", std::nullopt, "", "screen"};

class StationTellsWhoOrdered : public ::testing::Test {
protected:
    void SetUp() override { shop.shorten(); }
    [[nodiscard]] std::vector<OrderRecord> orders() const {
        return read_run_file_contents(shop.run_files().at(0)).value().revisions.orders;
    }
    void expect(const OrderRecord& order,
                const std::string& kind,
                const std::string& about,
                const Orderer& by) const {
        EXPECT_EQ(order.kind, kind);
        EXPECT_EQ(order.about, about);
        EXPECT_EQ(order.by.door, by.door);
        EXPECT_EQ(order.by.uid, by.uid);
        EXPECT_EQ(order.by.user, by.user);
        EXPECT_EQ(order.by.name, by.name);
        EXPECT_NE(order.utc_ns, 0);
    }
    Shop shop;
};

TEST_F(StationTellsWhoOrdered, ToArmAndToOverrideAndToAbort) {
    shop.config.instruments[1].due_on = "2020-01-01";
    Life life{shop};
    ArmRequest request;
    request.overrides["certificates"] = "the new one is on its way";
    request.by = jo;
    ASSERT_TRUE(life.arm(request));
    EXPECT_EQ(life.notes_with("armed by Jo Miller (user jo, uid 1000), overriding certificates."), 1);
    ASSERT_TRUE(life.abort("the door", screen));
    life.run(2s);
    EXPECT_EQ(life.notes_with("was aborted by screen (token)."), 1);
    const auto kept = orders();
    ASSERT_EQ(kept.size(), 3U);
    expect(kept[0], "arm", "", jo);
    expect(kept[1], "override", "certificates", jo);
    expect(kept[2], "abort", "", screen);
}

TEST_F(StationTellsWhoOrdered, ToTakeAgainAndToLeaveOutAlsoAfterTheRunWasClosed) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    for (int step = 0; step < 10; ++step)
        ASSERT_TRUE(life.take(step)) << step;
    life.run(2s);
    ASSERT_EQ(life.status().run->state, "complete");
    RevisionRequest request;
    request.selection.target = 2;
    request.reason = "coolant";
    request.by = jo;
    ASSERT_TRUE(life.retake(request));
    EXPECT_EQ(life.notes_with("coolant; ordered by Jo Miller (user jo, uid 1000)"), 1);
    const auto kept = orders();
    ASSERT_EQ(kept.size(), 2U);
    expect(kept[0], "arm", "", {});
    expect(kept[1], "retake", "1", jo);
}

TEST_F(StationTellsWhoOrdered, AnExclusionInTheOpenRun) {
    shop.config.cycle.approaches = 3;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    ASSERT_TRUE(life.take(0));
    RevisionRequest request;
    request.selection.target = 0;
    request.selection.approach = 0;
    request.reason = "a door";
    request.by = screen;
    ASSERT_TRUE(life.exclude(request));
    const auto kept = orders();
    ASSERT_EQ(kept.size(), 2U);
    expect(kept[1], "exclude", "", screen);
    EXPECT_EQ(life.notes_with("a door; ordered by screen (token)"), 1);
}

TEST_F(StationTellsWhoOrdered, ADriftTest) {
    shop.config.preflight.drift_window = 0s;
    Life life{shop};
    DriftRequest request;
    request.duration = 5s;
    request.interval = 500ms;
    request.by = jo;
    const auto begun = life.begin_drift(request);
    ASSERT_TRUE(*begun && **begun);
    life.run(10s);
    const auto kept = orders();
    ASSERT_EQ(kept.size(), 1U);
    expect(kept[0], "drift", "", jo);
}

TEST_F(StationTellsWhoOrdered, AndRefusesTheNumberOfAnotherCertificate) {
    shop.config.statements.certificate_number = "2026-0147";
    Life life{shop};
    std::ofstream{shop.scratch.file("certificate-numbers")} << "0\t1\tan-earlier-run\t2026-0147\n";
    const auto refused = life.arm();
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().detail.find("was given to run an-earlier-run"), std::string::npos);
    EXPECT_TRUE(shop.run_files().empty());
    ArmRequest request;
    request.statements["certificate_number"] = "2026-{month}";
    EXPECT_EQ(life.arm(request).error().field, "statements.certificate_number");
    request.statements["certificate_number"] = "2026-0148";
    EXPECT_TRUE(life.arm(request));
}

} // namespace
} // namespace axiscal::testing::station_order_test
