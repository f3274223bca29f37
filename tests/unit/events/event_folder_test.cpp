// Events: their body, their names, and the folder that they wait in.

#include "acquisition/events/event_folder.hpp"
#include "tests/support/scratch_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

namespace axiscal::event_folder_test {
namespace {

using testing::ScratchFolder;

StationEvent fault_of(const std::string& run, Fault fault = Fault::beam_lost) {
    StationEvent event;
    event.about = StationEvent::About::fault;
    event.when_utc = "2026-11-28T10:00:00.000Z";
    event.run_id = run;
    event.fault = fault;
    event.sentence = "The beam was lost.";
    return event;
}

StationEvent completion_of(const std::string& run, const std::string& certificate) {
    StationEvent event;
    event.when_utc = "2026-11-28T10:00:00.000Z";
    event.run_id = run;
    event.test = TestKind::positioning;
    event.certificate = certificate;
    event.parameter = "A";
    event.verdict = "pass";
    return event;
}

bool laid(const ScratchFolder& state, const StationEvent& event) {
    const auto result = lay_event(state.path(), event);
    EXPECT_TRUE(result) << (result ? "" : describe(result.error()));
    return result.value_or(false);
}

TEST(StationEvent, OfACompleteRunSaysFigureAndVerdictAndNoReading) {
    const auto event = completion_of("r1", "r1");
    const auto body = nlohmann::json::parse(event_body(event, "bay 3", 0));
    const nlohmann::json wanted{
        {"id", event_id(event)}, {"when", "2026-11-28T10:00:00.000Z"},
        {"kind", "complete"},    {"station", "bay 3"},
        {"run", "r1"},           {"test", "positioning"},
        {"certificate", "r1"},   {"verdict", {{"figure", "A"}, {"verdict", "pass"}}}};
    EXPECT_EQ(body, wanted);
    StationEvent without_limits = event;
    without_limits.parameter.clear();
    EXPECT_FALSE(nlohmann::json::parse(event_body(without_limits, "b", 0)).contains("verdict"));
}

TEST(StationEvent, OfAFaultSaysItsNameAndItsSentence) {
    const auto body = nlohmann::json::parse(event_body(fault_of("r1"), "bay 3", 2));
    EXPECT_EQ(body["fault"], "beam_lost");
    EXPECT_EQ(body["sentence"], "The beam was lost.");
    EXPECT_EQ(body["dropped"], 2);
    EXPECT_FALSE(body.contains("test") || body.contains("certificate") || body.contains("verdict"));
}

TEST(StationEvent, BodyStaysSmallWhateverIsSaid) {
    StationEvent event = fault_of("r1");
    event.sentence = std::string(100'000, '\x01');
    EXPECT_LT(event_body(event, "bay 3", 0).size(), 8192U);
    event.sentence = std::string(999, 'a') + "\xC3\xA4"; // cut within a sign
    EXPECT_TRUE(nlohmann::json::accept(event_body(event, "bay 3", 0)));
}

TEST(StationEvent, HasTheSameNameWhoeverMakesItAgain) {
    StationEvent later = fault_of("r1");
    later.when_utc = "2026-11-28T11:00:00.000Z";
    later.sentence = "Other words.";
    EXPECT_EQ(event_id(later), event_id(fault_of("r1")));
    EXPECT_NE(event_id(fault_of("r2")), event_id(fault_of("r1")));
    EXPECT_NE(event_id(fault_of("r1", Fault::overspeed)), event_id(fault_of("r1")));
    EXPECT_NE(event_id(completion_of("r1", "r1-2")), event_id(completion_of("r1", "r1")));
    EXPECT_EQ(event_id(later).find('.'), std::string::npos); // which would end it in the signature
}

TEST(EventFolder, TakesNothingWhereNobodyAsked) {
    const ScratchFolder state;
    EXPECT_FALSE(laid(state, fault_of("r1")));
    ASSERT_TRUE(open_events(state.path(), {"bay 3", true, false}));
    EXPECT_FALSE(laid(state, fault_of("r1")));
    EXPECT_TRUE(laid(state, completion_of("r1", "r1")));
    close_events(state.path());
    EXPECT_FALSE(std::filesystem::exists(state.file("events")));
}

TEST(EventFolder, HoldsAnEventOnceAndNotAgainAfterItWasTaken) {
    const ScratchFolder state;
    ASSERT_TRUE(open_events(state.path(), {"bay 3", true, true}));
    EXPECT_TRUE(laid(state, fault_of("r1")));
    EXPECT_FALSE(laid(state, fault_of("r1")));
    const std::string id = event_id(fault_of("r1"));
    EXPECT_EQ(waiting_events(state.path()), std::vector<std::string>{id});
    EXPECT_EQ(nlohmann::json::parse(waiting_body(state.path(), id).value())["station"], "bay 3");
    ASSERT_TRUE(settle_event(state.path(), id));
    EXPECT_TRUE(waiting_events(state.path()).empty());
    EXPECT_FALSE(laid(state, fault_of("r1")));
    ASSERT_TRUE(open_events(state.path(), {"bay 3", true, true})); // the next daemon
    EXPECT_FALSE(laid(state, fault_of("r1")));
}

TEST(EventFolder, DropsTheOldestAndTellsIt) {
    const ScratchFolder state;
    ASSERT_TRUE(open_events(state.path(), {"bay 3", true, true}));
    for (std::size_t i = 0; i < most_waiting_events; ++i)
        ASSERT_TRUE(laid(state, fault_of("r" + std::to_string(i))));
    const std::string oldest = waiting_events(state.path()).front();
    EXPECT_EQ(dropped_events(state.path()), 0);
    ASSERT_TRUE(laid(state, fault_of("last")));
    const auto waiting = waiting_events(state.path());
    EXPECT_EQ(waiting.size(), most_waiting_events);
    EXPECT_EQ(std::ranges::count(waiting, oldest), 0);
    EXPECT_EQ(dropped_events(state.path()), 1);
    const auto body = waiting_body(state.path(), event_id(fault_of("last"))).value();
    EXPECT_EQ(nlohmann::json::parse(body)["dropped"], 1);
}

TEST(EventFolder, KeepsOneSentenceOfTrouble) {
    const ScratchFolder state;
    ASSERT_TRUE(open_events(state.path(), {"bay 3", true, true}));
    EXPECT_EQ(event_trouble(state.path()), "");
    tell_event_trouble(state.path(), "no answer");
    EXPECT_EQ(event_trouble(state.path()), "no answer");
    tell_event_trouble(state.path(), "");
    EXPECT_EQ(event_trouble(state.path()), "");
}

} // namespace
} // namespace axiscal::event_folder_test
