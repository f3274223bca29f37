#pragma once
// A run record of a rotary axis behind an indexing table, made from a known truth: the sine of the
// rest written out, the index of simulated_run.hpp.

#include "simulated_run.hpp"

#include <numbers>

namespace axiscal::test {

inline constexpr double rad = std::numbers::pi / 180;

inline RotarySetup table_of_5_degrees() {
    RotarySetup setup;
    setup.step_deg = 5;
    setup.arm = mm(32.61);
    setup.range_deg = 10;
    return setup;
}

/// Eight targets with rests up to 2.5 degrees, three approaches each way.
struct TruthOfAngle {
    RotarySetup setup = table_of_5_degrees();
    double datum_deg = -3;
    Truth air;
    [[nodiscard]] static double deviation_deg(const PlannedPoint& point, double target_deg) {
        const double side = point.direction == Direction::positive ? 1 : -1;
        return (6 * std::sin(target_deg * rad) - 2 * side + 0.3 * point.approach) / 3600;
    }
    /// The upper part of the table stands turned by d, so that the rest is larger by d.
    [[nodiscard]] double table_deg(int position) const {
        const int count = static_cast<int>(setup.deviations_arcsec.size());
        const auto at = static_cast<std::size_t>((position % count + count) % count);
        return setup.deviations_arcsec[at] / 3600;
    }
    [[nodiscard]] Length reading(double angle_deg, int position, double at_s) const {
        const double rest = angle_deg - datum_deg - position * setup.step_deg + table_deg(position);
        const double n = 1 + true_index_minus_1(air, at_s);
        return mm(n * setup.arm.in(mm)*std::sin(rest * rad));
    }
    [[nodiscard]] RunRecord run() const {
        RunRecord run = simulated_run(air);
        run.rotary = setup;
        run.plan = {};
        run.plan.axis_kind = AxisKind::rotary;
        run.plan.approaches = 3;
        run.plan.datum = mm(datum_deg);
        for (const double target : {0.0, 46.3, 90.0, 132.9, 180.0, 224.4, 270.0, 318.8})
            run.plan.targets.push_back(mm(target));
        for (int j = 0; j < 3; ++j)
            for (const Direction direction : {Direction::positive, Direction::negative})
                for (int i = 0; i < 8; ++i) {
                    const int step = static_cast<int>(run.plan.points.size());
                    const int target = direction == Direction::positive ? i : 7 - i;
                    run.plan.points.push_back({step, target, direction, j});
                }
        run.datums.front().coordinate = mm(datum_deg);
        run.datums.front().reading = reading(datum_deg, 0, datum_s);
        run.points.clear();
        for (const PlannedPoint& planned : run.plan.points) {
            const double target =
                run.plan.targets[static_cast<std::size_t>(planned.target_index)].in(mm);
            const double middle_s = first_point_s + seconds_per_point * planned.step;
            PointRecord point;
            point.step = planned.step;
            point.planned = planned;
            point.window_begin = at_seconds(middle_s - 1);
            point.window_end = at_seconds(middle_s + 1);
            point.datum_id = run.datums.front().id;
            const int position = static_cast<int>(std::lround((target - datum_deg) / 5));
            point.reading = reading(target + deviation_deg(planned, target), position, middle_s);
            run.points.push_back(point);
        }
        return run;
    }
};

inline TruthOfAngle truth_with_a_bad_table() {
    TruthOfAngle truth;
    for (int k = 0; k < 72; ++k) // 8 seconds of arc, twice a turn; none at the datum
        truth.setup.deviations_arcsec.push_back(4 * std::cos(2 * k * 5 * rad) - 4 + 0.01 * k);
    return truth;
}

/// Eight faces before an autocollimator, the deviations of TruthOfAngle read off them: of the
/// reading a millimetre stands for a degree.
inline RunRecord polygon_run() {
    RunRecord run = truth_with_a_bad_table().run();
    run.rotary->deviations_arcsec.assign(run.plan.targets.size(), 0.0);
    run.rotary->method = AngleMethod::polygon;
    run.rotary->step_deg = 45;
    run.rotary->arm = {};
    run.rotary->range_deg = 0.2;
    run.laser = {};
    run.laser.instrument = "collimator";
    run.datums.front().reading = {};
    for (std::size_t face = 0; face < run.plan.targets.size(); ++face)
        run.plan.targets[face] = mm(45.0 * static_cast<double>(face));
    for (PointRecord& point : run.points)
        point.reading =
            mm(TruthOfAngle::deviation_deg(point.planned, 45.0 * point.planned.target_index));
    return run;
}

} // namespace axiscal::test
