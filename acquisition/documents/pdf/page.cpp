#include "acquisition/documents/pdf/page.hpp"

#include "analysis/quantity/valid_text.hpp"

#include <array>
#include <cairo-pdf.h>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <pango/pangocairo.h>

namespace axiscal {
namespace {

constexpr const char* face = "DejaVu Sans";

struct GObjectRelease {
    void operator()(gpointer object) const { g_object_unref(object); }
};
using Layout = std::unique_ptr<PangoLayout, GObjectRelease>;

struct FontDescriptionFree {
    void operator()(PangoFontDescription* font) const { pango_font_description_free(font); }
};
using FontDescription = std::unique_ptr<PangoFontDescription, FontDescriptionFree>;

FontDescription description_of(const TextStyle& style) {
    FontDescription font{pango_font_description_new()};
    pango_font_description_set_family(font.get(), face);
    pango_font_description_set_absolute_size(font.get(), style.size * PANGO_SCALE);
    pango_font_description_set_weight(font.get(),
                                      style.bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
    return font;
}

void set_font(PangoLayout* layout, const TextStyle& style) {
    pango_layout_set_font_description(layout, description_of(style).get());
    PangoAttrList* attributes = pango_attr_list_new();
    pango_attr_list_insert(attributes, pango_attr_fallback_new(FALSE));
    pango_layout_set_attributes(layout, attributes);
    pango_attr_list_unref(attributes);
}

bool is_in_font(PangoLayout* layout, const std::string& text) {
    pango_layout_set_text(layout, text.c_str(), static_cast<int>(text.size()));
    return pango_layout_get_unknown_glyphs_count(layout) == 0;
}

/// A name may hold any letter, the certificate's one font does not: such a letter is printed as its
/// code point, [U+5DE5]. With `all` every letter beyond ASCII is: a sequence may lack its glyph
/// though each of its letters has one.
std::string with_code_points(PangoLayout* layout, const std::string& text, bool all) {
    std::string printed;
    for (const char *at = text.c_str(), *next = at; *at != 0; at = next) {
        next = g_utf8_next_char(at);
        const gunichar letter = g_utf8_get_char(at);
        const std::string own{at, next};
        if (letter < 0x80 || (!all && is_in_font(layout, own))) {
            printed += own;
            continue;
        }
        std::array<char, 16> code{};
        std::snprintf(code.data(), code.size(), "[U+%04X]", static_cast<unsigned>(letter));
        printed += code.data();
    }
    return printed;
}

/// Text that is not valid would stop Pango, and control characters would break lines.
void set_words(PangoLayout* layout, std::string_view words) {
    const std::string text = valid_text(words);
    if (is_in_font(layout, text)) return;
    if (is_in_font(layout, with_code_points(layout, text, false))) return;
    const std::string plain = with_code_points(layout, text, true);
    pango_layout_set_text(layout, plain.c_str(), static_cast<int>(plain.size()));
}

Layout make_layout(cairo_t* cr, std::string_view words, const TextStyle& style) {
    Layout layout{pango_cairo_create_layout(cr)};
    PangoContext* context = pango_layout_get_context(layout.get());
    pango_context_set_language(context, pango_language_from_string("en"));
    pango_context_set_round_glyph_positions(context, FALSE);
    set_font(layout.get(), style);
    set_words(layout.get(), words);
    return layout;
}

double points_of(int pango_units) {
    return static_cast<double>(pango_units) / PANGO_SCALE;
}

void limit_to(PangoLayout* layout, double width, int lines) {
    pango_layout_set_width(layout, static_cast<int>(width * PANGO_SCALE));
    pango_layout_set_wrap(layout, PANGO_WRAP_WORD_CHAR);
    if (lines <= 0) return;
    pango_layout_set_height(layout, -lines);
    pango_layout_set_ellipsize(layout, PANGO_ELLIPSIZE_END);
}

ParagraphExtent extent_of(PangoLayout* layout) {
    int height = 0;
    pango_layout_get_size(layout, nullptr, &height);
    return {points_of(height), pango_layout_is_ellipsized(layout) != 0};
}

cairo_status_t append(void* sink, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(sink)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

} // namespace

void Canvas::source(Colour colour, double opacity) {
    cairo_set_source_rgba(cr_, colour.red, colour.green, colour.blue, opacity);
}

double Canvas::text(PagePoint at, std::string_view words, TextStyle style, Align align) {
    const Layout layout = make_layout(cr_, words, style);
    int width_units = 0;
    pango_layout_get_size(layout.get(), &width_units, nullptr);
    const double width = points_of(width_units);
    const double shift = align == Align::left ? 0 : align == Align::right ? width : width / 2;
    source(style.colour);
    cairo_move_to(cr_, at.x - shift, at.y - points_of(pango_layout_get_baseline(layout.get())));
    pango_cairo_show_layout(cr_, layout.get());
    cairo_new_path(cr_); // Pango leaves a current point: the next line would start at this text
    return width;
}

double Canvas::width_of(std::string_view words, TextStyle style) {
    const Layout layout = make_layout(cr_, words, style);
    int width_units = 0;
    pango_layout_get_size(layout.get(), &width_units, nullptr);
    return points_of(width_units);
}

ParagraphExtent Canvas::paragraph(
    PagePoint top_left, double width, std::string_view words, TextStyle style, int lines) {
    const Layout layout = make_layout(cr_, words, style);
    limit_to(layout.get(), width, lines);
    source(style.colour);
    cairo_move_to(cr_, top_left.x, top_left.y);
    pango_cairo_show_layout(cr_, layout.get());
    cairo_new_path(cr_);
    return extent_of(layout.get());
}

ParagraphExtent
Canvas::measure_paragraph(double width, std::string_view words, TextStyle style, int lines) {
    const Layout layout = make_layout(cr_, words, style);
    limit_to(layout.get(), width, lines);
    return extent_of(layout.get());
}

void Canvas::line(PagePoint from, PagePoint to, Stroke stroke) {
    polyline({from, to}, stroke);
}

void Canvas::polyline(const std::vector<PagePoint>& points, Stroke stroke) {
    constexpr std::array dash{4.0, 2.5};
    cairo_new_path(cr_);
    for (const PagePoint& point : points)
        cairo_line_to(cr_, point.x, point.y);
    source(stroke.colour);
    cairo_set_line_width(cr_, stroke.width);
    cairo_set_line_join(cr_, CAIRO_LINE_JOIN_ROUND);
    if (stroke.dashed) cairo_set_dash(cr_, dash.data(), static_cast<int>(dash.size()), 0);
    cairo_stroke(cr_);
    cairo_set_dash(cr_, nullptr, 0, 0);
}

void Canvas::area(const std::vector<PagePoint>& border, Colour colour, double opacity) {
    cairo_new_path(cr_);
    for (const PagePoint& point : border)
        cairo_line_to(cr_, point.x, point.y);
    cairo_close_path(cr_);
    source(colour, opacity);
    cairo_fill(cr_);
}

void Canvas::box(PageBox box, Stroke stroke) {
    cairo_new_path(cr_);
    cairo_rectangle(cr_, box.x, box.y, box.width, box.height);
    source(stroke.colour);
    cairo_set_line_width(cr_, stroke.width);
    cairo_stroke(cr_);
}

void Canvas::fill(PageBox box, Colour colour) {
    cairo_new_path(cr_);
    cairo_rectangle(cr_, box.x, box.y, box.width, box.height);
    source(colour);
    cairo_fill(cr_);
}

void Canvas::dot(PagePoint centre, double radius, Colour colour, double opacity) {
    cairo_new_path(cr_);
    cairo_arc(cr_, centre.x, centre.y, radius, 0, 2 * std::numbers::pi);
    source(colour, opacity);
    cairo_fill(cr_);
}

void Canvas::ring(PagePoint centre, double radius, Stroke stroke) {
    cairo_new_path(cr_);
    cairo_arc(cr_, centre.x, centre.y, radius, 0, 2 * std::numbers::pi);
    cairo_close_path(cr_);
    source(stroke.colour);
    cairo_set_line_width(cr_, stroke.width);
    cairo_stroke(cr_);
}

void Canvas::pointer(PagePoint centre, double angle_rad, Colour colour, double size) {
    const double along_x = std::cos(angle_rad) * size, along_y = -std::sin(angle_rad) * size;
    cairo_new_path(cr_);
    cairo_move_to(cr_, centre.x + 1.2 * along_x, centre.y + 1.2 * along_y);
    cairo_line_to(cr_, centre.x - 0.8 * along_x - along_y, centre.y - 0.8 * along_y + along_x);
    cairo_line_to(cr_, centre.x - 0.8 * along_x + along_y, centre.y - 0.8 * along_y - along_x);
    cairo_close_path(cr_);
    source(colour);
    cairo_fill(cr_);
}

void Canvas::arrow(PagePoint centre, double direction, Colour colour, double size) {
    cairo_new_path(cr_);
    cairo_move_to(cr_, centre.x + 1.2 * size * direction, centre.y);
    cairo_line_to(cr_, centre.x - 0.8 * size * direction, centre.y - size);
    cairo_line_to(cr_, centre.x - 0.8 * size * direction, centre.y + size);
    cairo_close_path(cr_);
    source(colour);
    cairo_fill(cr_);
}

PdfDocument::PdfDocument(const std::string& title,
                         const std::string& subject,
                         const std::string& created)
    : bytes_{std::make_unique<std::string>()}
    , surface_{cairo_pdf_surface_create_for_stream(append, bytes_.get(), page_width, page_height)}
    , cr_{cairo_create(surface_)}
    , canvas_{cr_} {
    cairo_pdf_surface_restrict_to_version(surface_, CAIRO_PDF_VERSION_1_5);
    const auto state = [this](cairo_pdf_metadata_t key, const std::string& value) {
        cairo_pdf_surface_set_metadata(surface_, key, valid_text(value).c_str());
    };
    state(CAIRO_PDF_METADATA_TITLE, title);
    state(CAIRO_PDF_METADATA_SUBJECT, subject);
    state(CAIRO_PDF_METADATA_CREATOR, "axiscal");
    state(CAIRO_PDF_METADATA_CREATE_DATE, created);
}

PdfDocument::~PdfDocument() {
    cairo_destroy(cr_);
    cairo_surface_destroy(surface_);
}

void PdfDocument::end_page() {
    cairo_show_page(cr_);
    ++pages_;
}

Result<std::string> PdfDocument::finish() {
    cairo_surface_finish(surface_);
    const cairo_status_t status = cairo_surface_status(surface_);
    if (status != CAIRO_STATUS_SUCCESS)
        return fail(Fault::io,
                    std::string{"drawing the certificate: "} + cairo_status_to_string(status));
    return *bytes_;
}

Result<void> check_certificate_font() {
    PangoFontMap* map = pango_cairo_font_map_get_default(); // owned by Pango
    PangoFontFamily** families = nullptr;
    int count = 0;
    pango_font_map_list_families(map, &families, &count);
    bool found = false;
    for (int i = 0; i < count; ++i)
        found = found || std::string_view{pango_font_family_get_name(families[i])} == face;
    g_free(families);
    if (found) return {};
    return fail(Fault::not_found,
                "the font DejaVu Sans is not installed: apt install fonts-dejavu-core");
}

} // namespace axiscal
