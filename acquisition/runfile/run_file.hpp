#pragma once
// One run is one SQLite file, <run-id>.axiscal; docs/run-file.md describes it. Blocking calls:
// the daemon makes them on the journal's thread.

#include "acquisition/runfile/digest.hpp"
#include "acquisition/runfile/ed25519.hpp"
#include "acquisition/runfile/record_rows.hpp"
#include "acquisition/runfile/statement.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace axiscal {

struct RunFileContents;

inline constexpr std::string_view run_file_ending = ".axiscal";

/// What becomes durable together.
struct RunBatch {
    std::vector<EnvironmentReading> environment;
    std::vector<EventRecord> events;
    std::vector<PreflightRecord> preflight;
    std::vector<RetakeRecord> retakes;
    std::vector<ExclusionRecord> exclusions;
    std::vector<AnswerRecord> answers;
    std::vector<OrderRecord> orders;
    std::optional<DatumRecord> datum;
    std::optional<PointRecord> point;
    std::vector<PointRecord> imported; ///< all points of a run that others measured, in their order
    std::optional<Synchronisation> synchronisation; ///< of the point, else of the datum
    std::optional<CircularSetup> circular;          ///< once, before the first block
    std::vector<StreamSetup> streams;
    std::vector<StreamChunk> chunks; ///< compressed when they are written
    [[nodiscard]] bool empty() const;
};

/// The open run file. A write that returned without error is on disk (WAL, synchronous=FULL).
/// After the first Fault::not_durable every further call fails with it: a failed sync is never
/// retried. A value that could not be read back (NaN) is refused as Fault::internal, unwritten.
/// For one thread at a time.
class RunFileWriter {
public:
    /// Makes the file with everything of `header` that is known before the first point. The name
    /// appears only with the whole header in it and is never taken from another file.
    /// @errors Fault::refused when the name is taken; Fault::not_durable, Fault::bad_run_file.
    static Result<RunFileWriter> create(const std::string& path,
                                        const RunRecord& header,
                                        const RunAttachments& attachments = {});
    /// Goes on with an open file; all that it holds is verified and synced first.
    /// @errors Fault::refused when the run is closed; Fault::bad_run_file.
    static Result<RunFileWriter> reopen(const std::string& path);
    /// Goes on with a closed file, for points that are taken again, readings that are left out or an
    /// answer; `first` must hold one of these, and no checks; it is written at once.
    /// @errors Fault::refused for an open file; Fault::internal for another `first`.
    static Result<RunFileWriter> reopen_closed(const std::string& path, const RunBatch& first);
    RunFileWriter(const RunFileWriter&) = delete;
    RunFileWriter& operator=(const RunFileWriter&) = delete;
    RunFileWriter(RunFileWriter&&) noexcept;
    RunFileWriter& operator=(RunFileWriter&&) noexcept;
    ~RunFileWriter(); ///< leaves the run open, to be resumed

    /// Gives the log of commits its full length before the first of them: each then overwrites, and
    /// its sync waits for the data alone.
    void reserve_log() const;

    /// One transaction, in the order preflight, retakes, exclusions, answers, orders, circular,
    /// streams, chunks, environment, events, datum, point.
    Result<void> write(const RunBatch& batch);
    /// A sentence that a person should find in the file.
    Result<void> append_note(std::string text, MonotonicTime at, std::int64_t utc_ns);

    /// Sequence numbers as they stand on disk; empty when there is no such row.
    [[nodiscard]] Result<std::optional<std::uint16_t>> sequence_of_point(int step) const;
    [[nodiscard]] Result<std::optional<std::uint16_t>> sequence_of_last_datum() const;
    [[nodiscard]] Result<std::optional<std::uint16_t>>
    sequence_of_skip(std::uint16_t sequence) const;
    /// The same of a request before a circle, or at an end of its arc.
    [[nodiscard]] Result<std::optional<std::uint16_t>>
    sequence_of_circle(std::uint16_t sequence) const;

