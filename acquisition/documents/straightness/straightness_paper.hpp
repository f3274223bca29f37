#pragma once
// The paper of a straightness test.

#include "acquisition/documents/paper.hpp"
#include "acquisition/documents/straightness/straightness_document.hpp"

namespace axiscal {

template <> struct PaperOf<StraightnessResult> {
    static constexpr TestKind kind = TestKind::straightness;
    static Result<StraightnessResult> evaluated(const std::string& path, RunFileContents contents);
    static nlohmann::ordered_json json(const StraightnessResult& one);
    static std::string csv(const StraightnessResult& one);
    static nlohmann::ordered_json figures(const StraightnessResult& one);
    static FigureAgreement agreement(const StraightnessResult& one);
    static bool is_partial(const StraightnessResult& one) { return one.completeness.partial(); }
    static std::string finished_utc(const StraightnessResult& one);
    static Result<std::string> pdf(const StraightnessResult& one);
};

} // namespace axiscal
