#include "acquisition/documents/pdf/front_parts.hpp"
#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/straightness/across_pages.hpp"
#include "acquisition/documents/straightness/across_remarks.hpp"

#include <algorithm>
#include <cstddef>

namespace axiscal {
namespace {

constexpr TextStyle across_warning{7.5, true, backward_vermilion};

std::string readings_of_plan(const Completeness& readings) {
    return std::to_string(readings.used) + " of " + std::to_string(readings.expected) +
           " planned readings";
}

std::string preliminary_text(const AcrossRun& one, const std::vector<std::string>& not_stated) {
    if (one.completeness.partial()) return "PARTIAL: " + readings_of_plan(one.completeness);
    std::string names;
    for (const std::string& term : not_stated)
        names += (names.empty() ? "" : ", ") + term;
    return names.empty() ? names : "PRELIMINARY, not stated: " + names;
}

void draw_deviations_of(Sheet& sheet, const AcrossRun& one, bool forward, int decimals) {
    const auto& readings = forward ? one.readings.forward_um : one.readings.backward_um;
    if (readings.empty()) return;
    std::size_t longest = 0;
    for (const auto& row : readings)
        longest = std::max(longest, row.size());
    std::vector<TableColumn> columns{TableColumn{"Target", "mm"}};
    for (std::size_t j = 0; j < longest; ++j)
        columns.push_back({(forward ? "↑ " : "↓ ") + std::to_string(j + 1), "µm"});
    std::vector<TableRow> rows;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        TableRow cells{fixed(one.readings.targets_mm[i], 3)};
        for (std::size_t j = 0; j < longest; ++j)
            cells.push_back(j < readings[i].size() ? fixed(readings[i][j], decimals) : "–");
        rows.push_back(std::move(cells));
    }
    sheet.table(columns, rows);
}

} // namespace

PageFrame across_frame_of(const AcrossRun& one,
                          const std::string& test,
                          const std::vector<std::string>& not_stated) {
    PageFrame frame = page_frame_of(one.run, one.run_file_sha256);
    frame.subject += ", " + test;
    if (!one.replaces.empty()) frame.certificate_number += ", replaces " + one.replaces;
    frame.preliminary = preliminary_text(one, not_stated);
    frame.numbered = !one.completeness.partial();
    return frame;
}

std::vector<StatedField> across_identity_fields(const AcrossRun& one) {
    auto fields = identity_fields(one.run.statements, dates_of_test(one.run));
    if (one.completeness.partial()) // they have no number, and nothing falls due
        std::erase_if(fields, [](const StatedField& field) {
            return field.key == "Certificate number" || field.key == "Next calibration due";
        });
    return fields;
}

std::string missing_on_paper(const std::vector<std::string>& not_stated) {
    std::string missing;
    for (const std::string& words : terms_in_words(not_stated))
        missing += (missing.empty() ? "" : "; ") + words;
    return missing;
}

void draw_what_is_missing(Sheet& sheet,
                          const AcrossRun& one,
                          const std::vector<std::string>& not_stated) {
    const std::string missing = missing_on_paper(not_stated);
    if (!missing.empty())
        sheet.text("Preliminary: the uncertainty budget lacks " + missing + ".", across_warning);
    if (one.completeness.partial())
        sheet.text("Partial: " + readings_of_plan(one.completeness) + ".", across_warning);
}

void draw_across_signatures(Sheet& sheet, const AcrossRun& one) {
    draw_signatures(sheet, one.run.statements,
                    {{"Run", stated(one.run.run_id)},
                     {"Run file SHA-256", stated(one.run_file_sha256)},
                     {"Result SHA-256", stated(one.result_digest)},
                     {"Software", "axiscal, version " + stated(one.run.software_version)}});
}

void draw_every_deviation(Sheet& sheet, const AcrossRun& one, int decimals) {
    sheet.heading("Every deviation");
    draw_deviations_of(sheet, one, true, decimals);
    draw_deviations_of(sheet, one, false, decimals);
    sheet.text("Since the datum, positive towards + of " + stated(one.optics().across) +
                   ". Readings that count, in the order in which they were taken.",
               note_style);
}

} // namespace axiscal
