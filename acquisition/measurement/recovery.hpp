#pragma once
// What an earlier daemon left: runs that were open go on or are closed, certificates that it could
// not make are made, and its newest run can be added to.

#include "acquisition/measurement/latest_tests.hpp"
#include "acquisition/measurement/left_run.hpp"
#include "acquisition/measurement/positioning/positioning_port.hpp"
#include "acquisition/measurement/positioning/set_up_watch.hpp"
#include "analysis/quantity/result.hpp"
#include "drivers/loop/scheduler.hpp"
#include "drivers/sample.hpp"
#include "drivers/trigger/journal_receipt.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace axiscal {

struct StoredRuns;

/// Loop-bound. Its tasks end with the loop, as those of the station that has it.
class Recovery {
public:
    /// @param arming  somebody opens a test just now
    Recovery(const PositioningContext& context, LatestTests& tests, const bool& arming);

    /// Once, before the port opens; again where the disk failed. What goes on is put on.
    /// @errors Fault::not_durable while the disk is why it cannot be done; those of
    /// look_through_runs().
    Task<Result<void>> take_over_stored_runs();
    /// The newest run, where none is known yet. Only when a person asks: a station that is started
    /// shows no old run. An exclusion needs no set-up; a retake is refused with what it lost.
    /// @errors Fault::no_run_armed, Fault::busy
    Task<Result<void>> take_over_closed_run();
    /// Of what measures the axis: until a run is known, for the one of an earlier daemon.
    void watch_set_up(const Sample& sample);

    /// Why the run of the last daemon could not go on, told to a CNC that waits for it.
    [[nodiscard]] const std::optional<Error>& why_not() const { return why_not_; }
    /// Another test takes its place.
    void forget_why_not() { why_not_.reset(); }
    /// The newest run of the last daemon was broken off.
    [[nodiscard]] bool left_broken_off() const { return left_broken_off_; }

private:
    [[nodiscard]] std::string runs_folder() const;
    Task<Result<void>> resume_or_close(std::string path);
    Task<Result<void>> go_on(TakenOver taken, std::int64_t opened_utc_ns);
    Task<Result<void>> close(std::string path, LeftClosing closing);
    Task<void> publish_done_of_closed(std::string newest_path);
    void keep_hold_of_broken_off(const StoredRuns& stored);
    Task<Result<RunSummary>> newest_closed_run();
    [[nodiscard]] bool somebody_else_began() const { return tests_.run() || arming_; }
    /// Certificates of complete runs that the last daemon could not finish.
    Task<void> certify_left_over(StoredRuns stored);
    [[nodiscard]] bool lacks_certificate(const RunSummary& run) const;
    Task<void> certify(std::string run_id, std::string path);

    PositioningContext context_;
    LatestTests& tests_;
    const bool& arming_;
    SetUpWatch set_up_since_start_;
    std::optional<JournalReceipt> done_of_closed_; ///< what the CNC was told of the newest run
    std::optional<Error> why_not_;
    bool left_broken_off_ = false;
};

} // namespace axiscal
