#pragma once
// `axiscal analyze CASE.json`: data not acquired by us in, "axiscal.result/1" out. Pure.

#include <string>
#include <string_view>

namespace axiscal {

struct CaseAnswer {
    std::string output;     ///< for stdout, ends with a newline; empty for a refused single case
    int exit_code = 0;      ///< 0, or 3 when anything was refused
    std::string error_line; ///< for stderr, without newline; names field and reason
};

/// One case, or an array of cases (the output is an array of the same length, a refused element is
/// {"refused":{"field","reason"}}).
///
/// A positioning case is an object with these keys, the first seven required (docs/analysis.md; the
/// rest, the standards and the other analyses: docs/analysis/):
///   analysis   "positioning"
///   standard   "ISO 230-2:2014", ":2006", ":1997" (k = 2), ":1988" (k = 3), and others by name
///   axis       {"name": text, "kind": "linear" | "rotary"}
///   unit       linear "mm", "um", "m"; rotary "deg", "arcsec"
///   readings   "positions" (deviation = reading - target, computed once) | "deviations"
///   targets    m >= 1 finite numbers, in any order, none twice
///   forward    m rows of n >= 1 finite numbers
///   backward   the same; absent for a unidirectional test
///   compensation  "already_at_20C"; that is what a case is taken for anyway
///   target_unit, travel, interval, polygon, indexing_table, uncertainty, tolerances
/// Remarks may stand under "comment", "customer", "date", "description", "id", "instrument",
/// "machine", "name", "note", "operator", "place", "run", "source" and "title"; any other key is
/// refused, because a misspelt "backward" must not turn a test into a unidirectional one.
/// Refused are wrong types (also numbers as text), NaN, infinities, magnitudes above 1e12 and
/// repeated keys.
/// A text that begins with neither { nor [ is a table (cases/case_table.hpp). UTF-8, or UTF-16 with
/// a byte order mark.
CaseAnswer analyze_cases(std::string_view bytes);

} // namespace axiscal
