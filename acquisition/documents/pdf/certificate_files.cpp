#include "acquisition/documents/pdf/certificate_files.hpp"

#include "acquisition/documents/circular/circular_certificate_csv.hpp"
#include "acquisition/documents/circular/circular_certificate_json.hpp"
#include "acquisition/documents/circular/circular_report.hpp"
#include "acquisition/documents/drift/drift_report.hpp"
#include "acquisition/documents/positioning/certificate_csv.hpp"
#include "acquisition/documents/positioning/certificate_json.hpp"
#include "acquisition/documents/positioning/report.hpp"
#include "acquisition/documents/probing/probing_report.hpp"
#include "acquisition/runfile/digest.hpp"
#include "acquisition/runfile/durable_file.hpp"

#include <filesystem>

namespace axiscal {
namespace {

Result<void>
copy_verified(const std::string& from, const std::string& to, const std::string& sha256) {
    std::error_code error;
    std::filesystem::copy_file(from, to, error);
    if (error) return fail(Fault::io, "copying " + from + " to " + to, error);
    if (auto synced = sync_file(to); !synced) return synced;
    AXISCAL_TRY(const std::string copied, sha256_of_file(to));
    if (copied != sha256)
        return fail(Fault::refused, from + " changed while the certificate was made");
    return {};
}

struct Papers {
    std::string json, csv, pdf;
};

Result<void> write_all(const Papers& papers,
                       const std::string& source_file,
                       const std::string& sha256,
                       const std::string& folder) {
    const std::pair<const char*, const std::string*> files[]{{certificate_json_name, &papers.json},
                                                             {certificate_csv_name, &papers.csv},
                                                             {certificate_pdf_name, &papers.pdf}};
    for (const auto& [name, content] : files)
        AXISCAL_CHECK(write_synced(folder + "/" + name, *content));
    const std::string name = std::filesystem::path(source_file).filename();
    return copy_verified(source_file, folder + "/" + name, sha256);
}

} // namespace

Result<void> write_certificate_files(const Certificate& certificate,
                                     const std::string& run_file,
                                     const std::string& folder) {
    AXISCAL_TRY(std::string pdf, render_certificate_pdf(certificate));
    const Papers papers{certificate_json_text(certificate), certificate_csv(certificate),
                        std::move(pdf)};
    return write_all(papers, run_file, certificate.run_file_sha256, folder);
}

Result<void> write_circular_files(const CircularCertificate& certificate,
                                  const std::string& source_file,
                                  const std::string& folder) {
    AXISCAL_TRY(std::string pdf, render_circular_pdf(certificate));
    const Papers papers{circular_certificate_json_text(certificate),
                        circular_certificate_csv(certificate), std::move(pdf)};
    return write_all(papers, source_file, certificate.file_sha256, folder);
}

Result<void> write_drift_files(const DriftDocument& document,
                               const std::string& run_file,
                               const std::string& folder) {
    AXISCAL_TRY(std::string pdf, render_drift_pdf(document));
    const Papers papers{drift_json_text(document), drift_csv(document), std::move(pdf)};
    return write_all(papers, run_file, document.run_file_sha256, folder);
}

Result<void> write_probing_files(const ProbingDocument& document,
                                 const std::string& run_file,
                                 const std::string& folder) {
    AXISCAL_TRY(std::string pdf, render_probing_pdf(document));
    const Papers papers{probing_json_text(document), probing_csv(document), std::move(pdf)};
    return write_all(papers, run_file, document.run_file_sha256, folder);
}

} // namespace axiscal
