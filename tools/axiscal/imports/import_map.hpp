#pragma once
// What a file does not say by itself: which column, which signal, which unit. A TOML file
// (docs/import.md).

#include "analysis/quantity/result.hpp"
#include "analysis/quantity/time.hpp"
#include "analysis/record/run_record.hpp"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace axiscal {

/// A row a reading; or a row a target, with a column for each run.
struct TableMap {
    std::string target, reading;                ///< headings of columns, or their numbers from 1
    std::string run, direction;                 ///< the same; empty: the order of the targets tells
    std::vector<std::string> forward, backward; ///< what stands in the column `direction`
    /// Of a row a target: the columns of the runs each way. `reading` is empty then.
    std::vector<std::string> forward_columns, backward_columns;
};

/// "NAME DATE TIME VALUE" a line, several names after each other.
struct StreamMap {
    std::string reading;                   ///< name of the instrument that measures
    double scale = 1, offset = 0;          ///< position = scale * value + offset, in `unit`
    std::optional<Duration> before, after; ///< window of a mean about the capture; none: last value
    std::string target;                    ///< name of the commanded position; or
    std::vector<double> places;            ///< the targets, in the order of their numbers
    std::string capture;                   ///< name of the number that changes at a capture
    std::string digits;                    ///< "dcpp": what each digit of it means; empty: nothing
    int forward = 1, backward = 2;         ///< the digit d
};

struct ImportMap {
    std::string axis; ///< its name; empty: as the file says
    AxisKind kind = AxisKind::linear;
    std::string unit, target_unit; ///< as in a case (docs/analysis.md)
    bool positions = true;         ///< readings are positions, else deviations
    std::variant<TableMap, StreamMap> of;
};

/// @param name  of the file, for refusals
/// @errors Fault::bad_configuration with file, line and key of the first thing that is wrong.
Result<ImportMap> import_map(std::string text, std::string name);

} // namespace axiscal
