#include "acquisition/documents/pdf/conformity_block.hpp"
#include "acquisition/documents/pdf/front_parts.hpp"
#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/straightness/straightness_pages.hpp"
#include "acquisition/documents/straightness/straightness_plot.hpp"
#include "acquisition/documents/straightness/straightness_wording.hpp"
#include "analysis/record/certificate_expiry.hpp"

#include <algorithm>

namespace axiscal {
namespace {

FrontAnswer answer_of(const StraightnessResult& result) {
    const bool partial = result.completeness.partial();
    return {"Axis " + stated(result.run.statements.axis) + ", straightness in " +
                stated(result.setup().across) + ", " + machine_in_answer(result.run.statements),
            dates_of_test(result.run).issued_on,
            partial ? "PARTIAL: no verdict"
                    : verdict_on_paper(result.conformity, straightness_name_on_paper),
            straightness_symbol_of(result) + " = " + straightness_on_paper(result, main_reference)};
}

std::string course_of_straightness(const StraightnessResult& result) {
    const StraightnessFigures& figures = result.figures;
    return std::to_string(figures.rows.size()) +
           " positions, n = " + std::to_string(figures.approaches) +
           (figures.approaches == 1 ? " approach" : " approaches") +
           (figures.backward ? " in each direction, mean of both"
                             : " in the forward direction only") +
           (result.mirror ? ", and of both positions of the mirror" : "");
}

void draw_title(Sheet& sheet, const StraightnessResult& result) {
    const bool partial = result.completeness.partial();
    draw_front_title(
        sheet,
        {partial ? "PARTIAL RESULT, no certificate" : "Certificate of straightness",
         result.run.statements.state,
         straightness_subject(result) + ", ISO 230-1:2012: " + course_of_straightness(result),
         answer_of(result)});
}

std::vector<StatedField> draw_identity(Sheet& sheet, const StraightnessResult& result) {
    const auto& rows = result.figures.rows;
    auto fields = across_identity_fields(result);
    fields.push_back({"Axis", stated(result.run.statements.axis) + ", targets " +
                                  fixed(rows.front().target_mm, 3) + " to " +
                                  fixed(rows.back().target_mm, 3) + " mm"});
    fields.push_back({"Direction", stated(result.setup().across) + ", + is positive"});
    auto shortened = sheet.fields(fields, 2, 2);
    sheet.advance(5);
    return shortened;
}

void draw_result_in_words(Sheet& sheet, const StraightnessResult& result) {
    sheet.advance(3);
    sheet.text(straightness_sentence(result), {9, true});
    draw_what_is_missing(sheet, result, result.mean().budget.not_stated);
    sheet.text("Straightness error: largest minus smallest deviation from the reference line, of "
               "the mean of the readings at each target. Positions by the control of the machine.",
               note_style);
}

void draw_straightness_plots(Sheet& sheet, const StraightnessResult& result) {
    constexpr double largest = 190;
    sheet.advance(4);
    const double room = (sheet.remaining() - signature_height - 8) / 2;
    const double height = std::min(room, largest);
    PageBox box{Sheet::left, sheet.y(), Sheet::width, height};
    draw_straightness_plot(sheet.canvas(), box, result);
    box.y += height + 4;
    draw_straightness_residuals(sheet.canvas(), box, result);
}

} // namespace

std::vector<StatedField> draw_straightness_front_page(Sheet& sheet,
                                                      const StraightnessResult& result) {
    const RunRecord& run = result.run;
    draw_title(sheet, result);
    auto shortened = draw_identity(sheet, result);
    draw_front_instruments(sheet, run.instruments, run_date_of(run), shortened);
    draw_result_in_words(sheet, result);
    draw_straightness_plots(sheet, result);
    draw_across_signatures(sheet, result);
    return shortened;
}

} // namespace axiscal
