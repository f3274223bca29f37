#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/run_file_open.hpp"
#include "acquisition/runfile/schema.hpp"
#include "acquisition/runfile/setups/setup_rows.hpp"
#include "analysis/quantity/valid_text.hpp"

#include <algorithm>
#include <filesystem>

namespace axiscal {
namespace {

constexpr std::int64_t most_rows = 20'000'000; // ten channels at 1 Hz for three weeks

tl::unexpected<Error> bad(const std::string& path, const std::string& reason) {
    return fail(Fault::bad_run_file, path + ": " + reason);
}

Result<void> check_identity(const Database& database, const std::string& path) {
    AXISCAL_TRY(const auto id, database.integer_of("PRAGMA application_id"));
    if (id != run_file_application_id) return bad(path, "this is not an axiscal run file");
    AXISCAL_TRY(const auto version, database.integer_of("PRAGMA user_version"));
    if (version != run_file_version)
        return bad(path, "written in format " + std::to_string(version) +
                             " by another axiscal; this one reads format " +
                             std::to_string(run_file_version));
    return {};
}

Result<std::vector<Row>> rows_of(const Database& database, const std::string& sql) {
    AXISCAL_TRY(auto select, database.prepare(sql));
    std::vector<Row> rows;
    for (;;) {
        AXISCAL_TRY(const bool more, select.step());
        if (!more) return rows;
        Row row;
        for (int i = 0; i < select.column_count(); ++i)
            row.push_back(select.column(i));
        rows.push_back(std::move(row));
    }
}

bool belongs_to(const Row& schema_row, const SetupRows& kind) {
    return std::ranges::any_of(kind.tables, [&](const DescribedTable& one) {
        return schema_row[2] == Value{std::string{one.table.name}};
    });
}

/// The tables of a kind of test that the file has nothing of are not expected in it: it was made
/// before that kind was known. Of one table, index or view alone all are.
void expect_known_kinds(std::vector<Row>& expected, const std::vector<Row>& found) {
    for (const SetupRows* kind : later_setup_rows()) {
        const auto of_kind = [kind](const Row& row) { return belongs_to(row, *kind); };
        if (std::ranges::none_of(found, of_kind)) std::erase_if(expected, of_kind);
    }
}

// Word for word our schema: no view, trigger, index or generated column can slip in. That a later
// kind's tables may be missing hides no row: each row is a link, so what a dropped table held
// leaves a gap in the numbers and breaks the hash of the row behind it, as its rows deleted would.
Result<void> check_schema(const Database& database, const std::string& path) {
    const std::string all = "SELECT type, name, tbl_name, sql FROM sqlite_schema ORDER BY name";
    AXISCAL_TRY(const auto ours, Database::in_memory());
    AXISCAL_CHECK(ours->execute(run_file_schema));
    AXISCAL_TRY(auto expected, rows_of(*ours, all));
    AXISCAL_TRY(const auto found, rows_of(database, all + " LIMIT 100"));
    expect_known_kinds(expected, found);
    if (found != expected) return bad(path, "the tables are not those of a run file");
    return {};
}

} // namespace

// SQLite forgives a last page that is cut short; without a WAL the size is known exactly.
Result<void> check_run_file_size(const Database& database, const std::string& path) {
    std::error_code error;
    if (std::filesystem::exists(path + "-wal", error)) return {};
    AXISCAL_TRY(const auto pages, database.integer_of("PRAGMA page_count"));
    AXISCAL_TRY(const auto page_size, database.integer_of("PRAGMA page_size"));
    const auto size = std::filesystem::file_size(path, error);
    if (error || size != static_cast<std::uintmax_t>(pages * page_size))
        return bad(path, "cut short or grown: copy it again from where it was made");
    return {};
}

Result<void> check_run_file_pages(const Database& database, const std::string& path) {
    AXISCAL_TRY(const auto verdict, database.value_of("PRAGMA quick_check(1)"));
    if (verdict == Value{std::string{"ok"}}) return {};
    const auto* word = std::get_if<std::string>(&verdict);
    return bad(path, "damaged: " + (word ? *word : std::string{"no verdict"}));
}

Result<std::vector<const Table*>> chained_tables_in(const Database& database) {
    AXISCAL_TRY(const auto names,
                rows_of(database, "SELECT name FROM sqlite_schema WHERE type='table'"));
    std::vector<const Table*> tables;
    for (const Table& table : chained_tables())
        if (std::ranges::find(names, Row{std::string{table.name}}) != names.end())
            tables.push_back(&table);
    return tables;
}

namespace {

/// Beside a closed file lies what a power cut left of a write to it: the pages as they were before.
/// SQLite puts them back at the next look of somebody who may write.
Result<void> take_back_unfinished(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::exists(path + "-journal", error)) return {};
    AXISCAL_TRY(auto database,
                Database::open(path, Database::Access::read_write, Fault::bad_run_file));
    if (const auto looked = database->integer_of("PRAGMA schema_version"); !looked)
        return bad(path, "a write to it was interrupted and cannot be taken back by you: start "
                         "axiscald, or look as its user (" +
                             looked.error().detail + ")");
    return {};
}

} // namespace

