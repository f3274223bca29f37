#include "acquisition/documents/straightness/straightness_report.hpp"

#include "acquisition/documents/pdf/front_parts.hpp"
#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/straightness/straightness_pages.hpp"
#include "acquisition/documents/straightness/straightness_paper.hpp"
#include "acquisition/documents/straightness/straightness_remarks.hpp"

namespace axiscal {
namespace {

std::string title_of(const StraightnessResult& result) {
    const Statements& said = result.run.statements;
    if (result.completeness.partial())
        return "Partial result of a straightness test, axis " + stated(said.axis);
    return "Certificate of straightness " + stated(said.certificate_number) + ", axis " +
           stated(said.axis);
}

std::string preliminary_text(const StraightnessResult& result) {
    const Completeness& readings = result.completeness;
    if (readings.partial())
        return "PARTIAL: " + std::to_string(readings.used) + " of " +
               std::to_string(readings.expected) + " planned readings";
    std::string names;
    for (const std::string& term : result.mean().budget.not_stated)
        names += (names.empty() ? "" : ", ") + term;
    return names.empty() ? names : "PRELIMINARY, not stated: " + names;
}

PageFrame frame_of(const StraightnessResult& result) {
    PageFrame frame = page_frame_of(result.run, result.run_file_sha256);
    frame.subject += ", axis " + stated(result.run.statements.axis) + ", straightness";
    if (!result.replaces.empty()) frame.certificate_number += ", replaces " + result.replaces;
    frame.preliminary = preliminary_text(result);
    frame.numbered = !result.completeness.partial();
    return frame;
}

} // namespace

Result<std::string> render_straightness_pdf(const StraightnessResult& result) {
    return render_pages(
        {title_of(result), "ISO 230-1:2012 straightness", iso8601_utc(result.run.closed.utc_ns)},
        frame_of(result), [&](Sheet& sheet) {
            const auto shortened = draw_straightness_front_page(sheet, result);
            draw_straightness_targets(sheet, result);
            draw_straightness_uncertainty(sheet, result);
            draw_straightness_conditions(sheet, result, shortened);
        });
}

Result<std::string> PaperOf<StraightnessResult>::pdf(const StraightnessResult& one) {
    return render_straightness_pdf(one);
}

} // namespace axiscal
