#pragma once
// Certificates of circles from a known truth; the statements are visibly made up.

#include "analysis/circular/circular_certificate.hpp"
#include "tests/unit/analysis/synthetic_circle.hpp"

#include <algorithm>
#include <random>
#include <stdexcept>

namespace axiscal::test {

/// Scale, squareness, lag, backlash and an offset centre: 5 to 15 um.
inline CircleTruth circular_truth() {
    return {{"off_x_ccw", 0.012},   {"off_y_ccw", -0.007}, {"off_x_cw", 0.0125},
            {"off_y_cw", -0.0066},  {"scale_x", 12e-6},    {"scale_y", -8e-6},
            {"square", 22e-6},      {"servo", 150e-6},     {"backlash_x", 0.0032},
            {"backlash_y", -0.0012}};
}

/// Every 0.4 deg from `from_deg` over `arc_deg`; noise of `noise_mm` out of the seed.
inline CircularTest circular_test(const CircleTruth& truth,
                                  unsigned seed,
                                  double from_deg = 0,
                                  double arc_deg = 360,
                                  double noise_mm = 0.0002) {
    CircularTest made = made_test(truth, even_angles(from_deg, from_deg + arc_deg, 0.4));
    std::mt19937 random{seed};
    for (CircularTrace& trace : made.traces)
        for (double& deviation : trace.radial_deviation_mm)
            deviation += noise_mm * (static_cast<double>(random()) / 2147483648.0 - 1);
    return made;
}

inline CircularUncertaintyStatement circular_statement() {
    CircularUncertaintyStatement stated;
    stated.device_width_um = 0.6;
    stated.calibration_U_um = 1.0;
    stated.calibration_k = 2;
    stated.repeatability_um = 0.4;
    stated.eve_um = 0.5;
    stated.machine_temperature_width_K = stated.bar_temperature_width_K = 1.0;
    stated.machine_alpha_width_per_K = 2e-6;
    stated.bar_alpha_width_per_K = 1e-6;
    return stated;
}

inline Statements circular_statements() {
    Statements said;
    said.certificate_number = "SYNTHETIC-C-0001";
    said.customer = "Example customer";
    said.place = "Hall 3, bay 12";
    said.machine = "Machining centre MC-800";
    said.machine_maker = "Example Machine Works";
    said.machine_serial = "0815-4711";
    said.operator_name = "A. Operator";
    said.approver = "B. Approver";
    said.procedure = "QP-18, edition 1";
    said.state = "as found";
    said.control_compensation = "pitch and backlash on";
    said.warm_up = "30 min of circles";
    said.idle_axes = "Z 300 mm";
    said.laboratory = "Example Calibration Laboratory";
    return said;
}

/// Two repeats of each sense and one to warm up; everything stated.
inline CircularRun circular_run(unsigned seed = 1) {
    CircularRun run;
    run.run_id = "20260101T000000Z-XY";
    run.software_version = "0.1.0";
    run.station = "station 7";
    run.config_hash = std::string(64, 'c');
    run.opened.utc_ns = 1767225600'000'000'000;
    run.closed.before = run.closed.after = monotonic_from_ns(3600'000'000'000);
    run.closed.utc_ns = 1767229200'000'000'000; // 2026-01-01 01:00 UTC
    run.complete = true;
    run.plan.nominal_radius_mm = 150;
    run.plan.feed_mm_per_s = 1000.0 / 60;
    run.plan.repeats = 2;
    run.plan.warm_up = 1;
    run.plan.centre_mm = {400, 250.5, -120};
    run.plan.tool_offset = "120 mm from the spindle nose";
    run.plan.work_offset = "80 mm above the table";
    run.capture.sample_rate_hz = 1000;
    run.bar.length_mm = 150.0123;
    run.bar.alpha_per_K = 1.2e-6;
    run.machine_alpha_per_K = 11.5e-6;
    run.statements = circular_statements();
    run.instruments = {{"ballbar", "u6", "Example Optics", "LVDT bar 150", "B-0042", "1.0",
                        "C-2025-200", "2025-09-30", "2026-09-30"}};
    run.bar_temperature = {22.4, 22.3, 22.5, "bar"};
    run.machine_temperature = {23.1, 23.0, 23.2, "table"};
    run.air_temperature = {21.7, 21.5, 21.9, "air"};
    run.uncertainty = circular_statement();
    for (int repeat = 0; repeat <= 2; ++repeat)
        for (const CircularTrace& trace :
             circular_test(circular_truth(), seed + static_cast<unsigned>(repeat)).traces) {
            CircleCapture circle;
            circle.trace = trace;
            circle.repeat = std::max(repeat, 1);
            circle.warm_up = repeat == 0;
            circle.residual_mm = 0.012;
            run.circles.push_back(circle);
        }
    return run;
}

inline CircularCertificate certificate_of(CircularMeasurement measured) {
    auto made = evaluate_measurement(std::move(measured), std::string(64, 'a'));
    if (!made) throw std::runtime_error{describe(made.error())};
    made->result_digest = std::string(64, 'b');
    return *std::move(made);
}

inline CircularCertificate circular_certificate(CircularRun run = circular_run()) {
    auto measured = measurement_of(std::move(run));
    if (!measured) throw std::runtime_error{describe(measured.error())};
    measured->trials = 50;
    return certificate_of(*std::move(measured));
}

/// As a case brings it: readings and nothing else.
inline CircularMeasurement bare_measurement(CircularTest of) {
    CircularMeasurement measured;
    measured.taken_elsewhere = true;
    measured.test = std::move(of);
    return measured;
}

inline CircularMeasurement one_sense(unsigned seed, Sense sense) {
    CircularMeasurement measured = bare_measurement(circular_test(circular_truth(), seed));
    std::erase_if(measured.test.traces,
                  [&](const CircularTrace& trace) { return trace.sense != sense; });
    return measured;
}

} // namespace axiscal::test
