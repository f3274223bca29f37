#pragma once
// The paper of a drift test.

#include "acquisition/documents/drift/drift_document.hpp"
#include "acquisition/documents/paper.hpp"

namespace axiscal {

template <> struct PaperOf<DriftResult> {
    static constexpr TestKind kind = TestKind::drift;
    static Result<DriftResult> evaluated(const std::string& path, RunFileContents contents);
    static nlohmann::ordered_json json(const DriftResult& one);
    static std::string csv(const DriftResult& one);
    static nlohmann::ordered_json figures(const DriftResult& one);
    static FigureAgreement agreement(const DriftResult& one);
    static bool is_partial(const DriftResult& /*one*/) { return false; }
    static std::string finished_utc(const DriftResult& /*one*/) { return {}; }
    static Result<std::string> pdf(const DriftResult& one);
};

} // namespace axiscal
