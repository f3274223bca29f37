#include "acquisition/documents/pdf/front_parts.hpp"

#include "acquisition/documents/pdf/wording.hpp"
#include "analysis/record/certificate_expiry.hpp"

#include <algorithm>

namespace axiscal {

namespace {

/// Two lines in a frame; a long name of a machine is cut, its full text stands among the fields.
void draw_answer(Sheet& sheet, const FrontAnswer& answer) {
    Canvas& canvas = sheet.canvas();
    constexpr TextStyle item{11, true}, date{11, true}, verdict{13, true}, figure{11, true};
    constexpr double height = 40, inset = 7, gap = 12;
    const PageBox box{Sheet::left, sheet.y() + 4, Sheet::width, height};
    canvas.box(box, {ink, 1.2});
    const double left = box.x + inset, right = box.right() - inset;
    const double date_room = canvas.width_of(answer.date, date) + gap;
    canvas.paragraph({left, box.y + 3}, right - left - date_room, answer.item, item, 1);
    canvas.text({right, box.y + 14}, answer.date, date, Align::right);
    const double figure_room = canvas.width_of(answer.figure, figure) + gap;
    canvas.paragraph({left, box.y + 20}, right - left - figure_room, answer.verdict, verdict, 1);
    canvas.text({right, box.y + 32}, answer.figure, figure, Align::right);
    sheet.advance(height + 8);
}

} // namespace

std::string machine_in_answer(const Statements& said) {
    return said.machine.empty() ? "machine not stated" : said.machine;
}

void draw_front_title(Sheet& sheet, const FrontTitle& title) {
    Canvas& canvas = sheet.canvas();
    const std::string state = "State: " + stated(title.state);
    constexpr TextStyle state_style{9, true};
    constexpr double state_room = Sheet::width * 0.4;
    const double box_width = std::min(state_room, canvas.width_of(state, state_style) + 14);
    const PageBox box{Sheet::right - box_width, sheet.y() + 1, box_width, 17};
    canvas.box(box, {ink, 0.8});
    canvas.paragraph({box.x + 7, box.y + 3}, box.width - 13, state, state_style, 1);
    canvas.text({Sheet::left, sheet.y() + 15}, title.title, {16, true});
    sheet.advance(22);
    sheet.text(title.subject, {8});
    draw_answer(sheet, title.answer);
}

PageFrame page_frame_of(const RunRecord& run, const std::string& run_file_sha256) {
    constexpr std::size_t digits_of_hash = 16;
    const Statements& said = run.statements;
    PageFrame frame;
    frame.laboratory = said.laboratory.empty() ? "Laboratory not stated" : said.laboratory;
    frame.certificate_number = stated(said.certificate_number);
    frame.subject = stated(said.machine) + ", serial " + stated(said.machine_serial);
    frame.foot = "Run " + stated(run.run_id) + " · run file SHA-256 " +
                 stated(run_file_sha256.substr(0, digits_of_hash)) + "… · axiscal " +
                 stated(run.software_version);
    return frame;
}

CertificateDates dates_of_test(const RunRecord& run) {
    constexpr std::size_t length_of_date = 10;
    const std::string started = iso8601_utc(run.opened.utc_ns);
    const std::string finished = iso8601_utc(run.closed.utc_ns);
    return {measured_span(started, finished), finished.substr(0, length_of_date),
            next_due_of(run.statements, run.closed.utc_ns)};
}

std::vector<StatedField> identity_fields(const Statements& said, const CertificateDates& dates) {
    return {{"Laboratory", stated(said.laboratory)},
            {"Certificate number", stated(said.certificate_number)},
            {"Customer", stated(said.customer)},
            {"Measured", dates.measured},
            {"Place", stated(said.place)},
            {"Issued on", stated(dates.issued_on)},
            {"Machine", stated(said.machine)},
            {"Next calibration due", stated(dates.next_due)},
            {"Maker", stated(said.machine_maker)},
            {"Procedure", stated(said.procedure)},
            {"Serial number", stated(said.machine_serial)},
            {"Control compensation", stated(said.control_compensation)}};
}

std::string measured_span(const std::string& started_utc, const std::string& finished_utc) {
    std::string begin = readable_instant(started_utc);
    const std::string end = readable_instant(finished_utc);
    if (begin == end) return begin;
    const bool one_day = begin.size() == 23 && end.size() == 23 && // "2026-01-02 08:15:03 UTC"
                         begin.substr(0, 10) == end.substr(0, 10);
    return one_day ? begin.substr(0, 16) + " to " + end.substr(11, 5) + " UTC"
                   : begin + " to " + end;
}

void draw_front_instruments(Sheet& sheet,
                            const std::vector<InstrumentRecord>& instruments,
                            const std::string& run_date,
                            std::vector<StatedField>& shortened) {
    constexpr std::size_t on_front = 5;
    std::vector<TableRow> rows;
    for (std::size_t i = 0; i < std::min(instruments.size(), on_front); ++i)
        rows.push_back(instrument_row(instruments[i], run_date));
    if (rows.empty()) sheet.text("Instruments: not stated", {7.5});
    const bool cut = sheet.table(instrument_columns(), rows, 7.5, 2);
    sheet.advance(-2);
    const bool more = instruments.size() > on_front;
    if (more)
        sheet.text(std::to_string(instruments.size() - on_front) +
                       " more instruments: see \"Instruments\" on the last pages.",
                   {7, false, grey});
    if (more || cut) shortened.push_back({"Instruments", ""});
}

namespace {

void draw_signature(Canvas& canvas, PageBox box, const char* role, const std::string& name) {
    canvas.text({box.x, box.y + 9}, role, {7.5, false, grey});
    canvas.paragraph({box.x + 46, box.y + 1.6}, box.width - 46, stated(name), {7.5}, 1);
    const double line = box.y + 38;
    canvas.line({box.x, line}, {box.x + box.width * 0.62, line});
    canvas.line({box.x + box.width * 0.68, line}, {box.right(), line});
    canvas.text({box.x, line + 9}, "signature", {6.5, false, grey});
    canvas.text({box.x + box.width * 0.68, line + 9}, "date", {6.5, false, grey});
}

} // namespace

void draw_signatures(Sheet& sheet,
                     const Statements& said,
                     const std::vector<StatedField>& evidence,
                     const char* traceability) {
    Canvas& canvas = sheet.canvas();
    const double y = sheet.y() + sheet.remaining() - signature_height;
    canvas.line({Sheet::left, y}, {Sheet::right, y}, {pale, 0.6});
    constexpr double column = (Sheet::width - 24) / 2;
    draw_signature(canvas, {Sheet::left, y + 4, column, 50}, "Operator", said.operator_name);
    draw_signature(canvas, {Sheet::left + column + 24, y + 4, column, 50}, "Approver",
                   said.approver);
    double line = y + 66;
    for (const StatedField& field : evidence) {
        canvas.text({Sheet::left, line}, field.key, {7, false, grey});
        canvas.paragraph({Sheet::left + 88, line - 6.6}, Sheet::width - 88, field.value, {7}, 1);
        line += 10;
    }
    canvas.text({Sheet::left, line}, traceability, {7, false, grey});
}

std::vector<TableColumn> instrument_columns() {
    return {{"Instrument", "", Align::left, true},
            {"Serial", "", Align::left, true},
            {"Certificate", "", Align::left, true},
            {"Calibrated", "", Align::left, true},
            {"Due", "", Align::left, true}};
}

TableRow instrument_row(const InstrumentRecord& instrument, const std::string& run_date) {
    std::string model = instrument.maker;
    if (!model.empty() && !instrument.model.empty()) model += " ";
    model += instrument.model;
    return {instrument.name + ": " + stated(model), stated(instrument.serial),
            stated(instrument.certificate_number), stated(instrument.calibrated_on),
            stated(instrument.due_on) +
                (has_expired(instrument.due_on, run_date) ? ", expired" : "")};
}

} // namespace axiscal
