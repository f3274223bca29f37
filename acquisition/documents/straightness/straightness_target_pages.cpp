#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/straightness/straightness_pages.hpp"
#include "acquisition/documents/straightness/straightness_wording.hpp"

#include <cstddef>

namespace axiscal {
namespace {

std::string um_or_dash(const std::optional<double>& value, int decimals) {
    return value ? fixed(*value, decimals) : std::string{"–"};
}

void draw_every_figure(Sheet& sheet, const StraightnessResult& result) {
    const int decimals = straightness_decimals(result);
    std::vector<TableRow> rows;
    for (const NamedStraightness& figure : figures_of(result))
        rows.push_back({straightness_name_on_paper(figure.key), fixed(figure.value_um, decimals),
                        figure.expanded_um ? "± " + fixed_up(*figure.expanded_um, decimals)
                                           : "U not evaluated"});
    sheet.heading("Every figure");
    sheet.table({{"Figure", "", Align::left},
                 {"Value", "µm"},
                 {"U (k = " + fixed(result.mean().budget.coverage, 0) + ")", "µm", Align::left}},
                rows);
    sheet.text(
        "By reference line; without an arrow: of the mean of both directions. B: largest "
        "difference of the mean of both directions at one target (forward minus backward), "
        "B\u0304 its mean, R by the formula of ISO 230-2; ISO 230-1 names none of these three.",
        note_style);
}

void draw_means(Sheet& sheet, const StraightnessResult& result) {
    const int decimals = straightness_decimals(result);
    const Straightness& against = result.mean().found.against;
    std::vector<TableRow> rows;
    for (std::size_t i = 0; i < result.figures.rows.size(); ++i) {
        const StraightnessRow& row = result.figures.rows[i];
        TableRow cells{fixed(row.target_mm, 3), fixed(row.mean_forward_um, decimals)};
        for (const auto& value : {row.mean_backward_um, row.mean_um, row.reversal_um})
            cells.push_back(um_or_dash(value, decimals));
        for (const auto& value : {row.s_forward_um, row.s_backward_um})
            cells.push_back(um_or_dash(value, decimals + 1));
        for (const LineReference reference : line_references)
            cells.push_back(fixed(line_against(against, reference).residuals[i], decimals));
        rows.push_back(std::move(cells));
    }
    sheet.heading("Result per target");
    sheet.table({{"Target", "mm"},
                 {"mean ↑", "µm"},
                 {"mean ↓", "µm"},
                 {"mean", "µm"},
                 {"B\u1d62", "µm"},
                 {"s ↑", "µm"},
                 {"s ↓", "µm"},
                 {"end points", "µm"},
                 {"least squares", "µm"},
                 {"minimum zone", "µm"}},
                rows);
    sheet.text("Means as measured, with the slope of the set-up; the last three columns are the "
               "deviations of the mean from each reference line, of the minimum zone across it.",
               note_style);
}

} // namespace

void draw_straightness_targets(Sheet& sheet, const StraightnessResult& result) {
    sheet.new_page();
    draw_every_figure(sheet, result);
    draw_means(sheet, result);
    draw_every_deviation(sheet, result, straightness_decimals(result));
}

} // namespace axiscal
