#include "acquisition/documents/circular/circular_report.hpp"

#include "acquisition/documents/circular/circular_pages.hpp"
#include "acquisition/documents/circular/circular_paper.hpp"
#include "acquisition/documents/circular/circular_wording.hpp"

namespace axiscal {
namespace {

std::string plane_text(const CircularCertificate& certificate) {
    return "plane " + certificate.measured.axes[0] + certificate.measured.axes[1];
}

std::string title_of(const CircularCertificate& certificate) {
    const CircularMeasurement& measured = certificate.measured;
    return (measured.taken_elsewhere ? "Report of a circular test " : "Calibration certificate ") +
           stated(measured.run.statements.certificate_number) + ", " + plane_text(certificate);
}

/// What is missing, in words that fit a page's head; empty when nothing is.
std::string preliminary_text(const CircularCertificate& certificate) {
    if (!certificate.preliminary) return {};
    if (!certificate.budget) return "PRELIMINARY: no uncertainty budget";
    std::string names;
    for (const MissingTerm& term : certificate.missing)
        names += (names.empty() ? "" : ", ") + term.name;
    return "PRELIMINARY, not stated: " + names;
}

PageFrame frame_of(const CircularCertificate& certificate) {
    const CircularMeasurement& measured = certificate.measured;
    const Statements& said = measured.run.statements;
    constexpr std::size_t digits_of_hash = 16;
    PageFrame frame;
    frame.laboratory = said.laboratory.empty() ? "Laboratory not stated" : said.laboratory;
    frame.certificate_number = stated(said.certificate_number);
    frame.subject = stated(said.machine) + ", serial " + stated(said.machine_serial) + ", " +
                    plane_text(certificate);
    frame.foot = (measured.taken_elsewhere ? "Case " : "Run ") + stated(measured.run.run_id) +
                 (measured.taken_elsewhere ? " · case file SHA-256 " : " · run file SHA-256 ") +
                 stated(certificate.file_sha256.substr(0, digits_of_hash)) + "… · axiscal " +
                 stated(measured.run.software_version);
    if (!certificate.replaces.empty())
        frame.certificate_number += ", replaces " + certificate.replaces;
    frame.preliminary = preliminary_text(certificate);
    return frame;
}

/// ISO 8601, or empty: a case need not tell its date.
std::string creation_of(const CircularMeasurement& measured) {
    const std::string date = iso_date_of(measured);
    const bool date_alone = measured.finished_utc.size() == date.size();
    if (date.empty()) return {};
    return date_alone ? date + "T00:00:00Z" : measured.finished_utc;
}

} // namespace

Result<std::string> render_circular_pdf(const CircularCertificate& certificate) {
    return render_pages(
        {title_of(certificate), "ISO 230-4 circular test", creation_of(certificate.measured)},
        frame_of(certificate), [&](Sheet& sheet) {
            const auto shortened = draw_circular_front_page(sheet, certificate);
            draw_circular_plot_pages(sheet, certificate);
            draw_circular_diagnosis(sheet, certificate);
            draw_circular_condition_pages(sheet, certificate, shortened);
        });
}

Result<std::string> PaperOf<CircularCertificate>::pdf(const CircularCertificate& one) {
    return render_circular_pdf(one);
}

} // namespace axiscal
