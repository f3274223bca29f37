// A bar driven through circles of known truth, written into a run file, read back and diagnosed.

#include "acquisition/publish/circular_run_file.hpp"

#include "acquisition/capture/stream_chunker.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/analysis/driven_bar.hpp"

#include <gtest/gtest.h>

namespace axiscal {
namespace {

using circular::Cause;
using testing::ScratchFolder;
using namespace test;

RunRecord header_of() {
    RunRecord run;
    run.run_id = "bay3-circle";
    run.plan.pass = circular_pass;
    run.plan.approaches = 0;
    InstrumentRecord bar;
    bar.name = "ballbar";
    bar.serial = "QB-7";
    run.instruments.push_back(bar);
    run.channels.push_back({4, "ballbar", "ballbar", "", ChannelKind::displacement, Medium::none});
    run.channels.push_back({5, "table", "t", "", ChannelKind::temperature, Medium::material});
    run.channels.push_back({6, "bar", "t", "", ChannelKind::temperature, Medium::material});
    run.channels.push_back({7, "air", "t", "", ChannelKind::temperature, Medium::air});
    run.statements.customer = "Milling shop";
    return run;
}

DrivenBar bar_of_the_shop() {
    DrivenBar bar;
    bar.setup.plan.nominal_radius_mm = 100;
    bar.setup.plan.feed_mm_per_s = 2000.0 / 60;
    bar.setup.plan.arc_deg = 220;
    bar.setup.plan.start_deg = -20;
    bar.setup.plan.overshoot_deg = 10;
    bar.setup.bar_instrument = "ballbar";
    bar.setup.bar_temperature_channel = 6;
    bar.setup.capture.sample_rate_hz = 1000;
    bar.noise_mm = 2e-4;
    bar.truth = {{"square", 40e-6}, {"backlash_x", 0.005}, {"servo", 2e-4}, {"scale_x", 30e-6}};
    return bar;
}

/// Writes the stream as a station does; environment every 5 s: 20.5, 21.0 and 22.0 degC.
std::string write_run(const ScratchFolder& scratch, const DrivenBar& bar, const StreamSamples& of) {
    const std::string path = scratch.file("circle.axiscal");
    auto writer = RunFileWriter::create(path, header_of()).value();
    RunBatch first;
    first.circular = bar.setup;
    first.streams.push_back({0, 4, "ballbar", "m", 1000});
    for (const auto& [number, at] : bar.begun)
        first.events.push_back({EventKind::note, at, 0, "circle", Fault::none,
                                static_cast<std::uint16_t>(number == 0 ? 99 : number)});
    EXPECT_TRUE(writer.write(first));
    StreamChunker chunker{0};
    for (std::size_t i = 0; i < of.at.size(); ++i) {
        RunBatch batch;
        if (auto chunk = chunker.push({4, of.at[i], of.value[i], i + 1, 1}))
            batch.chunks.push_back(*std::move(chunk));
        if (i % 5000 == 0)
            for (const auto& [channel, degC] : {std::pair{5, 21.0}, {6, 20.5}, {7, 22.0}})
                batch.environment.push_back({channel, of.at[i], degC});
        EXPECT_TRUE(writer.write(batch));
    }
    RunBatch last;
    last.chunks.push_back(chunker.finish().value());
    EXPECT_TRUE(writer.write(last));
    EXPECT_TRUE(writer.close(true, "every circle was driven", {}));
    return path;
}

TEST(CircularRunFile, TheInjectedErrorsComeBackOfTheFile) {
    const ScratchFolder scratch;
    DrivenBar bar = bar_of_the_shop();
    const StreamSamples stream = bar.drive();
    const std::string path = write_run(scratch, bar, stream);
    EXPECT_TRUE(is_circular_run(path).value());
    const auto run = read_circular_run(path);
    ASSERT_TRUE(run) << run.error().detail;
    EXPECT_TRUE(run->complete);
    EXPECT_EQ(run->bar.instrument.serial, "QB-7");
    EXPECT_EQ(run->statements.customer, "Milling shop");
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
    RunRecord header = header_of();
    header.plan.pass = "whole";
    ASSERT_TRUE(RunFileWriter::create(path, header));
    EXPECT_FALSE(is_circular_run(path).value());
    const auto run = read_circular_run(path);
    ASSERT_FALSE(run);
    EXPECT_EQ(run.error().fault, Fault::refused);
}

} // namespace
} // namespace axiscal
