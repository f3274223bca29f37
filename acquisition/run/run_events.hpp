#pragma once
// What goes into the state machine of a run, and what comes out. Plain values; every input carries
// its own time. Pure data.

#include "acquisition/capture/capture.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"
#include "drivers/trigger/trigger_port.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace axiscal {

// --- inputs -----------------------------------------------------------------------------------

/// A technician arms the run. With `tie_datum` the axis stands at the plan's datum now; without,
/// the CNC's first command is `prepare`.
struct Arm {
    MonotonicTime at;
    bool tie_datum = true;
};
/// The answer to OpenWindow. An answer to a window that is no longer open is counted and ignored.
struct WindowResult {
    std::uint64_t window = 0;
    Result<Capture> capture;
    MonotonicTime at;
};
/// A commit is on disk: the values of the JournalReceipt.
struct Committed {
    std::uint16_t sequence = 0;
    int step = -1;
    MonotonicTime at;
};
struct CommitFailed {
    std::string reason;
    MonotonicTime at;
};
/// The disk takes records again. What it holds was verified and synced anew: the record whose
/// commit had failed, or an order that was lost, may be among it after all.
struct DiskBack {
    std::shared_ptr<const RunRecord> on_disk;
    MonotonicTime at;
    std::shared_ptr<const RunRevisions> orders{}; ///< none: as they are known
    bool reopened = false; ///< the run was closed, and its file holds an order that opened it
};
/// By what share a reading in vacuum wavelengths exceeds the length at 20 degC, from fresh air and
/// material readings: n (1 + alpha (T - 20 degC)) - 1, by a linear scale (1 + alpha (T - 20 degC))
/// over the same of the scale, - 1; or why it is not known (environment_stale)
/// or may not be used (environment_outside).
/// Until the first one the environment counts as stale.
struct EnvironmentNow {
    Result<double> scale_minus_1;
};
/// The laser's driver says that something is wrong; datum_lost ends the run.
struct LaserFault {
    Fault fault = Fault::beam_lost;
    std::string sentence;
    MonotonicTime at;
};
/// A technician ends the run.
struct Abort {
    std::string reason;
    MonotonicTime at;
};
/// Which points of the plan a person means: all that fit what is given.
struct PointSelection {
    std::optional<int> target; ///< 0-based index
    std::optional<Direction> direction;
    std::optional<int> approach; ///< 0-based: the cycle
};
/// A person wants points taken again. They follow the plan's own, in its order.
struct Retake {
    PointSelection selection;
    std::string reason;
    MonotonicTime at;
};
/// A person wants readings left out of every figure; they stay in the file.
struct Exclude {
    PointSelection selection;
    std::string reason;
    MonotonicTime at;
};
/// The order of the last RecordRetake or RecordExclusion is on disk.
struct RevisionKept {
    MonotonicTime at;
};
/// It could not be written: what it added is taken back, and nothing else.
struct RevisionLost {
    MonotonicTime at;
};
struct Tick {
    MonotonicTime now;
};

using RunInput = std::variant<Arm,
                              TriggerEvent,
                              WindowResult,
                              Committed,
                              CommitFailed,
                              DiskBack,
                              EnvironmentNow,
                              LaserFault,
                              Abort,
                              Retake,
                              Exclude,
                              RevisionKept,
                              RevisionLost,
                              Tick>;

/// A point that is on disk, as it is shown.
struct AcceptedPoint {
    int step = 0;               ///< of one that was taken again: behind the plan's
    std::uint16_t sequence = 0; ///< of the request
    PlannedPoint planned;
    Length deviation; ///< as shown at the machine; never used by the analysis
};

// --- actions, to be carried out in order
// ----------------------------------------------------------

/// A new run is open to the CNC: done = 0.
struct PublishArmed {};
/// Find a still window after `from`, until `deadline`; answer with WindowResult.
struct OpenWindow {
    std::uint64_t window = 0;
    MonotonicTime from, deadline;
    std::optional<ApproachClaim> approach; ///< none at the datum
    Length expected;                       ///< coordinate
};
struct CloseWindow {
    std::uint64_t window = 0;
};
/// Make durable; answer with Committed{point.sequence, point.step} or CommitFailed.
struct CommitPoint {
    PointRecord point;
    std::optional<Synchronisation> synchronisation{};
};
/// Answer with Committed{datum.sequence, -1}.
struct CommitDatum {
    DatumRecord datum;
    std::optional<Synchronisation> synchronisation{};
};
/// An event that is acknowledged (skip, end, abort). Answer with Committed{event.sequence, step}.
struct CommitEvent {
    EventRecord event;
    int step = -1;
};
/// Publish done = sequence with the receipt that this Committed came from.
struct Acknowledge {
    std::uint16_t sequence = 0;
    int step = -1;
    bool skipped = false; ///< without a point
};
/// Publish done = sequence again, with the receipt of the last durable record: kept from its
/// commit, or after a restart Journal::receipt_for(step).
struct RepublishDone {
    std::uint16_t sequence = 0;
    int step = -1;
    bool skipped = false;
};
/// done stays. Origin manual: for the one whose input it answers, not for the port; later, without
/// an input of a person, it is the end of a manual capture, or with sequence 0 of the arming.
struct Refuse {
    std::uint16_t sequence = 0;
    Fault fault = Fault::none;
    std::string sentence; ///< what there is to say beyond fault_sentence(fault)
    TriggerOrigin origin = TriggerOrigin::cnc;
};
/// Not waited for. `utc_ns` is left to the one who has a clock.
struct RecordEvent {
    EventRecord event;
};
/// The order is to be durable before anything else of the run. Answer with RevisionKept or
/// RevisionLost. `reopens`: the run was closed, and stays so until then.
struct RecordRetake {
    RetakeRecord retake;
    bool reopens = false;
};
/// Answer as RecordRetake.
struct RecordExclusion {
    std::vector<ExclusionRecord> exclusions;
    bool reopens = false;
};
struct SetState {
    PortState state = PortState::idle;
};
/// The last action of a run; Fault::none when complete or ended by a person.
struct Close {
    bool complete = false;
    std::string reason;
    Fault fault = Fault::none;
    bool answers_cnc = false; ///< an acknowledged request ended the run
};

using RunAction = std::variant<PublishArmed,
                               OpenWindow,
                               CloseWindow,
                               CommitPoint,
                               CommitDatum,
                               CommitEvent,
                               Acknowledge,
                               RepublishDone,
                               Refuse,
                               RecordEvent,
                               RecordRetake,
                               RecordExclusion,
                               SetState,
                               Close>;
using RunActions = std::vector<RunAction>;

} // namespace axiscal
