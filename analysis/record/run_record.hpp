#pragma once
// What a run file holds, as plain values: the only input of the analysis. Pure data.

#include "analysis/quantity/boot_id.hpp"
#include "analysis/quantity/quantity.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/quantity/temperature.hpp"
#include "analysis/quantity/time.hpp"
#include "analysis/record/imported_readings.hpp"
#include "analysis/record/rotary_setup.hpp"
#include "analysis/record/test_kind.hpp"
#include "analysis/record/tolerance_record.hpp"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

enum class AxisKind : std::uint8_t { linear, rotary };
/// Sense of the motion by which a target is reached: positive (up arrow) goes towards higher
/// coordinates.
enum class Direction : std::int8_t { negative = -1, positive = 1 };
enum class CycleKind : std::uint8_t { standard, step };
/// Who asked for the capture.
enum class TriggerOrigin : std::uint8_t { cnc, dwell, manual };
enum class ChannelKind : std::uint8_t {
    displacement,
    temperature,
    pressure,
    humidity,
    carbon_dioxide,
    strength,
    angle ///< of an autocollimator
};
enum class Medium : std::uint8_t { none, air, material };
enum class AirFormula : std::uint8_t { ciddor, edlen };
enum class ExpansionForm : std::uint8_t { first_order, exact };
/// How often the environment counts in a difference of two means of n readings: once (the text of
/// the source speaks of the mean of n readings) or twice (strict propagation).
enum class EveModel : std::uint8_t { mean, difference };

std::string_view name_of(AxisKind kind);
std::string_view name_of(Direction direction); ///< "positive" | "negative"
std::string_view name_of(CycleKind kind);
std::string_view name_of(TriggerOrigin origin);
std::string_view name_of(ChannelKind kind);
std::string_view name_of(Medium medium);
std::string_view name_of(AirFormula formula);
std::string_view name_of(ExpansionForm form);
std::string_view name_of(EveModel model);
/// The unit in which a channel's value is stored: "m", "degC", "Pa", "%", "ppm", "arcsec".
std::string_view stored_unit_of(ChannelKind kind);

/// One position to be reached, in the order of the cycle.
struct PlannedPoint {
    int step = 0;         ///< 0-based place in the cycle
    int target_index = 0; ///< 0-based
    Direction direction = Direction::positive;
    int approach = 0; ///< 0-based repetition, < RunPlan::approaches
    auto operator<=>(const PlannedPoint&) const = default;
};

/// Targets and order of one pass. Lengths are axis coordinates; a rotary axis stores degrees as
/// millimetres (1 mm stands for 1 degree), named by `axis_kind`.
struct RunPlan {
    AxisKind axis_kind = AxisKind::linear;
    CycleKind cycle = CycleKind::standard;
    std::string pass = "whole"; ///< of a positioning test; "stretch": 2000 mm of a long axis
    std::string remark;         ///< e.g. why the stretch was declined; printed
    std::vector<Length> targets;
    int approaches = 5; ///< n per direction
    bool bidirectional = true;
    Length interval;                   ///< p
    std::optional<std::uint64_t> seed; ///< of the random parts r; absent when the list was given
    Length overrun;                    ///< least travel by which a target is reached from its side
    Length near_tolerance;             ///< |reading - target| at most this at capture
    Length datum;                      ///< coordinate at which the reading is tied
    std::vector<PlannedPoint> points;
};

/// Traceability of one instrument as stated in the station file; empty fields print "not stated".
struct InstrumentRecord {
    std::string name, driver, maker, model, serial, firmware;
    std::string certificate_number, calibrated_on, due_on;
};

/// One recorded channel.
struct ChannelRecord {
    int id = 0;
    std::string name, instrument, place;
    ChannelKind kind = ChannelKind::temperature;
    Medium medium = Medium::none;
    double correction =
        0; ///< added to every raw value before it was recorded, in stored_unit_of(kind)
};

/// One line of a certificate's table: at this reading add this, both in stored_unit_of(kind).
struct CorrectionPoint {
    double reading = 0, correction = 0;
};

/// What the certificate of one channel states. The correction was applied before a value was
/// recorded, as ChannelRecord::correction was; the table stands here to be seen.
struct ChannelCalibration {
    int channel = 0;                                       ///< ChannelRecord::id
    std::string certificate_number, calibrated_on, due_on; ///< empty: the instrument's
    std::optional<double> expanded_uncertainty;            ///< U, in stored_unit_of(kind), and/or:
    std::optional<double> expanded_uncertainty_per_m;      ///< of a length, m for each metre
    double coverage = 2;                                   ///< k of both
    std::vector<CorrectionPoint> corrections; ///< by reading, ascending; empty: constant
};

