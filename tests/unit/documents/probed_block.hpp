#pragma once
// A block probed at 480 mm/min, 8 um in a millisecond, by a probe and a control whose delays are
// known. The last two are what they are by hand; the first is the control's latch written out.
//   -X  the control latches at ticks of 1 ms, 2 ms late: 0.2 ms a step of 1.6 um, hence five places
//       in the tick that lie 0.8 ms apart at most: 6.4 um
//   -Y  one touch is 5 ms later than the others: 0.040 mm, the example of ISO 230-10, 6.9
//   -Z  5 um from growing distances, 3 um of the references: net sqrt(5^2 - 3^2) = 4 um

#include "analysis/record/probing_record.hpp"
#include "analysis/record/run_record.hpp"

#include <cstddef>

namespace axiscal::test {

inline constexpr double probing_feed_mm_per_min = 480, um_in_a_ms = 8;
inline constexpr int block_touches = 11, block_references = 5;

/// How late the latch of a touch is, in um of travel; a reference starts where touch 0 does.
inline double true_lateness_um(std::size_t axis, bool reference, int number) {
    const double constant_um = 2 * um_in_a_ms;
    if (axis == 0) {
        const int before = reference ? 0 : 2 * number;
        const int tenths_of_tick = ((5 - before) % 10 + 10) % 10; // until the next tick
        return constant_um + um_in_a_ms * tenths_of_tick / 10;
    }
    if (axis == 1) return constant_um + (!reference && number == 6 ? 5 * um_in_a_ms : 0);
    return constant_um + (number % 2 == 0 ? 0 : reference ? 3 : 5);
}

inline ProbingTouch true_touch(std::size_t axis, bool reference, int number) {
    ProbingTouch touch;
    touch.direction[axis] = -1;
    touch.reference = reference;
    touch.approach = mm(2 + (reference ? 0 : 0.0016 * number));
    touch.latched = {mm(-10), mm(-10), mm(-10)};
    touch.latched[axis] = um(-true_lateness_um(axis, reference, number));
    return touch;
}

/// Five references and eleven touches of each face, in the order of the part program.
inline ProbingRecord probed_block() {
    ProbingRecord record;
    record.feed_mm_per_min = probing_feed_mm_per_min;
    record.probe = "touch-trigger probe, stylus 6 mm";
    record.signal_path = "skip input";
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < block_references; ++i)
            record.touches.push_back(true_touch(axis, true, i));
        for (int i = 0; i < block_touches; ++i)
            record.touches.push_back(true_touch(axis, false, i));
    }
    return record;
}

/// Of a log that was read on 2026-01-01 at 01:00 UTC.
inline RunRecord probing_header() {
    RunRecord run;
    run.run_id = "20260101T010000Z-probing";
    run.software_version = "0.1.0";
    run.station = "station 7";
    run.kind = TestKind::probing;
    run.laser.instrument = "none";
    const ClockTie tie{MonotonicTime{}, 1'767'229'200'000'000'000, MonotonicTime{}};
    run.opened = run.closed = tie;
    run.complete = true;
    return run;
}

} // namespace axiscal::test
