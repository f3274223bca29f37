// Workpiece 1 with a machine whose nine curves are known.

#include "analysis/separation/single_axis_features.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace axiscal::single_axis_features_test {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

using Terms = PerCurve<std::vector<double>>;

SeparationModel box() {
    SeparationModel model;
    model.orders = {{{4, 3, 2}, {3, 4, 2}, {3, 3, 4}}};
    model.ranges_mm = {AxisRange{-60, 60}, AxisRange{-60, 60}, AxisRange{0, 80}};
    model.reference_mm = {0, 0, 40};
    return model;
}

Terms random_terms(std::mt19937_64& random, const SeparationModel& model) {
    std::normal_distribution<double> normal{0, 3};
    Terms terms;
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b)
            for (std::size_t k = 0; k < model.orders[a][b]; ++k)
                terms[a][b].push_back(normal(random));
    return terms;
}

struct Workpiece {
    std::vector<SingleAxisFeature> features;
    std::vector<std::vector<double>> deviations_um;
};

/// A feature along `axis`, read in `direction`, the others standing at `at` or stepping with it.
void add_feature(Workpiece& piece,
                 const SeparationModel& model,
                 const Terms& truth,
                 std::size_t axis,
                 std::size_t direction,
                 PerAxis<double> at,
                 PerAxis<double> step = {}) {
    SingleAxisFeature feature;
    feature.axis = axis;
    feature.direction = direction;
    std::vector<double> deviations;
    for (int i = 0; i < 9; ++i) {
        const AxisRange& range = model.ranges_mm[axis];
        PerAxis<double> point = at;
        point[axis] = range.from + (range.to - range.from) * (i + 0.5) / 9;
        for (std::size_t other = 0; other < 3; ++other)
            if (other != axis) point[other] += step[other] * i;
        const double deviation = deviation_from(truth, model, point)[direction];
        feature.nominal_mm.push_back(point[direction]);
        feature.on_machine_mm.push_back(point[direction]);
        feature.cmm_mm.push_back(point[direction] + deviation / 1000);
        for (std::size_t other = 0; other < 3; ++other)
            feature.positions_mm[other].push_back(point[other]);
        deviations.push_back(deviation);
    }
    piece.features.push_back(feature);
    piece.deviations_um.push_back(deviations);
}

/// All nine curves, in an order that is not the order of solution; z features step in x and y.
Workpiece whole(const SeparationModel& model, const Terms& truth) {
    Workpiece piece;
    for (std::size_t axis = 3; axis-- > 0;)
        for (std::size_t direction = 3; direction-- > 0;)
            add_feature(piece, model, truth, axis, direction, {-20, 40, 55},
                        axis == 2 ? PerAxis<double>{5, -8, 0} : PerAxis<double>{});
    return piece;
}

void expect_truth(const FeatureCurves& found, const Terms& truth) {
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) {
            ASSERT_TRUE(found.curves[a][b]) << a << b;
            for (std::size_t k = 0; k < truth[a][b].size(); ++k)
                EXPECT_NEAR(found.curves[a][b]->coefficients_um[k], truth[a][b][k], 1e-10);
        }
}

TEST(SingleAxisFeatures, DeviationsAreTheDifferencesOfTheReadings) {
    SingleAxisFeature feature;
    feature.nominal_mm = {10, 20};
    feature.on_machine_mm = {10.002, 19.999};
    feature.cmm_mm = {10.005, 19.997};
    const auto found = deviations_of(feature, "features[0]").value();
    const std::vector<double> dynamic{2, -1}, total{5, -3}, quasi_static{3, -2};
    for (std::size_t i = 0; i < 2; ++i) { // 20 mm in double: 4e-15 mm = 4e-12 um a reading
        EXPECT_NEAR(found.dynamic_um[i], dynamic[i], 1e-11);
        EXPECT_NEAR(found.total_um[i], total[i], 1e-11);
        EXPECT_NEAR(found.quasi_static_um[i], quasi_static[i], 1e-11);
    }
}

TEST(SingleAxisFeatures, FindTheNineCurvesOfASimulatedMachine) {
    std::mt19937_64 random{1};
    for (int trial = 0; trial < 20; ++trial) {
        SeparationModel model = box();
        for (auto& row : model.signs)
            for (double& sign : row)
                sign = std::bernoulli_distribution{}(random) ? 1 : -1;
        const Terms truth = random_terms(random, model);
        const Workpiece piece = whole(model, truth);
        const auto found = solve_features(piece.features, piece.deviations_um, model).value();
        EXPECT_TRUE(found.not_evaluated.empty());
        expect_truth(found, truth);
    }
}

