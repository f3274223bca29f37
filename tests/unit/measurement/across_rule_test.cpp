// What a reading across the axis says, and what it does not say.
#include "acquisition/measurement/straightness/across_rule.hpp"

#include <gtest/gtest.h>

namespace axiscal::across_rule_test {
namespace {

class Across : public ::testing::Test {
protected:
    Across() {
        setup.factor = 36;
        datum.coordinate = 60.0_mm;
        datum.reading = 1.0_mm;
    }
    [[nodiscard]] std::shared_ptr<const ReadingRule> rule() const {
        return across_the_axis(setup, 2.5_mm);
    }
    /// Of a deviation that rises with the reading.
    [[nodiscard]] Length reading_of(Length deviation) const {
        return datum.reading + deviation / 36;
    }
    [[nodiscard]] std::string refusal_of(Length deviation, Length target) const {
        const auto found = rule()->position_of(datum, reading_of(deviation), 0, target);
        if (found) return "accepted";
        EXPECT_EQ(found.error().fault, Fault::outside_window);
        return found.error().detail;
    }
    StraightnessSetup setup;
    DatumRecord datum;
};

TEST_F(Across, ThePlaceIsTheOneThatIsClaimed) {
    for (const Length target : {70.0_mm, 870.0_mm}) {
        const auto found = rule()->position_of(datum, reading_of(10.0_um), 2.7e-4, target);
        ASSERT_TRUE(found);
        EXPECT_EQ(*found, target);
    }
    EXPECT_FALSE(rule()->sees_every_place());
    EXPECT_FALSE(rule()->shows_place());
}

TEST_F(Across, NoWayIsAskedForAndNoneIsSeen) {
    EXPECT_EQ(rule()->least_reading_of_way(5.0_mm), Length{});
    EXPECT_EQ(rule()->way_of_reading(5.0_mm), Length{});
}

TEST_F(Across, PeopleAreShownTheDeviationFromTheDatum) {
    const auto shown = [this] {
        return rule()->deviation_of(datum, reading_of(7.2_um), 70.0_mm, 70.0_mm).in(um);
    };
    EXPECT_NEAR(shown(), 7.2, 1e-6);
    setup.sign = -1;
    EXPECT_NEAR(shown(), -7.2, 1e-6);
}

TEST_F(Across, BeyondTheRangeItSaysHowSteepTheOpticsStand) {
    EXPECT_EQ(refusal_of(2.499_mm, 560.0_mm), "accepted");
    EXPECT_EQ(
        refusal_of(3.0_mm, 560.0_mm),
        "A slope of 6 um/mm over 500 mm leaves the range of the optics (+- 2.5 mm): align the "
        "mirror.");
    EXPECT_EQ(refusal_of(-3.0_mm, 560.0_mm),
              "A slope of -6 um/mm over 500 mm leaves the range of the optics (+- 2.5 mm): align "
              "the mirror.");
}

TEST_F(Across, AtTheDatumThereIsNoSlope) {
    EXPECT_EQ(refusal_of(3.0_mm, 60.0_mm),
              "A deviation of 3 mm leaves the range of the optics (+- 2.5 mm): align the mirror.");
}

} // namespace
} // namespace axiscal::across_rule_test
