#include "acquisition/publish/report/drift_report.hpp"

#include "acquisition/publish/report/drift_pages.hpp"
#include "acquisition/publish/report/wording.hpp"

namespace axiscal {
namespace {

std::string title_of(const RunRecord& run) {
    return "Drift test " + stated(run.statements.certificate_number) + ", axis " +
           stated(run.statements.axis);
}

PageFrame frame_of(const DriftDocument& document) {
    const RunRecord& run = document.run;
    const Statements& said = run.statements;
    constexpr std::size_t digits_of_hash = 16;
    PageFrame frame;
    frame.laboratory = said.laboratory.empty() ? "Laboratory not stated" : said.laboratory;
    frame.certificate_number = stated(said.certificate_number);
    frame.subject = stated(said.machine) + ", serial " + stated(said.machine_serial) + ", axis " +
                    stated(said.axis) + ", drift test";
    frame.foot = "Run " + stated(run.run_id) + " · run file SHA-256 " +
                 stated(document.run_file_sha256.substr(0, digits_of_hash)) + "… · axiscal " +
                 stated(run.software_version);
    return frame;
}

/// Draws everything; @returns the number of pages.
int draw(PdfDocument& pdf, const DriftDocument& document, int total_pages) {
    Sheet sheet{pdf, frame_of(document), total_pages};
    const auto shortened = draw_drift_front_page(sheet, document);
    draw_drift_channels(sheet, document.drift);
    draw_drift_conditions(sheet, document, shortened);
    sheet.finish();
    return pdf.pages();
}

} // namespace

Result<std::string> render_drift_pdf(const DriftDocument& document) {
    AXISCAL_CHECK(check_certificate_font());
    const std::string title = title_of(document.run), subject = "ISO 230-2 E_VE, ISO 230-3 ETVE";
    const std::string created = iso8601_utc(document.run.closed.utc_ns);
    PdfDocument counting{title, subject, created};
    const int pages = draw(counting, document, 0);
    PdfDocument pdf{title, subject, created};
    draw(pdf, document, pages);
    return pdf.finish();
}

} // namespace axiscal
