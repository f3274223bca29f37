#include "acquisition/documents/pdf/back_parts.hpp"

#include "acquisition/documents/pdf/front_parts.hpp"
#include "acquisition/documents/pdf/wording.hpp"
#include "analysis/quantity/counted.hpp"

namespace axiscal {
namespace {

bool belongs_on_paper(const EventRecord& event) {
    switch (event.kind) {
    case EventKind::refused:
    case EventKind::skipped:
    case EventKind::interrupted:
    case EventKind::resumed:
    case EventKind::aborted:
    case EventKind::note:
    case EventKind::instrument: return true;
    default: return false;
    }
}

/// The sentence of the fault once: most texts of instruments hold it already, some of them with a
/// colon in the place of its full stop (describe()).
std::string words_of(const EventRecord& event) {
    std::string words = without_device_paths(event.text);
    const std::string sentence{fault_sentence(event.fault)};
    const std::string_view told = std::string_view{sentence}.substr(0, sentence.size() - 1);
    if (event.fault == Fault::none || words.find(told) != std::string::npos) return words;
    return words + (words.empty() ? "" : " · ") + sentence;
}

} // namespace

void draw_instruments(Sheet& sheet,
                      const std::vector<InstrumentRecord>& instruments,
                      const std::string& run_date) {
    std::vector<TableRow> rows;
    rows.reserve(instruments.size());
    for (const InstrumentRecord& instrument : instruments)
        rows.push_back(instrument_row(instrument, run_date));
    sheet.heading("Instruments");
    sheet.table(instrument_columns(), rows);
}

void draw_remarks(Sheet& sheet,
                  const std::vector<std::string>& remarks,
                  const std::vector<StatedField>& shortened) {
    std::vector<std::string> lines = remarks;
    for (const StatedField& field : shortened)
        if (!field.value.empty()) lines.push_back(field.key + " in full: " + field.value);
    if (lines.empty()) return sheet.text("Remarks: none.", {7.5}); // no page for one word
    sheet.heading("Remarks", 30);
    for (const std::string& line : lines)
        sheet.text("• " + line, {7.5});
}

void draw_events(Sheet& sheet, const std::vector<EventRecord>& events, const ClockTie& opened) {
    constexpr std::size_t most = 40;
    std::vector<TableRow> rows;
    std::size_t found = 0;
    for (const EventRecord& event : events) {
        if (!belongs_on_paper(event) || ++found > most) continue;
        const std::int64_t utc_ns = event.utc_ns ? event.utc_ns : opened.utc_ns_at(event.at);
        const std::string words = words_of(event);
        const std::string kind{name_of(event.kind)};
        if (!rows.empty() && rows.back()[1] == kind && rows.back()[2] == stated(words)) continue;
        rows.push_back({readable_instant(iso8601_utc(utc_ns)), kind, stated(words)});
    }
    if (rows.empty()) return;
    sheet.heading("Events");
    sheet.table({{"Time", "", Align::left},
                 {"Kind", "", Align::left},
                 {"What happened", "", Align::left, true}},
                rows, 7);
    if (found > most)
        sheet.text(counted(static_cast<long>(found - most), "more event") + ": see the run file.",
                   {7});
}

} // namespace axiscal
