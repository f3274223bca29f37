#pragma once
// The station: joins instruments, trigger port, run machine and journal on one loop. It carries out
// what the run machine decides and decides nothing about a run itself. Loop-bound.
//
// Its tasks end with the loop: when a station is destroyed, the loop must not run again.

#include "acquisition/capture/beam_alignment.hpp"
#include "acquisition/capture/stillness.hpp"
#include "acquisition/journal/journal.hpp"
#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/notices.hpp"
#include "acquisition/live/outbox_watch.hpp"
#include "acquisition/live/roles.hpp"
#include "acquisition/live/station_interface.hpp"
#include "acquisition/live/supervisor.hpp"
#include "acquisition/measurement/certificates.hpp"
#include "acquisition/measurement/circular/circle_measurement.hpp"
#include "acquisition/measurement/circular/circle_resume.hpp"
#include "acquisition/measurement/cnc_answer.hpp"
#include "acquisition/measurement/drift/drift_measurement.hpp"
#include "acquisition/measurement/drift/environmental_variation.hpp"
#include "acquisition/measurement/drift/resting_test.hpp"
#include "acquisition/measurement/measurement.hpp"
#include "acquisition/measurement/positioning/set_up_watch.hpp"
#include "acquisition/measurement/run_file_closer.hpp"
#include "acquisition/measurement/run_header.hpp"
#include "acquisition/preflight/preflight.hpp"
#include "acquisition/run/run_machine.hpp"
#include "acquisition/runfile/run_store.hpp"
#include "acquisition/runfile/signing_key.hpp"
#include "acquisition/station/sleep_lock.hpp"
#include "config/station_config.hpp"
#include "drivers/loop/doorbell.hpp"
#include "drivers/trigger/trigger_port.hpp"

#include <boost/asio/cancellation_signal.hpp>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace axiscal {

struct StationParts {
    StationConfig config;
    StationRoles roles;
    std::vector<std::unique_ptr<Instrument>> instruments;
    std::map<std::string, Tape> tapes; ///< by instrument, of those that are none
    std::unique_ptr<TriggerPort> port;
    std::string config_hash;
    BootId boot_id;
    std::string report_program = "axiscal-report";
    std::string inhibit_program; ///< systemd-inhibit; empty: the computer may fall asleep
    JournalThread journal_thread = JournalThread::own;
    StationKey key; ///< signs what is closed
};