    /// Writes the closing row and leaves one single file without WAL, synced with its folder.
    /// @param key  signs it, in the same transaction; null: nobody
    /// @errors Fault::busy while another program reads the file: the closing row is durable then,
    /// and a further call only tries the rest.
    Result<void>
    close(bool complete, std::string reason, const ClockTie& tie, const SecretKey* key = nullptr);
    [[nodiscard]] const std::string& path() const { return path_; }
    /// The closing row is durable.
    [[nodiscard]] bool closed() const { return closed_; }

private:
    RunFileWriter(std::string path, std::unique_ptr<Database> database);
    static Result<RunFileWriter> attach(const std::string& path);
    static Result<RunFileWriter> go_on(const std::string& path, const RunFileContents& contents);
    Result<Statement*> insertion_into(const Table& table);
    Result<void> append(const ChainedRow& row);
    /// `before`: SQL of the same transaction that comes first; `key` signs what is closed in it.
    Result<void> transact(const std::vector<ChainedRow>& rows,
                          const std::string& before = {},
                          const SecretKey* key = nullptr);
    Result<void> keep(Result<void> outcome);

    std::string path_;
    std::unique_ptr<Database> database_;
    std::map<std::string_view, Statement> insertions_; ///< by table
    std::int64_t links_ = 0;                           ///< in the chain so far
    Digest head_{}; ///< hash of the last link; zeros before the first
    bool closed_ = false;
    std::optional<Error> broken_;
};

struct StoredResult {
    std::string digest;   ///< as given by the analysis: of `parameters` and `positions`
    std::string document; ///< JSON
};

/// Everything in a run file.
struct RunFileContents {
    RunRecord run; ///< of points that were taken again, the last ones
    RunRevisions revisions;
    int results = 0; ///< stored so far
    std::vector<StreamSetup> streams;
    std::vector<StreamBlock> blocks; ///< as they were written
    RunAttachments attachments;
    bool closed = false;
    std::int64_t links = 0;
    Digest chain_head{}; ///< proves every row before it
};

/// Reads and verifies: identity and version, schema, SQLite's own check, each column's type and
/// range, the hash chain. Never writes to the file. Safe on hostile files.
/// @errors Fault::bad_run_file with a sentence that names what is wrong and, in the chain, where;
///         Fault::not_found.
Result<RunFileContents> read_run_file_contents(const std::string& path);
Result<RunRecord> read_run_file(const std::string& path);

/// Adds a result to a closed run file; several may be kept, the last one counts. The chain is not
/// touched; the file's SHA-256 changes.
/// @param key  signs it with the last closing; null: nobody
/// @errors Fault::refused while the run is open, and without a key where the closing is signed.
Result<void>
store_result(const std::string& path, const StoredResult& result, const SecretKey* key = nullptr);
/// @errors Fault::not_found when none is stored; Fault::bad_run_file when it was changed.
Result<StoredResult> read_stored_result(const std::string& path);

/// What the CNC was last told as `done` under a closed run: the newest point, datum, skip or end
/// that a request made durable.
struct LastRequest {
    std::uint16_t sequence = 0;
    int step = -1; ///< -1: no point
};
/// Empty when a person did everything. @errors Fault::refused while the run is open.
Result<std::optional<LastRequest>> last_request_of_closed(const std::string& path);

/// The last row is a closing row: nothing reopened the run since.
Result<bool> is_run_closed(const Database& database);

/// One line of a list of runs, read quickly: the chain is not verified.
struct RunSummary {
    TestKind kind = TestKind::positioning;
    std::string path, run_id, machine, axis, closing_reason;
    BootId boot_id; ///< of the computer when the run was opened
    MonotonicTime opened_at;
    std::int64_t opened_utc_ns = 0; ///< what the clock said
    int points = 0, planned = 0, closings = 0;
    bool closed = false, complete = false;
    bool evaluated = false;         ///< a result is stored since the last closing
    std::optional<std::string> bar; ///< its channel, "gauge/axis 1": of a drift test of a ballbar
    std::string machine_serial, machine_state; ///< as stated: "4711", "as found"; empty: not stated
};
Result<RunSummary> summarize_run_file(const std::string& path);
/// Folder of its certificate: the run's id, made anew by id_of_name() in case the file comes from
/// elsewhere. A run that was added to after its first one gets another: nothing
/// that was issued is replaced.
std::string certificate_name(const RunSummary& run);
/// Run files of a folder by name; unreadable ones are left out. Empty when there is no folder.
std::vector<RunSummary> list_run_files(const std::string& folder);
/// Brings back to one file what a power cut left between closing row and tidying; sweeps files
/// that were never finished. For the station's start, before any run is open.
Result<void> tidy_run_files(const std::string& folder);

} // namespace axiscal
