#include "acquisition/documents/straightness/straightness_csv.hpp"

#include "acquisition/documents/conformity_json.hpp"
#include "acquisition/documents/csv_text.hpp"
#include "acquisition/documents/straightness/straightness_remarks.hpp"

namespace axiscal {
namespace {

void append_straightness_head(std::string& csv, const StraightnessResult& result) {
    const RunRecord& run = result.run;
    const auto line = [&](const char* key, const std::string& value) {
        append_csv_line(csv, {std::string{"# "} + key, csv_field(value)});
    };
    append_csv_line(csv, {"# axiscal.straightness-csv/1"});
    line("run", run.run_id);
    line("certificate_number", run.statements.certificate_number);
    if (!result.replaces.empty()) line("replaces", result.replaces);
    line("machine", run.statements.machine);
    line("machine_serial", run.statements.machine_serial);
    line("axis", run.statements.axis);
    line("direction", result.setup().across);
    line("standard", "ISO 230-1:2012");
    line("reference", std::string{name_of(main_reference)});
    line("sign", "positive towards + of " + result.setup().across);
    line("completeness", result.completeness.partial() ? "partial" : "complete");
    line("run_file_sha256", result.run_file_sha256);
    line("software_version", run.software_version);
}

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
    for (const std::string& words : missing_terms_of(result))
        append_csv_line(csv, {"# preliminary", "not stated", csv_field(words)});
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

void append_deviations_across(std::string& csv,
                              const char* direction,
                              const std::vector<double>& targets_mm,
                              const std::vector<std::vector<double>>& rows_um) {
    for (std::size_t i = 0; i < rows_um.size(); ++i)
        for (std::size_t j = 0; j < rows_um[i].size(); ++j)
            append_csv_line(csv, {direction, csv_number(targets_mm[i]), std::to_string(j + 1),
                                  csv_number(rows_um[i][j])});
}

} // namespace

std::string straightness_csv(const StraightnessResult& result) {
    const StraightnessReadings& readings = result.readings;
    std::string csv;
    append_straightness_head(csv, result);
    append_conformity(csv, result.conformity);
    append_straightness_figures(csv, result);
    append_straightness_means(csv, result);
    append_csv_line(csv, {"direction", "target_mm", "number", "deviation_um"});
    append_deviations_across(csv, "forward", readings.targets_mm, readings.forward_um);
    append_deviations_across(csv, "backward", readings.targets_mm, readings.backward_um);
    return csv;
}

} // namespace axiscal
