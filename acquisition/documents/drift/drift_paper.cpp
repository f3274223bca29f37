#include "acquisition/documents/drift/drift_paper.hpp"

#include <utility>

namespace axiscal {

Result<DriftResult> PaperOf<DriftResult>::evaluated(const std::string& path,
                                                    RunFileContents contents) {
    return drift_result_of(path, std::move(contents));
}

nlohmann::ordered_json PaperOf<DriftResult>::json(const DriftResult& one) {
    return drift_to_json(one);
}

std::string PaperOf<DriftResult>::csv(const DriftResult& one) {
    return drift_csv(one);
}

nlohmann::ordered_json PaperOf<DriftResult>::figures(const DriftResult& one) {
    return drift_figures(one.drift);
}

FigureAgreement PaperOf<DriftResult>::agreement(const DriftResult& one) {
    return agreement_of(one.run);
}

} // namespace axiscal
