#pragma once
// A circular test in a run file, written as a station writes it; its truth is known.

#include "acquisition/capture/stream_chunker.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/analysis/driven_bar.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace axiscal::test {

inline RunRecord circular_header() {
    RunRecord run;
    run.run_id = "bay3-circle";
    run.kind = TestKind::circular;
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
    run.statements.certificate_number = "N-17";
    ChannelCalibration table;
    table.channel = 5;
    table.certificate_number = "T-551";
    run.calibrations.push_back(table);
    return run;
}

inline DrivenBar bar_of_the_shop() {
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
inline std::string write_circles(const testing::ScratchFolder& scratch,
                                 const DrivenBar& bar,
                                 const StreamSamples& of,
                                 bool close = true,
                                 const RunAttachments& beside = {},
                                 const RunRecord& header = circular_header()) {
    const std::string path = scratch.file("circle.axiscal");
    auto writer = RunFileWriter::create(path, header, beside).value();
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
    if (!close) return path;
    EXPECT_TRUE(writer.close(true, "every circle was driven", {}));
    return path;
}

} // namespace axiscal::test
