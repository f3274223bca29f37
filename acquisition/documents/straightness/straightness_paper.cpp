#include "acquisition/documents/straightness/straightness_paper.hpp"

#include "acquisition/documents/straightness/straightness_csv.hpp"
#include "acquisition/documents/straightness/straightness_json.hpp"

#include <utility>

namespace axiscal {

Result<StraightnessResult> PaperOf<StraightnessResult>::evaluated(const std::string& path,
                                                                  RunFileContents contents) {
    return straightness_result_of(path, std::move(contents));
}

nlohmann::ordered_json PaperOf<StraightnessResult>::json(const StraightnessResult& one) {
    return straightness_to_json(one);
}

std::string PaperOf<StraightnessResult>::csv(const StraightnessResult& one) {
    return straightness_csv(one);
}

nlohmann::ordered_json PaperOf<StraightnessResult>::figures(const StraightnessResult& one) {
    return straightness_figures_json(one);
}

/// The figures are made with + - * / and a root; an angle is taken for its sine.
FigureAgreement PaperOf<StraightnessResult>::agreement(const StraightnessResult& /*one*/) {
    return same_bits;
}

std::string PaperOf<StraightnessResult>::finished_utc(const StraightnessResult& one) {
    return iso8601_utc(one.run.closed.utc_ns);
}

} // namespace axiscal
