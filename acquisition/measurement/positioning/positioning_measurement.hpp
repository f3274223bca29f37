#pragma once
// The positioning run: the axis is captured at each target, when the CNC or a person asks for it.
// RunMachine decides what is taken, its ReadingRule what a reading says; here it is carried out and
// made durable.

#include "acquisition/capture/capture.hpp"
#include "acquisition/capture/stillness.hpp"
#include "acquisition/live/roles.hpp"
#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/measurement.hpp"
#include "acquisition/measurement/positioning/armed_run.hpp"
#include "acquisition/measurement/positioning/left_positioning.hpp"
#include "acquisition/measurement/positioning/positioning_port.hpp"
#include "acquisition/measurement/positioning/set_up_watch.hpp"
#include "acquisition/measurement/positioning/shown_figures.hpp"
#include "acquisition/measurement/revisable.hpp"
#include "acquisition/run/run_machine.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"
#include "drivers/trigger/journal_receipt.hpp"
#include "drivers/trigger/trigger_port.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

struct RunFileContents;

/// It ends with its last point, by an abort, or where its datum is lost. When the disk fails it
/// waits: nothing is acknowledged until then. After its closing it answers the repeat of its last
/// request, and can be added to while its set-up stands.
class PositioningMeasurement final : public Measurement, public Revisable {
public:
    /// Makes its run file; begin() records. @errors as Journal::open, with what to do.
    static Task<Result<std::shared_ptr<PositioningMeasurement>>> open(PositioningContext context,
                                                                      ArmedRun armed);
    /// Of a run that an earlier daemon left open; go_on() records.
    /// @param reading  as ArmedRun::reading
    /// @param proof    why its datum holds, for the record. @errors as Journal::reopen.
    static Task<Result<std::shared_ptr<PositioningMeasurement>>>
    reopen(PositioningContext context,
           std::string path,
           RunFileContents contents,
           std::shared_ptr<const ReadingRule> reading,
           std::string proof);
    /// Of a complete run that an earlier daemon closed: it can be added to.
    /// @param reading  as ArmedRun::reading
    static std::shared_ptr<PositioningMeasurement>
    of_closed(const PositioningContext& context,
              std::string path,
              RunFileContents contents,
              std::shared_ptr<const ReadingRule> reading,
              ClosedBefore before);
    /// By these three alone.
    /// @param header  without points
    PositioningMeasurement(const PositioningContext& context,
                           RunRecord header,
                           std::string path,
                           RunMachine machine);

    [[nodiscard]] const RunState& run() const override { return run_; }
    [[nodiscard]] const RunRecord& header() const { return header_; } ///< without points
    void begin(const Orderer& by) override;
    /// Of a run that a person armed at its datum. A run whose datum cannot be tied is closed again:
    /// the technician mends the cause and arms anew. @errors the cause.
    Task<Result<void>> await_datum();
    /// In place of begin() after reopen(). The port is not open yet: the first thing a CNC can read
    /// of us is the last durable request. @errors as Journal::receipt_for. It records all the same.
    Task<Result<void>> go_on() override;

    void on_sample(const Sample& sample) override;
    bool on_trigger(const TriggerEvent& event) override;
    /// Ten times a second, also when it is closed.
    void on_time(MonotonicTime now) override;
    /// A person captures the next point. @errors why it is refused.
    Result<void> trigger() override;
    /// Of a polygon whose faces a person reads. @errors as StationInterface::type_reading.
    Result<void> type_reading(double seconds_of_arc) override;
    Task<Result<RunEnding>> abort(std::string reason, Orderer by) override;
    void judge_instruments() override;
    Task<Result<void>> on_disk_back(MonotonicTime since) override;

    Result<std::shared_ptr<Revisable>> to_be_added_to() override { return held(); }
    Task<Result<RetakeAnswer>> retake(RevisionRequest request) override;
    Task<Result<int>> exclude(RevisionRequest request) override;
    Task<Result<void>> answer_finding(AnswerRequest request) override;
    [[nodiscard]] bool order_is_lost() const override { return revision_unknown_; }
    [[nodiscard]] Result<void> order_is_known() const override;

