#include "acquisition/documents/probing/probing_report.hpp"

#include "acquisition/documents/pdf/front_parts.hpp"
#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/probing/probing_pages.hpp"
#include "acquisition/documents/probing/probing_paper.hpp"

namespace axiscal {
namespace {

PageFrame frame_of(const ProbingResult& document) {
    PageFrame frame = page_frame_of(document.run, document.run_file_sha256);
    frame.subject += ", probing test";
    frame.preliminary = "PRELIMINARY: no uncertainty budget";
    return frame;
}

} // namespace

Result<std::string> render_probing_pdf(const ProbingResult& document) {
    const RunRecord& run = document.run;
    return render_pages({"Probing test " + stated(run.statements.certificate_number),
                         "ISO 230-10, 6.9", iso8601_utc(run.closed.utc_ns)},
                        frame_of(document), [&](Sheet& sheet) {
                            const ProbingFront front = draw_probing_front_page(sheet, document);
                            draw_probing_touches(sheet, document, front);
                            draw_probing_conditions(sheet, document, front);
                        });
}

Result<std::string> PaperOf<ProbingResult>::pdf(const ProbingResult& one) {
    return render_probing_pdf(one);
}

} // namespace axiscal
