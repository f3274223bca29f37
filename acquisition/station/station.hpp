#pragma once
// The station: joins instruments, trigger port, tests and journal on one loop. What a kind of test
// is, and what speaks against one, stands in acquisition/measurement. Loop-bound.
//
// Its tasks end with the loop: when a station is destroyed, the loop must not run again.

#include "acquisition/journal/journal.hpp"
#include "acquisition/live/channel_facts.hpp"
#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/notices.hpp"
#include "acquisition/live/outbox_watch.hpp"
#include "acquisition/live/roles.hpp"
#include "acquisition/live/station_interface.hpp"
#include "acquisition/live/supervisor.hpp"
#include "acquisition/measurement/beam_watch.hpp"
#include "acquisition/measurement/certificates.hpp"
#include "acquisition/measurement/disk_wait.hpp"
#include "acquisition/measurement/latest_tests.hpp"
#include "acquisition/measurement/measurement.hpp"
#include "acquisition/measurement/order_context.hpp"
#include "acquisition/measurement/positioning/axis_instruments.hpp"
#include "acquisition/measurement/positioning/positioning_port.hpp"
#include "acquisition/measurement/recovery.hpp"
#include "acquisition/measurement/revisable.hpp"
#include "acquisition/measurement/run_file_closer.hpp"
#include "acquisition/runfile/signing_key.hpp"
#include "acquisition/station/fault_teller.hpp"
#include "acquisition/station/sleep_lock.hpp"
#include "config/station_config.hpp"
#include "drivers/loop/doorbell.hpp"
#include "drivers/trigger/trigger_port.hpp"

#include <boost/asio/cancellation_signal.hpp>
#include <cstdint>
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
                      private PositioningPort {
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
    [[nodiscard]] PointsView points(std::size_t from) const override;
    [[nodiscard]] AlignmentView alignment() const override;
    Result<void> align(AlignmentOrder order) override;

private:
    // SupervisorListener, TriggerSink
    void on_sample(const Sample& sample) override;
    void on_instrument_state(const InstrumentView& view) override;
    void on_instrument_note(const InstrumentView& view) override;
    void on_trigger(const TriggerEvent& event) override;
    void on_cnc_silent(bool silent) override;
    void on_port_note(Fault fault, std::string sentence) override;

    // PositioningPort: what a test tells the CNC
    void publish_armed() override;
    void acknowledge(const JournalReceipt& receipt) override;
    void refuse_on_port(std::uint16_t sequence, const Error& error) override;
    void publish_no_run() override;
    void show(PortState state) override;
    void acknowledge_skip(const JournalReceipt& receipt) override;
    void end_requests(RunEnd end) override;
    void publish_position(MonotonicTime at, double position_mm) override;
    void start_with(PortState state) override { port_state_ = state; }
    void publish_anew() override { publish_to_port(); }

    /// An event of this moment, with the next commit.
    void record(EventKind kind, std::string sentence, Fault fault = Fault::none);

    /// What the last daemon left, tried until the disk takes records; opens the port then.
    Task<void> open_port_once_taken_over(std::string told);

    // station_revise.cpp: a person adds to a run, also after it was closed
    Task<Result<std::shared_ptr<Revisable>>> run_to_revise();
    [[nodiscard]] Result<std::shared_ptr<Revisable>> run_that_may_be_revised() const;
    void find_out_about_order(const Revisable& test);

    // station_view.cpp
    void publish_to_port();
    [[nodiscard]] AxisView axis_view() const;
    [[nodiscard]] ToDoFacts to_do_facts() const;

    // station_time.cpp: what only time decides
    /// Ten times a second while something can change by time alone, else when somebody rings.
    Task<void> tick();
    Task<void> pause_before_looking();
    void look_at_the_time();
    /// Of the limits, once a second: told when it leaves them and when it is back.
    void judge_environment();
    void keep_awake();
    void notice_sleep();
    /// A run, a drift test or an alignment goes on, an instrument speaks, or what was read last
    /// still grows old.
    [[nodiscard]] bool time_counts() const;

    void open_port();
    Task<void> serve_port();
    Task<void> try_out_sleep_lock();
    void keep_reading(const Sample& sample);
    void record_instrument(const std::string& sentence, const LogFacts& about);
    [[nodiscard]] static std::string news_of_state(const InstrumentView& view); ///< "is faulty"
    /// What its change of state is worth: nothing where it sees no face on the way.
    [[nodiscard]] std::string news_of_autocollimator(const InstrumentView& view);
    void note(const std::string& sentence) { notices_.note(sentence); }
    // The run or circular test that is open, or was the last one; null before the first.
    [[nodiscard]] const std::shared_ptr<Measurement>& last_run() const { return tests_.run(); }
    [[nodiscard]] bool run_open() const { return tests_.run_open(); }
    [[nodiscard]] bool takes_records() const { return tests_.takes_records(); }
    [[nodiscard]] bool is_unwritten() const { return tests_.is_unwritten(); }
    [[nodiscard]] bool drift_open() const { return tests_.rest_goes_on(); }
    /// Also of the newest run of the last daemon.
    [[nodiscard]] bool broken_off() const;
    [[nodiscard]] ChannelFacts channels() const {
        return {config_, roles_, supervisor_, readings_};
    }
    /// What a test works with. It refers to this station.
    [[nodiscard]] MeasurementContext measurement_context();
    [[nodiscard]] CncContext cnc_context();
    [[nodiscard]] PositioningContext positioning_context();
    [[nodiscard]] OrderContext order_context();
    [[nodiscard]] bool reads_polygon() const { return axiscal::reads_polygon(config_); }
    /// Its autocollimator is an instrument; else a person reads it and types.
    [[nodiscard]] bool reads_faces() const { return roles_.autocollimator.has_value(); }

    void sign_with(StationKey key);

    Scheduler& scheduler_;
    StationConfig config_;
    StationRoles roles_;
    std::string config_hash_;
    BootId boot_id_;
    SleepLock sleep_lock_;
    Supervisor supervisor_;
    std::unique_ptr<TriggerPort> port_;
    Journal journal_;
    LiveReadings readings_;
    mutable OutboxWatch outbox_watch_; ///< remembers what it read; a look changes nothing else
    MonotonicTime judged_{};
    Duration stale_after_{};            ///< a sample may change what is shown or judged so long
    MonotonicTime time_counts_until_{}; ///< at least: everything read has grown old by then
    bool asleep_ = false;               ///< tick() waits for the bell
    Doorbell bell_;
    Notices notices_;
    FaultTeller fault_teller_;
    bool stopping_ = false; ///< the daemon is about to end
    UnderWay under_way_;
    RunFileCloser files_;
    Certificates certificates_;
    LatestTests tests_;
    DiskWait disk_;
    Recovery recovery_;
    BeamWatch beam_;
    PortState port_state_ = PortState::idle;
    boost::asio::cancellation_signal end_port_;
    InstrumentState autocollimator_ = InstrumentState::unavailable; ///< as told last
    bool cnc_silent_ = false;
    JudgedChecks judged_checks_;  ///< by the last order, or by whoever asked since
    bool arming_refused_ = false; ///< by checks that the next preflight() judges again and tells
};

} // namespace axiscal
