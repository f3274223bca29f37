#pragma once
// What documents of every kind are made with: how figures are held against those of the first
// evaluation, and how a document becomes text. Pure, but for reading the run file.

#include "analysis/run_record.hpp"

#include <nlohmann/json.hpp>

#include <span>
#include <string>

namespace axiscal {

/// SHA-256 of the document's name and its figures, bit for bit; 64 lower-case hexadecimal digits.
/// @param format "axiscal.drift/1"
std::string digest_of_figures(std::string format, std::span<const double> figures);

/// Figures that differ from those of the first evaluation are refused; without one all are good.
/// @param digest of the figures recomputed now
/// @param besides ends the sentence: "; ..." or nothing
/// @errors Fault::bad_run_file; what read_stored_result says but Fault::not_found.
Result<void> check_stored_result(const std::string& run_file,
                                 const std::string& digest,
                                 const std::string& besides = {});

/// The first members of "run" in the document of a test: which run, where and when, by what, and
/// three digests.
nlohmann::ordered_json test_run_json(const RunRecord& run,
                                     const std::string& run_file_sha256,
                                     const std::string& result_digest);

/// Indented, one line feed at the end, always valid UTF-8.
std::string document_text(const nlohmann::ordered_json& document);

} // namespace axiscal
