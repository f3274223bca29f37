#pragma once
// What people decided about a run: what was checked before it, which points were taken again, which
// readings are left out. Pure data, beside RunRecord, which holds what was measured.

#include "analysis/record/run_record.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// One check before arming.
struct PreflightRecord {
    std::string name; ///< "soak"
    bool passed = false;
    bool warning = false;        ///< it passed, but the certificate has to say something
    std::string verdict;         ///< one sentence
    std::string override_reason; ///< why the run was armed although it failed; else empty
};

/// A planned point that is to be taken once more. Its `step` follows those of the plan.
struct RetakePoint {
    int step = 0;
    int planned_step = 0; ///< of the plan's point whose reading it replaces
};

struct RetakeRecord {
    int number = 1; ///< from 1 within the run
    MonotonicTime at;
    std::int64_t utc_ns = 0;
    std::string reason;
    std::vector<RetakePoint> points;
};

/// A reading that no figure may use.
struct ExclusionRecord {
    int step = 0; ///< PointRecord::step
    MonotonicTime at;
    std::int64_t utc_ns = 0;
    std::string reason;
};

/// What a person answers to a finding about the set-up, which no figure follows.
struct AnswerRecord {
    std::string finding; ///< name_of(SetupError)
    MonotonicTime at;
    std::int64_t utc_ns = 0;
    std::string text;
};

/// Who asked for something: what the door of the daemon knows of him, and the name that he gave.
struct Orderer {
    std::string door;                ///< "socket", "token", "page"; empty: not known
    std::optional<std::int64_t> uid; ///< of the process at the other end of the socket
    std::string user;                ///< its name on this computer, where it has one there; of a
                                     ///< page what its browser was called when it was paired
    std::string name;                ///< as given; nobody proves it
};

/// An order of a person that decides about a run.
struct OrderRecord {
    std::string kind;  ///< "arm", "override", "retake", "exclude", "answer", "abort", "drift"
    std::string about; ///< check that was overridden, number of the retake, finding; often empty
    MonotonicTime at;
    std::int64_t utc_ns = 0;
    Orderer by;
};

/// "Jo Miller (user jo, uid 1000)", "user jo, uid 1000", "Jo Miller (token)", "page tablet 2", "not
/// known".
std::string name_of(const Orderer& by);

struct RunRevisions {
    std::vector<PreflightRecord> preflight;
    std::vector<RetakeRecord> retakes;
    std::vector<ExclusionRecord> exclusions;
    std::vector<PointRecord> superseded; ///< replaced by RunRecord::points; by planned step, oldest
                                         ///< first
    std::vector<AnswerRecord> answers;   ///< as they were given; of one finding the last counts
    std::vector<OrderRecord> orders;     ///< as they were given
    int closings = 0;                    ///< a run that was added to is closed again
};

/// A reading that is shown and counted but enters no figure.
struct SetAside {
    PlannedPoint planned;
    int step = 0;
    double deviation = 0;    ///< mm at 20 degC, as every reading
    bool superseded = false; ///< taken again; else excluded
    std::string reason;
};

} // namespace axiscal
