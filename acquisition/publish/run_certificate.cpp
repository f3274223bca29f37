#include "acquisition/publish/run_certificate.hpp"

#include "acquisition/journal/digest.hpp"
#include "acquisition/journal/run_file.hpp"
#include "acquisition/publish/result_digest.hpp"
#include "acquisition/publish/result_json.hpp"

#include <nlohmann/json.hpp>

namespace axiscal {

Result<Certificate> certificate_of_run_file(const std::string& run_file) {
    AXISCAL_TRY(std::string sha256, sha256_of_file(run_file));
    AXISCAL_TRY(RunFileContents contents, read_run_file_contents(run_file));
    if (!contents.closed)
        return fail(Fault::incomplete_run, run_file + " is still open: close the run first");
    AXISCAL_TRY(Certificate certificate,
                make_certificate(std::move(contents.run), std::move(contents.revisions),
                                 std::move(sha256)));
    certificate.result_digest = result_digest(certificate.result);
    // A run that was added to is evaluated anew: the stored result is of what it held before.
    if (contents.results < certificate.revisions.closings) return certificate;
    const auto stored = read_stored_result(run_file);
    if (!stored && stored.error().fault != Fault::not_found)
        return tl::unexpected<Error>(stored.error());
    if (stored && stored->digest != certificate.result_digest)
        return fail(Fault::bad_run_file,
                    run_file + ": the figures recomputed now (" + certificate.result_digest +
                        ") are not those of its first evaluation (" + stored->digest +
                        "); this program computes differently from version " +
                        certificate.run.software_version);
    return certificate;
}

Result<void> seal_result(const std::string& run_file) {
    AXISCAL_TRY(const RunFileContents contents, read_run_file_contents(run_file));
    if (contents.closed && contents.results >= contents.revisions.closings) return {};
    AXISCAL_TRY(const Certificate certificate, certificate_of_run_file(run_file));
    return store_result(run_file,
                        {certificate.result_digest, result_to_json(certificate.result).dump()});
}

} // namespace axiscal
