#pragma once
// What a file does not say by itself: which column, which signal, which unit. A TOML file
// (docs/import.md).

#include "analysis/quantity/result.hpp"
#include "analysis/quantity/time.hpp"
#include "analysis/record/run_record.hpp"
#include "config/station_config.hpp"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace axiscal {

/// A row a reading; or a row a target, with a column for each run.
struct TableMap {
    std::string sheet;                          ///< of a workbook; empty: the first
    std::string target, reading;                ///< headings of columns, or their numbers from 1
    std::string run, direction;                 ///< the same; empty: the order of the targets tells
    std::vector<std::string> forward, backward; ///< what stands in the column `direction`
    /// Of a row a target: the columns of the runs each way. `reading` is empty then.
    std::vector<std::string> forward_columns, backward_columns;
};

/// Captures are where the axis stands: in which order it was to stand, and how still is still.
struct StandstillMap {
    RunPlan plan;          ///< kind of axis, targets, cycle, overrun, near_tolerance, datum, points
    CaptureConfig capture; ///< window and its limits; `fastest` 0: jumps are not judged
};

/// The uMD's own log holds counts of axis 1 and nothing else.
struct UmdMap {
    double metres_per_count = 0;   ///< less than 0: counts fall where the coordinate rises
    std::optional<double> rate_Hz; ///< where the file does not say it
    int sequence_bits = 0;         ///< the sample number begins again after 2^bits; 0: seen, or not
    int segment = 0;               ///< from 1; 0: the file has one only
    StandstillMap stops;
};

/// "NAME DATE TIME VALUE" a line, several names after each other.
struct StreamMap {
    std::string reading;                   ///< name of the instrument that measures
    double scale = 1, offset = 0;          ///< position = scale * value + offset, in `unit`
    std::optional<Duration> before, after; ///< window of a mean about the capture; none: last value
    std::string target;                    ///< name of the commanded position; or
    std::vector<double> places;            ///< the targets, in the order of their numbers
    std::optional<StandstillMap> stops;    ///< in place of targets and captures; or
    std::string capture;                   ///< name of the number that changes at a capture
    std::string digits;                    ///< "dcpp": what each digit of it means; empty: nothing
    int forward = 1, backward = 2;         ///< the digit d
};

struct ImportMap {
    std::string axis; ///< its name; empty: as the file says
    AxisKind kind = AxisKind::linear;
    std::string unit, target_unit; ///< as in a case (docs/analysis.md)
    bool positions = true;         ///< readings are positions, else deviations
    std::variant<TableMap, StreamMap, UmdMap> of;
};

/// Millimetres, or degrees, of one unit of a case or a map.
double millimetres_in(const std::string& unit);

/// @param name  of the file, for refusals
/// @errors Fault::bad_configuration with file, line and key of the first thing that is wrong.
Result<ImportMap> import_map(std::string text, std::string name);

} // namespace axiscal