struct LaserSetup {
    std::string instrument;
    Length vacuum_wavelength;
    double optical_fold = 2; ///< passes of the beam: 2 corner cube, 4 plane mirror
    int sign = 1;            ///< +1 when the count rises with the axis coordinate
    Length dead_path;        ///< interferometer to reflector at the datum, >= 0
    Length beam_walk; ///< offset e of the return spot over `beam_walk_travel` L (gamma = e/(2L))
    Length beam_walk_travel; ///< 0: no cosine correction
};

struct MaterialSetup {
    Expansion coefficient; ///< alpha_M of feedback element or screw
    std::optional<Expansion> standard_uncertainty;
    std::string feedback = "not stated"; ///< "linear scale" | "screw" ...
    ExpansionForm form = ExpansionForm::first_order;
};

/// A linear scale in the place of the laser: while it is at 20 degC it gives true lengths.
struct ScaleSetup {
    Length resolution;     ///< of one count
    Expansion coefficient; ///< alpha_S
    std::optional<Expansion> standard_uncertainty;
    std::optional<TemperatureDifference> temperature_width; ///< full width, of its temperature
    std::vector<int> channels; ///< ChannelRecord::id of the temperatures on it
};

struct AirSetup {
    AirFormula formula = AirFormula::ciddor;
    double co2_ppm = 450;
    Duration oldest = std::chrono::seconds{60}; ///< an older reading is no reading
};

/// A limit of the device that does not depend on the length, one that grows with it, or none.
struct DeviceLimit {
    std::optional<Length> fixed;
    std::optional<Ratio> per_length;
    [[nodiscard]] bool stated() const { return fixed || per_length; }
};

/// Contract keys of the figures of ISO 230-2, in the contract's order.
inline constexpr std::array<std::string_view, 12> positioning_parameters{
    "A", "A_forward", "A_backward", "E",          "E_forward", "E_backward",
    "M", "R",         "R_forward",  "R_backward", "B",         "B_mean"};

/// Largest expanded uncertainty U_T that the person in charge accepts for one parameter.
struct TargetUncertainty {
    std::string parameter; ///< contract key, "A_forward"
    Length limit;
};

/// What is stated for the uncertainty budget (ISO 230-2 annex A); an empty field is not stated.
/// Widths are FULL widths of rectangular distributions.
struct UncertaintySetup {
    DeviceLimit device_U;     ///< expanded uncertainty of the laser system, air sensors included
    double device_k = 2;      ///< its coverage factor
    DeviceLimit device_width; ///< instead of U: width of the band between its limits (+-a: 2a)
    std::optional<Length> misalignment;      ///< offset of the beam over the measured length, or:
    std::optional<Angle> misalignment_angle; ///< between beam and axis
    std::optional<TemperatureDifference> temperature_width; ///< of the material's temperature
    std::optional<Expansion> expansion_width; ///< of its coefficient; absent: from MaterialSetup's
                                              ///< standard uncertainty
    std::optional<Length> eve; ///< E_VE: range of the drift test, largest - smallest reading
    EveModel eve_model = EveModel::mean;
    std::vector<TargetUncertainty> targets;
};

/// What a person states; every field may be empty ("not stated").
struct Statements {
    std::string certificate_number, customer, place, machine, machine_maker, machine_serial, axis;
    std::string operator_name, approver, procedure, state; ///< state: as found | raw | as left
    std::string control_compensation, feed, dwell, warm_up, offsets, idle_axes, sensor_note,
        laboratory;
    std::string next_due; ///< ISO date; empty: one year after the run; "none": not recommended
};

struct DatumRecord {
    std::string id; ///< "<laser serial>/<epoch>/<n>"
    MonotonicTime at;
    Length coordinate; ///< machine coordinate there
    Length reading;    ///< mean displacement in vacuum wavelengths or by the scale, sign as counted
    std::uint32_t epoch = 0; ///< of the laser's counter
    Length spread;
    double slope_um_per_s = 0;
    int n = 0;
    std::uint16_t sequence =
        0; ///< sequence number of a CNC's prepare command; 0 when tied by `arm`
    std::uint64_t device_count = 0; ///< the laser's own number of the window's last sample
};

struct WindowSample {
    MonotonicTime at;
    double reading_m = 0; ///< displacement in vacuum wavelengths
    std::uint64_t device_count = 0;
};

