#pragma once
// The paper of a squareness test.

#include "acquisition/documents/paper.hpp"
#include "acquisition/documents/squareness/squareness_document.hpp"

namespace axiscal {

template <> struct PaperOf<SquarenessResult> {
    static constexpr TestKind kind = TestKind::squareness;
    static Result<SquarenessResult> evaluated(const std::string& path, RunFileContents contents);
    static nlohmann::ordered_json json(const SquarenessResult& one);
    static std::string csv(const SquarenessResult& one);
    static nlohmann::ordered_json figures(const SquarenessResult& one);
    static FigureAgreement agreement(const SquarenessResult& one);
    static bool is_partial(const SquarenessResult& one) { return one.completeness.partial(); }
    static std::string finished_utc(const SquarenessResult& one);
    static Result<std::string> pdf(const SquarenessResult& one);
};

} // namespace axiscal
