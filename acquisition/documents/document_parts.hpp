#pragma once
// What documents of every kind are made with: how figures are held against those of the first
// evaluation, and how a document becomes text. Pure, but for reading the run file.

#include "acquisition/documents/figure_agreement.hpp"

#include <functional>
#include <span>
#include <string>

namespace axiscal {

/// SHA-256 of the document's name and its figures, bit for bit; 64 lower-case hexadecimal digits.
/// @param format "axiscal.drift/1"
std::string digest_of_figures(std::string format, std::span<const double> figures);

/// Figures as computed now.
struct ComputedFigures {
    std::string digest;
    FigureAgreement agreement; ///< with those of the first evaluation
    /// "parameters" and, where there are some, "positions"; asked for where the digests differ.
    std::function<nlohmann::ordered_json()> document;
};

/// The digest that stands for the figures: that of the first evaluation, also where they agree with
/// it without having its bits; without one that of now. Figures that do not agree are refused.
/// @param besides ends the sentence: "; ..." or nothing
/// @errors Fault::bad_run_file; what read_stored_result says but Fault::not_found.
Result<std::string> standing_digest(const std::string& run_file,
                                    const ComputedFigures& now,
                                    const std::string& besides = {});

/// The first members of "run" in the document of a test: which run, where and when, by what, and
/// three digests.
nlohmann::ordered_json test_run_json(const RunRecord& run,
                                     const std::string& run_file_sha256,
                                     const std::string& result_digest);

/// Indented, one line feed at the end, always valid UTF-8.
std::string document_text(const nlohmann::ordered_json& document);

} // namespace axiscal
