#include "acquisition/documents/test_result.hpp"

#include "acquisition/documents/circular/circular_certificate_csv.hpp"
#include "acquisition/documents/circular/circular_certificate_json.hpp"
#include "acquisition/documents/circular/circular_run_file.hpp"
#include "acquisition/documents/document_parts.hpp"
#include "acquisition/documents/positioning/certificate_csv.hpp"
#include "acquisition/documents/positioning/certificate_json.hpp"
#include "acquisition/documents/positioning/result_json.hpp"

#include <type_traits>
#include <utility>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

/// One function a kind; a kind without one does not compile.
template <class... Kinds> struct OfEach : Kinds... { using Kinds::operator()...; };
template <class... Kinds> OfEach(Kinds...) -> OfEach<Kinds...>;

/// Of a circular test it is the SHA-256 of the case, where no run file stands behind it.
template <class Result> auto& sha256_in(Result& result) {
    if constexpr (std::is_same_v<std::remove_const_t<Result>, CircularCertificate>)
        return result.file_sha256;
    else
        return result.run_file_sha256;
}

} // namespace

Json json_of(const TestResult& result) {
    return std::visit(
        OfEach{[](const Certificate& one) { return certificate_to_json(one); },
               [](const CircularCertificate& one) { return circular_certificate_to_json(one); },
               [](const DriftResult& one) { return drift_to_json(one); },
               [](const ProbingResult& one) { return probing_to_json(one); }},
        result);
}

std::string json_text_of(const TestResult& result) {
    return document_text(json_of(result));
}

std::string csv_of(const TestResult& result) {
    return std::visit(
        OfEach{[](const Certificate& one) { return certificate_csv(one); },
               [](const CircularCertificate& one) { return circular_certificate_csv(one); },
               [](const DriftResult& one) { return drift_csv(one); },
               [](const ProbingResult& one) { return probing_csv(one); }},
        result);
}

Json stored_figures_of(const TestResult& result) {
    return std::visit(OfEach{[](const Certificate& one) { return result_to_json(one.result); },
                             [](const CircularCertificate& one) { return circular_figures(one); },
                             [](const DriftResult& one) { return drift_figures(one.drift); },
                             [](const ProbingResult& one) { return probing_figures(one); }},
                      result);
}

FigureAgreement agreement_of(const TestResult& result) {
    return std::visit(OfEach{[](const Certificate& one) { return agreement_of(one.run); },
                             [](const CircularCertificate&) { return rounding_of_the_library; },
                             [](const DriftResult& one) { return agreement_of(one.run); },
                             [](const ProbingResult&) { return rounding_of_the_library; }},
                      result);
}

const std::optional<Conformity>& conformity_of(const TestResult& result) {
    return std::visit(
        [](const auto& one) -> const std::optional<Conformity>& { return one.conformity; }, result);
}

const std::string& file_sha256_of(const TestResult& result) {
    return std::visit([](const auto& one) -> const std::string& { return sha256_in(one); }, result);
}

const std::string& digest_of(const TestResult& result) {
    return std::visit([](const auto& one) -> const std::string& { return one.result_digest; },
                      result);
}

void set_file_sha256(TestResult& result, std::string sha256) {
    std::visit([&](auto& one) { sha256_in(one) = std::move(sha256); }, result);
}

void set_digest(TestResult& result, std::string digest) {
    std::visit([&](auto& one) { one.result_digest = std::move(digest); }, result);
}

} // namespace axiscal
