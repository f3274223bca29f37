#include "acquisition/console/event_stream.hpp"

#include <gtest/gtest.h>

namespace axiscal::event_stream_test {
namespace {

TEST(EventStream, AnEventIsItsNameItsIdAndItsDataBeforeAnEmptyLine) {
    EXPECT_EQ(event_text("status", "{}"), "event: status\ndata: {}\n\n");
    EXPECT_EQ(event_text("points", "[1]", "a-1-2"), "event: points\nid: a-1-2\ndata: [1]\n\n");
    EXPECT_EQ(event_text("status", ""), "event: status\ndata: \n\n");
}

TEST(EventStream, EachLineOfTheDataIsALineOfTheEvent) {
    const std::string lines = "event: e\ndata: a\ndata: b\ndata: \ndata: c\n\n";
    EXPECT_EQ(event_text("e", "a\nb\n\nc"), lines);
    EXPECT_EQ(event_text("e", "a\r\nb\r\rc"), lines);
    EXPECT_EQ(event_text("e", "a\n"), "event: e\ndata: a\ndata: \n\n");
}

TEST(EventStream, NoNameAndNoIdMakesAnotherLine) {
    EXPECT_EQ(event_text("a\ndata: x", "1", "b\r\nretry: 0"),
              "event: adata: x\nid: bretry: 0\ndata: 1\n\n");
}

TEST(EventStream, TheWaitBeforeAnotherTryIsInMilliseconds) {
    EXPECT_EQ(retry_text(std::chrono::seconds{1}), "retry: 1000\n\n");
}

TEST(EventStream, AnIdIsReadAsItWasWritten) {
    const PointsId id{0xffff'ffff'ffff'ffff, 3, 2000};
    EXPECT_EQ(text_of(id), "ffffffffffffffff-3-2000");
    EXPECT_EQ(points_id_of(text_of(id)), id);
}

TEST(EventStream, WhatIsNoIdIsNone) {
    for (const char* text : {"", "-", "--", "1-2", "1-2-", "1-2-3-4", "1-2-3 ", "g-1-1", "1--1-1",
                             "1-2-99999999999999999999", "\xff-1-1"})
        EXPECT_FALSE(points_id_of(text)) << text;
}

TEST(EventStream, TheStreamIsAskedForByItsStretches) {
    const auto plain = events_asked_of("/v1/events", "");
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain->stream_points, 0U);
    EXPECT_FALSE(plain->has);
    const auto asked = events_asked_of("/v1/events/?stream=200", "a-1-7");
    ASSERT_TRUE(asked);
    EXPECT_EQ(asked->stream_points, 200U);
    EXPECT_EQ(asked->has, (PointsId{10, 1, 7}));
}

TEST(EventStream, AnotherQueryIsRefusedByItsField) {
    for (const char* query : {"?stream=0", "?stream=4097", "?stream=2x", "?stream="}) {
        const auto asked = events_asked_of("/v1/events" + std::string{query}, "");
        ASSERT_FALSE(asked) << query;
        EXPECT_EQ(asked.error().field, "stream");
    }
    const auto unknown = events_asked_of("/v1/events?points=3", "");
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().field, "query");
}

} // namespace
} // namespace axiscal::event_stream_test
