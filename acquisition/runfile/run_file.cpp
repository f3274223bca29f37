#include "acquisition/runfile/run_file.hpp"

#include "acquisition/runfile/durable_file.hpp"
#include "acquisition/runfile/file_users.hpp"
#include "acquisition/runfile/run_signature.hpp"
#include "acquisition/runfile/schema.hpp"
#include "acquisition/runfile/statement.hpp"
#include "acquisition/runfile/stream_packing.hpp"

#include <algorithm>
#include <fcntl.h>
#include <filesystem>
#include <iterator>
#include <set>
#include <unistd.h>

namespace axiscal {
namespace {

std::string insert_sql(const Table& table) {
    std::string marks = "?";
    for (std::size_t i = 0; i < table.types.size() + 1; ++i)
        marks += ",?";
    return "INSERT INTO " + std::string{table.name} + "(link, " + std::string{table.columns} +
           ", hash) VALUES(" + marks + ")";
}

Blob blob_of(const Digest& digest) {
    return Blob{std::string{digest.begin(), digest.end()}};
}

tl::unexpected<Error> held_by_others(const std::string& path) {
    return fail(Fault::busy, path + " is read by " + file_users_text(path) +
                                 ": the station goes on as soon as that program is ended");
}

// Back from WAL to one file that can be mailed. The first pragma tells 1 where a reader is in its
// way, and no error.
Result<void> fold_into_one_file(Database& database, const std::string& path) {
    AXISCAL_TRY(const auto in_the_way, database.integer_of("PRAGMA wal_checkpoint(TRUNCATE)"));
    if (in_the_way != 0) return held_by_others(path);
    const auto mode = database.value_of("PRAGMA journal_mode=DELETE");
    if (!mode && database.is_held()) return held_by_others(path);
    if (!mode) return tl::unexpected<Error>(mode.error());
    if (*mode != Value{std::string{"delete"}}) return held_by_others(path);
    return {};
}

Result<void> sync_with_folder(const std::string& path) {
    AXISCAL_CHECK(sync_file(path));
    return sync_folder(folder_of(path));
}

// What could not be read back is not written: a program error, not one of the disk.
Result<void> check_before_writing(const ChainedRow& row) {
    RecordedRun scratch;
    auto readable = check_row(*row.table, row.row);
    if (readable) readable = place_row(scratch, *row.table, row.row);
    if (!readable) return fail(Fault::internal, "not written: " + readable.error().detail);
    return {};
}

/// What a circular test adds; the chunks are compressed here, on the journal's own thread.
std::vector<ChainedRow> circular_rows(const RunBatch& batch) {
    std::vector<ChainedRow> rows;
    if (batch.circular) rows = rows_of(TestSetup{*batch.circular});
    for (const auto& stream : batch.streams)
        rows.push_back(row_of(stream));
    for (const auto& chunk : batch.chunks)
        rows.push_back(row_of(packed(chunk)));
    return rows;
}

std::vector<ChainedRow> rows_of_captures(const RunBatch& batch) {
    std::vector<ChainedRow> rows;
    if (batch.datum)
        rows.push_back(row_of(*batch.datum, batch.point ? std::nullopt : batch.synchronisation));
    if (batch.point) rows.push_back(row_of(*batch.point, batch.synchronisation));
    for (const PointRecord& point : batch.imported)
        rows.push_back(row_of(point, std::nullopt));
    return rows;
}

Error as_not_durable(Error error) {
    if (error.fault == Fault::io) error.fault = Fault::not_durable;
    return error;
}

} // namespace

bool RunBatch::empty() const {
    return environment.empty() && events.empty() && preflight.empty() && retakes.empty() &&
           exclusions.empty() && answers.empty() && orders.empty() && !datum && !point &&
           imported.empty() && !circular && streams.empty() && chunks.empty();
}

RunFileWriter::RunFileWriter(std::string path, std::unique_ptr<Database> database)
    : path_{std::move(path)}
    , database_{std::move(database)} {}
RunFileWriter::RunFileWriter(RunFileWriter&&) noexcept = default;
RunFileWriter& RunFileWriter::operator=(RunFileWriter&&) noexcept = default;
RunFileWriter::~RunFileWriter() = default;

Result<RunFileWriter> RunFileWriter::attach(const std::string& path) {
    AXISCAL_TRY(auto database,
                Database::open(path, Database::Access::read_write, Fault::not_durable));
    return RunFileWriter{path, std::move(database)};
}

Result<RunFileWriter> RunFileWriter::create(const std::string& path,
                                            const RunRecord& header,
                                            const RunAttachments& attachments) {
    const std::string unfinished = path + ".new";
    std::error_code cannot_look; // then it cannot be written either, which tells why
    if (std::filesystem::exists(path, cannot_look))
        return fail(Fault::refused, path + " exists already: a run file is never overwritten");
    if (auto made = write_synced(unfinished, ""); !made)
        return tl::unexpected<Error>(as_not_durable(made.error()));
    Result<Digest> head = [&]() -> Result<Digest> {
        AXISCAL_TRY(auto writer, attach(unfinished));
        AXISCAL_CHECK(
            writer.database_->execute("PRAGMA synchronous=EXTRA; PRAGMA page_size=4096;"));
        const std::string mark =
            "PRAGMA application_id=" + std::to_string(run_file_application_id) +
            "; PRAGMA user_version=" + std::to_string(run_file_version) + ";";
        // One transaction: a disk that takes 10 ms for a sync is not asked for it table by table.
        AXISCAL_CHECK(writer.transact(header_rows(header, attachments), mark + run_file_schema));
        return writer.head_;
    }();
    if (!head) return tl::unexpected<Error>(head.error());
    if (auto moved = move_to_free_name(unfinished, path); !moved)
        return tl::unexpected<Error>(as_not_durable(moved.error()));
    if (auto synced = sync_with_folder(path); !synced)
        return tl::unexpected<Error>(as_not_durable(synced.error()));
    return reopen(path);
}

Result<RunFileWriter> RunFileWriter::reopen(const std::string& path) {
    AXISCAL_TRY(const auto contents, read_run_file_contents(path));
    if (contents.closed) return fail(Fault::refused, path + " is closed: nothing can be added");
    return go_on(path, contents);
}

Result<RunFileWriter> RunFileWriter::reopen_closed(const std::string& path, const RunBatch& first) {
    const bool revises =
        !first.retakes.empty() || !first.exclusions.empty() || !first.answers.empty();
    if (!revises || !first.preflight.empty())
        return fail(Fault::internal,
                    path + " may be reopened by a retake, an exclusion or an answer only");
    AXISCAL_TRY(const auto contents, read_run_file_contents(path));
    if (!contents.closed) return fail(Fault::refused, path + " is open already");
    AXISCAL_TRY(auto writer, go_on(path, contents));
    AXISCAL_CHECK(writer.write(first));
    return writer;
}

Result<RunFileWriter> RunFileWriter::go_on(const std::string& path,
                                           const RunFileContents& contents) {
    AXISCAL_TRY(auto writer, attach(path));
    const auto mode = writer.database_->value_of("PRAGMA journal_mode=WAL");
    if (!mode && writer.database_->is_held()) return held_by_others(path);
    if (!mode) return tl::unexpected<Error>(mode.error());
    if (*mode != Value{std::string{"wal"}})
        return fail(Fault::not_durable, path + ": this file system does not carry a WAL");
    AXISCAL_CHECK(writer.database_->execute("PRAGMA synchronous=FULL"));
    // What a killed process wrote may be in the page cache only: sync it before it counts. The log
    // by itself: where a reader is in its way, the checkpoint leaves it as it is.
    if (std::filesystem::exists(path + "-wal")) AXISCAL_CHECK(sync_file(path + "-wal"));
    AXISCAL_CHECK(writer.database_->execute("PRAGMA wal_checkpoint(TRUNCATE)"));
    writer.links_ = contents.links;
    writer.head_ = contents.chain_head;
    return writer;
}

// SQLite takes a log whose header is no header for an empty one, and overwrites it from its start.
void RunFileWriter::reserve_log() const {
    constexpr std::size_t header = 32, frame = 24 + 4096; // file format of SQLite, section 4
    constexpr std::size_t frames = 1000;                  // then it folds them back by itself
    reserve_zeros(path_ + "-wal", header + frames * frame);
}

/// Compiled once a table: for a small row that is most of the work.
Result<Statement*> RunFileWriter::insertion_into(const Table& table) {
    auto known = insertions_.find(table.name);
    if (known == insertions_.end()) {
        AXISCAL_TRY(auto insert, database_->prepare(insert_sql(table)));
        known = insertions_.emplace(table.name, std::move(insert)).first;
    }
    return &known->second;
}

Result<void> RunFileWriter::append(const ChainedRow& row) {
    const Digest hash = sha256_link(head_, canonical_bytes(*row.table, row.row));
    AXISCAL_TRY(Statement * insert, insertion_into(*row.table));
    AXISCAL_CHECK(insert->bind({links_ + 1}));
    AXISCAL_CHECK(insert->bind(row.row, 2));
    AXISCAL_CHECK(insert->bind({blob_of(hash)}, static_cast<int>(row.row.size()) + 2));
    if (auto stepped = insert->step(); !stepped) return tl::unexpected<Error>(stepped.error());
    ++links_;
    head_ = hash;
    return {};
}

Result<void> RunFileWriter::transact(const std::vector<ChainedRow>& rows,
                                     const std::string& before,
                                     const SecretKey* key) {
    if (broken_) return tl::unexpected<Error>(*broken_);
    for (const auto& row : rows)
        AXISCAL_CHECK(check_before_writing(row));
    return keep([&]() -> Result<void> {
        AXISCAL_CHECK(database_->execute("BEGIN IMMEDIATE"));
        if (!before.empty()) AXISCAL_CHECK(database_->execute(before));
        for (const auto& row : rows)
            AXISCAL_CHECK(append(row));
        if (key != nullptr) AXISCAL_CHECK(append_signature(*database_, *key, std::nullopt));
        return database_->execute("COMMIT");
    }());
}

Result<void> RunFileWriter::keep(Result<void> outcome) {
    if (outcome) return outcome;
    broken_ = outcome.error();
    broken_->fault = Fault::not_durable;
    if (auto undone = database_->execute("ROLLBACK"); !undone && broken_->detail.empty())
        broken_->detail = undone.error().detail;
    return tl::unexpected<Error>(*broken_);
}

Result<void> RunFileWriter::write(const RunBatch& batch) {
    std::vector<ChainedRow> rows;
    for (const auto& check : batch.preflight)
        rows.push_back(row_of(check));
    for (const auto& retake : batch.retakes)
        std::ranges::move(rows_of(retake), std::back_inserter(rows));
    for (const auto& exclusion : batch.exclusions)
        rows.push_back(row_of(exclusion));
    for (const auto& answer : batch.answers)
        rows.push_back(row_of(answer));
    for (const auto& order : batch.orders)
        rows.push_back(row_of(order));
    std::ranges::move(circular_rows(batch), std::back_inserter(rows));
    for (const auto& reading : batch.environment)
        rows.push_back(row_of(reading));
    for (const auto& event : batch.events)
        rows.push_back(row_of(event));
    std::ranges::move(rows_of_captures(batch), std::back_inserter(rows));
    if (rows.empty() && !broken_) return {};
    return transact(rows);
}

Result<void> RunFileWriter::append_note(std::string text, MonotonicTime at, std::int64_t utc_ns) {
    RunBatch batch;
    batch.events.push_back({EventKind::note, at, utc_ns, std::move(text), Fault::none, 0});
    return write(batch);
}

namespace {

Result<std::optional<std::uint16_t>> sequence_in(const Database& database, const std::string& sql) {
    AXISCAL_TRY(const auto value, database.value_of(sql));
    const auto* sequence = std::get_if<std::int64_t>(&value);
    if (sequence == nullptr) return std::optional<std::uint16_t>{};
    return std::optional{static_cast<std::uint16_t>(*sequence)};
}

} // namespace

Result<std::optional<std::uint16_t>> RunFileWriter::sequence_of_point(int step) const {
    if (broken_) return tl::unexpected<Error>(*broken_);
    return sequence_in(*database_, "SELECT sequence FROM point WHERE step=" + std::to_string(step));
}

Result<std::optional<std::uint16_t>> RunFileWriter::sequence_of_last_datum() const {
    if (broken_) return tl::unexpected<Error>(*broken_);
    return sequence_in(*database_, "SELECT sequence FROM datum ORDER BY link DESC LIMIT 1");
}

Result<std::optional<std::uint16_t>> RunFileWriter::sequence_of_skip(std::uint16_t sequence) const {
    if (broken_) return tl::unexpected<Error>(*broken_);
    return sequence_in(*database_, "SELECT sequence FROM event WHERE kind='skipped' AND sequence=" +
                                       std::to_string(sequence) + " LIMIT 1");
}

Result<std::optional<std::uint16_t>>
RunFileWriter::sequence_of_circle(std::uint16_t sequence) const {
    if (broken_) return tl::unexpected<Error>(*broken_);
    return sequence_in(*database_, "SELECT sequence FROM event WHERE kind='note' AND sequence=" +
                                       std::to_string(sequence) + " LIMIT 1");
}

Result<void>
RunFileWriter::close(bool complete, std::string reason, const ClockTie& tie, const SecretKey* key) {
    if (!closed_) {
        AXISCAL_CHECK(transact({row_of(Closing{complete, std::move(reason), tie})}, {}, key));
        closed_ = true;
        broken_ = Error{Fault::refused, path_ + " is closed: nothing can be added", {}, {}};
        insertions_.clear();
    }
    AXISCAL_CHECK(fold_into_one_file(*database_, path_));
    database_.reset();
    return sync_with_folder(path_);
}

namespace {

/// Result and signature in one transaction: neither stands without the other.
Result<void> insert_result(Database& database, const StoredResult& result, const SecretKey* key) {
    AXISCAL_CHECK(database.execute("PRAGMA synchronous=EXTRA; BEGIN IMMEDIATE"));
    {
        AXISCAL_TRY(auto insert,
                    database.prepare("INSERT INTO result(digest, document, hash) VALUES(?,?,?)"));
        const Digest hash = sha256(result.digest + '\n' + result.document);
        AXISCAL_CHECK(insert.bind({result.digest, result.document, blob_of(hash)}));
        if (auto stepped = insert.step(); !stepped) return tl::unexpected<Error>(stepped.error());
        if (key != nullptr) AXISCAL_CHECK(append_signature(database, *key, hash));
    }
    return database.execute("COMMIT");
}

} // namespace

Result<void>
store_result(const std::string& path, const StoredResult& result, const SecretKey* key) {
    AXISCAL_TRY(const auto summary, summarize_run_file(path));
    if (!summary.closed) return fail(Fault::refused, path + " is still open: close the run first");
    AXISCAL_TRY(auto database,
                Database::open(path, Database::Access::read_write, Fault::not_durable));
    AXISCAL_TRY(const bool signed_closing, is_closing_signed(*database));
    if (signed_closing && key == nullptr)
        return fail(Fault::refused, path + " was closed with a signature, and the key for that of "
                                           "its result is gone: start axiscald anew");
    return insert_result(*database, result, key);
}

Result<void> tidy_run_files(const std::string& folder) {
    std::error_code error;
    std::set<std::string> found;
    for (std::filesystem::directory_iterator entry{folder, error}, end; !error && entry != end;
         entry.increment(error))
        found.insert(entry->path().string());
    for (const auto& path : found)
        if (path.ends_with(".axiscal.new") || path.ends_with(".axiscal.new-journal"))
            std::filesystem::remove(path, error);
    Result<void> outcome;
    for (const auto& path : found) {
        if (!path.ends_with(run_file_ending)) continue;
        if (!found.contains(path + "-wal") && !found.contains(path + "-journal")) continue;
        AXISCAL_TRY(auto database, Database::open(path, Database::Access::read_write, Fault::io));
        AXISCAL_TRY(const bool closed, is_run_closed(*database));
        if (!closed) continue;
        auto folded = fold_into_one_file(*database, path);
        database.reset();
        if (folded) folded = sync_with_folder(path);
        if (!folded && folded.error().fault != Fault::busy) return folded;
        if (!folded) outcome = std::move(folded);
    }
    return outcome;
}

} // namespace axiscal
