#pragma once
// The circular test: the ballbar is recorded at its full rate from arming to the last request; each
// request of the CNC becomes durable before it is answered.

#include "acquisition/capture/min_max_pyramid.hpp"
#include "acquisition/capture/stream_chunker.hpp"
#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/circular/armed_circles.hpp"
#include "acquisition/measurement/circular/circle_order.hpp"
#include "acquisition/measurement/circular/circle_resume.hpp"
#include "acquisition/measurement/cnc_answer.hpp"
#include "acquisition/measurement/measurement.hpp"
#include "analysis/circular/circle_watch.hpp"
#include "analysis/record/circular_setup.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"
#include "analysis/record/stream_record.hpp"
#include "drivers/trigger/journal_receipt.hpp"
#include "drivers/trigger/trigger_port.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

struct RunFileContents;

/// It ends with the request after its last circle, by an abort, or where it cannot go on. When the
/// disk fails it waits: nothing is acknowledged until then.
class CircleMeasurement final : public Measurement {
public:
    /// Makes its run file; begin() records. @errors as Journal::open.
    static Task<Result<std::shared_ptr<CircleMeasurement>>> open(CncContext context,
                                                                 ArmedCircles armed);
    /// Of a test that an earlier daemon left open; go_on() records.
    /// @param verdict  of judge_left_circles(), to go on. @errors as Journal::reopen.
    static Task<Result<std::shared_ptr<CircleMeasurement>>>
    reopen(CncContext context, std::string path, RunFileContents contents, CircleResume verdict);
    /// Of a run file that the journal has open; by these two alone.
    /// @param path  of that file
    CircleMeasurement(const CncContext& context,
                      RunRecord header,
                      std::string path,
                      const CircularSetup& setup);

    [[nodiscard]] const RunState& run() const override { return run_; }
    /// Its file, as it began; of one that was reopened with what it held then, without its stream.
    [[nodiscard]] const RunRecord& header() const { return header_; }
    void begin(const Orderer& by) override;
    /// In place of begin() after reopen(). The port is not open yet, and what the CNC stands at
    /// decides: the last durable request begins its circle again, and is answered once that is
    /// durable, unless that circle is whole; the next one is taken where the circle before it is
    /// whole.
    /// @errors as Journal::receipt_for_circle and ::flush. It records all the same.
    Task<Result<void>> go_on() override;

    void on_sample(const Sample& sample) override;
    /// Once it is closed as complete it still answers the repeat of its last request.
    bool on_trigger(const TriggerEvent& event) override;
    /// A person begins the next circle, or ends the last one. @errors why it is refused.
    Result<void> trigger() override;
    Task<Result<RunEnding>> abort(std::string reason, Orderer by) override;
    void judge_instruments() override;
    void keep_rest() override;
    Task<Result<void>> on_disk_back(MonotonicTime since) override;
    /// Never: its circles are driven again.
    Result<std::shared_ptr<Revisable>> to_be_added_to() override;

    /// It takes requests and readings: neither closing nor closed.
    [[nodiscard]] bool records() const { return run_.stage == RunState::Stage::open; }
    /// Ended as incomplete, also while it is being closed.
    [[nodiscard]] bool broken_off() const override { return broken_off_; }
    [[nodiscard]] RunStatus status() const;
    [[nodiscard]] std::optional<StreamView> stream(std::size_t most) const override;
    void put_on_status(StationStatus& shown) const override;
    void put_on_port(PortStatus& status) const override;

private:
    /// Of a test that an earlier daemon opened.
    struct Interruption {
        CirclesBefore before;
        std::string sentence;
    };
    /// One channel of the environment, and when it was recorded last.
    struct Logged {
        int channel = 0;
        std::optional<MonotonicTime> at;
    };
    static Task<void>
    commit(std::shared_ptr<CircleMeasurement> test, TriggerEvent event, CircleVerdict verdict);
    static Task<void> close(std::shared_ptr<CircleMeasurement> test, RunEnding ending, Fault fault);
    [[nodiscard]] std::shared_ptr<CircleMeasurement> held();
    [[nodiscard]] StreamSetup stream_setup() const;
    void record(EventKind kind, std::string sentence, Fault fault = Fault::none);
    void take_bar(const Sample& sample);
    void log_environment(const Sample& sample);
    void keep(StreamChunk chunk);
    /// @returns the answer to a person; the CNC hears its own.
    std::optional<Error> take(const TriggerEvent& event);
    [[nodiscard]] bool repeats_last(const TriggerEvent& event) const;
    void acknowledge_again(std::uint16_t sequence);
    Error refused(const CircleVerdict& verdict, Fault fault, TriggerOrigin origin);
    void refuse(std::uint16_t sequence, Error error, TriggerOrigin origin);
    Task<void> bar_is_read_until(MonotonicTime at);
    void
    settle(const Result<JournalReceipt>& receipt, std::uint16_t sequence, TriggerOrigin origin);
    void end(bool complete, std::string reason, Fault fault);
    Task<void> certify();
    Task<Result<RunEnding>> await_closing();
    Task<Result<void>> finish_after_disk();
    [[nodiscard]] std::optional<Error> trouble() const;

    CncContext context_;
    RunRecord header_;
    CircularSetup setup_;
    int bar_;                                  ///< channel of the ballbar
    std::vector<Logged> environment_;          ///< with the temperature of the bar
    std::vector<PreflightRecord> checks_;      ///< until begin()
    std::optional<Interruption> interruption_; ///< until go_on()
    bool resumed_ = false;                     ///< who answers late may be another instrument
    RunState run_;
    bool broken_off_ = false;
    CircleOrder order_;
    std::optional<CircleWatch> watch_; ///< of a circle that began once more after a restart
    StreamChunker chunker_{0};
    MinMaxPyramid view_;
    std::uint64_t dropped_ = 0; ///< chunks, because the disk did not keep up
    std::optional<JournalReceipt> last_receipt_;
    std::optional<Error> refusal_; ///< since the last durable request
};

} // namespace axiscal