Result<std::unique_ptr<Database>> open_run_file(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
        return fail(Fault::not_found, path + " is not a file");
    AXISCAL_CHECK(take_back_unfinished(path));
    AXISCAL_TRY(auto database,
                Database::open(path, Database::Access::read_only, Fault::bad_run_file));
    AXISCAL_CHECK(database->execute("BEGIN")); // one state, even while the run goes on
    AXISCAL_CHECK(check_identity(*database, path));
    AXISCAL_CHECK(check_schema(*database, path));
    return database;
}

namespace {

/// Rows of one table in chain order, read as the chain reaches them.
struct TableCursor {
    const Table* table;
    Statement select;
    bool done = false;
    std::int64_t link = 0;
    Row row;
    std::string hash;

    Result<void> advance(const std::string& path) {
        AXISCAL_TRY(const bool more, select.step());
        done = !more;
        if (done) return {};
        row.clear();
        const int last = select.column_count() - 1;
        for (int i = 1; i < last; ++i)
            row.push_back(select.column(i));
        const Value place = select.column(0), stored = select.column(last);
        if (const auto* number = std::get_if<std::int64_t>(&place)) link = *number;
        if (const auto* bytes = std::get_if<Blob>(&stored)) hash = bytes->bytes;
        if (auto checked = check_row(*table, row); !checked)
            return bad(path, "link " + std::to_string(link) + ": " + checked.error().detail);
        return {};
    }
};

Result<std::vector<TableCursor>> open_cursors(const Database& database, const std::string& path) {
    std::vector<TableCursor> cursors;
    AXISCAL_TRY(const auto tables, chained_tables_in(database));
    for (const Table* table : tables) {
        const std::string name{table->name};
        AXISCAL_TRY(const auto count, database.integer_of("SELECT count(*) FROM " + name));
        if (count > most_rows) return bad(path, name + " has more rows than any run");
        AXISCAL_TRY(auto select, database.prepare("SELECT link, " + std::string{table->columns} +
                                                  ", hash FROM " + name + " ORDER BY link"));
        cursors.push_back({table, std::move(select), false, 0, {}, {}});
        AXISCAL_CHECK(cursors.back().advance(path));
    }
    return cursors;
}

TableCursor* next_of(std::vector<TableCursor>& cursors) {
    TableCursor* next = nullptr;
    for (auto& cursor : cursors)
        if (!cursor.done && (next == nullptr || cursor.link < next->link)) next = &cursor;
    return next;
}

Result<void> take_link(RunFileContents& into,
                       RecordedRun& recorded,
                       const TableCursor& at,
                       const std::string& path) {
    const std::string name = "link " + std::to_string(into.links + 1);
    if (at.link != into.links + 1)
        return bad(path, "the row of " + name + " is missing: the file was changed");
    if (into.closed && !reopens(*at.table))
        return bad(path, name + " stands after the end of the run");
    const Digest hash = sha256_link(into.chain_head, canonical_bytes(*at.table, at.row));
    if (!std::ranges::equal(hash, at.hash, {}, {},
                            [](char byte) { return static_cast<std::uint8_t>(byte); }))
        return bad(path, "the row of " + name + " (table " + std::string{at.table->name} +
                             ") was changed after it was written");
    if (auto placed = place_row(recorded, *at.table, at.row); !placed)
        return bad(path, name + ": " + placed.error().detail);
    into.chain_head = hash;
    into.links = at.link;
    into.closed = at.table->name == "closing";
    return {};
}

Result<void> check_header(const Database& database, const std::string& path) {
    for (const std::string name : {"run", "test", "plan", "laser", "material", "air"}) {
        AXISCAL_TRY(const auto count, database.integer_of("SELECT count(*) FROM " + name));
        if (count != 1) return bad(path, "table " + name + " does not have exactly one row");
    }
    return {};
}

bool was_ordered(const RunRevisions& revisions, const PointRecord& point) {
    return std::ranges::any_of(revisions.retakes, [&](const RetakeRecord& retake) {
        return std::ranges::any_of(retake.points, [&](const RetakePoint& wanted) {
            return wanted.step == point.step && wanted.planned_step == point.planned.step;
        });
    });
}

/// Of readings of the same planned point the last one counts, if it was ordered.
Result<void> set_superseded_aside(RecordedRun& run, const std::string& path) {
    std::ranges::stable_sort(run.points, [](const PointRecord& a, const PointRecord& b) {
        return std::pair{a.planned.step, a.step} < std::pair{b.planned.step, b.step};
    });
    std::vector<PointRecord> last;
    last.reserve(run.points.size());
    for (PointRecord& point : run.points) {
        if (point.step != point.planned.step && !was_ordered(run.revisions, point))
            return bad(path, "point " + std::to_string(point.step) +
                                 " stands for another planned point, and no retake asked for it");
        if (!last.empty() && last.back().planned.step == point.planned.step) {
            run.revisions.superseded.push_back(std::move(last.back()));
            last.pop_back();
        }
        last.push_back(std::move(point));
    }
    run.points = std::move(last);
    return {};
}

Result<void> check_setup(const RecordedRun& run, const std::string& path) {
    const std::size_t setup = run.attachments.setup.index();
    if (setup == 0 || setup == static_cast<std::size_t>(run.kind)) return {};
    return bad(path, "it is a " + std::string{name_of(run.kind)} + " test with the set-up of a " +
                         std::string{name_of(static_cast<TestKind>(setup))} + " test");
}

void put_in_order(RunRecord& run) {
    std::ranges::stable_sort(run.environment, {}, &EnvironmentReading::at);
}

} // namespace

