#include "tools/axiscal/circular_case_certificate.hpp"

#include "acquisition/documents/result_digest.hpp"
#include "acquisition/runfile/digest.hpp"
#include "analysis/quantity/valid_text.hpp"
#include "config/version.hpp"
#include "tools/axiscal/case_text.hpp"
#include "tools/axiscal/cases/case_reader.hpp"
#include "tools/axiscal/cases/circular_input.hpp"
#include "tools/axiscal/whole_file.hpp"

#include <filesystem>
#include <utility>

namespace axiscal {
namespace {

Result<CircularInput> input_of(const std::string& text) {
    AXISCAL_TRY(const CaseText read, read_case_text(text));
    if (read.document.is_array())
        return refuse(Fault::bad_case, "case", "must be one circular case, not an array of cases");
    if (!read.repeated_keys.empty())
        return refuse(Fault::bad_case, printable(read.repeated_keys.begin()->second),
                      "stands twice in one object");
    if (!read.document.is_object()) return refuse(Fault::bad_case, "case", "must be an object");
    AXISCAL_TRY(const std::string name, text_of(read.document, "analysis", "analysis"));
    if (name != "circular")
        return refuse(Fault::bad_case, "analysis",
                      "only \"circular\" cases have a certificate; other results: axiscal analyze");
    return read_circular_case(read.document);
}

} // namespace

Result<CircularCertificate> circular_certificate_of_case(const std::string& case_file) {
    AXISCAL_TRY(std::string sha256, sha256_of_file(case_file));
    AXISCAL_TRY(const std::string text, whole_file(case_file));
    AXISCAL_TRY(CircularInput input, input_of(text));
    CircularMeasurement measured = measurement_of(std::move(input));
    const std::string& id = measured.run.run_id;
    measured.run.run_id = id_of_name(
        id.empty() ? std::filesystem::path(case_file).stem().string() : id, "case", longest_run_id);
    measured.run.software_version = software_version();
    AXISCAL_TRY(CircularCertificate certificate,
                evaluate_measurement(std::move(measured), std::move(sha256)));
    certificate.result_digest = result_digest(certificate.parameters);
    return certificate;
}

} // namespace axiscal
