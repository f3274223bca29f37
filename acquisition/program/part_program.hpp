#pragma once
// Part programs for controllers: one file a dialect, all from the same plan. Pure.

#include "analysis/record/run_record.hpp"
#include "config/station_config.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

struct ProgramOrder {
    RunPlan plan;
    std::string axis = "X"; ///< axis letter
    Speed feed;
    Duration dwell{};
    TriggerShape shape = TriggerShape::sequence_block;
    /// Longest wait for `done`; one that ends before the station's own is refused.
    Duration answer_limit = usual_cnc_timeout(std::chrono::seconds{10});
    Duration capture_timeout = std::chrono::seconds{10}; ///< the station's
    /// Points taken again in a run that is armed: the program begins at the last durable request
    /// instead of 0 and counts on.
    bool retakes = false;
    std::uint16_t last_request = 0;
    std::optional<RotarySetup> rotary{}; ///< of a rotary axis
    Duration least_halt{}; ///< dwell trigger: minimum halt + window; a shorter dwell is refused
    /// Request 1 is `prepare` at the datum, the points count from 2; sequence-block alone has it.
    bool datum_by_cnc = false;
};

/// @errors Fault::bad_request where the CNC is to tie the datum by a shape that has no `prepare`.
Result<void> check_prepare(const ProgramOrder& order);

/// @errors Fault::bad_request where the CNC would give up before the station does.
Result<void> check_answer_limit(Duration answer_limit, Duration capture_timeout);

/// One move of the cycle, before any dialect: where to, and whether a point is taken there.
struct ProgramMove {
    double coordinate_mm = 0;
    const PlannedPoint* point = nullptr;    ///< nullptr: over-travel or datum
    std::optional<int> table_position = {}; ///< the indexing table is turned there, the axis halts
};

/// The motion of the plan: datum, then every point reached from its own side by at least the
/// overrun, with the over-travel moves that this needs.
std::vector<ProgramMove> moves_of(const RunPlan& plan);
/// The same of an axis under an indexing table: strides that keep the interferometer in its range,
/// a halt before each approach at which the table is turned, then the approach by the overrun.
std::vector<ProgramMove> moves_with_table(const RunPlan& plan, const RotarySetup& setup);

struct ProgramDialect {
    std::string_view name;      ///< "linuxcnc", "marlin"
    std::string_view extension; ///< ".ngc"
    std::string_view summary;
    Result<std::string> (*write)(const ProgramOrder& order);
};

std::span<const ProgramDialect> program_dialects();
/// @errors Fault::bad_request with the list of known dialects.
Result<ProgramDialect> find_dialect(std::string_view name);

/// "seed=42 pass=whole targets=11 n=5 check=1A2B": what ties a program to its plan; the check is
/// CRC-16/XMODEM over the targets in 0.1 um ("348900;1393570;..."), so that a wrong pair of program
/// and job is seen.
std::string program_id(const RunPlan& plan);
/// Coordinates are written with four decimals (0.1 um) and always a decimal point.
std::string coordinate_word(const std::string& axis, double coordinate_mm);

/// Says the header of a program of shape "dwell", which no station can hold at the datum.
constexpr std::string_view waits_for_nobody =
    "this program waits for nobody: drive the axis to its datum and run 'axiscal arm' before it";

Result<std::string> write_linuxcnc(const ProgramOrder& order);
Result<std::string> write_marlin(const ProgramOrder& order);

} // namespace axiscal
