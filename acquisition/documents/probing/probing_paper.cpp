#include "acquisition/documents/probing/probing_paper.hpp"

#include <utility>

namespace axiscal {

Result<ProbingResult> PaperOf<ProbingResult>::evaluated(const std::string& path,
                                                        RunFileContents contents) {
    return probing_result_of(path, std::move(contents));
}

nlohmann::ordered_json PaperOf<ProbingResult>::json(const ProbingResult& one) {
    return probing_to_json(one);
}

std::string PaperOf<ProbingResult>::csv(const ProbingResult& one) {
    return probing_csv(one);
}

nlohmann::ordered_json PaperOf<ProbingResult>::figures(const ProbingResult& one) {
    return probing_figures(one);
}

FigureAgreement PaperOf<ProbingResult>::agreement(const ProbingResult& /*one*/) {
    return rounding_of_the_library;
}

} // namespace axiscal
