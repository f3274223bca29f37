#pragma once
// What a test gave, whatever its kind, and the documents that say so. Pure.

#include "acquisition/documents/circular/circular_paper.hpp"
#include "acquisition/documents/drift/drift_paper.hpp"
#include "acquisition/documents/positioning/positioning_paper.hpp"
#include "acquisition/documents/probing/probing_paper.hpp"
#include "acquisition/documents/squareness/squareness_paper.hpp"
#include "acquisition/documents/straightness/straightness_paper.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <variant>

namespace axiscal {

/// The one list of the kinds that have a paper: see paper.hpp.
using TestResult = std::variant<Certificate,
                                CircularCertificate,
                                DriftResult,
                                ProbingResult,
                                StraightnessResult,
                                SquarenessResult>;

/// The certificate's document, and its text: indented, valid UTF-8, one line feed at the end.
nlohmann::ordered_json json_of(const TestResult& result);
std::string json_text_of(const TestResult& result);
std::string csv_of(const TestResult& result);

/// Against the limits of its run; nothing where none were agreed on.
const std::optional<Conformity>& conformity_of(const TestResult& result);

/// What the run file keeps of it: the figures, without words.
nlohmann::ordered_json stored_figures_of(const TestResult& result);
/// How near the figures of another processor must come.
FigureAgreement agreement_of(const TestResult& result);
/// Of a run that is open, or was closed as incomplete.
bool is_partial(const TestResult& result);
/// When the certificate was issued; empty of a test whose paper gets no number.
std::string finished_utc_of(const TestResult& result);

/// Of the run file or the case; 64 lower-case hexadecimal digits.
const std::string& file_sha256_of(const TestResult& result);
/// By which the figures are known: see figure_agreement.hpp.
const std::string& digest_of(const TestResult& result);
void set_file_sha256(TestResult& result, std::string sha256);
void set_digest(TestResult& result, std::string digest);

} // namespace axiscal
