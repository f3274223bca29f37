#include "acquisition/publish/report/drift_report.hpp"

#include "acquisition/publish/report/drift_pages.hpp"
#include "acquisition/publish/report/front_parts.hpp"
#include "acquisition/publish/report/wording.hpp"

namespace axiscal {
namespace {

std::string title_of(const RunRecord& run) {
    return "Drift test " + stated(run.statements.certificate_number) + ", axis " +
           stated(run.statements.axis);
}

PageFrame frame_of(const DriftDocument& document) {
    PageFrame frame = page_frame_of(document.run, document.run_file_sha256);
    frame.subject += ", axis " + stated(document.run.statements.axis) + ", drift test";
    return frame;
}

} // namespace

Result<std::string> render_drift_pdf(const DriftDocument& document) {
    return render_pages({title_of(document.run), "ISO 230-2 E_VE, ISO 230-3 ETVE",
                         iso8601_utc(document.run.closed.utc_ns)},
                        frame_of(document), [&](Sheet& sheet) {
                            const auto shortened = draw_drift_front_page(sheet, document);
                            draw_drift_channels(sheet, document.drift);
                            draw_drift_conditions(sheet, document, shortened);
                        });
}

} // namespace axiscal
