// Fields and tables of a Sheet: every width is measured, every page break repeats the head.

#include "acquisition/documents/pdf/sheet.hpp"

#include <algorithm>
#include <numeric>

namespace axiscal {
namespace {

constexpr double least_gap = 7, largest_gap = 60, row_padding = 1.6;

/// Where the columns of one table stand.
struct TableGrid {
    double size = 7.5;
    std::vector<double> starts, widths;
};

std::vector<double> natural_widths(Canvas& canvas,
                                   const std::vector<TableColumn>& columns,
                                   const std::vector<TableRow>& rows,
                                   double size) {
    std::vector<double> widths(columns.size());
    for (std::size_t c = 0; c < columns.size(); ++c) {
        widths[c] = std::max(canvas.width_of(columns[c].head, {size, true}),
                             canvas.width_of(columns[c].unit, {size - 1}));
        for (const TableRow& row : rows)
            widths[c] = std::max(widths[c], canvas.width_of(row[c], {size}));
        widths[c] += 0.5; // rounding of Pango units must not wrap a cell that fits
    }
    return widths;
}

double sum(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Shrinks the wrapping columns, widest first, until the table fits; never below their heads.
void shrink_wrapping(Canvas& canvas,
                     const std::vector<TableColumn>& columns,
                     std::vector<double>& widths,
                     double size,
                     double room) {
    constexpr double step = 2;
    const std::vector<double> least = natural_widths(canvas, columns, {}, size);
    while (sum(widths) > room) {
        std::size_t widest = columns.size();
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const bool may_shrink = columns[c].wraps && widths[c] - step >= least[c];
            if (may_shrink && (widest == columns.size() || widths[c] > widths[widest])) widest = c;
        }
        if (widest == columns.size()) return;
        widths[widest] -= step;
    }
}

TableGrid lay_out(Canvas& canvas,
                  const std::vector<TableColumn>& columns,
                  const std::vector<TableRow>& rows,
                  double size) {
    constexpr double smallest = 4.5;
    const auto gaps = static_cast<double>(columns.size() > 1 ? columns.size() - 1 : 1);
    TableGrid grid{size, {}, natural_widths(canvas, columns, rows, size)};
    const double room = Sheet::width - gaps * least_gap;
    shrink_wrapping(canvas, columns, grid.widths, grid.size, room);
    while (sum(grid.widths) > room && grid.size > smallest) {
        grid.size -= 0.25;
        grid.widths = natural_widths(canvas, columns, rows, grid.size);
        shrink_wrapping(canvas, columns, grid.widths, grid.size, room);
    }
    const double gap = std::clamp((Sheet::width - sum(grid.widths)) / gaps, least_gap, largest_gap);
    double x = Sheet::left;
    for (const double column_width : grid.widths) {
        grid.starts.push_back(x);
        x += column_width + gap;
    }
    return grid;
}

double anchor(const TableGrid& grid, std::size_t c, Align align) {
    if (align == Align::left) return grid.starts[c];
    return grid.starts[c] + grid.widths[c] * (align == Align::right ? 1 : 0.5);
}

double right_edge(const TableGrid& grid) {
    return grid.starts.back() + grid.widths.back();
}

bool has_units(const std::vector<TableColumn>& columns) {
    return std::ranges::any_of(columns, [](const TableColumn& c) { return !c.unit.empty(); });
}

double head_height(const std::vector<TableColumn>& columns, double size) {
    return size * (has_units(columns) ? 2.5 : 1.4) + 4;
}

void draw_head(Sheet& sheet, const std::vector<TableColumn>& columns, const TableGrid& grid) {
    Canvas& canvas = sheet.canvas();
    const double first = sheet.y() + grid.size;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const double x = anchor(grid, c, columns[c].align);
        canvas.text({x, first}, columns[c].head, {grid.size, true}, columns[c].align);
        canvas.text({x, first + grid.size * 1.1}, columns[c].unit, {grid.size - 1, false, grey},
                    columns[c].align);
    }
    sheet.advance(head_height(columns, grid.size));
    canvas.line({Sheet::left, sheet.y() - 2}, {right_edge(grid), sheet.y() - 2}, {ink, 0.5});
}

double row_height(Canvas& canvas,
                  const std::vector<TableColumn>& columns,
                  const TableRow& row,
                  const TableGrid& grid,
                  int lines) {
    double height = canvas.measure_paragraph(Sheet::width, "0", {grid.size}).height;
    for (std::size_t c = 0; c < columns.size(); ++c)
        if (columns[c].wraps)
            height = std::max(
                height,
                canvas.measure_paragraph(grid.widths[c], row[c], {grid.size}, lines).height);
    return height + 2 * row_padding;
}

bool draw_row(Sheet& sheet,
              const std::vector<TableColumn>& columns,
              const TableRow& row,
              const TableGrid& grid,
              double height,
              int lines) {
    Canvas& canvas = sheet.canvas();
    bool shortened = false;
    const double y = sheet.y() + row_padding;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const double baseline = y + grid.size * 0.93; // ascent of DejaVu Sans
        if (columns[c].wraps)
            shortened |=
                canvas.paragraph({grid.starts[c], y}, grid.widths[c], row[c], {grid.size}, lines)
                    .shortened;
        else
            canvas.text({anchor(grid, c, columns[c].align), baseline}, row[c], {grid.size},
                        columns[c].align);
    }
    sheet.advance(height);
    canvas.line({Sheet::left, sheet.y()}, {right_edge(grid), sheet.y()}, {pale, 0.3});
    return shortened;
}

