#pragma once
// What a scenario file says: the machine's hidden truth and the faces that show it. Plain data.

#include "analysis/quantity/result.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace axiscal::simulate {

/// A quantity that changes slowly: start + rate t + swing sin(2 pi t / period).
struct SlowSignal {
    double start = 0, rate_per_hour = 0, swing = 0, period_s = 600;
    [[nodiscard]] double at(double seconds) const;
};

struct PeriodicError {
    double amplitude_um = 0, period_mm = 10, phase_deg = 0;
};
struct TablePoint {
    double position_mm = 0, error_um = 0;
};

struct AxisScenario {
    std::string name = "X";
    char letter = 'X';
    double start_mm = 0, travel_low_mm = -1e6, travel_high_mm = 1e6;
    double rapid_mm_per_min = 12000, acceleration_mm_per_s2 = 2000;
};

/// The errors of the axis at 20 C; all in um over mm.
struct ErrorScenario {
    double linear_um_per_m = 0, quadratic_um_per_m2 = 0, cubic_um_per_m3 = 0, centre_mm = 0;
    std::vector<TablePoint> table; ///< pitch error, straight between points, held outside
    std::vector<PeriodicError> periodic;
    double reversal_um = 0, reversal_slope_um_per_m = 0; ///< B; negative: approaches stop short
    double approach_noise_um = 0;                        ///< sigma, drawn anew at each stop
    double noise_um = 0;                                 ///< sigma per sample
    double vibration_um = 0, vibration_hz = 50, drift_um_per_hour = 0;
};

struct ThermalScenario {
    double expansion_um_per_m_k = 11.7, fixed_point_mm = 0;
    SlowSignal material{20, 0, 0, 600};
    std::vector<double> sensor_difference_k{0, 0}; ///< of each contact sensor; mean 0
    /// Of a linear scale in the laser's place over the material; a tM-TH8 shows the scale's
    /// temperature behind the contact sensors.
    double scale_warmer_k = 0;
};

struct AirScenario {
    SlowSignal temperature{20, 0, 0, 600}, pressure_pa{101325, 0, 0, 600},
        humidity_percent{50, 0, 0, 600};
    double co2_ppm = 450;
};

struct LaserScenario {
    std::string kind =
        "umd2-homodyne"; ///< umd0, umd1, umd2-homodyne, umd2-heterodyne, ids3010, hpi-3d
    std::string path;
    double wavelength_nm = 632.991354;
    int fold = 2, counts_per_cycle = 4, phase_bits = 16, fields = 8;
    int sign = 1;                         ///< +1: the axis moves away from the interferometer
    double dead_path_mm = 0, zero_mm = 0; ///< distance to the reflector when the axis is at zero_mm
    std::optional<double> rate_hz;
    bool partial_first_line = false;
    int port = 0;                 ///< ids3010: where it listens; 0 chooses
    bool device_corrects = false; ///< ids3010, hpi-3d: divides by the index of its own sensors
    double beam_tilt_mrad = 0;    ///< how the beam is left at the start; `steer` turns it
    /// ids3010, hpi-3d: of the signal where the beam comes back upon itself
    double contrast_percent = 85;
    /// The same: 1/e^2 of the intensity; a beam that comes back beside itself has less contrast.
    /// Absent: it has not.
    std::optional<double> beam_radius_mm;
    /// A linear scale in its place, of a homodyne kind: one count; with it there is no beam.
    std::optional<double> resolution_um;
    double scale_expansion_um_per_m_k = 0; ///< about its zero_mm
};

/// An indexing table on a rotary axis, with the reflectors of an angular interferometer on it. Of
/// the axis a millimetre then stands for a degree, a micrometre for a thousandth; nothing expands.
struct TableScenario {
    double step_deg = 5, turn_deg_per_s = 60;
    double arm_mm = 32.61;                ///< between the reflectors
    double range_deg = 10;                ///< beyond it the beam is lost
    std::vector<double> deviation_arcsec; ///< of each position; + stands turned with the axis
};

/// A polygon on a rotary axis before an autocollimator (sensor kind "elcomat"); mm and um stand for
/// degrees and thousandths as with an indexing table. The first face stands before it at 0.
struct PolygonScenario {
    int faces = 8;
    double range_arcsec = 1000;           ///< beyond it no light comes back
    double y_arcsec = 0;                  ///< what its second axis shows
    double poll_s = 0.1;                  ///< how often the station asks; for the truth alone
    std::vector<double> deviation_arcsec; ///< of each face; + stands turned with the axis
};

