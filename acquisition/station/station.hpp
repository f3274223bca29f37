#pragma once
// The station: joins instruments, trigger port, run machine and journal on one loop. It carries out
// what the run machine decides and decides nothing about a run itself. Loop-bound.

#include "acquisition/capture/environment_watch.hpp"
#include "acquisition/capture/sample_history.hpp"
#include "acquisition/journal/journal.hpp"
#include "acquisition/run/run_machine.hpp"
#include "acquisition/station/roles.hpp"
#include "acquisition/station/station_face.hpp"
#include "acquisition/station/supervisor.hpp"
#include "config/station_config.hpp"
#include "drivers/trigger_port.hpp"

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

struct StationParts {
    StationConfig config;
    StationRoles roles;
    std::vector<std::unique_ptr<Instrument>> instruments;
    std::unique_ptr<TriggerPort> port;
    std::string config_hash, boot_id;
    std::string report_program = "axiscal-report";
    JournalThread journal_thread = JournalThread::own;
};

class Station final : public StationFace, private SupervisorListener, private TriggerSink {
public:
    Station(Scheduler& scheduler, LinkOpener& links, StationParts parts);
    ~Station() override;
    Station(const Station&) = delete;
    Station& operator=(const Station&) = delete;

    /// Instruments first, then an open run is resumed or closed, the trigger port last.
    /// @errors Fault::io when the state directory cannot be used.
    Task<Result<void>> start();
    /// Trigger port first, then everything noted is made durable; an open run stays open.
    Task<void> stop();

    [[nodiscard]] StationStatus status() const override;
    Task<Result<std::string>> arm(ArmRequest request) override;
    Result<void> trigger() override;
    Result<void> abort(std::string reason) override;

private:
    struct OpenRun {
        RunRecord header; ///< without points
        std::string path;
        MonotonicTime began;
        int done_at_start = 0; ///< points that were durable when this daemon took the run over
    };

    // SupervisorListener, TriggerSink
    void on_sample(const Sample& sample) override;
    void on_instrument_change(const InstrumentView& view) override;
    void on_trigger(const TriggerEvent& event) override;
    void on_cnc_silent(bool silent) override;
    void on_port_note(Fault fault, std::string sentence) override;

    // station_run.cpp: the run machine's actions
    void feed(const RunInput& input);
    void perform(PublishArmed action);
    void perform(OpenWindow action);
    void perform(CloseWindow action);
    void perform(CommitPoint action);
    void perform(CommitDatum action);
    void perform(CommitEvent action);
    void perform(Acknowledge action);
    void perform(RepublishDone action);
    void perform(Refuse action);
    void perform(RecordEvent action);
    void perform(SetState action);
    void perform(Close action);
    Task<void> watch_window(OpenWindow window);
    template <class Record> Task<void> commit(Record record);
    Task<void> commit_event(CommitEvent action);
    void settle(Result<JournalReceipt> receipt);
    Task<void> close_run(Close action);

    // station_arm.cpp: opening and resuming
    void begin_run(RunRecord header, std::string path);
    [[nodiscard]] Result<std::vector<std::string>> open_runs() const;
    Result<RunPlan> plan_for(const ArmRequest& request) const;
    [[nodiscard]] Result<void> ready_to_measure() const;
    [[nodiscard]] RunSetup setup_of(const RunRecord& header) const;
    Task<Result<void>> await_datum();
    Task<Result<void>> resume_or_close(std::string path);
    Task<double> laser_rate_hz(MonotonicTime limit);
    Task<Result<void>> resume(std::string path, RunRecord run, std::string proof);
    Task<void> close_left_over(std::string path, std::string reason, Fault fault);
    [[nodiscard]] std::string laser_serial() const;

    // station_view.cpp
    void publish_to_port();
    [[nodiscard]] AxisView axis_view() const;
    [[nodiscard]] RunStatus run_status() const;
    [[nodiscard]] ChannelView channel_view(const StationChannel& channel) const;

    Task<void> serve_port();
    Task<void> tick();
    void take_reading(const Sample& sample);
    void log_environment(int channel, const Sample& sample);
    void note(const std::string& sentence);
    [[nodiscard]] Result<double> refractivity_now() const;

    Scheduler& scheduler_;
    StationConfig config_;
    StationRoles roles_;
    std::string config_hash_, boot_id_, report_program_;
    Supervisor supervisor_;
    std::unique_ptr<TriggerPort> port_;
    Journal journal_;
    SampleHistory history_;
    EnvironmentWatch watch_;
    std::vector<std::optional<Sample>> latest_;        ///< by channel
    std::vector<std::optional<MonotonicTime>> logged_; ///< by channel
    std::optional<RunMachine> machine_;
    std::optional<OpenRun> run_;
    std::optional<JournalReceipt> last_receipt_;
    std::uint64_t open_window_ = 0;
    PortState port_state_ = PortState::idle;
    std::optional<Error> last_refusal_; ///< since the last durable record
    std::optional<Close> last_outcome_;
    std::optional<DatumRecord> datum_;
    std::uint32_t laser_epoch_ = 0; ///< of the counter under which the datum holds
    double refractivity_ = 0;       ///< n - 1, the last one known; for live positions only
    std::string certificate_, port_note_;
    std::deque<std::string> notes_;
    bool cnc_silent_ = false, stopping_ = false, datum_lost_told_ = false;
    bool closing_ = false, closed_ = false; ///< of run_
};

} // namespace axiscal