TEST(SingleAxisFeatures, TwoFeaturesOfOneCurveKeepConstantsOfTheirOwn) {
    std::mt19937_64 random{2};
    const SeparationModel model = box();
    const Terms truth = random_terms(random, model);
    Workpiece piece;
    add_feature(piece, model, truth, 0, 1, {0, 40, 30});
    add_feature(piece, model, truth, 0, 1, {0, -40, 70});
    for (double& value : piece.deviations_um[1])
        value += 12;
    const auto found = solve_features(piece.features, piece.deviations_um, model).value();
    EXPECT_EQ(found.curves[1][0]->readings, 18u);
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(found.curves[1][0]->coefficients_um[k], truth[1][0][k], 1e-11);
}

TEST(SingleAxisFeatures, QuasiStaticCurvesLeaveTheDynamicOnesOfWorkpieceTwo) {
    // both parts are simulated; workpiece 1 gives one, the remainder of workpiece 2 the other
    std::mt19937_64 random{3};
    const SeparationModel model = box();
    const Terms quasi_static = random_terms(random, model), dynamic = random_terms(random, model);
    const Workpiece piece = whole(model, quasi_static);
    const auto found = solve_features(piece.features, piece.deviations_um, model).value();
    Terms known;
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b)
            known[a][b] = found.curves[a][b]->coefficients_um;
    SeparationCase second;
    second.model = model;
    std::uniform_real_distribution<double> any{-1, 1};
    for (int i = 0; i < 100; ++i) {
        const PerAxis<double> at{60 * any(random), 60 * any(random), 40 + 40 * any(random)};
        auto deviation = deviation_from(quasi_static, model, at);
        const auto more = deviation_from(dynamic, model, at);
        const auto taken = deviation_from(known, model, at);
        for (std::size_t a = 0; a < 3; ++a)
            deviation[a] += more[a] - taken[a];
        second.points_mm.push_back(at);
        second.deviation_um.push_back(deviation);
    }
    const auto rows = separate_errors(second).value();
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b)
            for (std::size_t k = 0; k < model.orders[a][b]; ++k)
                EXPECT_NEAR(rows[a].curves[b].coefficients_um[k], dynamic[a][b][k], 1e-9);
}

TEST(SingleAxisFeatures, SayWhatACurveLacks) {
    std::mt19937_64 random{4};
    const SeparationModel model = box();
    const Terms truth = random_terms(random, model);
    Workpiece piece;
    add_feature(piece, model, truth, 2, 0, {0, 0, 0}, {5, 0, 0}); // xz steps in x, xx is not there
    add_feature(piece, model, truth, 1, 1, {0, 0, 40});
    add_feature(piece, model, truth, 0, 1, {0, 0, 40});
    piece.features[2].positions_mm = {}; // yx: y is read, where x stood is not known
    auto& few = piece.features[1];
    few.nominal_mm.resize(4);
    for (auto& list : few.positions_mm)
        list.resize(4);
    piece.deviations_um[1].resize(4);
    const auto found = solve_features(piece.features, piece.deviations_um, model).value();
    EXPECT_NE(found.not_evaluated.at("xz").find("xx is not solved"), std::string::npos);
    EXPECT_NE(found.not_evaluated.at("yy").find("distinct positions"), std::string::npos);
    EXPECT_NE(found.not_evaluated.at("yx").find("positions_mm"), std::string::npos);
    EXPECT_EQ(found.not_evaluated.size(), 3u);
    for (const auto& row : found.curves)
        for (const auto& curve : row)
            EXPECT_FALSE(curve);
}

TEST(SingleAxisFeatures, RefuseListsThatDoNotFit) {
    const auto refused = [](auto change) {
        SingleAxisFeature feature;
        feature.nominal_mm = feature.on_machine_mm = feature.cmm_mm = {1, 2, 3};
        change(feature);
        const auto found = deviations_of(feature, "features[4]");
        return found ? std::string{} : found.error().field;
    };
    EXPECT_EQ(refused([](auto&) {}), "");
    EXPECT_EQ(refused([](auto& f) { f.nominal_mm.clear(); }), "features[4].nominal_mm");
    EXPECT_EQ(refused([](auto& f) { f.cmm_mm.pop_back(); }), "features[4].cmm_mm");
    EXPECT_EQ(refused([](auto& f) { f.on_machine_mm[1] = not_a_number; }),
              "features[4].on_machine_mm[1]");
    EXPECT_EQ(refused([](auto& f) { f.positions_mm[2] = {1}; }), "features[4].positions_mm");
}

} // namespace
} // namespace axiscal::single_axis_features_test
