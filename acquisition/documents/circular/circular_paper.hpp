#pragma once
// The paper of a circular test.

#include "acquisition/documents/paper.hpp"
#include "analysis/circular/circular_certificate.hpp"

namespace axiscal {

template <> struct PaperOf<CircularCertificate> {
    static constexpr TestKind kind = TestKind::circular;
    static Result<CircularCertificate> evaluated(const std::string& path, RunFileContents contents);
    static nlohmann::ordered_json json(const CircularCertificate& one);
    static std::string csv(const CircularCertificate& one);
    static nlohmann::ordered_json figures(const CircularCertificate& one);
    static FigureAgreement agreement(const CircularCertificate& one);
    static bool is_partial(const CircularCertificate& /*one*/) { return false; }
    static std::string finished_utc(const CircularCertificate& one);
    static Result<std::string> pdf(const CircularCertificate& one);
};

} // namespace axiscal
