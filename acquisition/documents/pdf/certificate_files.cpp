#include "acquisition/documents/pdf/certificate_files.hpp"

#include "acquisition/runfile/digest.hpp"
#include "acquisition/runfile/durable_file.hpp"

#include <filesystem>
#include <type_traits>
#include <variant>

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

Result<std::string> pdf_of(const TestResult& result) {
    return std::visit(
        [](const auto& one) { return PaperOf<std::remove_cvref_t<decltype(one)>>::pdf(one); },
        result);
}

} // namespace

Result<void> write_certificate_files(const TestResult& result,
                                     const std::string& source_file,
                                     const std::string& folder) {
    AXISCAL_TRY(const std::string pdf, pdf_of(result));
    AXISCAL_CHECK(write_synced(folder + "/" + certificate_json_name, json_text_of(result)));
    AXISCAL_CHECK(write_synced(folder + "/" + certificate_csv_name, csv_of(result)));
    AXISCAL_CHECK(write_synced(folder + "/" + certificate_pdf_name, pdf));
    const std::string name = std::filesystem::path(source_file).filename();
    return copy_verified(source_file, folder + "/" + name, file_sha256_of(result));
}

} // namespace axiscal