class Station final : public StationInterface,
                      private SupervisorListener,
                      private TriggerSink,
                      private CncAnswer {
public:
    Station(Scheduler& scheduler, LinkOpener& links, StationParts parts);
    ~Station() override;
    Station(const Station&) = delete;
    Station& operator=(const Station&) = delete;

    /// Instruments first, then an open run is resumed or closed, the trigger port last. While the
    /// disk takes no records an open run waits for it, and the port with it.
    /// @errors Fault::io when the state directory cannot be used.
    Task<Result<void>> start();
    /// The trigger port is told to end first, then everything noted is made durable; an open run
    /// stays open.
    Task<void> stop();

    [[nodiscard]] StationStatus status() const override;
    Task<Result<std::string>> arm(ArmRequest request) override;
    Result<void> trigger() override;
    Result<void> type_reading(double seconds_of_arc) override;
    Task<Result<RunEnding>> abort(std::string reason, Orderer by = {}) override;
    Task<Result<std::vector<PreflightRecord>>> preflight(ArmRequest request) override;
    Task<Result<RetakeAnswer>> retake(RevisionRequest request) override;
    Task<Result<int>> exclude(RevisionRequest request) override;
    Task<Result<void>> answer_finding(AnswerRequest request) override;
    Task<Result<std::string>> drift(DriftRequest request) override;
    [[nodiscard]] std::optional<StreamView> stream(std::size_t most) const override;
    [[nodiscard]] AlignmentView alignment() const override;
    Result<void> align(AlignmentOrder order) override;

private:
    /// The positioning run that is open, or the last one. None while a circular test is the last.
    struct CurrentRun {
        RunRecord header; ///< without points
        std::string path;
        bool closing = false, closed = false;
        bool closing_row_durable = false;
        std::optional<Error> closing_error; ///< why it is closed, and its file is not
        /// Why the reading could not be tied to the datum: the answer to who armed it.
        std::optional<Error> not_tied;
        std::function<bool()> orderer_has_gone; ///< while the datum is sought
        bool limits_waived = false;             ///< armed in spite of the environment
        bool resumed = false;    ///< of an earlier daemon: who answers late may be another
        bool taken_over = false; ///< an earlier daemon closed it, perhaps in another boot
        std::size_t answers = 0; ///< to findings, in its file
        bool broken_off = false; ///< closed as incomplete, and not by the CNC's own request
        std::optional<Close> outcome;
        std::optional<Error> refusal; ///< since the last durable record
        std::string certificate;      ///< folder
        std::optional<Error> no_certificate;
        /// Points that became durable under this daemon, for the time that is left.
        int taken = 0;
        MonotonicTime first_taken, last_taken;
    };

    // SupervisorListener, TriggerSink
    void on_sample(const Sample& sample) override;
    void on_instrument_state(const InstrumentView& view) override;
    void on_instrument_note(const InstrumentView& view) override;
    void on_trigger(const TriggerEvent& event) override;
    void on_cnc_silent(bool silent) override;
    void on_port_note(Fault fault, std::string sentence) override;

    // CncAnswer: what a test tells the CNC
    void publish_armed() override;
    void acknowledge(const JournalReceipt& receipt) override;
    void refuse_on_port(std::uint16_t sequence, const Error& error) override;
    void publish_no_run() override;
    void show(PortState state) override;

    // station_run.cpp: the run machine's actions
    /// Inputs are handled one after the other, each with all its actions, also when an action
    /// feeds the next.
    void feed(RunInput input);
    void feed_with_air(RunInput input); ///< the refractive index of this moment first
    /// What the run machine answers a person. It goes to nobody else.
    struct Answer {
        std::optional<Error> refusal;
        std::optional<RecordRetake> retake;
        std::optional<RecordExclusion> exclusion;
    };
    Answer ask(RunInput input);
    void take_up_inputs();
    void refresh_air();
    void handle(const RunInput& input);
    void perform(PublishArmed action);
    void perform(OpenWindow action);
    void perform(CloseWindow action);
    void perform(CommitPoint action);
    void perform(CommitDatum action);
    void perform(CommitEvent action);
    void perform(Acknowledge action);
    void warn_of_skip(const Acknowledge& action);
    void publish_done(std::uint16_t sequence, bool skipped);
    void perform(RepublishDone action);
    void perform(const Refuse& action);
    void refused_manually(const Refuse& action, Error error);
    void perform(RecordEvent action);
    /// An event of this moment, with the next commit.
    void record(EventKind kind, std::string sentence, Fault fault = Fault::none);
    void perform(RecordRetake action);
    void perform(RecordExclusion action);
    void perform(SetState action);
    void perform(Close action);
    Task<void> watch_window(OpenWindow window);
    bool drop_order_of_who_has_gone(MonotonicTime now);

    // station_polygon.cpp: the faces of a polygon, typed or read
    Task<void> await_typed(OpenWindow window);
    void take_face(const Sample& sample);
    /// Why no still window was found in time, in seconds of arc.
    [[nodiscard]] Error no_still_face(const StillnessVerdict& seen) const;
    /// What its change of state is worth: nothing where it sees no face on the way.
    [[nodiscard]] std::string news_of_autocollimator(const InstrumentView& view);
    [[nodiscard]] Result<void> autocollimator_speaks() const;
    /// Its channel, where the checks look at it; its facts are filled in then.
    std::optional<int> autocollimator_for(PreflightFacts& facts) const;

    template <class Record>
    Task<void> commit(Record record, std::optional<Synchronisation> synchronisation);
    Task<void> commit_event(CommitEvent action);
    void settle(Result<JournalReceipt> receipt);
    Task<void> close_run(Close action);
    Task<void> certify(std::string run_id, std::string path);

    // station_circular.cpp: a circular test is ordered; CircleMeasurement is the test itself
    [[nodiscard]] Result<void> ready_for_circles() const;
    /// It did so within the last two seconds; in its range or not.
    [[nodiscard]] Result<void> ballbar_speaks() const;
    Task<Result<std::string>> arm_circular(ArmRequest request);
    Task<Result<std::string>> open_circular(ArmRequest request);
    /// It takes the place of the last run, or circular test.
    void begin_circles(std::shared_ptr<CircleMeasurement> test);

    // station_circular_resume.cpp: a test that was open when the last daemon ended
    Task<Result<void>> resume_or_close_circles(std::string path, RunFileContents contents);
    Task<Result<void>>
    resume_circles(std::string path, RunFileContents contents, CircleResume verdict);
    Task<Result<void>> close_driven_circles(std::string path);

    // station_disk.cpp: the disk failed under an open run
    /// Tries until the run file can be written again, then goes on with the run or closes it.
    Task<void> wait_for_disk();
    /// @param path  of the positioning run; a circular test knows its own
    Task<Result<void>> try_disk(std::string path, MonotonicTime since);
    /// What the last daemon left, tried until the disk takes records; opens the port then.
    Task<void> take_over_when_disk_is_back(std::string message);
    /// Why no file may grow where the runs are, if so.
    Task<std::optional<Error>> disk_trouble();
    Task<Result<void>> close_file_for_now(bool complete, std::string reason);
    Task<void> wait_for_readers();
    DiskBack disk_back(RunFileContents contents);
    Task<Result<void>> go_on_after_disk(DiskBack back);
    Task<Result<void>> look_for_lost_order(std::string path);
    Task<Result<void>> take_up_order(std::string path, RunFileContents contents);
    Task<Result<void>> close_after_disk();
    Task<Result<void>> finish_after_disk();
    /// What failed and what to do, without the fault's own sentence.
    [[nodiscard]] std::string disk_text(const Error& error) const {
        return axiscal::disk_text(error, config_.state_directory);
    }

    // station_arm.cpp: opening and resuming
    Task<Result<std::string>> open_and_tie(ArmRequest request);
    void begin_run(RunRecord header, std::string path, RunMachine machine);
    [[nodiscard]] std::string runs_folder() const { return config_.state_directory + "/runs"; }
    /// @errors Fault::not_durable while the disk is why it cannot be done; those of
    /// look_through_runs().
    Task<Result<void>> take_over_stored_runs();
    void open_port();
    void keep_hold_of_broken_off(const StoredRuns& stored);
    /// Certificates of complete runs that the last daemon could not finish.
    [[nodiscard]] bool is_of_this_daemon(const std::string& path) const;
    Task<void> certify_left_over(StoredRuns stored);
    [[nodiscard]] bool lacks_certificate(const RunSummary& run) const;
    [[nodiscard]] Result<RunPlan> plan_for(const ArmRequest& request) const;
    [[nodiscard]] Result<void> plays_no_tape() const;
    [[nodiscard]] Result<void> ready_to_measure() const;
    [[nodiscard]] Result<void> disk_takes_records() const;
    /// Neither run nor drift test is open, and nobody opens one. @errors Fault::busy
    [[nodiscard]] Result<void> nothing_goes_on() const;
    Task<Result<RunEnding>> await_closing(std::string path);

    // station_preflight.cpp
    [[nodiscard]] PreflightFacts preflight_facts(const ArmRequest& request) const;
    [[nodiscard]] SensorFacts sensor_facts(int channel) const;

    // station_environment.cpp: the limits of the environment
    /// Once a second: told when it leaves them and when it is back.
    void judge_environment();
    [[nodiscard]] std::vector<SensorFacts> environment_facts() const;
    /// For the run machine: `scale` of live_scale_now(), unless the environment is outside and the
    /// run was not armed in spite of that.
    [[nodiscard]] Result<double> within_limits(Result<double> scale) const;

    // station_closed_run.cpp: the set-up is watched, the newest run of an earlier daemon taken over
    void watch_set_up(const Sample& sample);
    Task<Result<RunSummary>> newest_closed_run();
    Task<Result<void>> take_over_closed_run();
    Task<std::string> doubt_about_datum(const RunRecord& run);

    // station_answer.cpp: what a person answers to a finding about the set-up
    Task<Result<void>> finding_stands(std::string finding);

    // station_retake.cpp: points taken again and readings left out, also after the run was closed
    [[nodiscard]] Result<void> run_may_be_revised() const;
    Task<Result<void>> write_revision(Answer order, OrderRecord ordered);
    [[nodiscard]] Result<void> datum_stands() const;
    [[nodiscard]] Result<void> set_up_stands() const;
    void run_is_open_again();
    Task<void> show_last_number();
    Task<Result<void>> keep_revision(Answer order, Orderer by);
    void find_out_about_order();
    Task<Result<void>> close_again();
    Task<void> certify_once_unread(std::string run_id, std::string path);

    [[nodiscard]] RunSetup setup_of(const RunRecord& header) const;
    /// Of a test that is opened now. @param plan  of the axis; of other tests empty
    [[nodiscard]] RunHeaderParts header_parts(TestKind kind, RunPlan plan) const;
    Task<Result<void>> await_datum();
    [[nodiscard]] bool instruments_returned() const;
    Task<Result<void>> resume_or_close(std::string path);
    Task<double> laser_rate_hz(MonotonicTime limit);
    Task<Result<void>>
    resume(std::string path, RunRecord run, RunRevisions revisions, std::string proof);
    Task<Result<void>> publish_last_done(RunRecord run);
    Task<void> publish_done_of_closed(std::string newest_path);
    Task<Result<void>>
    close_left_over(std::string path, std::string reason, Fault fault, bool whole);
    void mark_another_boot(const BootId& boot_of_run);
    [[nodiscard]] std::string laser_serial() const;

    // station_serials.cpp: whether the instruments after a restart are those of the run
    [[nodiscard]] std::string laser_serial_for(const RunRecord& run) const;
    [[nodiscard]] std::vector<InstrumentSerial> serials_of_axis() const;
    void judge_instruments();
    [[nodiscard]] const StationChannel& channel_of(int id) const;
    [[nodiscard]] std::string shown_name_of(int id) const; ///< "gauge/axis 1", as in a run file

    // station_drift.cpp: a drift test is ordered; DriftMeasurement is the test itself
    [[nodiscard]] bool drift_is_of_bar(const DriftRequest& request) const;
    [[nodiscard]] Result<void> ready_for_drift(bool of_bar) const;
    [[nodiscard]] Result<RestingTest> drift_of_axis(const DriftRequest& request) const;
    [[nodiscard]] Result<RestingTest> drift_of_bar(const DriftRequest& request) const;
    Task<Result<std::string>> open_drift(DriftRequest request, bool of_bar);
    [[nodiscard]] Result<void> rests_at(Length place) const;
    [[nodiscard]] bool drift_open() const { return resting_ && resting_->is_open(); }

    // station_eve.cpp
    /// E_VE of the drift test that the station file points to, if it does: of the bar for circles,
    /// else of the axis.
    Task<Result<std::optional<FoundEve>>> eve_for(bool circles);
    [[nodiscard]] bool takes_circles(const ArmRequest& request) const;
    /// What of it the pre-flight checks look at.
    [[nodiscard]] Result<EveFacts> eve_facts(const ArmRequest& request,
                                             const FoundEve& found) const;
    [[nodiscard]] Result<std::vector<PreflightRecord>>
    judge(const ArmRequest& request, const std::optional<FoundEve>& eve) const;

    // station_align.cpp
    void watch_alignment(const Sample& sample);
    Result<void> keep_alignment(std::optional<double> spot_offset_mm);
    [[nodiscard]] AlignmentRecord alignment_so_far() const;
    /// The latest strength that the laser told, if it is no more than 2 s old.
    [[nodiscard]] std::optional<Sample> strength_told() const;
    [[nodiscard]] std::optional<double> strength_now() const;
    /// The last one kept, where it is of the laser that is there now. One that is still going on is
    /// kept first.
    std::optional<AlignmentRecord> alignment_for_run();

    // station_view.cpp
    void publish_to_port();
    [[nodiscard]] AxisView axis_view() const;
    [[nodiscard]] RunStatus run_status() const;
    [[nodiscard]] std::optional<double> seconds_left(const RunView& view) const;
    [[nodiscard]] ChannelView channel_view(const StationChannel& channel) const;

    // station_time.cpp: what only time decides
    /// Ten times a second while something can change by time alone, else when somebody rings.
    Task<void> tick();
    Task<void> pause_before_looking();
    void look_at_the_time();
    void keep_awake();
    void notice_sleep();
    /// A run, a drift test or an alignment goes on, an instrument speaks, or what was read last
    /// still grows old.
    [[nodiscard]] bool time_counts() const;

    Task<void> serve_port();
    Task<void> try_out_sleep_lock();
    void take_reading(const Sample& sample);
    void log_environment(int channel, const Sample& sample);
    void log_environment_anew(); ///< the first point needs a reading before it
    void record_instrument(const std::string& sentence, Fault fault);
    [[nodiscard]] static std::string news_of_state(const InstrumentView& view); ///< "is faulty"
    void note(const std::string& sentence) { notices_.note(sentence); }
    /// The positioning run takes records: neither closing nor closed.
    [[nodiscard]] bool recording() const;
    // Of the run or circular test that is open, or the last one.
    [[nodiscard]] bool takes_records() const; ///< neither closing nor closed
    [[nodiscard]] bool run_open() const;
    [[nodiscard]] bool is_being_closed() const;
    [[nodiscard]] bool is_unwritten() const;              ///< its closing row is not on disk
    [[nodiscard]] bool broken_off() const;                ///< as CurrentRun has it
    [[nodiscard]] const std::string& last_run_id() const; ///< where there is one
    /// What a test works with. It refers to this station.
    [[nodiscard]] MeasurementContext measurement_context();
    [[nodiscard]] CncContext cnc_context();
    /// As LiveReadings::scale_minus_1, with the wavelength of the run.
    [[nodiscard]] Result<double> live_scale_now() const;
    /// "laser" | "scale": what measures the axis, for sentences.
    [[nodiscard]] std::string reference_word() const {
        return config_.axis.scale ? "scale" : "laser";
    }
    [[nodiscard]] std::optional<double> position_now_mm(Length reading) const;
    /// A rotary axis with a polygon before an autocollimator.
    [[nodiscard]] bool reads_polygon() const {
        return config_.axis.angle && config_.axis.angle->setup.method == AngleMethod::polygon;
    }
    /// Its autocollimator is an instrument; else a person reads it and types.
    [[nodiscard]] bool reads_faces() const { return roles_.autocollimator.has_value(); }

    void sign_with(StationKey key);
    [[nodiscard]] OrderRecord
    order_of(std::string kind, const Orderer& by, std::string about = {}) const;

    Scheduler& scheduler_;
    StationConfig config_;
    StationRoles roles_;
    std::string config_hash_;
    BootId boot_id_;
    Duration slept_{}; ///< of the computer, as last told
    SleepLock sleep_lock_;
    Supervisor supervisor_;
    std::unique_ptr<TriggerPort> port_;
    Journal journal_;
    LiveReadings readings_;
    std::vector<std::optional<MonotonicTime>> logged_; ///< by channel
    mutable OutboxWatch outbox_watch_; ///< remembers what it read; a look changes nothing else
    MonotonicTime judged_{};
    Duration stale_after_{};            ///< a sample may change what is shown or judged so long
    MonotonicTime time_counts_until_{}; ///< at least: everything read has grown old by then
    bool asleep_ = false;               ///< tick() waits for the bell
    Doorbell bell_;
    Notices notices_;
    bool stopping_ = false; ///< the daemon is about to end
    RunFileCloser files_;
    Certificates certificates_;
    std::optional<RunMachine> machine_; ///< of run_
    std::optional<CurrentRun> run_;
    /// The circular test that is open, or the last one; null where a run came after it.
    std::shared_ptr<CircleMeasurement> circles_;
    struct Input {
        RunInput input;
        std::shared_ptr<Answer> answer; ///< of a person's request
    };
    std::deque<Input> inputs_;
    std::shared_ptr<Answer> answering_; ///< while that request is handled, and no longer
    bool handling_ = false;
    std::optional<JournalReceipt> last_receipt_;
    std::uint64_t open_window_ = 0;
    PortState port_state_ = PortState::idle;
    SetUpWatch set_up_;            ///< of the run that was closed
    std::string interruption_;     ///< of a closed run that was taken over, to be recorded
    bool left_broken_off_ = false; ///< the newest run of the last daemon was, as CurrentRun has it
    std::optional<Error> left_over_fault_; ///< why the run of the last daemon could not go on
    std::optional<DatumRecord> datum_;
    std::uint32_t datum_epoch_ = 0; ///< of the laser's counter under which the datum holds
    std::shared_ptr<DriftMeasurement> resting_; ///< the drift test that is open, or the last one
    std::string newest_run_; ///< id of the stored one that was opened latest; empty: none
    std::int64_t newest_run_utc_ns_ = 0;
    BeamAlignment beam_;
    boost::asio::cancellation_signal end_port_;
    bool waiting_for_disk_ = false; ///< the run file could not be written
    InstrumentState autocollimator_ = InstrumentState::unavailable; ///< as told last
    bool arming_ = false, cnc_silent_ = false, datum_lost_told_ = false;
    bool revising_ = false;         ///< a retake, an exclusion or an answer is being kept
    bool revision_unknown_ = false; ///< one could not be kept: the file may hold it all the same
};

} // namespace axiscal
