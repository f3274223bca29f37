#pragma once
// What the first page of every certificate has: title, instruments, signatures with the evidence.

#include "acquisition/documents/pdf/sheet.hpp"
#include "analysis/record/run_record.hpp"

#include <string>
#include <vector>

namespace axiscal {

inline constexpr double signature_height = 112; ///< what draw_signatures() takes at the page's end

/// What is read in five seconds, from two metres or on a grey copy.
struct FrontAnswer {
    std::string item, date;      ///< "Axis X, portal mill"; "2026-01-02"
    std::string verdict, figure; ///< "FAIL: R"; "A = 16.4 µm ± 2.4 µm"
};
struct FrontTitle {
    std::string title, state, subject;
    FrontAnswer answer;
};
/// "Portal mill" | "machine not stated"
std::string machine_in_answer(const Statements& said);
void draw_front_title(Sheet& sheet, const FrontTitle& title);

/// What stands on every page of a run's document; `subject` names the machine, to be added to.
PageFrame page_frame_of(const RunRecord& run, const std::string& run_file_sha256);

/// When it was measured, and the ISO dates of the document itself; empty prints "not stated".
struct CertificateDates {
    std::string measured, issued_on, next_due;
};
/// Of a run that is issued on the day of its end; due as stated, else after a year.
CertificateDates dates_of_test(const RunRecord& run);

/// Who, what, where and when: the fields that every first page begins with.
std::vector<StatedField> identity_fields(const Statements& said, const CertificateDates& dates);

/// "2026-01-02 08:15 to 09:40 UTC"; both ends in full where they lie on different days.
std::string measured_span(const std::string& started_utc, const std::string& finished_utc);

/// The first few; the rest, or all when a text had to be shortened, follows on a later page: then
/// "Instruments" is added to `shortened`.
void draw_front_instruments(Sheet& sheet,
                            const std::vector<InstrumentRecord>& instruments,
                            const std::string& run_date,
                            std::vector<StatedField>& shortened);

inline constexpr const char* traced_by_instruments =
    "Traceability: through the certificates of the instruments named above.";
/// Of readings by others.
inline constexpr const char* traced_by_nobody =
    "Traceability: not stated. The readings are imported; no instrument is known here.";

/// At the end of the page: operator and approver, then four lines of evidence and one of
/// traceability.
void draw_signatures(Sheet& sheet,
                     const Statements& said,
                     const std::vector<StatedField>& evidence,
                     const char* traceability = traced_by_instruments);

/// Columns and rows of the instrument table. Pure.
std::vector<TableColumn> instrument_columns();
/// `run_date` is the ISO date on which the run was opened: a certificate due before it had expired.
TableRow instrument_row(const InstrumentRecord& instrument, const std::string& run_date);

} // namespace axiscal
