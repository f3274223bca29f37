#pragma once
// A certificate of a simulated axis: its numbers come from a known truth, its statements are
// visibly made up.

#include "analysis/positioning/positioning_certificate.hpp"
#include "tests/unit/analysis/simulated_run.hpp"

#include <memory>
#include <random>
#include <stdexcept>

namespace axiscal::test {

inline Statements synthetic_statements() {
    Statements said;
    said.certificate_number = "SYNTHETIC-0001";
    said.customer = "Example customer";
    said.place = "Hall 3, bay 12";
    said.machine = "Machining centre MC-800";
    said.machine_maker = "Example Machine Works";
    said.machine_serial = "0815-4711";
    said.axis = "X";
    said.operator_name = "A. Operator";
    said.approver = "B. Approver";
    said.procedure = "QP-17, edition 3";
    said.state = "as found";
    said.control_compensation = "pitch and backlash on";
    said.feed = "3000 mm/min";
    said.dwell = "4 s";
    said.warm_up = "30 min of full strokes";
    said.offsets = "Y 0 mm, Z 250 mm from the spindle nose";
    said.idle_axes = "Y 250 mm, Z 300 mm";
    said.sensor_note = "sensors held by magnets";
    said.laboratory = "Example Calibration Laboratory";
    return said;
}

inline std::vector<InstrumentRecord> synthetic_instruments() {
    return {{"laser", "umd2", "Example Optics", "HeNe counter", "L-0042", "2.61", "C-2025-118",
             "2025-09-30", "2026-09-30"},
            {"air", "vcp", "Example Sensors", "PTH-1", "A-7", "1.0", "C-2025-119", "2025-10-02",
             "2026-10-02"},
            {"material", "modbus", "Example Sensors", "TH8", "M-3", "", "C-2025-120", "2025-10-02",
             "2026-10-02"}};
}

/// A 1 m axis with pitch error, backlash and noise; material 22.7 °C and rising, seeded.
inline Truth synthetic_truth(unsigned seed) {
    Truth truth;
    truth.form = ExpansionForm::first_order;
    truth.air_C = [](double s) { return 23.1 + 0.25 * std::sin(s / 700); };
    truth.material_C = [](double s) { return 22.7 + 0.3 * s / 2320; };
    truth.pressure_Pa = [](double s) { return 100870 - 0.02 * s; };
    truth.humidity_percent = [](double s) { return 43 + 1.5 * std::sin(s / 400); };
    auto random = std::make_shared<std::mt19937>(seed);
    truth.deviation_mm = [random](const PlannedPoint& point, double target_mm) {
        // the sum of twelve uniform draws: the same on every library
        double noise = -6;
        for (int i = 0; i < 12; ++i)
            noise += static_cast<double>((*random)()) / 4294967296.0;
        return 0.005 * std::sin(target_mm / 170) + 0.000009 * target_mm +
               (point.direction == Direction::positive ? 0.0013 : -0.0013) + 0.0005 * noise;
    };
    return truth;
}

inline RunRecord synthetic_run(unsigned seed = 1) {
    RunRecord run = simulated_run(synthetic_truth(seed));
    run.run_id = "20260101T000000Z-X";
    run.software_version = "0.1.0";
    run.station = "station 7";
    run.config_hash = std::string(64, 'c');
    run.plan.seed = 4711;
    run.plan.overrun = mm(2);
    run.plan.near_tolerance = mm(0.5);
    run.material.feedback = "linear scale";
    run.material.standard_uncertainty = per_kelvin(0.6e-6);
    run.statements = synthetic_statements();
    run.instruments = synthetic_instruments();
    return run;
}

inline Certificate certificate_of(RunRecord run, RunRevisions revisions = {}) {
    auto certificate = make_certificate(std::move(run), std::move(revisions), std::string(64, 'a'));
    if (!certificate) throw std::runtime_error(describe(certificate.error()));
    certificate->result_digest = std::string(64, 'd');
    return *std::move(certificate);
}

} // namespace axiscal::test
