// A bar driven through circles of known truth, written into a run file, read back and diagnosed.

#include "acquisition/documents/circular/circular_run_file.hpp"

#include "written_circle.hpp"

#include <gtest/gtest.h>

namespace axiscal::circular_run_file_test {
namespace {

using circular::Cause;
using testing::ScratchFolder;
using namespace test;

TEST(CircularRunFile, TheInjectedErrorsComeBackOfTheFile) {
    const ScratchFolder scratch;
    DrivenBar bar = bar_of_the_shop();
    const StreamSamples stream = bar.drive();
    const std::string path = write_circles(scratch, bar, stream);
    EXPECT_EQ(summarize_run_file(path)->kind, TestKind::circular);
    const auto run = circular_run_of(read_run_file_contents(path).value());
    ASSERT_TRUE(run) << run.error().detail;
    EXPECT_TRUE(run->complete);
    EXPECT_EQ(run->bar.instrument.serial, "QB-7");
    EXPECT_EQ(run->statements.customer, "Milling shop");
    ASSERT_EQ(run->calibrations.size(), 1U);
    EXPECT_EQ(run->calibrations[0].certificate_number, "T-551");
    EXPECT_EQ(run->gaps, 0U);
    EXPECT_NEAR(*run->machine_temperature.mean_degC, 21.0, 1e-12); // without the bar's own sensor
    EXPECT_NEAR(*run->bar_temperature.mean_degC, 20.5, 1e-12);
    EXPECT_NEAR(*run->air_temperature.mean_degC, 22.0, 1e-12);
    const auto found = diagnose_circle(mean_test(*run).value(), {"X", "Y"}).value();
    const double R = 100, F = bar.setup.plan.feed_mm_per_s;
    for (const Cause cause :
         {Cause::squareness, Cause::backlash_x, Cause::servo_lag_difference, Cause::backlash_y}) {
        const double leverage = leverage_of(cause, R, F);
        const auto& estimate = found.of(cause);
        // 0.1 um: steps shifted by the form at the ends, see CircleCut
        EXPECT_NEAR(*estimate.value * leverage, bar.truth[reference_name(cause)] * leverage,
                    3.5 * estimate.standard_uncertainty * leverage + 1e-4)
            << reference_name(cause);
    }
}

TEST(CircularRunFile, ARunWithoutCirclesIsRefused) {
    const ScratchFolder scratch;
    const std::string path = scratch.file("r.axiscal");
    RunRecord header = circular_header();
    header.kind = TestKind::positioning;
    ASSERT_TRUE(RunFileWriter::create(path, header));
    EXPECT_EQ(summarize_run_file(path)->kind, TestKind::positioning);
    const auto run = circular_run_of(read_run_file_contents(path).value());
    ASSERT_FALSE(run);
    EXPECT_EQ(run.error().fault, Fault::refused);
}

} // namespace
} // namespace axiscal::circular_run_file_test
