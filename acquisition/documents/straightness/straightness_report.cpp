#include "acquisition/documents/straightness/straightness_report.hpp"

#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/straightness/straightness_pages.hpp"
#include "acquisition/documents/straightness/straightness_paper.hpp"

namespace axiscal {
namespace {

std::string title_of(const StraightnessResult& result) {
    const Statements& said = result.run.statements;
    if (result.completeness.partial())
        return "Partial result of a straightness test, axis " + stated(said.axis);
    return "Certificate of straightness " + stated(said.certificate_number) + ", axis " +
           stated(said.axis);
}

} // namespace

Result<std::string> render_straightness_pdf(const StraightnessResult& result) {
    return render_pages(
        {title_of(result), "ISO 230-1:2012 straightness", iso8601_utc(result.run.closed.utc_ns)},
        across_frame_of(result, "axis " + stated(result.run.statements.axis) + ", straightness",
                        result.mean().budget.not_stated),
        [&](Sheet& sheet) {
            const auto shortened = draw_straightness_front_page(sheet, result);
            draw_straightness_targets(sheet, result);
            draw_straightness_uncertainty(sheet, result);
            draw_across_conditions(sheet, result, {}, shortened);
        });
}

Result<std::string> PaperOf<StraightnessResult>::pdf(const StraightnessResult& one) {
    return render_straightness_pdf(one);
}

} // namespace axiscal
