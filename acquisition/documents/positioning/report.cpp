#include "acquisition/documents/positioning/report.hpp"

#include "acquisition/documents/positioning/certificate_pages.hpp"
#include "acquisition/documents/positioning/positioning_paper.hpp"

namespace axiscal {
namespace {

std::string title_of(const Certificate& certificate) {
    const Statements& said = certificate.run.statements;
    if (certificate.completeness.partial())
        return "Partial result of a calibration, axis " + stated(said.axis);
    return "Calibration certificate " + stated(said.certificate_number) + ", axis " +
           stated(said.axis);
}

/// What is missing, in words that fit a page's head; empty when nothing is.
std::string preliminary_text(const Certificate& certificate) {
    const Completeness& readings = certificate.completeness;
    if (readings.partial())
        return "PARTIAL: " + std::to_string(readings.used) + " of " +
               std::to_string(readings.expected) + " planned readings";
    if (certificate.run.imported) return "IMPORTED, readings by others: no U";
    if (!certificate.preliminary) return {};
    if (!certificate.uncertainty.budget) return "PRELIMINARY: no uncertainty budget";
    std::string names;
    for (const MissingTerm& term : certificate.uncertainty.missing)
        names += (names.empty() ? "" : ", ") + term.name;
    return "PRELIMINARY, not stated: " + names;
}

PageFrame frame_of(const Certificate& certificate) {
    PageFrame frame = page_frame_of(certificate.run, certificate.run_file_sha256);
    frame.subject += ", axis " + stated(certificate.run.statements.axis);
    if (!certificate.replaces.empty())
        frame.certificate_number += ", replaces " + certificate.replaces;
    frame.preliminary = preliminary_text(certificate);
    frame.numbered = !certificate.completeness.partial();
    return frame;
}

} // namespace

Result<std::string> render_certificate_pdf(const Certificate& certificate) {
    if (certificate.deviations.targets().empty() || certificate.result.positions.empty())
        return fail(Fault::bad_case, "the certificate has no targets");
    return render_pages({title_of(certificate), certificate.result.standard + " positioning",
                         certificate.finished_utc},
                        frame_of(certificate), [&](Sheet& sheet) {
                            const auto shortened = draw_front_page(sheet, certificate);
                            draw_target_pages(sheet, certificate);
                            draw_condition_pages(sheet, certificate, shortened);
                        });
}

Result<std::string> PaperOf<Certificate>::pdf(const Certificate& one) {
    return render_certificate_pdf(one);
}

} // namespace axiscal
