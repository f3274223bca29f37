#include "acquisition/capture/environment_watch.hpp"

#include "axis_signal.hpp"

#include <gtest/gtest.h>

namespace axiscal::environment_watch_test {
namespace {

using testing::at_s;
constexpr Duration limit = std::chrono::seconds{60};

EnvironmentWatch two_contacts() {
    return EnvironmentWatch{{{EnvironmentRole::material_temperature, "material 1", "table left"},
                             {EnvironmentRole::material_temperature, "material 2", "table right"},
                             {EnvironmentRole::air_pressure, "pressure", "cabinet"}}};
}

TEST(EnvironmentWatch, GivesAFreshValueWithItsAge) {
    auto watch = two_contacts();
    watch.take(0, Sample{0, at_s(100), 21.5});
    const auto reading = watch.fresh(0, at_s(130), limit);
    ASSERT_TRUE(reading);
    EXPECT_EQ(reading->value, 21.5);
    EXPECT_EQ(reading->age, std::chrono::seconds{30});
}

TEST(EnvironmentWatch, NeverPassesAStaleValueAsANumber) {
    auto watch = two_contacts();
    watch.take(0, Sample{0, at_s(100), 21.5});
    EXPECT_TRUE(watch.fresh(0, at_s(160), limit));
    EXPECT_FALSE(watch.fresh(0, at_s(160.001), limit));
}

TEST(EnvironmentWatch, NeverPassesAnAbsentValueAsANumber) {
    auto watch = two_contacts();
    EXPECT_FALSE(watch.fresh(0, at_s(100), limit));
    watch.take(0, Sample{0, at_s(100), 21.5});
    watch.take(0, Sample::bad(0, at_s(101), Quality::absent));
    EXPECT_FALSE(watch.fresh(0, at_s(102), limit));
    watch.take(0, Sample{0, at_s(103), 21.6});
    EXPECT_TRUE(watch.fresh(0, at_s(104), limit));
}

TEST(EnvironmentWatch, NeverPassesNanAsANumber) {
    auto watch = two_contacts();
    watch.take(0, Sample{0, at_s(100), std::nan("")});
    EXPECT_FALSE(watch.fresh(0, at_s(100), limit));
}

TEST(EnvironmentWatch, DistrustsAReadingFromTheFuture) {
    auto watch = two_contacts();
    watch.take(0, Sample{0, at_s(200), 21.5});
    EXPECT_FALSE(watch.fresh(0, at_s(100), limit));
}

TEST(EnvironmentWatch, AnOlderReadingDoesNotReplaceANewerOne) {
    auto watch = two_contacts();
    watch.take(0, Sample{0, at_s(100), 21.5});
    watch.take(0, Sample{0, at_s(99), 30.0});
    EXPECT_EQ(watch.fresh(0, at_s(101), limit)->value, 21.5);
}

TEST(EnvironmentWatch, MeanNeedsEveryChannelOfTheRole) {
    auto watch = two_contacts();
    watch.take(0, Sample{0, at_s(100), 21.0});
    EXPECT_FALSE(watch.fresh_mean(EnvironmentRole::material_temperature, at_s(101), limit));
    watch.take(1, Sample{1, at_s(100), 22.0});
    EXPECT_EQ(watch.fresh_mean(EnvironmentRole::material_temperature, at_s(101), limit), 21.5);
    EXPECT_FALSE(watch.fresh_mean(EnvironmentRole::air_humidity, at_s(101), limit));
}

TEST(EnvironmentWatch, NamesTheStaleChannelItsPlaceAndItsAge) {
    auto watch = two_contacts();
    watch.take(0, Sample{0, at_s(100), 21.0});
    watch.take(1, Sample{1, at_s(20), 22.0});
    watch.take(2, Sample{2, at_s(100), 101325.0});
    const auto verdict = watch.check(at_s(110), limit);
    ASSERT_FALSE(verdict);
    EXPECT_EQ(verdict.error().fault, Fault::environment_stale);
    EXPECT_EQ(verdict.error().detail, "The material temperature 'material 2' (table right) is "
                                      "90 s old, the limit is 60 s.");
    watch.take(1, Sample{1, at_s(109), 22.0});
    EXPECT_TRUE(watch.check(at_s(110), limit));
}

} // namespace
} // namespace axiscal::environment_watch_test