Result<RunFileContents> read_run_file_contents(const std::string& path) {
    AXISCAL_TRY(const auto database, open_run_file(path));
    AXISCAL_CHECK(check_run_file_size(*database, path));
    AXISCAL_CHECK(check_run_file_pages(*database, path));
    AXISCAL_CHECK(check_header(*database, path));
    AXISCAL_TRY(auto cursors, open_cursors(*database, path));
    RunFileContents contents;
    RecordedRun recorded;
    while (TableCursor* next = next_of(cursors)) {
        AXISCAL_CHECK(take_link(contents, recorded, *next, path));
        AXISCAL_CHECK(next->advance(path));
    }
    AXISCAL_CHECK(check_setup(recorded, path));
    AXISCAL_CHECK(set_superseded_aside(recorded, path));
    put_in_order(recorded);
    AXISCAL_TRY(const auto results, database->integer_of("SELECT count(*) FROM result"));
    contents.results = static_cast<int>(results);
    contents.revisions = std::move(recorded.revisions);
    contents.streams = std::move(recorded.streams);
    contents.blocks = std::move(recorded.blocks);
    contents.attachments = std::move(recorded.attachments);
    contents.run = std::move(static_cast<RunRecord&>(recorded));
    return contents;
}

Result<RunRecord> read_run_file(const std::string& path) {
    AXISCAL_TRY(auto contents, read_run_file_contents(path));
    return std::move(contents.run);
}

Result<bool> is_run_closed(const Database& database) {
    AXISCAL_TRY(const auto closed, database.integer_of("SELECT max(link) FROM closing"));
    if (closed == 0) return false;
    AXISCAL_TRY(const auto reopened,
                database.integer_of("SELECT max(link) FROM (SELECT link FROM retake UNION ALL "
                                    "SELECT link FROM exclusion UNION ALL "
                                    "SELECT link FROM answer)"));
    return closed > reopened;
}

Result<StoredResult> read_stored_result(const std::string& path) {
    AXISCAL_TRY(const auto database, open_run_file(path));
    AXISCAL_TRY(const auto rows, rows_of(*database, "SELECT digest, document, hash FROM result "
                                                    "ORDER BY id DESC LIMIT 1"));
    if (rows.empty()) return fail(Fault::not_found, path + " holds no result yet");
    const auto* digest = std::get_if<std::string>(&rows[0][0]);
    const auto* document = std::get_if<std::string>(&rows[0][1]);
    const auto* hash = std::get_if<Blob>(&rows[0][2]);
    if (digest == nullptr || document == nullptr || hash == nullptr)
        return bad(path, "the stored result has another type");
    const Digest right = sha256(*digest + '\n' + *document);
    if (hash->bytes != std::string{right.begin(), right.end()})
        return bad(path, "the stored result was changed after it was written");
    return StoredResult{*digest, *document};
}

namespace {

Result<void> take_opening(const Database& database, RunSummary& summary) {
    AXISCAL_TRY(const auto rows, rows_of(database, "SELECT run_id, boot_id, opened_before_ns, "
                                                   "opened_utc_ns FROM run LIMIT 1"));
    if (rows.empty()) return {};
    if (const auto* id = std::get_if<std::string>(&rows[0][0])) summary.run_id = *id;
    if (const auto* boot = std::get_if<std::string>(&rows[0][1])) summary.boot_id.text = *boot;
    if (const auto* at = std::get_if<std::int64_t>(&rows[0][2]))
        summary.opened_at = monotonic_from_ns(*at);
    if (const auto* utc_ns = std::get_if<std::int64_t>(&rows[0][3]))
        summary.opened_utc_ns = *utc_ns;
    return {};
}

/// As laser_channel_of() in run_drift.cpp finds it.
constexpr const char* bar_of_drift =
    "SELECT channel.instrument || '/' || channel.name FROM channel JOIN laser ON "
    "channel.instrument=laser.instrument WHERE kind='displacement' ORDER BY channel.link LIMIT 1";

} // namespace

