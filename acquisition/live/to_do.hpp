#pragma once
// One list of what people have to do: faults of the run, instruments, pre-flight checks, findings
// about the set-up, share and disk, each with its rank, the next action, and what undoes that.
// Pure: nothing is measured for it, and where the station has a sentence already, that one stands
// here.

#include "analysis/record/run_revisions.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

struct StationStatus;

/// In the order of the list.
enum class ToDoRank : std::uint8_t {
    stop, ///< the open run, or the one that somebody wants to arm, cannot go on before it is done
    look, ///< it may spoil a result, or a result waits for it
    note  ///< worth knowing; it can wait
};
/// "stop", "look", "note".
std::string_view name_of(ToDoRank rank);

/// Within a rank in this order: what holds the CNC comes first.
enum class ToDoSource : std::uint8_t {
    disk,
    run,
    trigger,
    instrument,
    clock,
    preflight,
    finding,
    outbox,
    doctor ///< seen from outside the station alone (tools/axiscal/doctor)
};
/// "disk", "run", "trigger", ...
std::string_view name_of(ToDoSource source);

struct ToDo {
    std::string id; ///< "instrument/laser": stays the same while the trouble does
    ToDoRank rank = ToDoRank::note;
    ToDoSource source = ToDoSource::run;
    std::string seen;      ///< what is seen
    std::string since_utc; ///< ISO time; empty: not known
    std::string next;      ///< the one action, in words
    std::string command; ///< the line of a shell that does it; empty: none does. TEXT is filled in
    std::string undo;    ///< the line that undoes `command`; empty: nothing does
};

/// A finding about the set-up that nobody answered.
struct OpenFinding {
    std::string error;                   ///< "moved_optic", as POST /v1/run/answer takes it
    std::string seen, probably, look_at; ///< a sentence each
};

/// A disk that takes no records.
struct DiskTrouble {
    std::string seen; ///< empty: it takes them
    std::string next; ///< the way out; empty: none is known
};

/// The pre-flight checks as they were judged last.
struct JudgedChecks {
    std::vector<PreflightRecord> checks; ///< none: nobody asked since the last test was armed
    std::string utc;
    bool refused_arming = false; ///< they are why somebody's test was not armed
};

/// What the station knows besides its status.
struct ToDoFacts {
    DiskTrouble disk;
    JudgedChecks judged;
    std::vector<OpenFinding> findings; ///< of the run that the status shows
};

/// What stops the CNC first. No trouble stands there twice.
std::vector<ToDo> things_to_do(const StationStatus& status, const ToDoFacts& facts);

/// "Mend what fails, or arm with --override soak="reason": the certificate prints it."
std::string mend_or_override(const std::string& check);

} // namespace axiscal
