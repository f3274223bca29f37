#include "acquisition/documents/squareness/squareness_report.hpp"

#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/squareness/squareness_pages.hpp"
#include "acquisition/documents/squareness/squareness_paper.hpp"

namespace axiscal {
namespace {

std::string square_axes(const SquarenessResult& result) {
    return "axis " + stated(result.second_axis()) + " to axis " + stated(result.first_axis());
}

std::string title_of(const SquarenessResult& result) {
    if (result.completeness.partial())
        return "Partial result of a squareness test, " + square_axes(result);
    return "Certificate of squareness " + stated(result.run.statements.certificate_number) + ", " +
           square_axes(result);
}

} // namespace

Result<std::string> render_squareness_pdf(const SquarenessResult& result) {
    return render_pages(
        {title_of(result), "ISO 230-1:2012 squareness", iso8601_utc(result.run.closed.utc_ns)},
        across_frame_of(result, square_axes(result) + ", squareness", result.budget.not_stated),
        [&](Sheet& sheet) {
            const auto shortened = draw_squareness_front_page(sheet, result);
            draw_squareness_targets(sheet, result);
            draw_squareness_uncertainty(sheet, result);
            draw_across_conditions(sheet, result, fields_of_square(result), shortened);
        });
}

Result<std::string> PaperOf<SquarenessResult>::pdf(const SquarenessResult& one) {
    return render_squareness_pdf(one);
}

} // namespace axiscal
