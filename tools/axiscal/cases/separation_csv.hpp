#pragma once
// Both measurements of a workpiece as a table: `feature,nominal_*,on_machine_*,cmm_*`. Pure.

#include "analysis/quantity/result.hpp"
#include "analysis/separation/single_axis_features.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

struct MeasuredPoint {
    std::string feature;
    std::size_t line = 0; ///< in the file, from 1
    PerAxis<std::optional<double>> nominal_mm, on_machine_mm, cmm_mm;
};

/// A header line, then a line a point. Columns after `feature` in any order: nominal_x, _y, _z,
/// on_machine_x, ..., cmm_x, ..., each perhaps with _mm at its end; mm; empty cells
/// where a coordinate was not measured. Separators, numbers and quotes are those of any table
/// (table_text.hpp): lines that begin with # are remarks above the header, features below it.
/// @errors Fault::bad_case, field "measurements_csv line N".
Result<std::vector<MeasuredPoint>> read_measurements_csv(std::string_view text);

/// What the points of one name say about one direction.
struct NamedFeature {
    std::string name;
    std::optional<std::size_t>
        axis;                 ///< the one axis whose nominal changes; absent: none or several
    SingleAxisFeature values; ///< `axis` there counts only if known here
};
/// Every feature and measured direction, in the order of the file.
/// @errors Fault::bad_case: an axis measured at some points of a feature and not at others.
Result<std::vector<NamedFeature>> features_of(const std::vector<MeasuredPoint>& points);

} // namespace axiscal