    /// It takes requests and readings: neither closing nor closed.
    [[nodiscard]] bool records() const { return run_.stage == RunState::Stage::open; }
    /// Its closing row is on disk. Not while a closed run is closed again.
    [[nodiscard]] bool is_written() const override { return written_; }
    /// Closed as incomplete, and not by the CNC's own request; also while it is being closed.
    [[nodiscard]] bool broken_off() const override { return broken_off_; }
    void keep_certificate(const Result<std::string>& entry) override;

    [[nodiscard]] RunStatus status() const;
    [[nodiscard]] PointsView points(std::size_t from) const override;
    /// Where it stands, while the run is open; how far from the next target, near it.
    void put_on_axis(AxisView& axis, Length reading) const override;
    void put_on_port(PortStatus& status) const override;
    void put_on_status(StationStatus& shown) const override;
    /// Where the axis stands, while the datum of the closed run holds; not where a reading shows it
    /// near a target alone, or not at all.
    [[nodiscard]] std::optional<Length> place_now() const override;

private:
    /// What the run machine answers a person. It goes to nobody else.
    struct Answer {
        std::optional<Error> refusal;
        std::optional<RecordRetake> retake;
        std::optional<RecordExclusion> exclusion;
    };
    struct Input {
        RunInput input;
        std::shared_ptr<Answer> answer; ///< of a person's request
    };
    /// Of a run that an earlier daemon opened.
    struct Interruption {
        RunRecord run; ///< with its points
        std::string sentence;
    };
    /// One channel of the environment, and when it was recorded last.
    struct Logged {
        int channel = 0;
        std::optional<MonotonicTime> at;
    };
    using Self = std::shared_ptr<PositioningMeasurement>;

    [[nodiscard]] Self held();
    [[nodiscard]] std::string runs_folder() const;
    void note(const std::string& sentence) const;
    void record(EventKind kind, std::string sentence, Fault fault = Fault::none);
    void take_reading(const Sample& sample);
    void watch_set_up(const Sample& sample);
    void log_environment(const Sample& sample);
    void log_environment_anew(); ///< the first point needs a reading before it
    Task<Result<RunEnding>> await_closing();

    // positioning_actions.cpp: the run machine's actions
    /// Inputs are handled one after the other, each with all its actions, also when an action
    /// feeds the next.
    void feed(RunInput input);
    void feed_with_air(RunInput input); ///< the refractive index of this moment first
    Answer ask(RunInput input);
    void take_up_inputs();
    void refresh_air();
    [[nodiscard]] Result<double> scale_now() const;
    [[nodiscard]] Result<double> within_limits(Result<double> scale) const;
    void handle(const RunInput& input);
    void perform(PublishArmed action);
    void perform(OpenWindow action);
    void perform(CloseWindow action);
    void perform(CommitPoint action);
    void perform(CommitDatum action);
    void perform(CommitEvent action);
    void perform(Acknowledge action);
    void perform(RepublishDone action);
    void perform(const Refuse& action);
    void perform(RecordEvent action);
    void perform(RecordRetake action);
    void perform(RecordExclusion action);
    void perform(SetState action);
    void perform(Close action);
    void publish_done(std::uint16_t sequence, bool skipped);
    void warn_of_skip(const Acknowledge& action);
    void refused_manually(const Refuse& action, Error error);
    template <class Record>
    static Task<void> commit(Self test, Record record, std::optional<Synchronisation> at);
    static Task<void> commit_event(Self test, CommitEvent action);
    void settle(const Result<JournalReceipt>& receipt);
    static Task<void> close(Self test, Close action);
    Task<void> certify();

