#include "acquisition/documents/straightness/straightness_csv.hpp"

#include "acquisition/documents/conformity_json.hpp"
#include "acquisition/documents/csv_text.hpp"
#include "acquisition/documents/straightness/across_csv.hpp"

namespace axiscal {
namespace {

void append_straightness_figures(std::string& csv, const StraightnessResult& result) {
    for (const NamedStraightness& figure : figures_of(result)) {
        const std::string value = csv_number(figure.value_um);
        if (figure.expanded_um)
            append_csv_line(csv, {"# parameter", figure.key, value, "um",
                                  "\u00B1 " + csv_number(*figure.expanded_um),
                                  "k = " + csv_number(result.mean().budget.coverage)});
        else
            append_csv_line(csv, {"# parameter", figure.key, value, "um", "U not evaluated"});
    }
    if (result.mirror)
        append_csv_line(csv, {"# mirror", std::string{name_of(main_reference)},
                              csv_number(result.mirror->straightness_um(main_reference)), "um",
                              "parted by reversal, run " + result.setup().reversal_of});
    append_missing(csv, result.mean().budget.not_stated);
}

void append_straightness_means(std::string& csv, const StraightnessResult& result) {
    const auto& residuals = line_against(result.mean().found.against, main_reference).residuals;
    append_csv_line(csv, {"# target_mm", "mean_forward_um", "mean_backward_um", "mean_um", "B_um",
                          "s_forward_um", "s_backward_um", "residual_um"});
    for (std::size_t i = 0; i < result.figures.rows.size(); ++i) {
        const StraightnessRow& row = result.figures.rows[i];
        append_csv_line(csv, {"# " + csv_number(row.target_mm), csv_number(row.mean_forward_um),
                              csv_number(row.mean_backward_um), csv_number(row.mean_um),
                              csv_number(row.reversal_um), csv_number(row.s_forward_um),
                              csv_number(row.s_backward_um), csv_number(residuals[i])});
    }
}

} // namespace

std::string straightness_csv(const StraightnessResult& result) {
    std::string csv;
    append_across_head(csv, result, "axiscal.straightness-csv/1",
                       "positive towards + of " + result.setup().across);
    append_conformity(csv, result.conformity);
    append_straightness_figures(csv, result);
    append_straightness_means(csv, result);
    append_every_deviation(csv, result.readings);
    return csv;
}

} // namespace axiscal
