// The list of what to do as the interface gives it.
#include "acquisition/console/api_json.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace axiscal::to_do_json_test {
namespace {

TEST(ToDoJson, StandsInTheStatusWithEveryKeyOfEachEntry) {
    StationStatus status;
    EXPECT_EQ(to_json(status).at("to_do"), nlohmann::ordered_json::array());
    status.to_do = {{"outbox", ToDoRank::look, ToDoSource::outbox, "12 results wait", "",
                     "Start it.", "systemctl start x", "systemctl stop x"}};
    const auto entry = to_json(status).at("to_do").at(0);
    EXPECT_EQ(entry.at("id"), "outbox");
    EXPECT_EQ(entry.at("rank"), "look");
    EXPECT_EQ(entry.at("source"), "outbox");
    EXPECT_EQ(entry.at("seen"), "12 results wait");
    EXPECT_EQ(entry.at("since_utc"), "");
    EXPECT_EQ(entry.at("next"), "Start it.");
    EXPECT_EQ(entry.at("command"), "systemctl start x");
    EXPECT_EQ(entry.at("undo"), "systemctl stop x");
}

} // namespace
} // namespace axiscal::to_do_json_test
