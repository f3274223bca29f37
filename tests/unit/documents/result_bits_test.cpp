// The same run of a linear axis gives the same bits on every compiler, optimisation and preset. The
// digest below is no known answer (those are in tests/unit/analysis): it only ties the presets to
// each other. It may change only together with a formula, and then the commit says why.

#include "acquisition/documents/result_digest.hpp"
#include "analysis/positioning/positioning_certificate.hpp"
#include "tests/unit/analysis/simulated_run.hpp"
#include "tests/unit/analysis/stated_uncertainty.hpp"

#include <bit>
#include <gtest/gtest.h>

namespace axiscal::result_bits_test {
namespace {

/// No number here comes from a mathematics library: its last bits differ between systems.
RunRecord run_of_plain_arithmetic() {
    test::Truth truth;
    truth.material_C = [](double s) { return 21 + 3 * s / 2300; };
    truth.air_C = [](double s) { return 20 + 2 * s / 2300; };
    RunRecord run = test::simulated_run(truth);
    for (PointRecord& point : run.points) {
        const auto target = static_cast<std::size_t>(point.planned.target_index);
        const int scatter_nm = point.planned.step * 7919 % 1000;
        point.reading = run.plan.targets[target] * 1.0003 + nm(scatter_nm);
    }
    return run;
}

TEST(ResultBits, AreTheSameOnEveryPreset) {
    const auto certificate = make_certificate(run_of_plain_arithmetic(), "");
    ASSERT_TRUE(certificate.has_value());
    EXPECT_EQ(result_digest(certificate->result),
              "4e3a6b01cc48de0a8abbdbbaf61199ab8d2ccd3d86a123d51ee28ab610f4cd64");
}

TEST(ResultBits, OfTheSimulationAreTheSameOnEveryPreset) {
    RunRecord run = run_of_plain_arithmetic();
    run.uncertainty = test::stated_uncertainty();
    run.plan.seed = 1;
    const auto certificate = make_certificate(std::move(run), "");
    ASSERT_TRUE(certificate.has_value());
    std::uint64_t digest = 0xcbf29ce484222325; // FNV-1a over whole words
    for (const MonteCarloFigure& figure : certificate->uncertainty.simulation->figures)
        for (const double number :
             {figure.mean, figure.u, figure.interval.symmetric.low, figure.interval.symmetric.high,
              figure.interval.shortest.low, figure.interval.shortest.high})
            digest = (digest ^ std::bit_cast<std::uint64_t>(number)) * 0x100000001b3;
    EXPECT_EQ(digest, 12177281050924155743U);
}

} // namespace
} // namespace axiscal::result_bits_test
