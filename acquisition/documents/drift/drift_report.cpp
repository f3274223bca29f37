#include "acquisition/documents/drift/drift_report.hpp"

#include "acquisition/documents/drift/drift_pages.hpp"
#include "acquisition/documents/drift/drift_paper.hpp"
#include "acquisition/documents/pdf/front_parts.hpp"
#include "acquisition/documents/pdf/wording.hpp"

namespace axiscal {
namespace {

std::string title_of(const DriftResult& document) {
    return "Drift test " + stated(document.run.statements.certificate_number) + ", " +
           drift_subject_text(document);
}

PageFrame frame_of(const DriftResult& document) {
    PageFrame frame = page_frame_of(document.run, document.run_file_sha256);
    frame.subject += ", " + drift_subject_text(document) + ", drift test";
    return frame;
}

} // namespace

Result<std::string> render_drift_pdf(const DriftResult& document) {
    return render_pages({title_of(document), drift_standards(document.drift),
                         iso8601_utc(document.run.closed.utc_ns)},
                        frame_of(document), [&](Sheet& sheet) {
                            const auto shortened = draw_drift_front_page(sheet, document);
                            draw_drift_channels(sheet, document.drift);
                            draw_drift_conditions(sheet, document, shortened);
                        });
}

Result<std::string> PaperOf<DriftResult>::pdf(const DriftResult& one) {
    return render_drift_pdf(one);
}

} // namespace axiscal
