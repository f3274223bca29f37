#include "acquisition/runfile/run_file_verify.hpp"

#include "acquisition/runfile/record_rows.hpp"
#include "acquisition/runfile/run_file_open.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <optional>

namespace axiscal {
namespace {

constexpr std::int64_t most_holes = 1000; // a wrong number is no million of missing rows

/// One row as it lies in its table.
struct StoredRow {
    const Table* table = nullptr;
    std::int64_t link = 0;
    Row row;
    std::string hash;
    std::string misfit; ///< why it is no row of its table, if so
};

std::string bytes_of(const Digest& digest) {
    return {digest.begin(), digest.end()};
}

Digest digest_of(const std::string& bytes) {
    Digest digest{};
    std::transform(bytes.begin(), bytes.begin() + std::min<std::ptrdiff_t>(std::ssize(bytes), 32),
                   digest.begin(), [](char byte) { return static_cast<std::uint8_t>(byte); });
    return digest;
}

/// "step=7": the first column, shortened.
std::string about(const Table& table, const Row& row) {
    constexpr std::size_t longest = 40;
    const std::string column{table.columns.substr(0, table.columns.find(','))};
    std::string value = "?";
    if (!row.empty()) {
        if (const auto* number = std::get_if<std::int64_t>(&row[0]))
            value = std::to_string(*number);
        if (const auto* real = std::get_if<double>(&row[0])) value = std::to_string(*real);
        if (const auto* text = std::get_if<std::string>(&row[0])) value = text->substr(0, longest);
    }
    return column + "=" + value;
}

std::string place_text(const StoredRow& row) {
    return "row " + std::to_string(row.link) + " (table " + std::string{row.table->name} + ", " +
           about(*row.table, row.row) + ")";
}

/// Rows of one table in the order of their numbers.
class TableRows {
public:
    static Result<TableRows> open(const Database& database, const Table& table) {
        AXISCAL_TRY(auto select,
                    database.prepare("SELECT link, " + std::string{table.columns} + ", hash FROM " +
                                     std::string{table.name} + " ORDER BY link"));
        TableRows rows{table, std::move(select)};
        AXISCAL_CHECK(rows.advance());
        return rows;
    }
    [[nodiscard]] const std::optional<StoredRow>& next() const { return next_; }
    /// Gives back the row and goes on to the one after it.
    Result<StoredRow> take() {
        StoredRow taken = std::move(*next_);
        AXISCAL_CHECK(advance());
        return taken;
    }

private:
    TableRows(const Table& table, Statement select)
        : table_{&table}
        , select_{std::move(select)} {}
    Result<void> advance() {
        next_.reset();
        AXISCAL_TRY(const bool more, select_.step());
        if (!more) return {};
        StoredRow row;
        row.table = table_;
        const int last = select_.column_count() - 1;
        for (int i = 1; i < last; ++i)
            row.row.push_back(select_.column(i));
        const Value link = select_.column(0), hash = select_.column(last);
        if (const auto* number = std::get_if<std::int64_t>(&link)) row.link = *number;
        if (const auto* bytes = std::get_if<Blob>(&hash)) row.hash = bytes->bytes;
        RecordedRun scratch;
        auto readable = check_row(*table_, row.row);
        if (readable) readable = place_row(scratch, *table_, row.row);
        if (!readable) row.misfit = readable.error().detail;
        next_ = std::move(row);
        return {};
    }

    const Table* table_;
    Statement select_;
    std::optional<StoredRow> next_;
};

/// The chain as far as it was walked.
class Walk {
public:
    /// @param last_closing the highest number of a closing row; 0: there is none.
    Walk(ChainReport& report, std::int64_t last_closing)
        : report_{report}
        , last_closing_{last_closing} {}

