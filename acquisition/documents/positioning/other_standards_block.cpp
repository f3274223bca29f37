#include "acquisition/documents/positioning/certificate_pages.hpp"

#include <algorithm>

namespace axiscal {
namespace {

std::string
value_in(const NamedFigures& figures, const std::string& name, const PaperUnits& units) {
    const auto found = std::ranges::find(figures, name, &NamedFigure::name);
    return found == figures.end() ? "–" : units.of_deviation(found->value);
}

/// Every figure of any of them, in the order in which they come.
std::vector<std::string> names_of(const NamedFigures& own, const std::vector<OtherResult>& others) {
    std::vector<std::string> names;
    const auto add = [&names](const NamedFigures& figures) {
        for (const NamedFigure& figure : figures)
            if (std::ranges::find(names, figure.name) == names.end()) names.push_back(figure.name);
    };
    add(own);
    for (const OtherResult& other : others)
        add(other.parameters);
    return names;
}

void draw_notes(Sheet& sheet, const OtherResult& other) {
    std::string words = other.standard + ": formulas " + other.confidence;
    if (!other.note.empty()) words += "; " + other.note;
    for (const std::string& note : other.notes)
        words += "; " + note;
    for (const auto& [name, reason] : other.not_evaluated)
        words += "; " + positioning_symbol(name) + " not evaluated: " + reason;
    sheet.text(words + ".", note_style);
}

} // namespace

void draw_other_standards(Sheet& sheet, const Certificate& certificate) {
    if (certificate.others.empty()) return;
    const PaperUnits units = paper_units_of(certificate);
    const NamedFigures own = named_figures(certificate.result.parameters);
    std::vector<TableColumn> columns{{"Figure", "", Align::left},
                                     {certificate.result.standard, units.deviation}};
    for (const OtherResult& other : certificate.others)
        columns.push_back({other.standard, units.deviation});
    std::vector<TableRow> rows;
    for (const std::string& name : names_of(own, certificate.others)) {
        TableRow row{positioning_symbol(name), value_in(own, name, units)};
        for (const OtherResult& other : certificate.others)
            row.push_back(value_in(other.parameters, name, units));
        rows.push_back(std::move(row));
    }
    sheet.heading("The same readings by other standards");
    sheet.table(columns, rows);
    for (const OtherResult& other : certificate.others)
        draw_notes(sheet, other);
}

} // namespace axiscal
