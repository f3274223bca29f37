#pragma once
// What the station shows and takes: the only thing the console knows of it.

#include "acquisition/capture/min_max_pyramid.hpp"
#include "acquisition/live/outbox_watch.hpp"
#include "acquisition/live/supervisor.hpp"
#include "acquisition/live/to_do.hpp"
#include "acquisition/run/run_events.hpp"
#include "analysis/positioning/figures_so_far.hpp"
#include "analysis/record/circular_setup.hpp"
#include "analysis/record/run_attachments.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"
#include "analysis/record/test_kind.hpp"
#include "drivers/loop/scheduler.hpp"
#include "drivers/sample.hpp"
#include "drivers/trigger/trigger_port.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// One channel as it stands now; `value` is empty unless good and fresh.
struct ChannelView {
    std::string instrument, channel; ///< as the station file speaks of it
    std::string name;                ///< for people
    std::string place, unit;
    ChannelKind kind = ChannelKind::temperature;
    Medium medium = Medium::none;
    std::optional<double> value;
    std::optional<double> age_s;  ///< of the last sample, good or not
    bool used = false;            ///< laser, or part of the run's environment
    std::string role;             ///< axis | ballbar | environment; empty: not used
    std::string quality = "none"; ///< good | stale | signal_error | beam_lost | absent | none
    std::string due_on = {};      ///< ISO date of its own certificate; empty: the instrument's
    std::optional<double> stale_after_s = {}; ///< an older sample is no value; empty: none is
};

/// The axis as the laser sees it now.
struct AxisView {
    std::string name;
    AxisKind kind = AxisKind::linear; ///< rotary: mm stands for deg, um for 0.001 deg
    bool reads_angle = false;         ///< an autocollimator's: so do displacement, spread and slope
    std::optional<double> position_mm, deviation_um; ///< needs a datum
    std::optional<double> displacement_mm;           ///< raw: vacuum wavelengths, or of a scale
    std::optional<double> strength_percent;
    std::optional<double> least_strength_percent = {}; ///< below it the check `strength` fails
    std::optional<double> spread_um, slope_um_per_s;   ///< over the last window
    bool still = false;
    std::optional<double> age_s;         ///< of the last reading, good or not
    std::optional<double> stale_after_s; ///< an older reading shows nothing of the axis
};

/// The circle that is driven, or the first one before it is begun.
struct CircleView {
    PlannedCircle circle;
    bool begun = false;
};

struct RunStatus {
    std::string run_id, pass,
        state; ///< state: tying datum | armed | settling | stopped | complete | incomplete
    std::string file;
    int step = 0, steps = 0;        ///< points durable, points planned
    int done = 0;                   ///< last sequence with a durable point
    std::optional<int> next_target; ///< 0-based
    std::optional<double> next_nominal_mm;
    std::optional<Direction> next_direction;
    std::optional<int> next_approach;                      ///< 0-based
    std::optional<CircleView> circle;                      ///< of a circular test alone
    int retakes_asked = 0, retakes_left = 0, excluded = 0; ///< points
    int skipped = 0;                                       ///< points, and not taken since
    std::optional<double> seconds_left;
    std::optional<double> last_deviation_um;
    std::optional<double> last_synchronisation_um; ///< of the last point; empty: not stated
    std::string last_fault, last_sentence;         ///< empty when all is well
    std::string certificate; ///< folder of the finished certificate, when there is one
    /// Of a positioning run with a datum and a durable point that counts; else null.
    std::shared_ptr<const FiguresSoFar> so_far;
};

/// The drift test that goes on, or the last one since the start.
struct DriftView {
    std::string run_id, state; ///< recording | complete | incomplete
    std::string file, certificate;
    bool of_bar = false;                     ///< of the ballbar, else of the axis
    std::optional<double> place_mm;          ///< a ballbar has none
    int taken = 0, missing = 0, planned = 0; ///< readings of the laser, or of the ballbar
    std::optional<double> range_um;          ///< so far, of the bare readings
    std::optional<double> seconds_left;
    std::string sentence; ///< empty when all is well
};

struct StationStatus {
    std::string station, version, utc;
    AxisView axis;
    std::vector<ChannelView> channels;
    std::vector<InstrumentView> instruments;
    std::string trigger, trigger_note;
    PortCounters trigger_counters;
    bool cnc_silent = false;
    std::optional<RunStatus> run; ///< the open run, or the last one since start
    bool run_open = false;
    std::optional<DriftView> drift;
    OutboxView outbox;
    std::vector<std::string> notes; ///< latest last, at most 20
    std::vector<ToDo> to_do;        ///< things_to_do(): what stops the CNC first
};

/// What a person gives when arming; empty fields keep the station file's statements.
struct ArmRequest {
    std::optional<double> datum_mm;        ///< coordinate where the axis stands now
    TestKind kind = TestKind::positioning; ///< of what is armed: a drift test is ordered otherwise
    std::string pass = "whole";            ///< of a positioning run; of another kind its name
    std::optional<std::uint64_t> seed;
    bool datum_by_cnc = false;                     ///< wait for the CNC's prepare command instead
    std::map<std::string, std::string> statements; ///< "operator", "state", "customer", ...
    std::map<std::string, std::string> overrides;  ///< reason by name of a pre-flight check
    std::map<std::string, std::string> options;    ///< what one kind of test alone is told, by name
    Orderer by;
    std::function<bool()> has_gone; ///< nobody waits for the answer any more; empty: stays
};

/// What a person wants taken again, or left out.
struct RevisionRequest {
    PointSelection selection;
    std::string reason;
    Orderer by;
};