    /// All rows that bear the same number; one of them is the row that was written.
    void take(std::vector<StoredRow> same_number) {
        const auto right = std::ranges::find_if(
            same_number, [this](const StoredRow& row) { return fits(row) != Fit::no; });
        const auto kept = right == same_number.end() ? same_number.begin() : right;
        for (auto row = same_number.begin(); row != same_number.end(); ++row)
            if (row != kept) added(*row, "bears the number of another row");
        if (kept->link < 1)
            added(*kept, "bears a number that no row has");
        else if (report_.closed && !reopens(*kept->table) && !is_reopened_before(*kept))
            added(*kept, "stands after the end of the run");
        else
            follow(*kept);
    }
    void end(bool was_folded) {
        settle_suspect("");
        if (was_folded && !report_.closed && ran_) {
            find({RowDamage::missing, "closing", report_.links + 1, "",
                  "row " + std::to_string(report_.links + 1) +
                      " (table closing) is missing: the file is folded as a closed one, but the "
                      "end of the run is gone"});
        }
        std::ranges::stable_sort(report_.findings, {}, &RowFinding::link);
        if (report_.findings.size() > ChainReport::most_findings) {
            report_.untold = std::ssize(report_.findings) -
                             static_cast<std::ptrdiff_t>(ChainReport::most_findings);
            report_.findings.resize(ChainReport::most_findings);
        }
    }
    void find(RowFinding finding) { report_.findings.push_back(std::move(finding)); }

private:
    /// How a row continues the one before: by the hash that stands there, or by the hash that row
    /// should have had; `unknown` after a hole.
    enum class Fit : std::uint8_t { stored, computed, unknown, no };

    [[nodiscard]] Fit fits(const StoredRow& row) const {
        if (row.link != report_.links + 1) return Fit::unknown;
        const std::string bytes = canonical_bytes(*row.table, row.row);
        if (stored_ && bytes_of(sha256_link(*stored_, bytes)) == row.hash) return Fit::stored;
        if (computed_ && bytes_of(sha256_link(*computed_, bytes)) == row.hash) return Fit::computed;
        return stored_ ? Fit::no : Fit::unknown;
    }

    /// The row that opened the closed run again is missing: it was closed once more after this one,
    /// or this is a point that the missing one ordered.
    [[nodiscard]] bool is_reopened_before(const StoredRow& row) const {
        const bool after_hole = row.link > report_.links + 1;
        return after_hole && (row.link <= last_closing_ || row.table->name == "retake_point");
    }

    void name_missing_before(const StoredRow& row) {
        const std::string after = " table " + std::string{row.table->name};
        const std::string place =
            previous_ ? "between table " + std::string{previous_->table->name} + " and" + after
                      : "before" + after;
        for (std::int64_t link = report_.links + 1;
             link < row.link && link <= report_.links + most_holes; ++link)
            find({RowDamage::missing,
                  {},
                  link,
                  {},
                  "row " + std::to_string(link) + ", " + place + ", is missing"});
    }

    void follow(const StoredRow& row) {
        name_missing_before(row);
        const Fit fit = fits(row);
        const bool doubtful = suspect_.has_value();
        settle_suspect(fit == Fit::computed ? "its hash was changed" : "");
        if (fit == Fit::no) suspect_ = row;
        if (fit == Fit::no && previous_ && !doubtful)
            suspicion_ = "it does not continue " + place_text(*previous_) +
                         ": this row was changed, or that one was replaced with a fitting hash";
        if (fit != Fit::no && !row.misfit.empty()) changed(row, row.misfit);
        const auto& anchor = fit == Fit::computed ? computed_ : stored_;
        const std::string bytes = canonical_bytes(*row.table, row.row);
        computed_ = fit == Fit::unknown || !anchor ? std::optional<Digest>{}
                                                   : std::optional{sha256_link(*anchor, bytes)};
        stored_ = digest_of(row.hash);
        report_.links = row.link;
        previous_ = StoredRow{row.table, row.link, {row.row.begin(), row.row.begin() + 1}, {}, {}};
        for (const char* of_course : {"datum", "event", "point"})
            ran_ = ran_ || row.table->name == of_course;
        report_.closed = report_.complete = false;
        if (row.table->name != "closing") return;
        report_.closed = true;
        report_.complete = row.row[0] == Value{std::int64_t{1}};
    }

    /// What the next row tells about one that did not fit.
    void settle_suspect(const std::string& known) {
        if (!suspect_) return;
        changed(*suspect_, !known.empty()       ? known
                           : suspicion_.empty() ? "its bytes are not those of its hash"
                                                : suspicion_);
        suspect_.reset();
        suspicion_.clear();
    }
    void changed(const StoredRow& row, const std::string& how) {
        find({RowDamage::changed, std::string{row.table->name}, row.link,
              about(*row.table, row.row),
              place_text(row) + " was changed after it was written: " + how});
    }
    void added(const StoredRow& row, const std::string& how) {
        find({RowDamage::added, std::string{row.table->name}, row.link, about(*row.table, row.row),
              place_text(row) + " was added later: it " + how});
    }

