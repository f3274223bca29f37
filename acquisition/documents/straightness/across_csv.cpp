#include "acquisition/documents/straightness/across_csv.hpp"

#include "acquisition/documents/csv_text.hpp"
#include "acquisition/documents/straightness/across_remarks.hpp"

#include <cstddef>

namespace axiscal {
namespace {

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

void append_across_head(std::string& csv,
                        const AcrossRun& one,
                        const std::string& format,
                        const std::string& sign) {
    const RunRecord& run = one.run;
    const auto line = [&](const char* key, const std::string& value) {
        append_csv_line(csv, {std::string{"# "} + key, csv_field(value)});
    };
    append_csv_line(csv, {"# " + format});
    line("run", run.run_id);
    line("certificate_number", run.statements.certificate_number);
    if (!one.replaces.empty()) line("replaces", one.replaces);
    line("machine", run.statements.machine);
    line("machine_serial", run.statements.machine_serial);
    line("axis", run.statements.axis);
    line("direction", one.optics().across);
    line("standard", "ISO 230-1:2012");
    line("reference", std::string{name_of(main_reference)});
    line("sign", sign);
    line("completeness", one.completeness.partial() ? "partial" : "complete");
    line("run_file_sha256", one.run_file_sha256);
    line("software_version", run.software_version);
}

void append_missing(std::string& csv, const std::vector<std::string>& not_stated) {
    for (const std::string& words : terms_in_words(not_stated))
        append_csv_line(csv, {"# preliminary", "not stated", csv_field(words)});
}

void append_every_deviation(std::string& csv, const StraightnessReadings& readings) {
    append_csv_line(csv, {"direction", "target_mm", "number", "deviation_um"});
    append_deviations_across(csv, "forward", readings.targets_mm, readings.forward_um);
    append_deviations_across(csv, "backward", readings.targets_mm, readings.backward_um);
}

} // namespace axiscal
