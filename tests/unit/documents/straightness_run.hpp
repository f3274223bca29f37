#pragma once
// A bow of 4 um over 400 mm, measured through a Wollaston prism twice in each direction. What it
// comes to is computed by straightness_numbers.py.

#include "acquisition/runfile/run_file.hpp"
#include "analysis/record/run_attachments.hpp"
#include "analysis/record/run_record.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace axiscal::test {

inline constexpr int bow_targets = 5, bow_approaches = 2;
using BowRows = std::array<std::array<double, bow_approaches>, bow_targets>;
inline constexpr BowRows bow_forward_um{
    {{{0.0, 0.2}}, {{3.0, 3.4}}, {{5.0, 5.2}}, {{4.4, 4.0}}, {{2.2, 2.0}}}};
inline constexpr BowRows bow_backward_um{
    {{{-0.4, -0.2}}, {{2.6, 2.2}}, {{4.4, 4.6}}, {{3.4, 3.6}}, {{1.4, 1.6}}}};

/// Everything is stated that a budget needs; one count of 0.1 nm is 3.6 nm across.
inline StraightnessSetup bow_setup() {
    StraightnessSetup setup;
    setup.across = "Y";
    setup.factor = 36;
    setup.resolution = nm(0.1);
    setup.place = "prism on the table";
    setup.uncertainty.factor_U = percent(0.5);
    setup.uncertainty.mirror_limit_um_per_m2 = 0.15;
    setup.uncertainty.eve = um(0.4);
    return setup;
}

inline RunPlan bow_plan() {
    RunPlan plan;
    plan.approaches = bow_approaches;
    for (int i = 0; i < bow_targets; ++i)
        plan.targets.push_back(mm(100.0 * i));
    int step = 0;
    for (int approach = 0; approach < bow_approaches; ++approach) {
        for (int i = 0; i < bow_targets; ++i)
            plan.points.push_back({step++, i, Direction::positive, approach});
        for (int i = bow_targets; i-- > 0;)
            plan.points.push_back({step++, i, Direction::negative, approach});
    }
    return plan;
}

/// What the laser counts of the deviation, from a datum at 1 mm of its reading.
inline PointRecord bow_point(const PlannedPoint& planned, const StraightnessSetup& setup) {
    constexpr double refractive_index = 1.000271;
    const auto target = static_cast<std::size_t>(planned.target_index);
    const auto approach = static_cast<std::size_t>(planned.approach);
    const BowRows& rows =
        planned.direction == Direction::positive ? bow_forward_um : bow_backward_um;
    PointRecord point;
    point.step = planned.step;
    point.planned = planned;
    point.window_begin = point.window_end = monotonic_from_ns(1'000'000'000LL * planned.step);
    point.reading =
        mm(1) + um(rows[target][approach] * refractive_index / (setup.sign * setup.factor));
    point.datum_id = "L-1/1/1";
    return point;
}

/// Measured on 2026-01-01 from 01:00 UTC, for a minute.
inline RunRecord bow_run(const StraightnessSetup& setup) {
    constexpr std::int64_t utc_ns = 1'767'229'200'000'000'000, minute_ns = 60'000'000'000;
    RunRecord run;
    run.run_id = "station-20260101T010000Z-X";
    run.software_version = "0.1.0";
    run.station = "station 7";
    run.kind = TestKind::straightness;
    run.statements.axis = "X";
    run.laser.instrument = "laser";
    run.opened = {MonotonicTime{}, utc_ns, MonotonicTime{}};
    const MonotonicTime end = monotonic_from_ns(minute_ns);
    run.closed = {end, utc_ns + minute_ns, end};
    run.complete = true;
    run.closing_reason = "Every planned point is durable.";
    run.plan = bow_plan();
    DatumRecord datum;
    datum.id = "L-1/1/1";
    datum.reading = mm(1);
    run.datums = {datum};
    for (const PlannedPoint& planned : run.plan.points)
        run.points.push_back(bow_point(planned, setup));
    return run;
}

/// As it is read from a closed run file.
inline RunFileContents bow_contents(const StraightnessSetup& setup = bow_setup()) {
    RunFileContents contents;
    contents.run = bow_run(setup);
    contents.attachments.setup = setup;
    contents.closed = true;
    contents.revisions.closings = 1;
    return contents;
}

/// The same run as a file.
inline void write_bow(const std::string& path, const RunFileContents& contents) {
    auto writer = RunFileWriter::create(path, contents.run, contents.attachments).value();
    RunBatch tied;
    tied.datum = contents.run.datums.front();
    EXPECT_TRUE(writer.write(tied));
    for (const PointRecord& point : contents.run.points) {
        RunBatch batch;
        batch.point = point;
        EXPECT_TRUE(writer.write(batch));
    }
    if (contents.closed) {
        EXPECT_TRUE(
            writer.close(contents.run.complete, contents.run.closing_reason, contents.run.closed));
    }
}

} // namespace axiscal::test
