#include "acquisition/documents/test_result.hpp"

#include "acquisition/documents/document_parts.hpp"

#include <type_traits>
#include <utility>

namespace axiscal {
namespace {

template <class Test> using PaperFor = PaperOf<std::remove_cvref_t<Test>>;

/// Of a circular test it is the SHA-256 of the case, where no run file stands behind it.
template <class Test> auto& sha256_in(Test& one) {
    if constexpr (requires { one.run_file_sha256; })
        return one.run_file_sha256;
    else
        return one.file_sha256;
}

} // namespace

nlohmann::ordered_json json_of(const TestResult& result) {
    return std::visit([](const auto& one) { return PaperFor<decltype(one)>::json(one); }, result);
}

std::string json_text_of(const TestResult& result) {
    return document_text(json_of(result));
}

std::string csv_of(const TestResult& result) {
    return std::visit([](const auto& one) { return PaperFor<decltype(one)>::csv(one); }, result);
}

nlohmann::ordered_json stored_figures_of(const TestResult& result) {
    return std::visit([](const auto& one) { return PaperFor<decltype(one)>::figures(one); },
                      result);
}

FigureAgreement agreement_of(const TestResult& result) {
    return std::visit([](const auto& one) { return PaperFor<decltype(one)>::agreement(one); },
                      result);
}

bool is_partial(const TestResult& result) {
    return std::visit([](const auto& one) { return PaperFor<decltype(one)>::is_partial(one); },
                      result);
}

std::string finished_utc_of(const TestResult& result) {
    return std::visit([](const auto& one) { return PaperFor<decltype(one)>::finished_utc(one); },
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
