#pragma once
// A recorded probing test as the documents that leave the station. Pure, but for reading the run
// file.

#include "acquisition/runfile/ed25519.hpp"
#include "analysis/probing/probing_delay.hpp"
#include "analysis/record/probing_record.hpp"
#include "analysis/record/run_record.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace axiscal {

struct ProbingDocument {
    RunRecord run;
    ProbingRecord record;
    std::vector<ProbingDelay> results; ///< one a series
    std::string run_file_sha256, result_digest;
};

/// Reads and verifies the run file and computes everything, as certificate_of_run_file does.
/// @errors Fault::refused when it is no probing test; Fault::incomplete_run; Fault::bad_run_file,
/// also for figures that are not those stored; Fault::not_found; Fault::bad_case.
Result<ProbingDocument> probing_of_run_file(const std::string& run_file);

/// The first evaluation: stores digest and figures in the closed run file, once.
Result<void> seal_probing(const std::string& run_file, const SecretKey* key = nullptr);

/// How far the tip moves in a millisecond, the usual servo tick of a control, mm. Pure.
double feed_mm_per_ms(const ProbingRecord& record);

/// Feed, figures of each series, what is stated. "preliminary" is true: no uncertainty of these
/// figures is known, as "missing" says.
nlohmann::ordered_json probing_to_json(const ProbingDocument& document);
std::string probing_json_text(const ProbingDocument& document);
/// Every touch: direction, kind, approach, the latched X, Y, Z.
std::string probing_csv(const ProbingDocument& document);

} // namespace axiscal
