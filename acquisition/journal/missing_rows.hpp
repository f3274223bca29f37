#pragma once
// Which table a row came from that is no longer there, told from the rows around it. Pure.

#include "acquisition/journal/record_rows.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace axiscal {

/// A hole in the chain's numbering, and what is known of the row that was there.
struct MissingRow {
    std::int64_t link = 0;
    std::string table; ///< one, or those it can have been: "environment, event or exclusion"
    std::string about; ///< "step=7" where the plan or a reference tells; else empty
};

/// Takes the rows that are there, and the holes between them, in chain order. The header's rows
/// stand in the order of the tables, so their neighbours tell the table; a point is missed by the
/// plan, a datum by the points that refer to it, a statement by its name. From format 4 on the row
/// of synchronisation follows its point or datum at once, that of a block's time its block, so that
/// each tells of the other. An order to take points again is told by its points and they by their
/// steps, the setup of a circular test by the rows around it. Of what nothing tells all tables are
/// named that can have stood there.
class MissingRows {
public:
    explicit MissingRows(int format)
        : format_{format} {}
    void see(const Table& table, const Row& row);
    void hole(std::int64_t link);
    /// After the last row.
    std::vector<MissingRow> result();

private:
    struct Hole {
        MissingRow row;
        std::size_t before = 0, after = 0; ///< tables of the neighbours, by their place
        bool alone = true;                 ///< the rows right before and after it are there
        [[nodiscard]] bool open() const { return row.table.empty(); }
    };
    void see_header(const Table& table, const Row& row);
    void see_point(const Row& row);
    void see_first_of_pair(const Table& table, const Row& row);
    void see_second_of_pair(const Table& table, const Row& row);
    void see_retake_point(const Row& row);
    void see_ordered_point(int step, int planned_step);
    void settle_points(int next_step);
    void gather_header_evidence();
    void gather_evidence_of_optional_tables();
    void settle_header(Hole& hole);
    void settle_streams();
    void settle_body(Hole& hole);
    [[nodiscard]] bool fits_header(const Hole& hole, std::string_view name) const;
    [[nodiscard]] std::vector<std::string> body_candidates(const Hole& hole) const;
    [[nodiscard]] bool is_circular() const;
    /// Holes since the row seen last.
    [[nodiscard]] std::span<Hole> fresh() { return std::span{holes_}.last(fresh_); }
    [[nodiscard]] std::int64_t count_of(std::string_view table) const;
    void miss(std::string_view table, std::string about) {
        evidence_.emplace_back(table, std::move(about));
    }

    int format_;
    bool rotary_axis_ = false, circular_pass_ = false; ///< by the plan
    std::vector<Hole> holes_;
    std::size_t fresh_ = 0;
    std::optional<MissingRow> due_; ///< the second of a pair, which must be the next row
    std::map<std::string, std::int64_t, std::less<>> counts_; ///< rows by table
    std::size_t last_table_ = 0;                              ///< of the row seen last
    std::size_t in_question_ = 0; ///< holes before it lie before the last point
    int last_step_ = -1;
    std::set<int> planned_, channels_, referred_channels_, calibrated_, corrected_;
    std::set<int> streams_, referred_streams_;
    std::set<int> ordered_;   ///< steps of points to be taken again
    int retakes_ = 0;         ///< highest number of an order
    std::set<int> accounted_; ///< steps without a point that are not to be missed any more
    int targets_ = 0;         ///< highest index the plan's points refer to, + 1
    std::set<std::string> statements_, datums_, instruments_, referred_instruments_;
    std::vector<std::pair<std::string, std::string>> evidence_; ///< table, about
};

} // namespace axiscal