/// The samples of one window. They never change, and copies share them: a second at 50 kHz is a
/// megabyte, which the loop would copy three times on the way of a point to the disk.
class WindowSamples {
public:
    WindowSamples() = default;
    WindowSamples(std::vector<WindowSample> samples) // NOLINT(google-explicit-constructor)
        : samples_{std::make_shared<const std::vector<WindowSample>>(std::move(samples))} {}
    WindowSamples(std::initializer_list<WindowSample> samples)
        : WindowSamples{std::vector<WindowSample>(samples)} {}

    [[nodiscard]] std::size_t size() const { return samples_ ? samples_->size() : 0; }
    [[nodiscard]] bool empty() const { return size() == 0; }
    [[nodiscard]] const WindowSample* begin() const {
        return samples_ ? samples_->data() : nullptr;
    }
    [[nodiscard]] const WindowSample* end() const { return begin() + size(); }
    [[nodiscard]] const WindowSample& front() const { return samples_->front(); }
    [[nodiscard]] const WindowSample& back() const { return samples_->back(); }

private:
    std::shared_ptr<const std::vector<WindowSample>> samples_;
};

/// One accepted point.
struct PointRecord {
    int step = 0;
    std::uint16_t sequence = 0;
    PlannedPoint planned;
    TriggerOrigin origin = TriggerOrigin::cnc;
    MonotonicTime triggered_at, window_begin, window_end;
    Length reading; ///< mean over the window, vacuum wavelengths, sign as counted
    Length spread;  ///< max - min over the window
    double slope_um_per_s = 0;
    int n = 0;
    Length approach_travel; ///< seen in the samples, from the claimed side
    std::string datum_id;
    Length live_deviation; ///< as shown at the machine; never used by the analysis
    WindowSamples samples;
};

struct EnvironmentReading {
    int channel = 0;
    MonotonicTime at;
    double value = 0; ///< corrected, in stored_unit_of(kind)
};

enum class EventKind : std::uint8_t {
    opened,
    armed,
    datum,
    refused,
    skipped,
    interrupted,
    resumed,
    aborted,
    closed,
    note,
    instrument
};
std::string_view name_of(EventKind kind);

struct EventRecord {
    EventKind kind = EventKind::note;
    MonotonicTime at;
    std::int64_t utc_ns = 0;
    std::string text; ///< one sentence
    Fault fault = Fault::none;
    std::uint16_t sequence = 0;
};

struct RunRecord {
    std::string run_id;
    std::string software_version;
    std::string station, station_config; ///< name; the station file's text, whole
    std::string config_hash;             ///< SHA-256 of station_config
    BootId boot_id;                      ///< of the computer when the run was opened
    ClockTie opened, closed;
    bool complete = false; ///< closed with every planned point
    std::string closing_reason;
    TestKind kind = TestKind::positioning;
    RunPlan plan;
    LaserSetup laser;
    MaterialSetup material;
    AirSetup air;
    std::optional<RotarySetup> rotary; ///< of a rotary axis: how its angle was measured
    /// The reference is this scale: of `laser` instrument and sign count, of `air` the age alone.
    std::optional<ScaleSetup> scale;
    /// Readings by others: PointRecord::reading is the deviation that their program gave, at 20
    /// degC or whatever it took for that; laser, material and air say nothing then.
    std::optional<ImportedReadings> imported;
    std::optional<UncertaintySetup> uncertainty;
    std::optional<ToleranceRecord> tolerances; ///< of this kind of test; absent: none was agreed
    /// By which the figures are computed and named (analysis/positioning/standards.hpp), the
    /// certificate's own first; empty: the kind's usual one.
    std::vector<std::string> standards;
    Statements statements;
    std::vector<InstrumentRecord> instruments;
    std::vector<ChannelRecord> channels;
    std::vector<ChannelCalibration> calibrations; ///< at most one a channel; order of channels
    std::vector<DatumRecord> datums;
    std::vector<PointRecord> points;             ///< by step, ascending
    std::vector<EnvironmentReading> environment; ///< by time, ascending
    std::vector<EventRecord> events;
};

/// "laser" | "scale": what measured the axis, for sentences.
std::string_view reference_word_of(const RunRecord& run);

/// The channel is a temperature of the scale that measures the axis, none of the machine.
bool sits_on_scale(const RunRecord& run, int channel);

/// Every planned cell filled exactly once, each point under one datum, steps in order.
/// @errors Fault::incomplete_run naming the first missing step; Fault::datum_lost when datums
/// differ.
Result<void> check_complete(const RunRecord& run);

} // namespace axiscal