    // positioning_windows.cpp: still windows, and readings that a person types
    static Task<void> watch_window(Self test, OpenWindow window);
    static Task<void> await_typed(Self test, OpenWindow window);
    [[nodiscard]] std::optional<Result<Capture>>
    look_into(StillWindowSearch& search, const OpenWindow& window, MonotonicTime now) const;
    bool drop_order_of_who_has_gone(MonotonicTime now);
    [[nodiscard]] bool reads_faces() const { return context_.roles.autocollimator.has_value(); }

    // positioning_retake.cpp, positioning_answer.cpp: what is added
    [[nodiscard]] Result<void> datum_stands() const;
    [[nodiscard]] Result<void> set_up_stands() const;
    Task<Result<void>> write_revision(Answer order, OrderRecord ordered);
    Task<Result<void>> keep_revision(Answer order, Orderer by);
    void run_is_open_again();
    Task<void> show_last_number();
    Task<Result<void>> close_again();
    static Task<void> certify_once_unread(Self test);
    Task<Result<void>> finding_stands(std::string finding);

    // positioning_disk.cpp
    DiskBack disk_back(RunFileContents contents);
    Task<Result<void>> go_on_after_disk(DiskBack back);
    Task<Result<void>> look_for_lost_order();
    Task<Result<void>> take_up_order(RunFileContents contents);
    Task<Result<void>> close_after_disk();
    Task<Result<void>> finish_after_disk();

    // positioning_resume.cpp
    Task<Result<void>> publish_last_done(RunRecord run);
    void be_closed(std::string reason, std::uint32_t epoch, ClosedBefore before);

    // positioning_view.cpp
    [[nodiscard]] Length target_of(const PlannedPoint& point) const;
    [[nodiscard]] std::optional<Length> place_of(Length reading) const;
    [[nodiscard]] std::optional<Length> place_near(Length target, Length reading) const;
    [[nodiscard]] std::string state_text(const RunView& view) const;
    void tell_trouble(RunStatus& run, const RunView& view) const;
    [[nodiscard]] std::optional<double> seconds_left(const RunView& view) const;

    PositioningContext context_;
    RunRecord header_; ///< without points
    RunMachine machine_;
    RunState run_;
    bool written_ = false;    ///< its closing row is on disk
    bool broken_off_ = false; ///< closed as incomplete, and not by the CNC's own request
    std::deque<Input> inputs_;
    std::shared_ptr<Answer> answering_; ///< while that request is handled, and no longer
    bool handling_ = false;
    std::uint64_t open_window_ = 0;
    std::optional<DatumRecord> datum_;
    std::uint32_t datum_epoch_ = 0; ///< of the laser's counter under which the datum holds
    bool datum_lost_told_ = false;
    std::optional<JournalReceipt> last_receipt_;
    std::optional<Error> refusal_; ///< since the last durable record
    /// Why the reading could not be tied to the datum: the answer to who armed it.
    std::optional<Error> not_tied_;
    std::vector<PreflightRecord> checks_; ///< until begin()
    bool datum_by_cnc_ = false;
    std::function<bool()> orderer_has_gone_;   ///< while the datum is sought
    bool limits_waived_ = false;               ///< armed in spite of the environment
    std::optional<Interruption> interruption_; ///< until go_on()
    bool resumed_ = false;            ///< of an earlier daemon: who answers late may be another
    bool taken_over_ = false;         ///< an earlier daemon closed it, perhaps in another boot
    std::string restart_;             ///< of a closed run that was taken over, to be recorded
    SetUpWatch set_up_;               ///< since it was closed
    std::size_t answers_ = 0;         ///< to findings, in its file
    bool revision_unknown_ = false;   ///< an order could not be kept: the file may hold it
    std::vector<Logged> environment_; ///< in the order of StationRoles::environment()
    /// Points that became durable under this daemon, for the time that is left.
    int taken_ = 0;
    MonotonicTime first_taken_, last_taken_;
    mutable ShownFigures figures_; ///< remembers what it computed; a look changes nothing else
};

} // namespace axiscal
