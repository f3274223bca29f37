#include "acquisition/documents/pdf/conformity_block.hpp"
#include "acquisition/documents/pdf/front_parts.hpp"
#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/squareness/squareness_pages.hpp"
#include "acquisition/documents/squareness/squareness_plot.hpp"
#include "acquisition/documents/squareness/squareness_wording.hpp"
#include "analysis/record/certificate_expiry.hpp"

#include <algorithm>

namespace axiscal {
namespace {

FrontAnswer answer_of_square(const SquarenessResult& result) {
    const bool partial = result.completeness.partial();
    return {"Axis " + stated(result.second_axis()) + " to axis " + stated(result.first_axis()) +
                ", squareness, " + machine_in_answer(result.run.statements),
            dates_of_test(result.run).issued_on,
            partial ? "PARTIAL: no verdict"
                    : verdict_on_paper(result.conformity, squareness_name_on_paper),
            squareness_on_paper(result)};
}

std::string course_of_squareness(const SquarenessResult& result) {
    const StraightnessFigures& figures = result.figures;
    return std::to_string(result.lines.front().recorded.rows.size()) + " positions of axis " +
           stated(result.first_axis()) + ", " + std::to_string(figures.rows.size()) + " of axis " +
           stated(result.second_axis()) + ", n = " + std::to_string(figures.approaches) +
           (figures.backward ? " in each direction, mean of both"
                             : " in the forward direction only");
}

void draw_square_title(Sheet& sheet, const SquarenessResult& result) {
    const bool partial = result.completeness.partial();
    draw_front_title(
        sheet, {partial ? "PARTIAL RESULT, no certificate" : "Certificate of squareness",
                result.run.statements.state,
                squareness_title(result) + ", ISO 230-1:2012: " + course_of_squareness(result),
                answer_of_square(result)});
}

std::string reach_of(const SquareLine& line) {
    const auto& rows = line.recorded.rows;
    return stated(line.recorded.axis) + ", targets " + fixed(rows.front().target.in(mm), 3) +
           " to " + fixed(rows.back().target.in(mm), 3) + " mm";
}

std::vector<StatedField> draw_square_identity(Sheet& sheet, const SquarenessResult& result) {
    auto fields = across_identity_fields(result);
    fields.push_back({"First axis", reach_of(result.lines[0])});
    fields.push_back({"Second axis", reach_of(result.lines[1])});
    fields.push_back({"Error of the square", square_error_on_paper(result)});
    fields.push_back({"As an angle", squareness_in_arcsec(result)});
    auto shortened = sheet.fields(fields, 2, 2);
    sheet.advance(5);
    return shortened;
}

void draw_squareness_in_words(Sheet& sheet, const SquarenessResult& result) {
    sheet.advance(3);
    sheet.text(squareness_sentence(result), {9, true});
    draw_what_is_missing(sheet, result, result.budget.not_stated);
    sheet.text("The angle between +" + stated(result.first_axis()) + " and +" +
                   stated(result.second_axis()) +
                   " minus 90°: positive where it is larger. Slopes of the mean of the readings at "
                   "each target. Positions by the control of the machine.",
               note_style);
}

void draw_both_lines(Sheet& sheet, const SquarenessResult& result) {
    constexpr double largest = 384;
    sheet.advance(4);
    const double height = std::min(sheet.remaining() - signature_height - 4, largest);
    draw_squareness_plot(sheet.canvas(), {Sheet::left, sheet.y(), Sheet::width, height}, result);
}

} // namespace

std::vector<StatedField> draw_squareness_front_page(Sheet& sheet, const SquarenessResult& result) {
    const RunRecord& run = result.run;
    draw_square_title(sheet, result);
    auto shortened = draw_square_identity(sheet, result);
    draw_front_instruments(sheet, run.instruments, run_date_of(run), shortened);
    draw_squareness_in_words(sheet, result);
    draw_both_lines(sheet, result);
    draw_across_signatures(sheet, result);
    return shortened;
}

} // namespace axiscal