/// A table that fits on one page is not broken for a few rows.
void keep_together(Sheet& sheet,
                   const std::vector<TableColumn>& columns,
                   const std::vector<TableRow>& rows,
                   const TableGrid& grid,
                   int lines) {
    constexpr double largest = page_height * 0.45;
    double height = head_height(columns, grid.size);
    for (const TableRow& row : rows) {
        height += row_height(sheet.canvas(), columns, row, grid, lines);
        if (height > largest) return;
    }
    sheet.require(height);
}

} // namespace

bool Sheet::table(const std::vector<TableColumn>& columns,
                  const std::vector<TableRow>& rows,
                  double size,
                  int lines) {
    const TableGrid grid = lay_out(canvas(), columns, rows, size);
    keep_together(*this, columns, rows, grid, lines);
    bool shortened = false, head_drawn = false;
    for (const TableRow& row : rows) {
        const double height = row_height(canvas(), columns, row, grid, lines);
        const double head = head_drawn ? 0 : head_height(columns, grid.size);
        if (remaining() < height + head && y_ > content_top) {
            new_page();
            head_drawn = false;
        }
        if (!head_drawn) draw_head(*this, columns, grid);
        head_drawn = true;
        shortened |= draw_row(*this, columns, row, grid, height, lines);
    }
    y_ += 5;
    return shortened;
}

std::vector<StatedField>
Sheet::fields(const std::vector<StatedField>& fields, int columns, int lines) {
    constexpr TextStyle key_style{7.5, false, grey}, value_style{7.5};
    constexpr double gutter = 12, key_gap = 6;
    const auto count = static_cast<std::size_t>(columns);
    const double column_width = (width - gutter * (columns - 1)) / columns;
    std::vector<double> key_widths(count, 0);
    for (std::size_t i = 0; i < fields.size(); ++i)
        key_widths[i % count] =
            std::max(key_widths[i % count], canvas().width_of(fields[i].key, key_style) + key_gap);
    std::vector<StatedField> shortened;
    for (std::size_t first = 0; first < fields.size(); first += count) {
        const std::size_t last = std::min(first + count, fields.size());
        double height = 0;
        for (std::size_t i = first; i < last; ++i)
            height = std::max(height, canvas()
                                          .measure_paragraph(column_width - key_widths[i - first],
                                                             fields[i].value, value_style, lines)
                                          .height);
        require(height);
        for (std::size_t i = first; i < last; ++i) {
            const double x = left + static_cast<double>(i - first) * (column_width + gutter);
            const double key_width = key_widths[i - first];
            canvas().paragraph({x, y_}, key_width, fields[i].key, key_style);
            if (canvas()
                    .paragraph({x + key_width, y_}, column_width - key_width, fields[i].value,
                               value_style, lines)
                    .shortened)
                shortened.push_back(fields[i]);
        }
        y_ += height + 2;
    }
    return shortened;
}

} // namespace axiscal
