#include "acquisition/documents/squareness/squareness_csv.hpp"

#include "acquisition/documents/conformity_json.hpp"
#include "acquisition/documents/csv_text.hpp"
#include "acquisition/documents/straightness/across_csv.hpp"

#include <cstddef>

namespace axiscal {
namespace {

void append_squareness_figures(std::string& csv, const SquarenessResult& result) {
    for (const NamedSquareness& figure : figures_of(result)) {
        const std::string value = csv_number(figure.value_um_per_m);
        const std::string angle = csv_number(arcsec_of_um_per_m(figure.value_um_per_m));
        if (figure.expanded_um_per_m)
            append_csv_line(csv, {"# parameter", figure.key, value, "um/m",
                                  "\u00B1 " + csv_number(*figure.expanded_um_per_m),
                                  "k = " + csv_number(result.budget.coverage), angle, "arcsec"});
        else
            append_csv_line(csv, {"# parameter", figure.key, value, "um/m", "U not evaluated", "",
                                  angle, "arcsec"});
    }
    append_csv_line(csv,
                    {"# method_spread",
                     csv_number(result.found.squareness.method_spread * um_per_m_of_rad), "um/m"});
    append_missing(csv, result.budget.not_stated);
}

void append_square(std::string& csv, const SquarenessResult& result) {
    append_csv_line(csv, {"# title", csv_field(squareness_title(result))});
    append_csv_line(csv, {"# square", std::string{name_of(result.setup().square)}});
    append_csv_line(csv, {"# square_error", std::string{square_error_by(result)},
                          csv_number(result.found.square_error_rad * um_per_m_of_rad), "um/m"});
}

void append_square_lines(std::string& csv, const SquarenessResult& result) {
    for (const SquareLine& line : result.lines) {
        const RecordedLine& recorded = line.recorded;
        const ReferenceLine& fitted = line_against(line.found.against, main_reference);
        append_csv_line(csv, {"# line", csv_field(recorded.axis), csv_field(recorded.across),
                              std::string{name_of(line.square)}, csv_field(recorded.run_id),
                              "slope " + csv_number(fitted.slope * um_per_m_of_rad) + " um/m",
                              "straightness " + csv_number(fitted.straightness) + " um"});
        append_csv_line(csv, {"# target_mm", "mean_forward_um", "mean_backward_um", "residual_um"});
        for (std::size_t i = 0; i < recorded.rows.size(); ++i) {
            const RecordedLineRow& row = recorded.rows[i];
            append_csv_line(csv,
                            {"# " + csv_number(row.target.in(mm)), csv_number(row.forward.in(um)),
                             row.backward ? csv_number(row.backward->in(um)) : "",
                             csv_number(fitted.residuals[i])});
        }
    }
}

} // namespace

std::string squareness_csv(const SquarenessResult& result) {
    std::string csv;
    append_across_head(csv, result, "axiscal.squareness-csv/1", sign_of_squareness(result));
    append_square(csv, result);
    append_conformity(csv, result.conformity);
    append_squareness_figures(csv, result);
    append_square_lines(csv, result);
    append_every_deviation(csv, result.readings);
    return csv;
}

} // namespace axiscal
