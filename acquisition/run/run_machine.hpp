#pragma once
// The state machine of one run: the trigger contract (docs/trigger.md) and nothing else. No I/O,
// no clock: an input goes in, actions come out.

#include "acquisition/run/first_targets.hpp"
#include "acquisition/run/reading_rule.hpp"
#include "acquisition/run/run_events.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

struct RunSetup {
    RunPlan plan;
    std::shared_ptr<const ReadingRule> reading; ///< never null
    std::string laser_serial;                   ///< for datum ids
    Duration capture_timeout = std::chrono::seconds{10};
    RunRevisions revisions{}; ///< of an open run that goes on
};

/// Counted, never silent.
struct RunCounters {
    int doubled = 0;      ///< the request under capture came again
    int republished = 0;  ///< the last finished request came again
    int out_of_order = 0; ///< missed, late, restarted
    int refused = 0;      ///< every refusal, out-of-order ones included
    int stray = 0;        ///< windows and commits nobody waited for
};

struct RunView {
    PortState state = PortState::idle;
    bool closed = false, complete = false, stopped = false;
    std::uint16_t last_durable = 0;
    int last_durable_step = -1;
    bool last_skipped = false;            ///< that request skipped its point
    std::optional<PlannedPoint> next;     ///< none when every point is done or skipped
    int without_point = 0;                ///< planned, skipped, and not taken since
    int done = 0, skipped = 0, total = 0; ///< points that are taken again included
    int retakes_asked = 0, retakes_left = 0, excluded = 0;
    std::optional<DatumRecord> datum;
    std::uint32_t datum_epoch = 0; ///< of the laser's counter now, while the datum holds
    std::optional<Length> last_position, last_deviation; ///< of the last accepted point, live
    std::optional<Synchronisation> last_synchronisation; ///< of the last accepted point
    RunCounters counters;
};

/// Pure. Guarantees, whatever comes in: Acknowledge follows only a Committed that answers the
/// outstanding commit, once; every planned point is committed at most once, and once more for each
/// retake that names it; after Close nothing is committed or acknowledged until a retake reopens
/// the run.
class RunMachine {
public:
    /// A new run; it takes triggers after Arm.
    explicit RunMachine(RunSetup setup);
    /// An open run after a restart, found resumable (resume.hpp). `epoch`: of the laser's counter
    /// now, proven to continue the datum's. The first request must be the last durable one or the
    /// next; anything else closes the run (sequence_lost). As much of the way to the first point as
    /// nobody watched is not asked for, and an event says so.
    RunMachine(RunSetup setup, const RunRecord& open_run, std::uint32_t epoch, MonotonicTime now);
    /// A run that an earlier daemon closed as complete: a retake may reopen it. `epoch` as above.
    static RunMachine
    of_closed(RunSetup setup, const RunRecord& run, std::uint32_t epoch, MonotonicTime now);

    RunActions handle(const RunInput& input);
    [[nodiscard]] RunView view() const;
    /// In the order they were taken; none ever goes.
    [[nodiscard]] const std::vector<AcceptedPoint>& accepted() const { return accepted_; }
    /// Those that figures use: of each place in the plan the last one, unless it is left out.
    [[nodiscard]] std::vector<AcceptedPoint> counting() const;
    /// The reading of that step is left out, and the order for it is on disk.
    [[nodiscard]] bool leaves_out(int step) const;
    /// Readings of which leaves_out() says so. None is ever taken in again.
    [[nodiscard]] std::size_t left_out() const;
    [[nodiscard]] const ReadingRule& reading() const { return *setup_.reading; }
    /// What a step of the plan, or behind it of a retake, is planned to be.
    [[nodiscard]] PlannedPoint planned_at(int step) const;

private:
    enum class Purpose : std::uint8_t { datum, point, skip, end };
    /// The one thing that is under way: a window, then its commit.
    struct Pending {
        Purpose purpose = Purpose::point;
        TriggerOrigin origin = TriggerOrigin::cnc;
        std::uint16_t sequence = 0;
        int step = -1;
        MonotonicTime triggered_at, deadline;
        std::uint64_t window = 0;
        bool committing = false;
        PointRecord point;
        DatumRecord datum;
        std::optional<Synchronisation> synchronisation; ///< of point or datum
        EventRecord event;                              ///< of a skip or an end
    };

    void on(const Arm& arm, RunActions& out);
    void on(const TriggerEvent& event, RunActions& out);
    void on(const WindowResult& result, RunActions& out);
    void on(const Committed& committed, RunActions& out);
    void on(const CommitFailed& failed, RunActions& out);
    void on(const DiskBack& back, RunActions& out);
    void on(const EnvironmentNow& environment, RunActions& out);
    void on(const LaserFault& fault, RunActions& out);
    void on(const Abort& abort, RunActions& out);
    void on(const Tick& tick, RunActions& out);

    // run_machine_retake.cpp: points taken again, readings left out
    void on(const Retake& retake, RunActions& out);
    void on(const Exclude& exclude, RunActions& out);
    void on(const RevisionKept& kept, RunActions& out);
    void on(const RevisionLost& lost, RunActions& out);
    void reopen(MonotonicTime at, RunActions& out);
    void adopt_orders(const RunRevisions& orders, const RunRecord& run);
    void take_back_steps(std::size_t first, MonotonicTime at, RunActions& out);
    /// What a person's selection names; the sentence says why none of it can be meant.
    /// @param skipped_too  points that the CNC skipped can be taken, but not left out
    [[nodiscard]] Result<std::vector<int>> chosen(const PointSelection& selection,
                                                  bool skipped_too) const;
    [[nodiscard]] bool is_without_point(int planned_step) const;
    [[nodiscard]] int without_point() const;
    [[nodiscard]] std::optional<Error> objection_to_retake(const Retake& retake) const;
    [[nodiscard]] bool is_left_out(int planned_step) const;
    [[nodiscard]] bool leaves_enough(const std::vector<int>& planned_steps) const;
    [[nodiscard]] bool awaits_retake(int planned_step) const;
    [[nodiscard]] bool plan_is_done() const;
    void append_retakes(const std::vector<RetakePoint>& points);

