#pragma once
// Which table a row came from that is no longer there, told from the rows around it. Pure.

#include "acquisition/journal/record_rows.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace axiscal {

/// A hole in the chain's numbering, and what is known of the row that was there.
struct MissingRow {
    std::int64_t link = 0;
    std::string table; ///< one, or those it can have been: "environment or event"
    std::string about; ///< "step=7" where the plan or a reference tells; else empty
};

/// Takes the rows that are there, and the holes between them, in chain order. The header's rows
/// stand in the order of the tables, so their neighbours tell the table; a point is missed by the
/// plan, a datum by the points that refer to it, a statement by its name. From format 4 on the row
/// of synchronisation follows its point or datum at once, so that each tells of the other.
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
    };
    void see_point(const Row& row);
    void see_synchronisation(const Row& row);
    void settle_points(int next_step);
    void settle_header(Hole& hole);
    void gather_header_evidence();
    [[nodiscard]] std::int64_t count_of(std::string_view table) const;
    void miss(std::string_view table, std::string about) {
        evidence_.emplace_back(table, std::move(about));
    }

    int format_;
    bool rotary_axis_ = false; ///< by the plan
    std::vector<Hole> holes_;
    bool after_hole_ = false;                ///< the last row that was told of is missing
    std::optional<int> due_synchronisation_; ///< step of the one that must be the next row
    std::map<std::string, std::int64_t, std::less<>> counts_; ///< rows by table
    std::size_t last_table_ = 0;                              ///< of the row seen last
    std::size_t in_question_ = 0; ///< holes before it lie before the last point
    int last_step_ = -1;
    std::set<int> planned_, channels_, referred_channels_;
    std::set<int> accounted_; ///< steps without a point that are not to be missed any more
    int targets_ = 0;         ///< highest index the plan's points refer to, + 1
    std::set<std::string> statements_, datums_, instruments_, referred_instruments_;
    std::vector<std::pair<std::string, std::string>> evidence_; ///< table, about
};

} // namespace axiscal
