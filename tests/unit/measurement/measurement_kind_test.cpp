// Each kind of test has a row, and a row says all or nothing of a matter.
#include "acquisition/measurement/measurement_kind.hpp"

#include <gtest/gtest.h>

namespace axiscal::measurement_kind_test {
namespace {

TEST(MeasurementKind, OfEachAnEarlierDaemonsRunIsTakenOver) {
    for (const TestKind kind : all_test_kinds) {
        const MeasurementKind& row = kind_row(kind);
        EXPECT_TRUE(row.take_over != nullptr) << name_of(kind);
        const bool may_be_added_to = row.take_over_closed != nullptr;
        const bool refuses = row.refuse_addition != nullptr;
        EXPECT_NE(may_be_added_to, refuses) << name_of(kind);
    }
}

TEST(MeasurementKind, OneThatIsArmedTellsAllThatThePreflightAsks) {
    for (const TestKind kind : all_test_kinds) {
        const MeasurementKind& row = kind_row(kind);
        const bool armed = row.open != nullptr;
        EXPECT_EQ(row.is_set_up != nullptr, armed) << name_of(kind);
        EXPECT_EQ(row.add_facts != nullptr, armed) << name_of(kind);
        EXPECT_EQ(row.wanted_drift != nullptr, armed) << name_of(kind);
        EXPECT_EQ(row.eve_facts != nullptr, armed) << name_of(kind);
    }
}

TEST(MeasurementKind, TheRowIsThatOfItsName) {
    EXPECT_FALSE(kind_row(TestKind::drift).driven_by_cnc);
    EXPECT_TRUE(kind_row(TestKind::probing).driven_by_cnc);
    EXPECT_TRUE(kind_row(TestKind::probing).open == nullptr);
    EXPECT_TRUE(kind_row(TestKind::positioning).take_over_closed != nullptr);
    EXPECT_TRUE(kind_row(TestKind::circular).refuse_addition != nullptr);
    EXPECT_TRUE(kind_row(TestKind::circular).open != nullptr);
}

} // namespace
} // namespace axiscal::measurement_kind_test