    // run_machine.cpp: order of requests, commits, closing
    [[nodiscard]] std::optional<Error> objection_now() const;
    bool answered_by_order(const TriggerEvent& event, RunActions& out);
    bool answered_after_resume(const TriggerEvent& event, RunActions& out);
    void start_command(const TriggerEvent& event, RunActions& out);
    void commit_event(const TriggerEvent& event, Purpose purpose, RunActions& out);
    [[nodiscard]] std::optional<Error> objection_to_skip(const TriggerEvent& event) const;
    [[nodiscard]] bool last_was_skipped() const;
    void settle_commit(const Pending& settled, RunActions& out);
    void close(bool complete, std::string reason, Fault fault, RunActions& out);
    static void answer_with_close(RunActions& out);
    void close_as_wanted(RunActions& out); ///< once nothing is on its way to the disk
    [[nodiscard]] static bool holds(const RunRecord& run, const Pending& record);
    void adopt(const Pending& record);
    void close_when_idle(Close wanted, MonotonicTime at, RunActions& out);
    void refuse(std::uint16_t sequence,
                TriggerOrigin origin,
                const Error& error,
                MonotonicTime at,
                RunActions& out);
    void refuse(const TriggerEvent& event, const Error& error, RunActions& out);
    /// A person's order is not taken: nothing is recorded, and nothing of the run changes.
    static void object(std::uint16_t sequence, const Error& error, RunActions& out);
    void record(EventKind kind,
                MonotonicTime at,
                std::string text,
                Fault fault,
                std::uint16_t sequence,
                RunActions& out);
    void set_state(PortState state, RunActions& out);
    /// The first step that is neither taken nor skipped.
    [[nodiscard]] std::optional<int> next_step() const;

    // run_machine_capture.cpp: what a request must fit, what a window must show
    void start_datum(const TriggerEvent& event, RunActions& out);
    void start_point(const TriggerEvent& event, RunActions& out);
    [[nodiscard]] Error no_datum_yet() const;
    [[nodiscard]] std::optional<Error> objection_to_claim(const TriggerEvent& event,
                                                          int step) const;
    void open_window(Pending pending,
                     std::optional<ApproachClaim> approach,
                     Length expected,
                     RunActions& out);
    void accept_datum(const Capture& capture, RunActions& out);
    void accept_point(const Capture& capture, RunActions& out);
    [[nodiscard]] std::optional<Error> objection_to_place(Length position, Length target) const;
    [[nodiscard]] bool is_target_before(Length target) const;
    [[nodiscard]] std::string place_text(Length position, Length target) const;
    [[nodiscard]] bool may_have_been_unseen(const Error& error) const;
    void refuse_pending(const Error& error, MonotonicTime at, RunActions& out);

    RunSetup setup_;
    PortState state_ = PortState::idle;
    bool armed_ = false, closed_ = false, complete_ = false, stopped_ = false;
    bool first_request_after_resume_ = false, approach_unseen_ = false, any_accepted_ = false;
    std::uint16_t last_durable_ = 0;
    int last_durable_step_ = -1;
    std::vector<bool> done_, skipped_; ///< by step; those of retakes follow the plan's
    std::vector<int> retaken_;         ///< by step beyond the plan: the plan's step
    std::vector<int> last_reading_; ///< by the plan's step: step of the reading that counts, or -1
    std::vector<int> excluded_;     ///< steps
    int retakes_ = 0;               ///< orders
    std::optional<DatumRecord> datum_;
    std::uint32_t datum_epoch_ = 0;
    bool datum_broken_ = false; ///< counting was interrupted since: the next capture ends the run
    int datum_count_ = 0;
    MonotonicTime approach_since_{};
    std::vector<ClaimedTarget> first_claims_; ///< the first accepted targets, at most two
    Result<double> scale_minus_1_ =
        fail(Fault::environment_stale, "No environment reading has come yet.");
    /// What an order added that is not known to be on disk.
    struct Unkept {
        std::size_t first_step = 0; ///< of those added; the number of all when there is none
        std::vector<int> excluded;
        bool reopens = false;
    };
    std::optional<Unkept> unkept_;
    std::optional<Pending> pending_;
    std::optional<Pending> unwritten_;  ///< its commit failed; waits for the disk
    std::optional<Close> wanted_close_; ///< waits for the outstanding commit
    std::uint64_t windows_ = 0;
    std::optional<Refuse> last_refusal_; ///< an unchanged one is not recorded again
    std::vector<AcceptedPoint> accepted_;
    std::optional<Length> last_position_, last_deviation_;
    std::optional<Synchronisation> last_synchronisation_;
    RunCounters counters_;
};

/// Closing reason of a run that ended by an acknowledged request: its program goes on.
inline constexpr const char* ended_by_cnc = "The CNC ended the run before its last point.";

/// Faults after which an incremental counter does not know its zero any more.
bool breaks_counting(Fault fault);

} // namespace axiscal
