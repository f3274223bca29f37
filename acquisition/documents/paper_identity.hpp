#pragma once
// By which name a certificate is known, and which one it replaces (ISO/IEC 17025, 7.8.2.1 d and
// 7.8.8): both stand in the result that is stored in the run file.

#include "acquisition/runfile/run_file.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace axiscal {

struct PaperIdentity {
    std::string number;   ///< empty: the station gives none, or the paper was not issued
    std::string replaces; ///< number of the earlier certificate, without one its folder's name
    int closing = 1;      ///< of the run, from 1
};

/// What of a run file decides about its paper.
struct PaperOfRun {
    std::string run_id;
    std::string number_pattern; ///< as the station states it; empty: no numbers
    int closings = 0, results = 0;
    /// A result is kept since the run was last closed.
    [[nodiscard]] bool stored() const { return results >= closings; }
};
PaperOfRun paper_of(const RunFileContents& contents);

/// Of the paper that a run file makes now. One that was not issued yet bears nothing.
/// @errors those of read_stored_result() but Fault::not_found.
Result<PaperIdentity> identity_of(const std::string& run_file, const PaperOfRun& paper);

/// Of the paper that is issued now: its number is taken, and is on disk when this returns.
/// @errors those of take_certificate_number() and read_stored_result().
Result<PaperIdentity> new_identity(const std::string& run_file,
                                   const PaperOfRun& paper,
                                   const std::string& state_directory,
                                   int year);

nlohmann::ordered_json identity_json(const PaperIdentity& identity);
/// "This certificate replaces certificate CAL-2026-0001."
std::string amendment_remark(const PaperIdentity& identity);

} // namespace axiscal