    ChainReport& report_;
    std::int64_t last_closing_;
    std::optional<Digest> stored_ = Digest{}, computed_; ///< hash of the last row; empty: unknown
    std::optional<StoredRow> suspect_, previous_;
    std::string suspicion_;
    bool ran_ = false; ///< more than a header was written
};

Result<std::vector<TableRows>> open_tables(const Database& database, ChainReport& report) {
    std::vector<TableRows> tables;
    AXISCAL_TRY(const auto present, chained_tables_in(database));
    tables.reserve(present.size());
    for (const Table& table : chained_tables()) {
        const std::string name{table.name};
        if (std::ranges::find(present, &table) == present.end()) {
            report.rows.emplace_back(name, 0);
            continue;
        }
        AXISCAL_TRY(const auto count, database.integer_of("SELECT count(*) FROM " + name));
        report.rows.emplace_back(name, count);
        AXISCAL_TRY(auto rows, TableRows::open(database, table));
        tables.push_back(std::move(rows));
    }
    return tables;
}

/// The rows of the lowest number; empty at the end.
Result<std::vector<StoredRow>> next_rows(std::vector<TableRows>& tables) {
    std::optional<std::int64_t> lowest;
    for (const TableRows& table : tables)
        if (table.next() && (!lowest || table.next()->link < *lowest)) lowest = table.next()->link;
    std::vector<StoredRow> rows;
    for (TableRows& table : tables)
        if (lowest && table.next() && table.next()->link == *lowest) {
            AXISCAL_TRY(StoredRow row, table.take());
            rows.push_back(std::move(row));
        }
    return rows;
}

/// Results are no links: each bears the hash of its own content.
Result<void> check_results(const Database& database, ChainReport& report) {
    AXISCAL_TRY(auto select, database.prepare("SELECT id, digest, document, hash FROM result"));
    std::int64_t count = 0;
    for (;; ++count) {
        AXISCAL_TRY(const bool more, select.step());
        if (!more) break;
        const Value id = select.column(0), digest = select.column(1), document = select.column(2),
                    hash = select.column(3);
        const auto* number = std::get_if<std::int64_t>(&id);
        const auto* first = std::get_if<std::string>(&digest);
        const auto* second = std::get_if<std::string>(&document);
        const auto* stored = std::get_if<Blob>(&hash);
        if (first && second && stored && bytes_of(sha256(*first + '\n' + *second)) == stored->bytes)
            continue;
        const std::int64_t row = number ? *number : 0;
        report.findings.push_back(
            {RowDamage::changed, "result", row, "id=" + std::to_string(row),
             "row " + std::to_string(row) + " of table result was changed after it was written"});
    }
    report.rows.emplace_back("result", count);
    return {};
}

/// Bytes 18 and 19 of the header say how the file is journalled: 2 while a run writes it (WAL), 1
/// once it was folded into one file.
bool is_folded(const std::string& path) {
    constexpr std::size_t place = 18;
    std::ifstream file{path, std::ios::binary};
    std::array<char, place + 1> head{};
    return file.read(head.data(), head.size()) && head[place] == 1;
}

} // namespace

std::string_view name_of(RowDamage damage) {
    switch (damage) {
    case RowDamage::changed: return "changed";
    case RowDamage::missing: return "missing";
    case RowDamage::added: return "added";
    }
    return "?";
}

Result<ChainReport> verify_chain(const std::string& path) {
    AXISCAL_TRY(const auto database, open_run_file(path));
    AXISCAL_CHECK(check_run_file_size(*database, path));
    AXISCAL_CHECK(check_run_file_pages(*database, path));
    ChainReport report;
    AXISCAL_TRY(auto tables, open_tables(*database, report));
    AXISCAL_TRY(const auto last_closing,
                database->integer_of("SELECT ifnull(max(link), 0) FROM closing"));
    Walk walk{report, last_closing};
    std::string head;
    for (;;) {
        AXISCAL_TRY(auto rows, next_rows(tables));
        if (rows.empty()) break;
        head = rows.front().hash;
        walk.take(std::move(rows));
    }
    report.chain_head = hex_of(digest_of(head));
    walk.end(is_folded(path));
    AXISCAL_CHECK(check_results(*database, report));
    return report;
}

} // namespace axiscal
