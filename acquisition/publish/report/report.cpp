#include "acquisition/publish/report/report.hpp"

#include "acquisition/publish/report/certificate_pages.hpp"

namespace axiscal {
namespace {

std::string title_of(const Certificate& certificate) {
    const Statements& said = certificate.run.statements;
    return "Calibration certificate " + stated(said.certificate_number) + ", axis " +
           stated(said.axis);
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
    if (certificate.preliminary) frame.preliminary = "PRELIMINARY: no uncertainty budget";
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
