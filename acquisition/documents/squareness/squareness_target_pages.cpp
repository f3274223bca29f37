#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/squareness/squareness_pages.hpp"
#include "acquisition/documents/squareness/squareness_wording.hpp"

#include <algorithm>
#include <cstddef>

namespace axiscal {
namespace {

constexpr int deviation_decimals_across = 2;

void draw_every_squareness(Sheet& sheet, const SquarenessResult& result) {
    const int decimals = squareness_decimals(result);
    std::vector<TableRow> rows;
    for (const NamedSquareness& figure : figures_of(result))
        rows.push_back(
            {squareness_name_on_paper(figure.key), fixed(figure.value_um_per_m, decimals),
             figure.expanded_um_per_m ? "± " + fixed_up(*figure.expanded_um_per_m, decimals)
                                      : "U not evaluated",
             fixed(arcsec_of_um_per_m(figure.value_um_per_m), decimals)});
    sheet.heading("Every figure");
    sheet.table({{"Squareness by", "", Align::left},
                 {"Value", "µm/m"},
                 {"U (k = " + fixed(result.budget.coverage, 0) + ")", "µm/m", Align::left},
                 {"Value", "″"}},
                rows);
    sheet.text("By the reference line of both axes alike. U is that of the least squares lines; by "
               "another line the figure differs by up to the straightness of both axes over their "
               "lengths.",
               note_style);
}

void draw_slopes_of_lines(Sheet& sheet, const SquarenessResult& result) {
    const int decimals = squareness_decimals(result);
    std::vector<TableRow> rows;
    for (const SquareLine& line : result.lines) {
        TableRow cells{stated(line.recorded.axis) + " in " + stated(line.recorded.across),
                       std::string{name_of(line.square)}, stated(line.recorded.run_id),
                       std::to_string(line.recorded.readings)};
        for (const LineReference reference : line_references)
            cells.push_back(fixed(
                line_against(line.found.against, reference).slope * um_per_m_of_rad, decimals));
        cells.push_back(
            fixed(line.found.straightness_um(main_reference), deviation_decimals_across));
        rows.push_back(std::move(cells));
    }
    sheet.heading("Slope of the lines");
    sheet.table({{"Axis", "", Align::left},
                 {"Square", "", Align::left},
                 {"Run", "", Align::left, true},
                 {"n", ""},
                 {"end points", "µm/m"},
                 {"least squares", "µm/m"},
                 {"minimum zone", "µm/m"},
                 {"straightness", "µm"}},
                rows);
    sheet.text("A slope is that of this set-up between optics and axis, no property of the axis. "
               "n: readings in each mean of one direction, the fewest. Straightness against the "
               "least squares line.",
               note_style);
}

/// A heading does not stand alone at the end of a page; a long table breaks.
double room_of_means(std::size_t rows) {
    constexpr std::size_t most_together = 10;
    return 45 + 15.0 * static_cast<double>(std::min(rows, most_together));
}

void draw_means_of_line(Sheet& sheet, const SquareLine& line) {
    constexpr int decimals = deviation_decimals_across;
    const ReferenceLine& fitted = line_against(line.found.against, main_reference);
    std::vector<TableRow> rows;
    for (std::size_t i = 0; i < line.recorded.rows.size(); ++i) {
        const RecordedLineRow& row = line.recorded.rows[i];
        rows.push_back({fixed(row.target.in(mm), 3), fixed(row.forward.in(um), decimals),
                        row.backward ? fixed(row.backward->in(um), decimals) : "–",
                        fixed(line.found.line.deviations[i], decimals),
                        fixed(fitted.residuals[i], decimals)});
    }
    sheet.heading("Axis " + stated(line.recorded.axis) + " in direction " +
                      stated(line.recorded.across) + ", square " +
                      std::string{name_of(line.square)},
                  room_of_means(rows.size()));
    sheet.table({{"Target", "mm"},
                 {"mean ↑", "µm"},
                 {"mean ↓", "µm"},
                 {"mean", "µm"},
                 {"about the least squares line", "µm"}},
                rows);
    sheet.text("Run " + stated(line.recorded.run_id) + ". Positive towards + of " +
                   stated(line.recorded.across) + ", with the slope of the set-up.",
               note_style);
}

} // namespace

void draw_squareness_targets(Sheet& sheet, const SquarenessResult& result) {
    sheet.new_page();
    draw_every_squareness(sheet, result);
    draw_slopes_of_lines(sheet, result);
    for (const SquareLine& line : result.lines)
        draw_means_of_line(sheet, line);
    draw_every_deviation(sheet, result, deviation_decimals_across);
}

} // namespace axiscal
