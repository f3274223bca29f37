#pragma once
// A run record made from a known truth by formulas that the analysis does not use: exact expansion,
// Boensch and Potulski's index with Ciddor's exponential saturation pressure, the optical path
// written out.

#include "analysis/record/run_record.hpp"

#include <cmath>
#include <functional>
#include <string>

namespace axiscal::test {

struct Truth {
    double datum_mm = 0, dead_path_mm = 300;
    double expansion_per_K = 11.7e-6;
    double beam_tangent = 0; ///< tan of the angle between beam and axis
    int sign = 1;
    ExpansionForm form = ExpansionForm::exact;
    AirFormula formula = AirFormula::ciddor;
    std::function<double(double)> material_C = [](double) { return 23.0; }; ///< of seconds
    std::function<double(double)> air_C = [](double) { return 22.0; };
    std::function<double(double)> pressure_Pa = [](double) { return 100400.0; };
    std::function<double(double)> humidity_percent = [](double) { return 45.0; };
    /// deviation at 20 degC in mm
    std::function<double(const PlannedPoint&, double target_mm)> deviation_mm =
        [](const PlannedPoint& point, double target_mm) {
            return 0.004 * std::sin(target_mm / 170) + 0.000012 * target_mm +
                   (point.direction == Direction::positive ? 0.0015 : -0.0015) +
                   0.0002 * point.approach;
        };
};

inline constexpr double seconds_per_point = 20, first_point_s = 100, datum_s = 60;

/// n - 1 by Boensch and Potulski 1998, 450 ppm CO2, 632.9908 nm.
inline double true_index_minus_1(const Truth& truth, double at_s) {
    const double t = truth.air_C(at_s), p = truth.pressure_Pa(at_s), kelvins = t + 273.15;
    const double saturation_Pa =
        std::exp(1.2378847e-5 * kelvins * kelvins - 1.9121316e-2 * kelvins + 33.93711047 -
                 6343.1645 / kelvins);
    const double vapour_Pa = truth.humidity_percent(at_s) / 100 * saturation_Pa;
    const double s = 1 / (0.6329908 * 0.6329908);
    const double standard =
        1e-8 * (8091.37 + 2333983 / (130 - s) + 15518 / (38.9 - s)) * (1 + 0.5327e-6 * (450 - 400));
    return standard * p / 93214.60 * (1 + 1e-8 * (0.5953 - 0.009876 * t) * p) / (1 + 0.003661 * t) -
           1e-10 * (3.8020 - 0.0384 * s) * vapour_Pa;
}

/// What the counter holds when the axis stands (at 20 degC terms) at `position_mm`.
inline double true_reading_mm(const Truth& truth, double position_mm, double at_s) {
    const double strain = truth.expansion_per_K * (truth.material_C(at_s) - 20);
    const double along_axis = truth.sign * (position_mm - truth.datum_mm) * (1 + strain);
    const double along_beam = along_axis / std::sqrt(1 + truth.beam_tangent * truth.beam_tangent);
    const double n = 1 + true_index_minus_1(truth, at_s);
    const double n_at_datum = 1 + true_index_minus_1(truth, datum_s);
    return n * (truth.dead_path_mm + along_beam) - n_at_datum * truth.dead_path_mm;
}

inline MonotonicTime at_seconds(double seconds) {
    return MonotonicTime{from_seconds(seconds)};
}

inline RunPlan plan_of_1m_axis() {
    RunPlan plan;
    plan.interval = mm(100);
    for (int i = 0; i < 11; ++i)
        plan.targets.push_back(mm(i * 95.3 + 12.417));
    const int m = static_cast<int>(plan.targets.size());
    for (int approach = 0; approach < plan.approaches; ++approach)
        for (const Direction direction : {Direction::positive, Direction::negative})
            for (int k = 0; k < m; ++k) {
                const int target = direction == Direction::positive ? k : m - 1 - k;
                const int step = static_cast<int>(plan.points.size());
                plan.points.push_back({step, target, direction, approach});
            }
    return plan;
}

inline void add_environment(RunRecord& run, const Truth& truth) {
    run.channels = {
        {1, "air temperature", "air", "beam", ChannelKind::temperature, Medium::air, 0},
        {2, "air pressure", "air", "beam", ChannelKind::pressure, Medium::air, 0},
        {3, "air humidity", "air", "beam", ChannelKind::humidity, Medium::air, 0},
        {4, "scale left", "mat", "x = 0", ChannelKind::temperature, Medium::material, 0},
        {5, "scale right", "mat", "x = 1 m", ChannelKind::temperature, Medium::material, 0}};
    const double end_s = first_point_s + seconds_per_point * 111;
    for (double s = 0; s <= end_s; s += 10) {
        const MonotonicTime at = at_seconds(s);
        run.environment.push_back({1, at, truth.air_C(s)});
        run.environment.push_back({2, at, truth.pressure_Pa(s)});
        run.environment.push_back({3, at, truth.humidity_percent(s)});
        run.environment.push_back({4, at, truth.material_C(s) - 0.25});
        run.environment.push_back({5, at, truth.material_C(s) + 0.25});
    }
}

/// The datum, and each planned point where its target and the truth's deviation put it.
/// `beyond_mm` gives what the counter holds beyond `offset_mm` at a position and a time in
/// seconds.
template <typename AnyTruth, typename Counted>
void add_points(RunRecord& run, const AnyTruth& truth, double offset_mm, const Counted& beyond_mm) {
    DatumRecord datum;
    datum.id = "serial/0/1";
    datum.at = at_seconds(datum_s);
    datum.coordinate = run.plan.datum;
    datum.reading = mm(offset_mm);
    run.datums = {datum};
    for (const PlannedPoint& planned : run.plan.points) {
        const double middle_s = first_point_s + seconds_per_point * planned.step;
        const double target_mm =
            run.plan.targets[static_cast<std::size_t>(planned.target_index)].in(mm);
        PointRecord point;
        point.step = planned.step;
        point.planned = planned;
        point.window_begin = at_seconds(middle_s - 1);
        point.window_end = at_seconds(middle_s + 1);
        point.datum_id = datum.id;
        const double position_mm = target_mm + truth.deviation_mm(planned, target_mm);
        point.reading = mm(offset_mm + beyond_mm(truth, position_mm, middle_s));
        run.points.push_back(point);
    }
}

inline void add_points(RunRecord& run, const Truth& truth) {
    add_points(run, truth, 17.25, true_reading_mm); // a counter need not be zero at the datum
}

inline RunRecord simulated_run(const Truth& truth) {
    RunRecord run;
    run.run_id = "test-run";
    run.plan = plan_of_1m_axis();
    run.plan.datum = mm(truth.datum_mm);
    run.laser.vacuum_wavelength = nm(632.9908);
    run.laser.sign = truth.sign;
    run.laser.dead_path = mm(truth.dead_path_mm);
    run.laser.beam_walk_travel = mm(1000);
    run.laser.beam_walk = mm(2000 * truth.beam_tangent);
    run.material.coefficient = per_kelvin(truth.expansion_per_K);
    run.material.form = truth.form;
    run.air.formula = truth.formula;
    add_environment(run, truth);
    add_points(run, truth);
    run.complete = true;
    run.opened = {at_seconds(0), 1'767'225'600'000'000'000, at_seconds(0)}; // 2026-01-01T00:00:00Z
    run.closed = {at_seconds(3600), 1'767'229'200'000'000'000, at_seconds(3600)};
    return run;
}

} // namespace axiscal::test
