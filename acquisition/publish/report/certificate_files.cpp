#include "acquisition/publish/report/certificate_files.hpp"

#include "acquisition/journal/digest.hpp"
#include "acquisition/journal/durable_file.hpp"
#include "acquisition/publish/certificate_csv.hpp"
#include "acquisition/publish/certificate_json.hpp"
#include "acquisition/publish/report/report.hpp"

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

} // namespace

Result<void> write_certificate_files(const Certificate& certificate,
                                     const std::string& run_file,
                                     const std::string& folder) {
    AXISCAL_TRY(const std::string pdf, render_certificate_pdf(certificate));
    const std::pair<const char*, std::string> files[]{
        {certificate_json_name, certificate_json_text(certificate)},
        {certificate_csv_name, certificate_csv(certificate)},
        {certificate_pdf_name, pdf}};
    for (const auto& [name, content] : files)
        if (auto written = write_synced(folder + "/" + name, content); !written) return written;
    const std::string name = std::filesystem::path(run_file).filename();
    return copy_verified(run_file, folder + "/" + name, certificate.run_file_sha256);
}

} // namespace axiscal