/// A Wollaston prism before a bisecting mirror in place of the laser's reflector: it shows the
/// motion across the axis.
struct StraightnessScenario {
    double factor = 36; ///< deviation across for a displacement of 1 that the laser shows
    bool mirror_reversed = false;
    ErrorScenario across; ///< of the motion
    ErrorScenario mirror; ///< its form along the axis
};

/// The prism sees the second of two axes through an optical square, which a run of the first axis
/// came before. Angles in um/m: 1 is 1e-6 rad.
struct SquarenessScenario {
    double axes_um_per_m = 0;   ///< angle between the + directions minus 90 degrees
    double square_um_per_m = 0; ///< the same of the square, as it counts while it is not turned
    bool square_turned = false;
    double first_um_per_m = 0; ///< slope (tangent) that the first line had in its set-up
};

/// A ballbar between spindle and table, and what it shall find; ways of its plane move it.
struct BallbarScenario {
    std::string path, plane = "XY"; ///< letters of the first and the second axis
    double centre_first_mm = 0, centre_second_mm = 0, radius_mm = 100;
    double start_first_mm = 0, start_second_mm = 0;
    double scale_first_um_per_m = 0, scale_second_um_per_m = 0;
    double squareness_um_per_m = 0; ///< > 0: the + axes enclose more than 90 degrees
    double backlash_first_um = 0, backlash_second_um = 0; ///< lost motion
    double cyclic_first_um = 0, cyclic_period_mm = 10;    ///< amplitude
    double noise_um = 0;                                  ///< sigma per sample
    std::optional<double> rate_hz;       ///< of its counter; absent: the counter's usual rate
    std::optional<double> resolution_um; ///< a glass scale: one count; absent: a laser
    std::optional<double> stroke_um;     ///< to either side; beyond it the reading stays at its end
};

struct SensorScenario {
    std::string name, kind; ///< dracal-vcp, tm-th8, comet ... (README.md)
    std::string path = {};  ///< symlink to the pty; empty: Modbus TCP
    int port = 0, unit = 1, fraction_digits = 2, first_register = 0x31;
};

struct CncFault {
    std::string kind; ///< doubled late missed out-of-order wrong-direction wrong-target
    int request = 0;  ///< 1-based count of requests
    double late_s = 1;
};

struct CncScenario {
    std::string shape = "sequence-block"; ///< single-register, coil-and-index, dwell
    std::string transport = "tcp";        ///< rtu, server (the CNC is the Modbus server)
    std::string host = "127.0.0.1", path;
    int port = 0, baud = 115200, unit = 1, base_address = 0;
    char parity = 'N';
    double poll_s = 0.01, counts_per_unit = 10000;
    bool low_word_first = false;
    std::string motion_fault; ///< diameter inch wrong-axis swapped-sign shifted-datum
    double shift_mm = 1;
    std::vector<CncFault> faults;
};

/// What the derivation of the bounds needs to know of the run.
struct TruthScenario {
    double window_s = 0.5, duration_s = 300;
    int draws = 10000;
};

struct Scenario {
    std::uint64_t seed = 1;
    AxisScenario axis;
    ErrorScenario errors;
    ThermalScenario thermal;
    AirScenario air;
    LaserScenario laser;
    std::vector<SensorScenario> sensors;
    std::optional<TableScenario> indexing_table;
    std::optional<PolygonScenario> polygon;
    std::optional<StraightnessScenario> straightness;
    std::optional<SquarenessScenario> squareness; ///< beside `straightness`
    std::optional<BallbarScenario> ballbar;
    std::optional<CncScenario> cnc;
    TruthScenario truth;
    /// A rotary axis: an angle does not expand.
    [[nodiscard]] bool rotary() const { return indexing_table || polygon; }
};

/// @errors bad_configuration naming the key: unknown keys, wrong types and unknown kinds, all at
/// once.
Result<Scenario> read_scenario(const std::string& path);
/// The same from text; `toml` false: JSON.
Result<Scenario> parse_scenario(const std::string& text, bool toml);

} // namespace axiscal::simulate
