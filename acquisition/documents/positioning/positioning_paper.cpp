#include "acquisition/documents/positioning/positioning_paper.hpp"

#include "acquisition/documents/positioning/certificate_csv.hpp"
#include "acquisition/documents/positioning/certificate_json.hpp"
#include "acquisition/documents/positioning/positioning_run_file.hpp"
#include "acquisition/documents/positioning/result_json.hpp"

#include <utility>

namespace axiscal {

Result<Certificate> PaperOf<Certificate>::evaluated(const std::string& /*path*/,
                                                    RunFileContents contents) {
    return certificate_of(std::move(contents));
}

nlohmann::ordered_json PaperOf<Certificate>::json(const Certificate& one) {
    return certificate_to_json(one);
}

std::string PaperOf<Certificate>::csv(const Certificate& one) {
    return certificate_csv(one);
}

nlohmann::ordered_json PaperOf<Certificate>::figures(const Certificate& one) {
    return result_to_json(one.result);
}

FigureAgreement PaperOf<Certificate>::agreement(const Certificate& one) {
    return agreement_of(one.run);
}

} // namespace axiscal
