#pragma once
// A run of a linear axis that a linear scale measured, made from a known truth: lengths grow by
// (1 + alpha dT), and a scale that grows counts less. No air anywhere.

#include "tests/unit/analysis/simulated_run.hpp"

#include <functional>

namespace axiscal::test {

struct ScaleTruth {
    double machine_per_K = 11.7e-6, scale_per_K = 8.5e-6;
    int sign = 1;
    ExpansionForm form = ExpansionForm::exact;
    std::function<double(double)> machine_C = [](double) { return 24.0; }; ///< of seconds
    std::function<double(double)> scale_C = [](double) { return 26.5; };
    /// deviation at 20 degC in mm
    std::function<double(const PlannedPoint&, double target_mm)> deviation_mm =
        [](const PlannedPoint& point, double target_mm) {
            return 0.003 * std::sin(target_mm / 140) +
                   (point.direction == Direction::positive ? 0.001 : -0.001);
        };
};

inline constexpr int machine_channel = 1, scale_channel = 2;

inline void add_scale_environment(RunRecord& run, const ScaleTruth& truth) {
    run.channels = {
        {0, "axis 1", "scale", "", ChannelKind::displacement, Medium::none, 0},
        {machine_channel, "bed", "mat", "bed", ChannelKind::temperature, Medium::material, 0},
        {scale_channel, "glass", "mat", "scale", ChannelKind::temperature, Medium::material, 0}};
    for (double s = 0; s <= first_point_s + seconds_per_point * 111; s += 10) {
        run.environment.push_back({machine_channel, at_seconds(s), truth.machine_C(s)});
        run.environment.push_back({scale_channel, at_seconds(s), truth.scale_C(s)});
    }
}

/// What the scale counts from the datum at 0 mm, where its zero lies.
inline double counted_mm(const ScaleTruth& truth, double position_mm, double at_s) {
    const double grown_mm = position_mm * (1 + truth.machine_per_K * (truth.machine_C(at_s) - 20));
    return truth.sign * grown_mm / (1 + truth.scale_per_K * (truth.scale_C(at_s) - 20));
}

inline RunRecord run_by_scale(const ScaleTruth& truth) {
    RunRecord run;
    run.run_id = "scale-run";
    run.plan = plan_of_1m_axis();
    run.laser.instrument = "scale";
    run.laser.sign = truth.sign;
    run.material.coefficient = per_kelvin(truth.machine_per_K);
    run.material.form = truth.form;
    run.scale = ScaleSetup{um(0.1), per_kelvin(truth.scale_per_K), {}, {}, {scale_channel}};
    add_scale_environment(run, truth);
    add_points(run, truth, -3.5, counted_mm); // a counter need not be zero at the datum
    run.complete = true;
    run.opened = {at_seconds(0), 1'767'225'600'000'000'000, at_seconds(0)}; // 2026-01-01T00:00:00Z
    run.closed = {at_seconds(3600), 1'767'229'200'000'000'000, at_seconds(3600)};
    return run;
}

} // namespace axiscal::test
