#pragma once
// Which field of the run record stands in which column (schema.sql). Pure.
// A field added to a record breaks the structured binding in record_rows.cpp: give it a column.

#include "acquisition/runfile/row.hpp"
#include "acquisition/runfile/schema.hpp"
#include "analysis/record/run_attachments.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"
#include "analysis/record/stream_record.hpp"

#include <span>

namespace axiscal {

/// How a run ended; its row is the last link of a closed file.
struct Closing {
    bool complete = false;
    std::string reason;
    ClockTie tie;
};

/// Everything that rows are placed into.
struct RecordedRun : RunRecord {
    std::vector<StreamSetup> streams;
    std::vector<StreamBlock> blocks; ///< as they were written
    RunRevisions revisions;
    RunAttachments attachments;
};

struct ChainedRow {
    const Table* table = nullptr;
    Row row;
};

/// Every table whose rows are links of the chain, in the order of the schema: `run` is the first.
std::span<const Table> chained_tables();
const Table& table_named(std::string_view name);

/// The rows written when the file is made, in order; points, datums, environment, events and
/// closing of `header` are not among them.
std::vector<ChainedRow> header_rows(const RunRecord& header,
                                    const RunAttachments& attachments = {});
/// `stated`: what the uncertain time of its samples adds to the reading; empty: not stated.
ChainedRow row_of(const DatumRecord& datum, const std::optional<Synchronisation>& stated);
ChainedRow row_of(const PointRecord& point, const std::optional<Synchronisation>& stated);
ChainedRow row_of(const EnvironmentReading& reading);
ChainedRow row_of(const EventRecord& event);
ChainedRow row_of(const Closing& closing);
/// None of a positioning run, whose plan says all.
std::vector<ChainedRow> rows_of(const TestSetup& setup);
ChainedRow row_of(const StreamSetup& stream);
ChainedRow row_of(const StreamBlock& block);
ChainedRow row_of(const PreflightRecord& check);
ChainedRow row_of(const ExclusionRecord& exclusion);
ChainedRow row_of(const AnswerRecord& answer);
ChainedRow row_of(const OrderRecord& order);
/// The order, then its points.
std::vector<ChainedRow> rows_of(const RetakeRecord& retake);
/// A row that may stand after a closing row: the run is open again from there on.
bool reopens(const Table& table);

/// Puts one checked row into its place in `run`.
/// @errors Fault::bad_run_file naming table, column and value.
Result<void> place_row(RecordedRun& run, const Table& table, const Row& row);

} // namespace axiscal
