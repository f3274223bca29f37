#pragma once
// Pages that fill from top to bottom: head and foot on each, a cursor between them, and tables that
// break over pages with their head repeated. Not thread-safe.

#include "acquisition/documents/pdf/page.hpp"

#include <functional>
#include <string>
#include <vector>

namespace axiscal {

/// What stands on every page.
struct PageFrame {
    std::string laboratory, certificate_number, subject;
    std::string foot;        ///< run, hash, software
    std::string preliminary; ///< empty when the certificate is final
    bool numbered = true;    ///< false: a partial result, which has no certificate number
};

struct TableColumn {
    std::string head, unit; ///< two lines; the unit prints grey
    Align align = Align::right;
    bool wraps = false; ///< takes what the others leave and breaks its text
};
using TableRow = std::vector<std::string>;

struct StatedField {
    std::string key, value;
};

/// Of what is said below a table, a plot or a set of fields.
inline constexpr TextStyle note_style{7, false, grey};

class Sheet {
public:
    static constexpr double left = 18 * points_per_mm, right = page_width - 18 * points_per_mm;
    static constexpr double top = 12 * points_per_mm, bottom = page_height - 12 * points_per_mm;
    static constexpr double width = right - left;

    /// @param total_pages  m of "page n of m"; 0 while counting.
    Sheet(PdfDocument& document, PageFrame frame, int total_pages);
    /// Ends the last page.
    void finish();

    Canvas& canvas() { return document_.canvas(); }
    [[nodiscard]] double y() const { return y_; }
    [[nodiscard]] double remaining() const { return content_bottom - y_; }
    void advance(double height) { y_ += height; }
    /// Begins a new page when less than `height` is left.
    void require(double height);
    void new_page();

    void rule();
    /// Heading that stays together with the next `with` points.
    void heading(std::string_view words, double with = 60);
    /// Wrapped text over the full width, breaking between paragraphs only.
    void text(std::string_view words, TextStyle style = {});
    /// Keys and values in `columns` columns, values at most `lines` lines each (0: any).
    /// @returns the fields that were shortened: print them in full elsewhere.
    std::vector<StatedField>
    fields(const std::vector<StatedField>& fields, int columns, int lines = 0);
    /// Column widths are measured, never typed. A table that is too wide prints smaller.
    /// @returns whether a cell was shortened (only with lines > 0).
    bool table(const std::vector<TableColumn>& columns,
               const std::vector<TableRow>& rows,
               double size = 7.5,
               int lines = 0);

private:
    static constexpr double content_top = top + 34, content_bottom = bottom - 16;
    void begin_page();
    void draw_preliminary();
    void end_page();

    PdfDocument& document_;
    PageFrame frame_;
    int total_pages_;
    double y_ = content_top;
};

/// What a PDF says of itself; `created` is an ISO 8601 instant taken from the run.
struct PdfLabel {
    std::string title, subject, created;
};

/// The bytes of a document whose pages say "page n of m": drawn once to be counted, then for good.
/// @param draw_pages  draws everything on the sheet it is given; called twice.
/// @errors Fault::not_found without the font; Fault::refused naming a text that the font cannot
/// print; Fault::io from Cairo.
Result<std::string> render_pages(const PdfLabel& label,
                                 const PageFrame& frame,
                                 const std::function<void(Sheet&)>& draw_pages);

} // namespace axiscal
