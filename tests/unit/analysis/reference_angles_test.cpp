// Readings of a polygon or an indexing table become deviations of the axis.

#include "analysis/positioning/reference_angles.hpp"

#include <gtest/gtest.h>
#include <random>

namespace axiscal::reference_angles_test {
namespace {

ReferenceAngles polygon(std::vector<double> deviations, std::vector<int> faces) {
    return {std::move(deviations),           std::move(faces),        true, true,
            "polygon.face_deviation_arcsec", "polygon.face_of_target"};
}

DeviationTable table_of(std::vector<double> targets) {
    DeviationTable table;
    table.targets = std::move(targets);
    table.forward.assign(table.targets.size(), {0, 0});
    table.backward = table.forward;
    table.unit = "arcsec";
    return table;
}

constexpr double degrees_per_arcsec = 1.0 / 3600;

TEST(ReferenceAngles, PerfectAxisReadsTheFacesAlone) {
    // an axis without error sees each face's own deviation; taken out, nothing is left
    const std::vector<double> faces{0, 1.5, -2, 0.5};
    auto table = table_of({0, 90, 180, 270});
    for (std::size_t i = 0; i < 4; ++i)
        table.forward[i] = table.backward[i] = {faces[i], faces[i]};
    ASSERT_TRUE(take_out_reference(polygon(faces, {1, 2, 3, 4}), degrees_per_arcsec, 1, table));
    for (const auto& row : table.forward)
        EXPECT_EQ(row, (std::vector<double>{0, 0}));
}

TEST(ReferenceAngles, FacesNumberedTheOtherWayRoundAreFollowed) {
    const std::vector<double> faces{0, 1.5, -2, 0.5};
    auto table = table_of({0, 90, 180, 270});
    table.forward = {{10, 10}, {10.5, 10.5}, {8, 8}, {11.5, 11.5}};
    table.backward.clear();
    ASSERT_TRUE(take_out_reference(polygon(faces, {1, 4, 3, 2}), degrees_per_arcsec, 1, table));
    for (const auto& row : table.forward)
        EXPECT_EQ(row, (std::vector<double>{10, 10}));
}

TEST(ReferenceAngles, SensesTurnTheSigns) {
    auto reference = polygon({0, 3}, {1, 2});
    const auto second = [&](bool certificate, bool reading) {
        reference.certificate_with_axis = certificate;
        reference.reading_with_axis = reading;
        auto table = table_of({0, 180});
        table.forward[1] = {5, 5};
        EXPECT_TRUE(take_out_reference(reference, degrees_per_arcsec, 1, table));
        return table.forward[1][0];
    };
    EXPECT_EQ(second(true, true), 2);
    EXPECT_EQ(second(false, true), 8);
    EXPECT_EQ(second(true, false), -8);
    EXPECT_EQ(second(false, false), -2);
}

TEST(ReferenceAngles, DegreesAreConverted) {
    auto table = table_of({0, 180});
    table.forward[1] = {0.001, 0.001};
    ASSERT_TRUE(take_out_reference(polygon({0, 3.6}, {1, 2}), 1, 1, table));
    EXPECT_NEAR(table.forward[1][0], 0, 1e-18);
}

TEST(ReferenceAngles, FacesAreUsedAgainOnFurtherTurns) {
    const std::vector<double> faces{1, 2, 3, 4, 5, 6, 7, 8};
    std::vector<double> targets;
    std::vector<int> seen;
    for (int i = 0; i < 20; ++i) {
        targets.push_back(45.0 * i + 0.3); // 0.3 degree beside every face: the same for all
        seen.push_back(1 + i % 8);
    }
    auto table = table_of(targets);
    ASSERT_TRUE(take_out_reference(polygon(faces, seen), degrees_per_arcsec, 1, table));
    EXPECT_EQ(table.forward[10][0], -3);
}

std::string refused_field(const ReferenceAngles& reference, std::vector<double> targets) {
    auto table = table_of(std::move(targets));
    const auto result = take_out_reference(reference, degrees_per_arcsec, 1, table);
    return result ? "" : result.error().field;
}

TEST(ReferenceAngles, RefusesWhatIsNoFaceOrTheWrongOne) {
    EXPECT_EQ(refused_field(polygon({0}, {1, 1}), {0, 180}), "polygon.face_deviation_arcsec");
    EXPECT_EQ(refused_field(polygon({0, 1}, {1}), {0, 180}), "polygon.face_of_target");
    EXPECT_EQ(refused_field(polygon({0, 1}, {1, 3}), {0, 180}), "polygon.face_of_target[1]");
    EXPECT_EQ(refused_field(polygon({0, 1}, {0, 1}), {0, 180}), "polygon.face_of_target[0]");
    EXPECT_EQ(refused_field(polygon({0, 1, 2, 3}, {1, 2, 4, 3}), {0, 90, 180, 270}),
              "polygon.face_of_target[2]");
    EXPECT_EQ(refused_field(polygon({0, 1, 2, 3}, {1, 2, 3, 4}), {0, 90, 182, 270}),
              "polygon.face_of_target[2]");
}

TEST(ReferenceAnglesLaws, TheTruthBehindAnyArtefactIsFoundAgain) {
    std::mt19937_64 random{9107};
    std::normal_distribution<double> error{0, 5};
    for (int trial = 0; trial < 100; ++trial) {
        const int count = std::uniform_int_distribution<int>{3, 36}(random);
        std::vector<double> faces, targets, truth;
        std::vector<int> seen;
        const bool with_axis = trial % 2 == 0, reads_with = trial % 3 != 0;
        for (int i = 0; i < count; ++i) {
            faces.push_back(error(random));
            targets.push_back(360.0 / count * i);
            seen.push_back(trial % 5 == 0 ? (count - i) % count + 1 : i + 1);
            truth.push_back(error(random));
        }
        auto table = table_of(targets);
        for (std::size_t i = 0; i < targets.size(); ++i) {
            const double face = faces[static_cast<std::size_t>(seen[i] - 1)];
            const double seen_angle = truth[i] + (with_axis ? face : -face);
            table.forward[i] = table.backward[i] = {reads_with ? seen_angle : -seen_angle};
        }
        auto reference = polygon(faces, seen);
        reference.certificate_with_axis = with_axis;
        reference.reading_with_axis = reads_with;
        ASSERT_TRUE(take_out_reference(reference, degrees_per_arcsec, 1, table));
        for (std::size_t i = 0; i < targets.size(); ++i)
            EXPECT_NEAR(table.backward[i][0], truth[i], 1e-14);
    }
}

} // namespace
} // namespace axiscal::reference_angles_test
