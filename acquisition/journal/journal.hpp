#pragma once
// The one writer of an open run: a thread that owns the run file, and the only maker of receipts.

#include "acquisition/journal/journal_clock.hpp"
#include "acquisition/runfile/ed25519.hpp"
#include "analysis/record/circular_setup.hpp"
#include "analysis/record/run_attachments.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"
#include "analysis/record/stream_record.hpp"
#include "drivers/loop/scheduler.hpp"
#include "drivers/trigger/journal_receipt.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

struct RunBatch;
class RunFileWriter;
struct RunFileContents;
struct RunSummary;
struct StoredDrift;
struct StoredResult;
struct StoredRuns;
struct WantedDrift;
struct WantedRun;

/// Where commits wait for the disk: `own` thread for a daemon, or `caller`, for tools and replay
/// under a virtual clock, where nothing else has to go on meanwhile.
enum class JournalThread : std::uint8_t { own, caller };

/// Coroutines resume on the scheduler's executor; they cannot be cancelled, because a commit under
/// way is either durable or not. The Journal must outlive them. note() and failure() are
/// thread-safe; the coroutines are loop-bound.
///
/// A failed commit is final: every later one fails with Fault::not_durable and the first cause.
class Journal {
public:
    /// @param clock  what a thread of its own waits by; must outlive the journal.
    explicit Journal(Scheduler& scheduler,
                     JournalThread thread = JournalThread::own,
                     JournalClock& clock = JournalClock::steady());
    /// Writes what was noted and leaves an open run open, to be resumed.
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Every closing from now on; before the first run is opened. Null: nothing is signed.
    void sign_with(std::shared_ptr<const SecretKey> key);

    /// A new run file. @errors Fault::refused when the name is taken, Fault::busy while another
    /// run is open, Fault::not_durable.
    Task<Result<void>> open(std::string path, RunRecord header, RunAttachments attachments);
    /// With nothing beside the run.
    Task<Result<void>> open(std::string path, RunRecord header);
    /// Goes on with a run file that was left open. @errors as RunFileWriter::reopen.
    Task<Result<void>> reopen(std::string path);
    /// Goes on with a closed run: `retake` or `exclusions`, and who ordered them, are its first new
    /// rows, on disk when this returns. @errors as RunFileWriter::reopen_closed.
    Task<Result<void>> reopen_closed(std::string path,
                                     std::optional<RetakeRecord> retake,
                                     std::vector<ExclusionRecord> exclusions,
                                     std::vector<OrderRecord> orders = {});
    /// The same with an answer to a finding.
    Task<Result<void>> reopen_closed(std::string path, AnswerRecord answer, OrderRecord order);

    /// Durable, with everything noted before, when the receipt comes.
    /// @errors Fault::not_durable; Fault::no_run_armed when no run is open.
    Task<Result<JournalReceipt>> commit(PointRecord point,
                                        std::optional<Synchronisation> synchronisation = {});
    /// The receipt's step is -1.
    Task<Result<JournalReceipt>> commit(DatumRecord datum,
                                        std::optional<Synchronisation> synchronisation = {});
    /// An event that the CNC waits for (skip, end, abort); the receipt bears `step`.
    Task<Result<JournalReceipt>> commit(EventRecord event, int step);
    /// For what is durable already, read back from disk: a point by its step, the last datum by -1.
    /// @errors Fault::not_found.
    Task<Result<JournalReceipt>> receipt_for(int step);
    /// The same for a skipped step, which is an event: found by the request that skipped it.
    Task<Result<JournalReceipt>> receipt_for_skip(std::uint16_t sequence, int step);
    /// The same for a request of a circular test; its receipt's step is `sequence` - 1.
    Task<Result<JournalReceipt>> receipt_for_circle(std::uint16_t sequence);

    /// For what the newest request of a closed run made durable.
    /// @errors Fault::not_found when no request did; Fault::refused while it is open.
    Task<Result<JournalReceipt>> receipt_of_closed(std::string path);

    /// look_through_runs() off the loop. `boot_id`: of the computer now.
    Task<Result<StoredRuns>> stored_runs(std::string folder, BootId boot_id);
    /// summarize_run_file() off the loop.
    Task<Result<RunSummary>> summarize(std::string path);

    /// read_stored_result() off the loop.
    Task<Result<StoredResult>> stored_result(std::string path);

    /// As find_drift(), off the loop.
    Task<Result<StoredDrift>> find_drift(std::string folder, WantedDrift wanted);
    /// As find_complete_run(), off the loop.
    Task<Result<RunFileContents>> find_complete_run(std::string folder, WantedRun wanted);

    /// Queued: durable with the next commit, or two seconds later at the latest.
    void note(EventRecord event);
    void note(std::vector<EnvironmentReading> readings);
    /// Of a circular test, before its first chunk.
    void note(CircularSetup setup, std::vector<StreamSetup> streams);
    /// False, and not queued, while `most_chunks` wait for the disk: the caller counts it.
    bool note(StreamChunk chunk);
    /// 64 s of 1 kHz, 21 s of 50 kHz; 16 MB at most, and those that are being written beside them.
    static constexpr std::size_t most_chunks = 64;
    void note(std::vector<PreflightRecord> checks);
    void note(RetakeRecord retake);
    void note(std::vector<ExclusionRecord> exclusions);
    void note(OrderRecord order);
    /// Makes everything noted durable now.
    Task<Result<void>> flush();

    /// After a failed write: lets go of the run file and forgets the failure, so that reopen() can
    /// verify and sync what is on disk, as after a restart. What was noted meanwhile is kept.
    Task<void> let_go();
    /// tidy_run_files() off the loop.
    Task<Result<void>> tidy(std::string folder);
    /// try_folder() off the loop.
    Task<Result<void>> try_folder(std::string folder);
    /// The run of a run file, read and verified off the loop.
    Task<Result<RunRecord>> read(std::string path);
    /// Everything in it, the same way.
    Task<Result<RunFileContents>> contents(std::string path);

    /// Ends the run: one single file, synced. The journal can then open another.
    Task<Result<void>> close(bool complete, std::string reason);

    /// Why nothing can be made durable any more, if so.
    [[nodiscard]] std::optional<Error> failure() const;

private:
    struct Worker;
    Task<Result<void>> reopen_closed(std::string path, std::shared_ptr<RunBatch> first);
    Task<Result<JournalReceipt>> commit(RunBatch batch, std::uint16_t sequence, int step);
    using Lookup = Result<std::optional<std::uint16_t>> (*)(const RunFileWriter& writer, int key);
    Task<Result<JournalReceipt>> receipt_by(Lookup lookup, int key, int step);

    Scheduler& scheduler_;
    std::unique_ptr<Worker> worker_;
};

} // namespace axiscal
