#include "acquisition/documents/circular/circular_paper.hpp"

#include "acquisition/documents/circular/circular_certificate_csv.hpp"
#include "acquisition/documents/circular/circular_certificate_json.hpp"
#include "acquisition/documents/circular/circular_run_file.hpp"

namespace axiscal {

Result<CircularCertificate> PaperOf<CircularCertificate>::evaluated(const std::string& path,
                                                                    RunFileContents contents) {
    return circular_certificate_of(path, contents);
}

nlohmann::ordered_json PaperOf<CircularCertificate>::json(const CircularCertificate& one) {
    return circular_certificate_to_json(one);
}

std::string PaperOf<CircularCertificate>::csv(const CircularCertificate& one) {
    return circular_certificate_csv(one);
}

nlohmann::ordered_json PaperOf<CircularCertificate>::figures(const CircularCertificate& one) {
    return circular_figures(one);
}

FigureAgreement PaperOf<CircularCertificate>::agreement(const CircularCertificate& /*one*/) {
    return rounding_of_the_library;
}

std::string PaperOf<CircularCertificate>::finished_utc(const CircularCertificate& one) {
    return one.measured.finished_utc;
}

} // namespace axiscal
