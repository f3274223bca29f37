#include "acquisition/documents/positioning/certificate_pages.hpp"

#include <algorithm>

namespace axiscal {
namespace {

constexpr std::size_t deviations_in_a_row = 12;

/// Of the plan's targets, from 1.
std::string number_of(const Certificate& certificate, std::size_t row) {
    return std::to_string(certificate.completeness.targets[row] + 1);
}

void append_spread(TableRow& cells,
                   const PositionRow& row,
                   const PaperUnits& units,
                   bool backward) {
    cells.push_back(units.of_spread(row.s_forward));
    if (backward) cells.push_back(units.of_spread(row.s_backward));
    cells.push_back(units.of_deviation(row.repeatability_forward));
    if (!backward) return;
    cells.push_back(units.of_deviation(row.repeatability_backward));
    cells.push_back(units.of_deviation(row.repeatability));
}

void draw_statistics(Sheet& sheet, const Certificate& certificate) {
    const PaperUnits units = paper_units_of(certificate);
    const bool backward = !certificate.deviations.backward().empty();
    const bool spread = certificate.result.approaches > 1;
    const std::string& unit = units.deviation;
    std::vector<TableColumn> columns{
        {"i", ""}, {"Target P\u1d62", units.position}, {"mean ↑", unit}};
    if (backward) {
        columns.push_back({"mean ↓", unit});
        columns.push_back({"mean", unit});
        columns.push_back({"B\u1d62", unit});
    }
    if (spread)
        for (const char* head : {"s ↑", "s ↓", "R\u1d62 ↑", "R\u1d62 ↓", "R\u1d62"})
            if (backward || std::string_view{head}.ends_with("↑")) columns.push_back({head, unit});
    std::vector<TableRow> rows;
    for (const PositionRow& row : certificate.result.positions) {
        TableRow cells{number_of(certificate, rows.size()), units.of_position(row.target),
                       units.of_deviation(row.mean_forward)};
        if (backward)
            for (const auto& value : {row.mean_backward, row.mean, row.reversal})
                cells.push_back(units.of_deviation(value));
        if (spread) append_spread(cells, row, units, backward);
        rows.push_back(std::move(cells));
    }
    sheet.heading("Result per target");
    sheet.table(columns, rows);
}

/// One column of the table of single deviations.
struct ApproachColumn {
    const std::vector<std::vector<double>>* rows;
    std::size_t approach;
    std::string head;
};

void append_approaches(std::vector<ApproachColumn>& columns,
                       const std::vector<std::vector<double>>& rows,
                       std::size_t approaches,
                       const char* arrow) {
    if (rows.empty()) return;
    for (std::size_t j = 0; j < approaches; ++j)
        columns.push_back({&rows, j, arrow + std::string{" "} + std::to_string(j + 1)});
}

/// "-" where the reading is in no figure; the others keep the place of their approach. `row_index`:
/// of the tables of deviations.
std::string deviation_cell(const ApproachColumn& column,
                           std::size_t row_index,
                           const Certificate& certificate,
                           const PaperUnits& units) {
    const auto& row = (*column.rows)[row_index];
    const auto approaches = static_cast<std::size_t>(certificate.run.plan.approaches);
    if (row.size() == approaches) return units.of_deviation(row[column.approach]);
    const bool forward = column.rows == &certificate.deviations.forward();
    const int target = certificate.completeness.targets[row_index];
    std::size_t before = 0; // missing approaches of this row before this one
    for (const LeftOut& entry : certificate.completeness.left_out) {
        if (entry.target_index != target || (entry.direction == Direction::positive) != forward)
            continue;
        for (const int missing : entry.approaches) {
            const auto approach = static_cast<std::size_t>(missing);
            if (approach == column.approach) return "-";
            if (approach < column.approach) ++before;
        }
    }
    return units.of_deviation(row[column.approach - before]);
}

/// What no figure uses, each with its reason.
void draw_set_aside(Sheet& sheet, const Certificate& certificate) {
    if (certificate.set_aside.empty()) return;
    const PaperUnits units = paper_units_of(certificate);
    std::vector<TableRow> rows;
    rows.reserve(certificate.set_aside.size());
    for (const SetAside& reading : certificate.set_aside)
        rows.push_back({std::to_string(reading.planned.target_index + 1),
                        reading.planned.direction == Direction::positive ? "↑" : "↓",
                        std::to_string(reading.planned.approach + 1),
                        units.of_deviation(reading.deviation),
                        reading.superseded ? "replaced" : "excluded", reading.reason});
    sheet.heading("Readings that no figure uses");
    sheet.table({{"Target", ""},
                 {"Direction", ""},
                 {"Approach", ""},
                 {"Deviation", units.deviation},
                 {"", "", Align::left},
                 {"Reason", "", Align::left, true}},
                rows);
}

void draw_block(Sheet& sheet,
                const std::vector<ApproachColumn>& approaches,
                std::size_t first,
                std::size_t last,
                const Certificate& certificate) {
    const PaperUnits units = paper_units_of(certificate);
    std::vector<TableColumn> columns{{"i", ""}, {"Target P\u1d62", units.position}};
    for (std::size_t c = first; c < last; ++c)
        columns.push_back({approaches[c].head, units.deviation});
    const auto& targets = certificate.deviations.targets();
    std::vector<TableRow> rows;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        TableRow cells{number_of(certificate, i), units.of_position(targets[i])};
        for (std::size_t c = first; c < last; ++c)
            cells.push_back(deviation_cell(approaches[c], i, certificate, units));
        rows.push_back(std::move(cells));
    }
    sheet.table(columns, rows);
}

} // namespace

void draw_target_pages(Sheet& sheet, const Certificate& certificate) {
    sheet.new_page();
    draw_statistics(sheet, certificate);
    sheet.text("mean = (mean ↑ + mean ↓) / 2;  B\u1d62 = mean ↑ − mean ↓;  s: standard deviation "
               "of the n approaches (n − 1);  R\u1d62 ↑ = 2k s ↑;  R\u1d62 = largest of k s ↑ + "
               "k s ↓ + |B\u1d62|, R\u1d62 ↑ and R\u1d62 ↓.",
               {7, false, grey});
    sheet.heading("Every deviation x\u1d62\u2c7c (target i, approach j)");
    std::vector<ApproachColumn> approaches;
    const auto n = static_cast<std::size_t>(certificate.run.plan.approaches);
    append_approaches(approaches, certificate.deviations.forward(), n, "↑");
    append_approaches(approaches, certificate.deviations.backward(), n, "↓");
    for (std::size_t first = 0; first < approaches.size(); first += deviations_in_a_row)
        draw_block(sheet, approaches, first,
                   std::min(first + deviations_in_a_row, approaches.size()), certificate);
    draw_set_aside(sheet, certificate);
}

} // namespace axiscal
