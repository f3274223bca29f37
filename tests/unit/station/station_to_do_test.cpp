// What the station puts on its list of what to do, and when it leaves it.
#include "tests/unit/station/station_bench.hpp"

#include <algorithm>

namespace axiscal::testing::station_to_do_test {
namespace {

class StationLists : public ::testing::Test {
protected:
    void SetUp() override { shop.shorten(); }
    static const ToDo* find(const StationStatus& status, const std::string& id) {
        const auto found = std::ranges::find(status.to_do, id, &ToDo::id);
        return found == status.to_do.end() ? nullptr : &*found;
    }
    static void ask_preflight(Life& life) {
        boost::asio::co_spawn(
            life.scheduler.loop(), life.station->preflight({}),
            [](std::exception_ptr, Result<std::vector<PreflightRecord>> got) { EXPECT_TRUE(got); });
        life.run(100ms);
    }
    Shop shop;
};

TEST_F(StationLists, NothingWhileAllIsWell) {
    Life life{shop};
    ask_preflight(life);
    const StationStatus status = life.status();
    EXPECT_TRUE(std::ranges::none_of(status.to_do, [](const ToDo& entry) {
        return entry.rank == ToDoRank::stop;
    })) << status.to_do.front().seen;
}

TEST_F(StationLists, TheCheckThatRefusedAnArmingFirstUntilOneIsArmed) {
    shop.config.statements.state = "";
    Life life{shop};
    ASSERT_FALSE(life.arm());
    ask_preflight(life); // as the console does for who was refused
    const StationStatus refused = life.status();
    const ToDo* check = find(refused, "preflight/compensation");
    ASSERT_NE(check, nullptr);
    EXPECT_EQ(check->rank, ToDoRank::stop);
    EXPECT_FALSE(check->since_utc.empty());
    ask_preflight(life);
    const StationStatus looked = life.status();
    ASSERT_NE(find(looked, "preflight/compensation"), nullptr);
    EXPECT_EQ(find(looked, "preflight/compensation")->rank, ToDoRank::look)
        << "somebody only looked";
    ArmRequest request;
    request.statements["state"] = "as found";
    ASSERT_TRUE(life.arm(request));
    EXPECT_EQ(find(life.status(), "preflight/compensation"), nullptr);
}

TEST_F(StationLists, AnInstrumentThatIsGoneWithTheTimeItWent) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    life.air->unplugged = true;
    life.run(3s);
    const StationStatus status = life.status();
    const ToDo* air = find(status, "instrument/air");
    ASSERT_NE(air, nullptr);
    EXPECT_EQ(air->rank, ToDoRank::stop);
    EXPECT_EQ(air->next, "Check plug and power.");
    const std::string since = air->since_utc;
    EXPECT_FALSE(since.empty());
    life.run(10s);
    const StationStatus later = life.status();
    ASSERT_NE(find(later, "instrument/air"), nullptr);
    EXPECT_EQ(find(later, "instrument/air")->since_utc, since);
    life.air->unplugged = false;
    life.run(10s);
    EXPECT_EQ(find(life.status(), "instrument/air"), nullptr);
}

} // namespace
} // namespace axiscal::testing::station_to_do_test
