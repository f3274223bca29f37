#pragma once
// The paper of a positioning test.

#include "acquisition/documents/paper.hpp"
#include "analysis/positioning/positioning_certificate.hpp"

namespace axiscal {

template <> struct PaperOf<Certificate> {
    static constexpr TestKind kind = TestKind::positioning;
    static Result<Certificate> evaluated(const std::string& path, RunFileContents contents);
    static nlohmann::ordered_json json(const Certificate& one);
    static std::string csv(const Certificate& one);
    static nlohmann::ordered_json figures(const Certificate& one);
    static FigureAgreement agreement(const Certificate& one);
    static bool is_partial(const Certificate& one) { return one.completeness.partial(); }
    static std::string finished_utc(const Certificate& one) { return one.finished_utc; }
    static Result<std::string> pdf(const Certificate& one);
};

} // namespace axiscal
