#pragma once
// The part program of a probing test (ISO 230-10, 6.9) and the log that it leaves. Pure.

#include "analysis/quantity/result.hpp"
#include "analysis/record/probing_record.hpp"

#include <string>

namespace axiscal {

/// The block lies on the negative side of three faces that meet in its corner; rough work
/// coordinates have their zero at that corner within `clear` / 2. The text of 6.9.2 after its step
/// c) is lost to us: counts and steps are inputs.
struct ProbingPlan {
    double feed_mm_per_min = 480;
    double first_mm = 2;     ///< shortest approach distance a_1
    double step_mm = 0.0016; ///< a_k = a_1 + (k - 1) step; not a whole part of feed x cycle time
    int touches = 11;        ///< of each direction
    int references = 5;      ///< touches from a_1 alone, before them: E_0
    double clear_mm = 10;    ///< from the faces while the probe goes round the block
    double inset_mm = 10;    ///< from the edges to the points that are touched
    double travel_feed_mm_per_min = 1000;
};

/// What ties a program and its log to the plan: "feed=480 first=2 step=0.0016 touches=11 ...".
std::string probing_id(const ProbingPlan& plan);
/// The plan that a generated program names in its first lines.
/// @errors Fault::bad_request for another program.
Result<ProbingPlan> read_probing_id(const std::string& program);

/// LinuxCNC (2.9, G38.2 and LOGOPEN): one touch of each face sets the zero of G54 there; then
/// -X, -Y, -Z, each the references first, from growing distances; `log` gets a line a touch.
/// @errors Fault::bad_request naming the number that cannot be.
Result<std::string> write_probing_linuxcnc(const ProbingPlan& plan, const std::string& log);

/// The log's lines, "-X touch 2.0016" or "-X reference 2.0000" and the latched X, Y, Z in mm, as
/// the record of this plan. Any control can be made to write them, or a person.
/// @errors Fault::bad_request for other lines, not as many as planned, or others than planned.
Result<ProbingRecord> read_probing_log(const ProbingPlan& plan, const std::string& log);

} // namespace axiscal