/// What a person answers to a finding about the set-up.
struct AnswerRequest {
    std::string finding; ///< "moved_optic", as the certificate names it
    std::string text;
    Orderer by;
};

/// How a run ended that was to be aborted: its last point may have been on its way to the disk.
struct RunEnding {
    bool complete = false;
    std::string reason; ///< as the run file has it
};

/// What will be taken again.
struct RetakeAnswer {
    struct Point {
        int step = 0; ///< 0-based, behind the plan's
        PlannedPoint planned;
    };
    std::vector<Point> points;
    std::uint16_t last_request = 0; ///< the first of these bears the number after it
};

/// The ballbar's stream since arming, or since the daemon's start within a test: the lowest and the
/// highest reading of each stretch.
struct StreamView {
    std::string run_id, channel; ///< "ballbar/axis 1"
    bool recording = false;
    double rate_hz = 0; ///< of the last second; 0: not known
    std::uint64_t samples = 0;
    std::uint64_t samples_a_stretch = 1; ///< the last may hold fewer
    std::uint64_t gaps = 0, missing = 0;
    std::vector<MinMax> stretches; ///< bare readings, m
};

/// A durable point beside what the plan and people say of it.
struct ShownPoint : AcceptedPoint {
    Length nominal;        ///< of its target
    bool excluded = false; ///< a person left it out
};

/// The points of the run that is shown, in the order they became durable.
struct PointsView {
    std::string run_id;    ///< empty: none is shown, or it has no points, as a circular test
    std::size_t count = 0; ///< of all; never falls while this daemon shows this run
    std::vector<ShownPoint> points; ///< as many of them as were asked for
    /// Points that are excluded, of all; never falls while this daemon shows this run. Where it
    /// grew, earlier points have changed.
    std::size_t excluded = 0;
    std::vector<Length> targets = {};                ///< of the plan; only with all points (from 0)
    std::shared_ptr<const FiguresSoFar> so_far = {}; ///< as RunStatus::so_far, of all `count`
};

/// The beam while it is aligned, or how it was left.
struct AlignmentView {
    bool running = false;
    std::optional<AlignmentRecord> record; ///< of the one that is going on, else the last one kept
    std::optional<double> distance_mm, strength_percent; ///< now, while it is going on
    bool at_rest = false;
};
enum class AlignmentAction : std::uint8_t { begin, keep, drop };
struct AlignmentOrder {
    AlignmentAction action = AlignmentAction::begin;
    std::optional<double> spot_offset_mm; ///< with `keep`: walk of the return spot, as seen
};

/// A drift test: the axis rests at `place_mm`, or the ballbar where it is, and every channel is
/// read at the interval.
struct DriftRequest {
    std::optional<bool> of_bar; ///< default: only where the station measures no axis
    Duration duration = std::chrono::minutes{30}, interval = std::chrono::seconds{1};
    std::optional<double> place_mm; ///< default: the end of the travel far from the interferometer
    std::map<std::string, std::string> statements;
    Orderer by;
};

/// Answers of the state-changing calls. Loop-bound.
class StationInterface {
public:
    virtual ~StationInterface() = default;
    [[nodiscard]] virtual StationStatus status() const = 0;
    /// Opens a run and ties the datum; returns its id when the datum is durable. Dropped, and the
    /// run closed again, when who ordered it has gone before the datum was found.
    virtual Task<Result<std::string>> arm(ArmRequest request) = 0;
    /// The technician's own capture of the next point, marked manual.
    virtual Result<void> trigger() = 0;
    /// What a person reads off the autocollimator: of the point that the CNC asks for, else of the
    /// next one, marked manual. @errors Fault::bad_request unless the station reads a polygon; the
    /// reason why the point is refused.
    virtual Result<void> type_reading(double seconds_of_arc) = 0;
    /// Returns when the run, or the drift test, is closed. @errors Fault::busy while a record is
    /// still on its way to the disk, or another program reads the file, Fault::not_durable where
    /// the file could not be closed: nothing more is taken then, and the station closes it as soon
    /// as it can.
    virtual Task<Result<RunEnding>> abort(std::string reason, Orderer by) = 0;
    /// What arming would meet now. @errors Fault::bad_request for an override that is none.
    virtual Task<Result<std::vector<PreflightRecord>>> preflight(ArmRequest request) = 0;
    /// Points of the open run, or of the last one while its set-up stands. Durable on return.
    /// @errors the reason why not.
    virtual Task<Result<RetakeAnswer>> retake(RevisionRequest request) = 0;
    /// @returns how many readings were left out. Durable on return.
    virtual Task<Result<int>> exclude(RevisionRequest request) = 0;
    /// Of the last run, closed; it gets another certificate. Durable on return.
    /// @errors Fault::bad_request where its certificate has no such finding; the reason why not.
    virtual Task<Result<void>> answer_finding(AnswerRequest request) = 0;
    /// Begins a drift test; returns its run id when its file is made. abort() ends it.
    virtual Task<Result<std::string>> drift(DriftRequest request) = 0;
    /// At most `most` stretches; none before the first circular test since the start.
    [[nodiscard]] virtual std::optional<StreamView> stream(std::size_t most) const = 0;
    /// Without the first `from` points; none before the first run since the start.
    [[nodiscard]] virtual PointsView points(std::size_t /*from*/) const { return {}; }
    [[nodiscard]] virtual AlignmentView alignment() const = 0;
    /// begin: watch the beam from now on; a watch that is going on starts anew. keep: it ends, and
    /// what it showed stands in the run files from now on. drop: it ends, the last one kept holds.
    virtual Result<void> align(AlignmentOrder order) = 0;
};

} // namespace axiscal
