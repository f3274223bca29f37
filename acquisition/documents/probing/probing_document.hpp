#pragma once
// A recorded probing test as the documents that leave the station. Pure.

#include "acquisition/runfile/run_file.hpp"
#include "analysis/conformity/conformity.hpp"
#include "analysis/probing/probing_delay.hpp"
#include "analysis/record/probing_record.hpp"
#include "analysis/record/run_record.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace axiscal {

/// What a probing test gave.
struct ProbingResult {
    RunRecord run;
    ProbingRecord record;
    std::vector<ProbingDelay> results; ///< one a series
    std::optional<Conformity> conformity; ///< of a test with limits
    std::string run_file_sha256, result_digest;
};

/// Computes everything of a run file that was read; without its hash.
/// @errors Fault::incomplete_run naming `path`; those of evaluate_probing_delay().
Result<ProbingResult> probing_result_of(const std::string& path, RunFileContents contents);

/// What is stored at the first evaluation.
nlohmann::ordered_json probing_figures(const ProbingResult& result);

/// How far the tip moves in a millisecond, the usual servo tick of a control, mm. Pure.
double feed_mm_per_ms(const ProbingRecord& record);

/// Feed, figures of each series, what is stated. "preliminary" is true: no uncertainty of these
/// figures is known, as "missing" says.
nlohmann::ordered_json probing_to_json(const ProbingResult& document);
/// Every touch: direction, kind, approach, the latched X, Y, Z.
std::string probing_csv(const ProbingResult& document);

} // namespace axiscal
