#pragma once
// The paper of a probing test.

#include "acquisition/documents/paper.hpp"
#include "acquisition/documents/probing/probing_document.hpp"

namespace axiscal {

template <> struct PaperOf<ProbingResult> {
    static constexpr TestKind kind = TestKind::probing;
    static Result<ProbingResult> evaluated(const std::string& path, RunFileContents contents);
    static nlohmann::ordered_json json(const ProbingResult& one);
    static std::string csv(const ProbingResult& one);
    static nlohmann::ordered_json figures(const ProbingResult& one);
    static FigureAgreement agreement(const ProbingResult& one);
    static bool is_partial(const ProbingResult& /*one*/) { return false; }
    static std::string finished_utc(const ProbingResult& /*one*/) { return {}; }
    static Result<std::string> pdf(const ProbingResult& one);
};

} // namespace axiscal
