#include "acquisition/documents/pdf/sheet.hpp"

#include <algorithm>

namespace axiscal {

Sheet::Sheet(PdfDocument& document, PageFrame frame, int total_pages)
    : document_{document}
    , frame_{std::move(frame)}
    , total_pages_{total_pages} {
    begin_page();
}

void Sheet::begin_page() {
    const std::string page =
        "page " + std::to_string(document_.pages() + 1) + " of " + std::to_string(total_pages_);
    const TextStyle small{7.5, false, grey};
    const double page_room = canvas().width_of(page, {7.5, true}) + 12;
    canvas().text({right, top + 8}, page, {7.5, true}, Align::right);
    canvas().paragraph({left, top}, width * 0.5, frame_.laboratory, {7.5, true}, 1);
    canvas().paragraph({left + width * 0.52, top}, width * 0.48 - page_room,
                       frame_.numbered ? "Certificate No. " + frame_.certificate_number
                                       : "No certificate",
                       {7.5}, 1);
    canvas().paragraph({left, top + 11}, width * 0.5, frame_.subject, small, 1);
    draw_preliminary();
    canvas().line({left, top + 25}, {right, top + 25}, {ink, 0.6});
    canvas().line({left, bottom - 11}, {right, bottom - 11}, {pale, 0.6});
    canvas().paragraph({left, bottom - 9}, width, frame_.foot, {6.5, false, grey}, 1);
    y_ = content_top;
}

/// In one line, smaller when there is much to say.
void Sheet::draw_preliminary() {
    constexpr double room = width * 0.48, smallest = 5;
    TextStyle style{7.5, true, backward_vermilion};
    while (style.size > smallest && canvas().width_of(frame_.preliminary, style) > room)
        style.size -= 0.25;
    canvas().paragraph({left + width * 0.52, top + 11}, room, frame_.preliminary, style, 1);
}

void Sheet::end_page() {
    document_.end_page();
}

void Sheet::finish() {
    end_page();
}

void Sheet::new_page() {
    end_page();
    begin_page();
}

void Sheet::require(double height) {
    if (remaining() < height && y_ > content_top) new_page();
}

void Sheet::rule() {
    canvas().line({left, y_}, {right, y_}, {pale, 0.6});
    y_ += 5;
}

void Sheet::heading(std::string_view words, double with) {
    require(with + 20);
    y_ += y_ > content_top ? 9 : 0;
    canvas().text({left, y_ + 10}, words, {10, true});
    y_ += 17;
}

void Sheet::text(std::string_view words, TextStyle style) {
    require(canvas().measure_paragraph(width, words, style).height);
    y_ += canvas().paragraph({left, y_}, width, words, style).height + 2;
}

Result<std::string> render_pages(const PdfLabel& label,
                                 const PageFrame& frame,
                                 const std::function<void(Sheet&)>& draw_pages) {
    AXISCAL_CHECK(check_certificate_font());
    const auto draw = [&](PdfDocument& document, int total_pages) {
        Sheet sheet{document, frame, total_pages};
        draw_pages(sheet);
        sheet.finish();
    };
    PdfDocument counting{label.title, label.subject, label.created};
    draw(counting, 0);
    PdfDocument document{label.title, label.subject, label.created};
    draw(document, counting.pages());
    return document.finish();
}

} // namespace axiscal
