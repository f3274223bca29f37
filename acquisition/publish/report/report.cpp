#include "acquisition/publish/report/report.hpp"

#include "acquisition/publish/report/certificate_pages.hpp"

namespace axiscal {
namespace {

std::string title_of(const Certificate& certificate) {
    const Statements& said = certificate.run.statements;
    return "Calibration certificate " + stated(said.certificate_number) + ", axis " +
           stated(said.axis);
}

/// What is missing, in words that fit a page's head; empty when nothing is.
std::string preliminary_words(const Certificate& certificate) {
    if (!certificate.preliminary) return {};
    if (!certificate.uncertainty.budget) return "PRELIMINARY: no uncertainty budget";
    std::string names;
    for (const MissingTerm& term : certificate.uncertainty.missing)
        names += (names.empty() ? "" : ", ") + term.name;
    return "PRELIMINARY, not stated: " + names;
}

PageFrame frame_of(const Certificate& certificate) {
    const Statements& said = certificate.run.statements;
    PageFrame frame;
    frame.laboratory = said.laboratory.empty() ? "Laboratory not stated" : said.laboratory;
    frame.certificate_number = stated(said.certificate_number);
    frame.subject = stated(said.machine) + ", serial " + stated(said.machine_serial) + ", axis " +
                    stated(said.axis);
    frame.foot = "Run " + stated(certificate.run.run_id) + " · run file SHA-256 " +
                 stated(certificate.run_file_sha256.substr(0, 16)) + "… · axiscal " +
                 stated(certificate.run.software_version);
    frame.preliminary = preliminary_words(certificate);
    return frame;
}

/// Draws everything; @returns the number of pages.
int draw(PdfDocument& document, const Certificate& certificate, int total_pages) {
    Sheet sheet{document, frame_of(certificate), total_pages};
    const auto shortened = draw_front_page(sheet, certificate);
    draw_target_pages(sheet, certificate);
    draw_condition_pages(sheet, certificate, shortened);
    sheet.finish();
    return document.pages();
}

} // namespace

Result<std::string> render_certificate_pdf(const Certificate& certificate) {
    if (auto font = check_certificate_font(); !font)
        return tl::unexpected<Error>(std::move(font).error());
    if (certificate.deviations.targets().empty() || certificate.result.positions.empty())
        return fail(Fault::bad_case, "the certificate has no targets");
    const std::string title = title_of(certificate),
                      subject = certificate.result.standard + " positioning";
    PdfDocument counting{title, subject, certificate.finished_utc};
    const int pages = draw(counting, certificate, 0);
    PdfDocument document{title, subject, certificate.finished_utc};
    draw(document, certificate, pages);
    return document.finish();
}

} // namespace axiscal
