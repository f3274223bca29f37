#pragma once
// Walks the whole hash chain of a run file and names every row that is not what it was when it was
// written. Reads on where the reader of run_file.hpp stops at the first mistake. Blocking.

#include "analysis/quantity/result.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace axiscal {

enum class RowDamage : std::uint8_t { changed, missing, added };
std::string_view name_of(RowDamage damage); ///< "changed", "missing", "added"

struct RowFinding {
    RowDamage damage = RowDamage::changed;
    std::string table;     ///< "point"; empty where a row is gone, but for the closing row
    std::int64_t link = 0; ///< place in the chain; in `result` the row's id
    std::string row;       ///< its first column, "step=7"; empty when the row is gone
    std::string sentence;  ///< for people, all of the above included
};

/// What the chain of a file shows.
struct ChainReport {
    std::int64_t links = 0;                                 ///< rows of the chain
    std::vector<std::pair<std::string, std::int64_t>> rows; ///< by table, `result` included
    bool closed = false, complete = false;
    std::string chain_head;           ///< hash of the last row, 64 hexadecimal digits
    std::vector<RowFinding> findings; ///< in chain order, at most most_findings
    std::int64_t untold = 0;          ///< findings beyond that
    static constexpr std::size_t most_findings = 100;
    [[nodiscard]] bool intact() const { return findings.empty(); }
};

/// A row whose bytes and hash were both made to fit anew shows at the row after it, which is named
/// with it; for the last row nothing in the file can tell: that is what the certificate's SHA-256
/// of the file is for. An open run may be verified while it goes on.
/// @errors Fault::not_found; Fault::bad_run_file for what is no run file, has other tables or
/// damaged pages.
Result<ChainReport> verify_chain(const std::string& path);

} // namespace axiscal