Result<RunSummary> summarize_run_file(const std::string& path) {
    AXISCAL_TRY(const auto database, open_run_file(path));
    const auto text_of = [&](const std::string& sql) -> Result<std::string> {
        AXISCAL_TRY(auto value, database->value_of(sql));
        auto* text = std::get_if<std::string>(&value);
        return text ? std::move(*text) : std::string{};
    };
    RunSummary summary;
    summary.path = path;
    AXISCAL_CHECK(take_opening(*database, summary));
    AXISCAL_TRY(summary.machine, text_of("SELECT value FROM statement WHERE name='machine'"));
    AXISCAL_TRY(summary.axis, text_of("SELECT value FROM statement WHERE name='axis'"));
    AXISCAL_TRY(summary.machine_serial,
                text_of("SELECT value FROM statement WHERE name='machine_serial'"));
    AXISCAL_TRY(summary.machine_state, text_of("SELECT value FROM statement WHERE name='state'"));
    const std::string last_closing = " FROM closing ORDER BY link DESC LIMIT 1";
    AXISCAL_TRY(summary.closing_reason, text_of("SELECT reason" + last_closing));
    AXISCAL_TRY(const std::string kind, text_of("SELECT kind FROM test"));
    // Of a changed file the first kind: who reads all of it is told of the row.
    summary.kind = kind_named(kind).value_or(all_test_kinds.front());
    AXISCAL_TRY(const auto points,
                database->integer_of("SELECT count(DISTINCT planned_step) FROM point"));
    AXISCAL_TRY(const auto planned, database->integer_of("SELECT count(*) FROM plan_point"));
    AXISCAL_TRY(summary.closed, is_run_closed(*database));
    AXISCAL_TRY(const auto complete, database->integer_of("SELECT complete" + last_closing));
    summary.points = static_cast<int>(points);
    summary.planned = static_cast<int>(planned);
    summary.complete = summary.closed && complete != 0;
    // A run that was opened again is evaluated once more after its last closing.
    AXISCAL_TRY(const auto results, database->integer_of("SELECT count(*) FROM result"));
    AXISCAL_TRY(const auto closings, database->integer_of("SELECT count(*) FROM closing"));
    summary.evaluated = results != 0 && results >= closings;
    summary.closings = static_cast<int>(closings);
    AXISCAL_TRY(const auto of_bar, database->integer_of("SELECT of_bar FROM drift"));
    if (of_bar != 0) {
        AXISCAL_TRY(summary.bar, text_of(bar_of_drift));
    }
    return summary;
}

Result<std::optional<LastRequest>> last_request_of_closed(const std::string& path) {
    AXISCAL_TRY(const auto database, open_run_file(path));
    AXISCAL_TRY(const bool closed, is_run_closed(*database));
    if (!closed) return fail(Fault::refused, path + " is still open");
    AXISCAL_TRY(const auto rows,
                rows_of(*database,
                        "SELECT sequence, step, link FROM point UNION ALL "
                        "SELECT sequence, -1, link FROM datum WHERE sequence<>0 UNION ALL "
                        "SELECT sequence, -1, link FROM event WHERE sequence<>0 AND kind "
                        "IN ('skipped','aborted','note') ORDER BY link DESC LIMIT 1"));
    if (rows.empty()) return std::optional<LastRequest>{};
    const auto* sequence = std::get_if<std::int64_t>(&rows[0][0]);
    const auto* step = std::get_if<std::int64_t>(&rows[0][1]);
    if (sequence == nullptr || step == nullptr) return bad(path, "a request has another type");
    return std::optional{
        LastRequest{static_cast<std::uint16_t>(*sequence), static_cast<int>(*step)}};
}

std::string certificate_name(const RunSummary& run) {
    return id_of_name(run.run_id, "run", longest_run_id) +
           (run.closings > 1 ? "-r" + std::to_string(run.closings) : "");
}

std::vector<RunSummary> list_run_files(const std::string& folder) {
    std::vector<RunSummary> summaries;
    std::error_code error;
    for (std::filesystem::directory_iterator entry{folder, error}, end; !error && entry != end;
         entry.increment(error)) {
        if (entry->path().extension() != run_file_ending) continue;
        if (auto summary = summarize_run_file(entry->path().string()))
            summaries.push_back(*std::move(summary));
    }
    std::ranges::sort(summaries, {}, &RunSummary::path);
    return summaries;
}

} // namespace axiscal
