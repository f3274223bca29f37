#pragma once
// Drawing primitives of the certificate over Cairo and Pango, in points (1/72 inch) from the top
// left corner of an A4 page. One face only: DejaVu Sans, with font fallback switched off, because a
// minus sign or an arrow that silently comes from another face looks wrong and raises no error.

#include "analysis/quantity/result.hpp"

#include <cairo.h>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace axiscal {

inline constexpr double points_per_mm = 72.0 / 25.4;
inline constexpr double page_width = 210 * points_per_mm, page_height = 297 * points_per_mm;

struct Colour {
    double red = 0, green = 0, blue = 0;
};
/// Okabe-Ito blue and vermilion: far apart for colour-blind eyes, and on a copier the two
/// directions also differ by solid and dashed.
inline constexpr Colour ink{}, grey{0.42, 0.42, 0.42}, pale{0.86, 0.86, 0.86},
    forward_blue{0.0, 0.447, 0.698}, backward_vermilion{0.835, 0.369, 0.0};

enum class Align { left, centre, right };

struct TextStyle {
    double size = 8; ///< points
    bool bold = false;
    Colour colour = ink;
};

struct Stroke {
    Colour colour = ink;
    double width = 0.6;
    bool dashed = false;
};

struct PagePoint {
    double x = 0, y = 0;
};

struct PageBox {
    double x = 0, y = 0, width = 0, height = 0;
    [[nodiscard]] double right() const { return x + width; }
    [[nodiscard]] double bottom() const { return y + height; }
};

/// Height and completeness of a paragraph.
struct ParagraphExtent {
    double height = 0;
    bool shortened = false; ///< the text did not fit into `lines` and ends in an ellipsis
};

/// What one can draw. Borrows the cairo_t. Not thread-safe.
class Canvas {
public:
    explicit Canvas(cairo_t* cr)
        : cr_{cr} {}

    /// One line of text with its baseline at `at`. Returns its width. Here and in paragraph() a
    /// letter that the font lacks is printed as its code point, [U+5DE5].
    double text(PagePoint at, std::string_view words, TextStyle style = {}, Align = Align::left);
    double width_of(std::string_view words, TextStyle style = {});
    /// Wrapped text whose first line's top lies at `top_left`, at most `lines` lines (0: any).
    ParagraphExtent paragraph(PagePoint top_left,
                              double width,
                              std::string_view words,
                              TextStyle style = {},
                              int lines = 0);
    /// The same without drawing.
    ParagraphExtent
    measure_paragraph(double width, std::string_view words, TextStyle style = {}, int lines = 0);

    void line(PagePoint from, PagePoint to, Stroke stroke = {});
    void polyline(const std::vector<PagePoint>& points, Stroke stroke = {});
    /// Translucent area inside `border`: opaque bands would hide each other.
    void area(const std::vector<PagePoint>& border, Colour fill, double opacity);
    void box(PageBox box, Stroke stroke = {});
    void fill(PageBox box, Colour colour);
    void dot(PagePoint centre, double radius, Colour colour, double opacity = 1);
    /// A solid circle.
    void ring(PagePoint centre, double radius, Stroke stroke = {});
    /// Filled triangle pointing right (+1) or left (-1). Drawn, not typed.
    void arrow(PagePoint centre, double direction, Colour colour, double size = 2.6);
    /// Filled triangle whose tip shows along `angle_rad`: 0 to the right, counter-clockwise.
    void pointer(PagePoint centre, double angle_rad, Colour colour, double size = 2.6);

private:
    void source(Colour colour, double opacity = 1);
    cairo_t* cr_;
};

/// A4 PDF kept in memory: equal calls give equal bytes. Not thread-safe.
class PdfDocument {
public:
    /// @param created  ISO 8601 instant taken from the run (the library would ask the clock).
    PdfDocument(const std::string& title, const std::string& subject, const std::string& created);
    ~PdfDocument();
    PdfDocument(const PdfDocument&) = delete;
    PdfDocument& operator=(const PdfDocument&) = delete;

    Canvas& canvas() { return canvas_; }
    void end_page();
    [[nodiscard]] int pages() const { return pages_; }
    /// Closes the document. @errors Fault::io from Cairo.
    Result<std::string> finish();

private:
    std::unique_ptr<std::string> bytes_; ///< address handed to Cairo's stream
    cairo_surface_t* surface_;
    cairo_t* cr_;
    Canvas canvas_;
    int pages_ = 0;
};

/// @errors Fault::not_found when DejaVu Sans is not installed, naming the Debian package.
Result<void> check_certificate_font();

} // namespace axiscal
