#include "acquisition/measurement/certificates.hpp"

#include "acquisition/live/notices.hpp"
#include "acquisition/measurement/certificate_writer.hpp"

#include <utility>

namespace axiscal {
namespace {

std::string news_of(const WrittenCertificate& written) {
    const std::string verdict =
        written.verdict.empty() ? std::string{} : "Verdict on " + written.verdict + ". ";
    return verdict + "Certificate written: " + written.entry;
}

} // namespace

Certificates::Certificates(Scheduler& scheduler,
                           Notices& notices,
                           std::string report_program,
                           std::string outbox)
    : scheduler_{scheduler}
    , notices_{notices}
    , report_program_{std::move(report_program)}
    , outbox_{std::move(outbox)} {}

Task<Result<std::string>> Certificates::make(std::string run_id, std::string run_file) {
    const auto written = co_await write_certificate(scheduler_, report_program_, run_file, outbox_);
    if (!written) {
        notices_.note("No certificate for run " + run_id + ": " + describe(written.error()) +
                          " 'axiscal export " + run_file + "' tries again.",
                      {written.error().fault, run_id});
        co_return tl::unexpected<Error>(written.error());
    }
    made_of_ = run_id;
    unanswered_ = written->unanswered;
    notices_.note(news_of(*written), {Fault::none, run_id});
    for (const std::string& finding : written->setup_findings)
        notices_.note(finding, {Fault::none, run_id});
    co_return written->entry;
}

} // namespace axiscal
